#include "Grid/OrientedMesh.h"

#include "Grid/CopiedTriangles.h"
#include "Grid/CornerClasses.h"
#include "Grid/SurfaceEdges.h"

#include <utility>
#include <vector>

namespace gridfem
{
namespace
{

/// Whether no two triangles run along an edge in the same direction.
bool FaceAlike(const TriangleMesh& mesh, const CornerClasses& classes)
{
  const Buckets<Id> ends(mesh.points.size(),
    [&](auto&& add)
    {
      for (Id t = 0; t < static_cast<Id>(mesh.triangles.size()); ++t)
      {
        const std::array<Id, 3> corners = classes(t);
        for (int k = 0; k < 3 && !IsDegenerate(corners); ++k)
        {
          add(corners[k], corners[(k + 1) % 3]);
        }
      }
    });
  return !ends.HasEqual();
}

/// Returns the mesh with the first of all triangles that have the same corners.
TriangleMesh WithoutCopies(const TriangleMesh& mesh, const Array<Index>& pointClass)
{
  const std::vector<char> isCopy = CopiedTriangles(mesh, pointClass);
  TriangleMesh kept;
  kept.points = mesh.points;
  for (std::size_t t = 0; t < mesh.triangles.size(); ++t)
  {
    if (isCopy.empty() || !isCopy[t])
    {
      kept.triangles.push_back(mesh.triangles[t]);
    }
  }
  return kept;
}

} // namespace

OrientedMesh Orient(const TriangleMesh& mesh, bool weldCoincidentPoints, int threads)
{
  OrientedMesh oriented;
  const Array<Index> pointClass =
    weldCoincidentPoints ? WeldCoincidentPoints(mesh.points, {}, threads) : Array<Index>();
  if (FaceAlike(mesh, { mesh, pointClass }))
  {
    return oriented;
  }
  TriangleMesh turned = WithoutCopies(mesh, pointClass);
  oriented.copies = static_cast<Id>(mesh.triangles.size() - turned.triangles.size());
  const SurfaceEdges edges = FindSurfaceEdges(turned, weldCoincidentPoints, threads);
  oriented.oneSided = edges.numberOfOneSided;
  for (std::size_t t = 0; t < turned.triangles.size(); ++t)
  {
    if (edges.side[t] < 0)
    {
      std::swap(turned.triangles[t][1], turned.triangles[t][2]);
      ++oriented.turned;
    }
  }
  oriented.mesh = std::move(turned);
  return oriented;
}

} // namespace gridfem
