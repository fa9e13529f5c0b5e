// From vtkPolyData to the triangles that Core computes on.
#ifndef GridFEM_InputMesh_h
#define GridFEM_InputMesh_h

#include "Base/Progress.h"
#include "Grid/TriangleMesh.h"

#include <memory>
#include <utility>
#include <vector>

class vtkPolyData;

namespace gridfem
{

/// The polygons and strips of a vtkPolyData as triangles, in the order of its cells. The points are
/// all points of the vtkPolyData, in double precision.
struct InputMesh
{
  std::shared_ptr<const TriangleMesh> triangles;
  std::vector<Id> sourceCell; // per triangle, ascending: the cell of the vtkPolyData it comes from
};

/// Decomposes polygons of any size, concave ones too, and strips. Vertices, lines and polygons with
/// fewer than three corners are left out, and so are cells that vtkGhostType marks as hidden or as
/// duplicates of cells elsewhere. Throws InvalidInput when nothing is left, or naming the first
/// cell with a point that does not exist.
InputMesh ReadInputMesh(vtkPolyData* input, int threads, const Progress& progress = {});

/// The piece of a surface that one of several ranks has, which may be null or without polygons. Its
/// points are all its points. Throws InvalidInput as ReadInputMesh, but not where nothing is left.
/// @param copies  gets the triangles of the cells that vtkGhostType marks as duplicates
InputMesh ReadPiece(vtkPolyData* piece, int threads, InputMesh& copies);

/// The means of values on triangles over the cells they come from, weighted by area; 0 on other
/// cells.
MultiVector MeansOnCells(const InputMesh& mesh, const MultiVector& onTriangles, Id cells);

/// The triangles of one cell: indices [first, second) into InputMesh::triangles.
std::pair<Id, Id> TrianglesOfCell(const InputMesh& mesh, Id cell);

} // namespace gridfem

#endif
