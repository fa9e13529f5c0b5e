#include "Grid/GivenPieces.h"

#include "Base/Grouping.h"
#include "Grid/GridFunctions.h"

#include <algorithm>

namespace gridfem
{

ClippedMesh ClipOfGivenCells(const TriangleMesh& mesh, const GivenCells& given,
  bool weldCoincidentPoints, const Progress& progress)
{
  ClippedMesh clipped;
  clipped.grid = given.grid;
  clipped.cells = given.cells;
  clipped.isWelded = weldCoincidentPoints;
  clipped.numberOfInputPoints = static_cast<Id>(mesh.points.size());
  clipped.position.reserve(mesh.points.size());
  for (const Vec3& point : mesh.points)
  {
    clipped.position.push_back(clipped.grid.ToGrid(point));
  }
  RequireIndices(3.0 * static_cast<double>(mesh.triangles.size()), "corners of triangles");
  Array<Index> cellOf; // of the triangles that are kept
  Array<Index> triangleOf;
  for (std::size_t t = 0; t < mesh.triangles.size(); ++t)
  {
    const auto cell = std::lower_bound(given.cells.begin(), given.cells.end(), given.ofTriangle[t]);
    if (cell != given.cells.end() && *cell == given.ofTriangle[t])
    {
      cellOf.push_back(static_cast<Index>(cell - given.cells.begin()));
      triangleOf.push_back(static_cast<Index>(t));
    }
  }
  Groups byCell = GroupItems(cellOf, static_cast<Id>(given.cells.size()));
  clipped.cellBegin = std::move(byCell.begin);
  clipped.pieceBegin.push_back(0);
  for (const Index item : byCell.item)
  {
    clipped.pieceTriangle.push_back(triangleOf[item]);
    for (const Id corner : mesh.triangles[triangleOf[item]])
    {
      clipped.corners.push_back(static_cast<Index>(corner));
    }
    clipped.pieceBegin.push_back(static_cast<Index>(clipped.corners.size()));
  }
  progress.Check(0.3);
  const Array<Index> pointClass =
    weldCoincidentPoints ? WeldCoincidentPoints(mesh.points, UsedPoints(mesh)) : Array<Index>{};
  clipped.links = FindLinks(clipped, pointClass, progress.Part(0.4, 1.0));
  return clipped;
}

} // namespace gridfem
