// Whether a filter's ranks can compute together, in every build.
#ifndef GridFEM_CanDistribute_h
#define GridFEM_CanDistribute_h

#include "Base/Errors.h"

#include <memory>

class vtkAlgorithm;
class vtkInformationVector;
class vtkPolyData;
class vtkSurfaceFEMAlgorithm;

namespace gridfem
{

class InputSurface;
class Stages;
struct FilterOptions;

/// Thrown on all ranks if one process has to compute on the whole surface: the parts of a triangle
/// with a hanging node may need a point of another rank.
struct NeedsWholeSurface : InvalidInput
{
  NeedsWholeSurface() : InvalidInput("The surface has hanging nodes, and ranks share it.") {}
};

/// Returns the surface of this rank's pieces. Null in a build without MPI.
std::unique_ptr<InputSurface> MakePieceSurface(
  Stages& stages, vtkAlgorithm* filter, const FilterOptions& options);

/// Whether all ranks can compute together, each with its piece on port 0. Otherwise rank 0 gathers
/// the surface. Only a basis and a selection may be connected to other ports, because ranks
/// together know no other inputs. Collective.
/// @param needsAll  the filter has to do something that needs the whole surface on one rank
bool CanDistribute(vtkSurfaceFEMAlgorithm* filter, vtkInformationVector** inputs, bool needsAll);

/// Whether a piece, which may be null, has polygons or strips.
bool HasPolygons(vtkPolyData* piece);

/// Whether SetInputArrayToProcess(index, ...) names an array.
bool IsArrayChosen(vtkSurfaceFEMAlgorithm* filter, int index);

} // namespace gridfem

#endif
