// Whether a filter's ranks can compute together, in every build.
#ifndef GridFEM_CanDistribute_h
#define GridFEM_CanDistribute_h

#include <initializer_list>
#include <string>

class vtkInformationVector;
class vtkSurfaceFEMAlgorithm;

namespace gridfem
{

/// Collective. Whether all ranks can compute together, each with its piece on port 0: without
/// connections to ports behind that of a basis, other than selections, of which ranks together know
/// nothing. Where they cannot, the filter on the first rank warns and says why rank 0 gathers the
/// surface; not where there is none.
/// @param obstacle  what else the filter is asked for that only rank 0 can do; empty: nothing
bool CanDistribute(
  vtkSurfaceFEMAlgorithm* filter, vtkInformationVector** inputs, const std::string& obstacle);

/// Whether SetInputArrayToProcess(index, ...) names an array.
bool IsArrayChosen(vtkSurfaceFEMAlgorithm* filter, int index);

/// What an obstacle is called.
struct Obstacle
{
  bool isThere;
  const char* name;
};

/// The name of the first obstacle that is there; empty: none is.
std::string FirstObstacle(std::initializer_list<Obstacle> obstacles);

} // namespace gridfem

#endif
