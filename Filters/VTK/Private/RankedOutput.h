// The outputs that the first rank has computed, handed to all ranks.
#ifndef GridFEM_RankedOutput_h
#define GridFEM_RankedOutput_h

#include "DataMessage.h"
#include "GatheredSurface.h"

class vtkDataObject;
class vtkPolyData;

namespace gridfem
{

/// What the owners of pieces get of the field arrays that the surface had before.
enum class GivenFieldArrays
{
  Shared,  // those that the owner lacks
  Withheld // none
};

/// Puts into the message what a rank gets of an output of the first rank, or a block of one that
/// the first block has. Where the output has the cells of the gathered surface, that is what is new
/// of it: arrays at the rank's own points and cells, copies of other ranks' ones as well, and the
/// places of points that have moved. Real numbers of points and cells that are nowhere in the whole
/// are NaN, others 0. Of an output with cells of its own, and where the first rank has all of the
/// surface, it is the names of arrays alone. Field arrays go to every rank, but for the tables of a
/// clip and of a basis, which go where its cells are.
void PutPart(vtkDataObject* output, const GatheredSurface& input, int rank, DataMessage& message,
  GivenFieldArrays given = GivenFieldArrays::Shared);

/// Collective. Field arrays of another rank's input that its filter has kept are added to the
/// outputs of ranks whose inputs lack them, those of the lowest rank that has them. Not the tables
/// of a clip.
/// @param input  may be null
void ShareFieldArrays(vtkDataObject* input, vtkDataObject* output);

/// Makes an output of a rank from its part.
/// @param own     the rank's own surface
/// @param output  on the first rank that of all ranks
void TakePart(DataMessage& message, vtkPolyData* own, vtkDataObject* output);

} // namespace gridfem

#endif
