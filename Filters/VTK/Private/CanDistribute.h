// Whether the ranks can compute together, which is asked in every build.
#ifndef GridFEM_CanDistribute_h
#define GridFEM_CanDistribute_h

class vtkAlgorithm;
class vtkPolyData;

namespace gridfem
{

/// Whether this build has MPI and PETSc, and VTK's global controller is one of MPI.
bool CanDistribute();

/// Whether SetInputArrayToProcess(index, ...) names an array.
bool IsArrayChosen(vtkAlgorithm* algorithm, int index);

/// Whether a rank's piece, which may be null, has a basis or ghost cells, of which ranks together
/// know nothing.
bool HasBasisOrGhosts(vtkPolyData* piece);

} // namespace gridfem

#endif
