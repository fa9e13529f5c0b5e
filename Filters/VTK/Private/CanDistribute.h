// Whether the ranks can compute together, which is asked in every build.
#ifndef GridFEM_CanDistribute_h
#define GridFEM_CanDistribute_h

class vtkAlgorithm;
class vtkPolyData;

namespace gridfem
{

/// Whether this build has MPI, and VTK's global controller is one of MPI. Where it is not
/// so, the filter on the first rank warns that rank 0 gathers.
bool CanDistribute(vtkAlgorithm* filter);

/// Whether SetInputArrayToProcess(index, ...) names an array.
bool IsArrayChosen(vtkAlgorithm* algorithm, int index);

/// Whether a rank's piece, which may be null, has a basis or ghost cells, of which ranks together
/// know nothing.
bool HasBasisOrGhosts(vtkPolyData* piece);

} // namespace gridfem

#endif
