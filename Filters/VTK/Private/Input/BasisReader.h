// Reads Core's clipped mesh and function space back from the arrays of DESIGN §4.
#ifndef GridFEM_BasisReader_h
#define GridFEM_BasisReader_h

#include "Grid/GivenPieces.h"
#include "Output/ClippedArrays.h"
#include "Solvers/SurfaceBasis.h"

#include <vector>

class vtkPolyData;

namespace gridfem
{

constexpr const char* NoBasisText = "The second input is not the output of a basis filter: the "
                                    "arrays 'PatchBasisIds' and 'PatchId' are missing.";

/// Returns all octree cells of a clip, ascending. Throws InvalidInput if its tables do not fit.
std::vector<MortonKey> ReadOctreeCells(vtkPolyData* data);

/// Returns the octree cells of the triangles of `data`. Throws as ReadClippedMesh.
GivenCells ReadGivenCells(vtkPolyData* data, const InputMesh& mesh);

/// Returns the clipped mesh whose pieces are the triangles of `data`, with links.
/// @param mesh  is ReadInputMesh(data)
/// @param weldCoincidentPoints  makes coincident points count as one for the links
/// Throws InvalidInput naming an array that is missing or does not fit, or the first triangle
/// outside its cell.
ClippedMesh ReadClippedMesh(vtkPolyData* data, const InputMesh& mesh, bool weldCoincidentPoints,
  const Progress& progress = {});

/// The contents of the tables of a basis, without its triangles.
struct BasisFacts
{
  Grid grid;
  Id functions = 0;
  bool isConnectivityAware = true;
};

/// Reads the tables. Throws InvalidInput naming an array that is missing or does not fit.
BasisFacts ReadBasisFacts(vtkPolyData* data);

/// Whether coincident points counted as one when the basis of `data` was made.
bool WeldsCoincidentPoints(vtkPolyData* data);

/// Returns the basis on the triangles of `data`. It takes the shortcut in memory if that fits, else
/// it reads the arrays. Throws like ReadClippedMesh.
SurfaceBasis ReadBasis(vtkPolyData* data, const InputMesh& mesh, const Progress& progress = {});

/// Returns the basis of `data` on the mesh it was made from. Throws InvalidInput for another mesh.
SurfaceBasis ReadBasisFor(
  vtkPolyData* data, const InputMesh& source, const Progress& progress = {});

} // namespace gridfem

#endif
