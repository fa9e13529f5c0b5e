// What filters do that all ranks compute together, in every build.
#ifndef GridFEM_CanDistribute_h
#define GridFEM_CanDistribute_h

#include "InputMesh.h"

#include <initializer_list>

class vtkInformationVector;
class vtkPolyData;
class vtkSurfaceFEMAlgorithm;

namespace gridfem
{

/// Collective. Whether all ranks can compute together, each with its piece on port 0: on the
/// functions of a grid of a chosen depth, without a basis, ghost cells or connections to further
/// ports, of which ranks together know nothing. Where the build has no MPI, or VTK's
/// global controller is not one of MPI, the filter on the first rank warns that rank 0 gathers.
/// @param depth    that is chosen
/// @param isPlain  whether the filter does nothing else that rank 0 alone can do
bool CanDistribute(
  vtkSurfaceFEMAlgorithm* filter, vtkInformationVector** inputs, int depth, bool isPlain);

/// Whether SetInputArrayToProcess(index, ...) names one of these arrays.
bool IsArrayChosen(vtkSurfaceFEMAlgorithm* filter, std::initializer_list<int> indices);

/// A rank's piece, which may be null; no triangles where it has no polygons. Throws InvalidInput
/// for these, and for properties of the filter that are wrong on all ranks.
InputMesh ReadPiece(vtkSurfaceFEMAlgorithm* filter, vtkPolyData* piece);

} // namespace gridfem

#endif
