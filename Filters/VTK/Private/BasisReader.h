// From the arrays of DESIGN §4 back to Core's clipped mesh and function space.
#ifndef GridFEM_BasisReader_h
#define GridFEM_BasisReader_h

#include "ClippedArrays.h"
#include "Grid/GivenPieces.h"
#include "Solvers/SurfaceBasis.h"

#include <vector>

class vtkPolyData;

namespace gridfem
{

/// All octree cells of a clip, ascending. Throws InvalidInput where its tables do not fit.
std::vector<MortonKey> ReadOctreeCells(vtkPolyData* data);

/// The octree cells of the triangles of `data`. Throws as ReadClippedMesh.
GivenCells ReadGivenCells(vtkPolyData* data, const InputMesh& mesh);

/// The clipped mesh whose pieces are the triangles of `data`, with links.
/// @param mesh  ReadInputMesh(data)
/// @param weldCoincidentPoints  coincident points count as one for the links
/// Throws InvalidInput naming the array that is missing or does not fit, or the first triangle that
/// does not lie in its cell.
ClippedMesh ReadClippedMesh(vtkPolyData* data, const InputMesh& mesh, bool weldCoincidentPoints,
  const Progress& progress = {});

/// What the tables of a basis say without its triangles.
struct BasisFacts
{
  Grid grid;
  Id functions = 0;
  bool isConnectivityAware = true;
};

/// Throws InvalidInput naming an array that is missing or does not fit.
BasisFacts ReadBasisFacts(vtkPolyData* data);

/// Whether coincident points counted as one when the basis of `data` was made.
bool WeldsCoincidentPoints(vtkPolyData* data);

/// The basis on the triangles of `data`: the shortcut in memory where it fits, else from the arrays
/// alone. Throws like ReadClippedMesh.
SurfaceBasis ReadBasis(vtkPolyData* data, const InputMesh& mesh, const Progress& progress = {});

/// The basis of `data` on the mesh it was made from.
/// Throws InvalidInput when it was made from another one.
SurfaceBasis ReadBasisFor(
  vtkPolyData* data, const InputMesh& source, const Progress& progress = {});

} // namespace gridfem

#endif
