#include "Grid/CopiedTriangles.h"

#include "Grid/CornerClasses.h"

namespace gridfem
{

std::vector<char> CopiedTriangles(const TriangleMesh& mesh, const Array<Index>& pointClass)
{
  const CornerClasses classes(mesh, pointClass);
  const auto sorted = [&](Id triangle)
  {
    std::array<Id, 3> corners = classes(triangle);
    std::sort(corners.begin(), corners.end());
    return corners;
  };
  const auto count = static_cast<Id>(mesh.triangles.size());
  const Buckets<Id> ofLowest(mesh.points.size(),
    [&](auto&& add)
    {
      for (Id t = 0; t < count; ++t)
      {
        add(sorted(t)[0], t);
      }
    });
  std::vector<char> isCopy;
  for (std::size_t point = 0; point + 1 < ofLowest.begin.size(); ++point)
  {
    const auto first = ofLowest.things.begin() + ofLowest.begin[point];
    const auto last = ofLowest.things.begin() + ofLowest.begin[point + 1];
    for (auto own = first; own != last; ++own)
    {
      const std::array<Id, 3> corners = sorted(*own);
      if (!IsDegenerate(corners) &&
          std::any_of(first, own, [&](Id other) { return sorted(other) == corners; }))
      {
        isCopy.resize(mesh.triangles.size(), 0);
        isCopy[*own] = 1;
      }
    }
  }
  return isCopy;
}

void DropCopies(TriangleMesh& mesh, std::vector<Id>& sourceCell)
{
  const std::vector<char> isCopy = CopiedTriangles(mesh);
  if (isCopy.empty())
  {
    return;
  }
  std::size_t kept = 0;
  for (std::size_t t = 0; t < isCopy.size(); ++t)
  {
    if (!isCopy[t])
    {
      mesh.triangles[kept] = mesh.triangles[t];
      sourceCell[kept++] = sourceCell[t];
    }
  }
  mesh.triangles.resize(kept);
  sourceCell.resize(kept);
}

} // namespace gridfem
