// Reads the triangles that Core computes on from vtkPolyData.
#ifndef GridFEM_InputMesh_h
#define GridFEM_InputMesh_h

#include "Base/Progress.h"
#include "Grid/JoinSeams.h"

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
  bool isWelded = false;      // seams were joined (JoinSeams)
  std::vector<MovedPoint> moved; // points that joining seams moved, ascending
  Id copied = 0;                 // triangles left out, because others have the same corners
};

/// Decomposes polygons of any size, concave ones too, and strips. Leaves out vertices, lines,
/// polygons with fewer than three corners, and cells that vtkGhostType marks as hidden or as
/// duplicates. Throws InvalidInput if no triangle is left, or naming the first cell with a point
/// that does not exist.
/// @param weldCoincidentPoints  joins seams (JoinSeams). Polygons with hanging nodes get more
///   triangles. A clipped mesh that is read with its cells has no seams to join.
InputMesh ReadInputMesh(
  vtkPolyData* input, bool weldCoincidentPoints, int threads, const Progress& progress = {});

/// Reads the points of the data, and moves them as joining the seams of the mesh moved its points.
std::vector<Vec3> ReadPointsLike(const InputMesh& mesh, vtkPolyData* data);

/// Reads the piece of one of several ranks, which may be null or without polygons. The mesh has all
/// points of the piece. Throws InvalidInput as ReadInputMesh does, but the piece may be empty.
/// @param copies  gets the triangles of the cells that vtkGhostType marks as duplicates
InputMesh ReadPiece(vtkPolyData* piece, int threads, InputMesh& copies);

/// Returns the means of values on triangles over the cells they come from, weighted by area. Other
/// cells have NaN.
MultiVector MeansOnCells(const InputMesh& mesh, const MultiVector& onTriangles, Id cells);

/// Returns the triangles of one cell: indices [first, second) into InputMesh::triangles.
std::pair<Id, Id> TrianglesOfCell(const InputMesh& mesh, Id cell);

} // namespace gridfem

#endif
