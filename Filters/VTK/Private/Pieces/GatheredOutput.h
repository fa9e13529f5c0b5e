// Hands the outputs that the first rank has computed to all ranks.
#ifndef GridFEM_GatheredOutput_h
#define GridFEM_GatheredOutput_h

#include "Pieces/DataMessage.h"
#include "Pieces/GatheredSurface.h"

class vtkDataObject;
class vtkPolyData;

namespace gridfem
{

/// The field arrays of the surface that the owners of pieces get back.
enum class GivenFieldArrays
{
  Shared,  // arrays that the owner lacks
  Withheld // none
};

/// Puts a rank's part of an output of the first rank, or of a block, into the message.
/// - An output with the cells of the gathered surface gives only its new data. These are the arrays
///   at the rank's own points and cells, copied ones included, and the places of moved points.
///   Points and cells that the gathered surface lacks get NaN for real numbers, -1 for ids and 0
///   for others.
/// - An output with cells of its own gives only the names of arrays. So does any output if the
///   first rank has all of the surface.
/// - Field arrays go to every rank. The tables of a clip and of a basis go only with its cells.
void PutPart(vtkDataObject* output, const GatheredSurface& input, int rank, DataMessage& message,
  GivenFieldArrays given = GivenFieldArrays::Shared);

/// Adds field arrays that another rank's filter has kept from its input to the outputs of ranks
/// whose inputs lack them. Takes them from the lowest rank that has them. Leaves out the tables of
/// a clip. Collective.
/// @param input  may be null
void ShareFieldArrays(vtkDataObject* input, vtkDataObject* output);

/// Makes an output of a rank from its part.
/// @param own     the rank's own surface
/// @param output  the rank's output; on the first rank, the output of all ranks
void TakePart(DataMessage& message, vtkPolyData* own, vtkDataObject* output);

} // namespace gridfem

#endif
