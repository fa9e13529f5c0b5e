#include "Spaces/HatFunctions.h"

#include "Base/Errors.h"
#include "Base/Grouping.h"
#include "Base/RadixSort.h"
#include "Base/UnionFind.h"
#include "Grid/Grid.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <string>

namespace gridfem
{
namespace
{

std::vector<char> FlatTriangles(const TriangleMesh& mesh, const HatOptions& options)
{
  std::vector<char> isFlat(mesh.triangles.size());
  ParallelRanges(static_cast<Id>(mesh.triangles.size()), options.threads,
    [&](Id begin, Id end)
    {
      for (Id t = begin; t < end; ++t)
      {
        isFlat[t] = HatTriangle(mesh, t, options.unitLength).IsFlat();
      }
    });
  return isFlat;
}

/// Returns 1 for points of triangles that are not flat.
std::vector<char> PointsWithFunction(const TriangleMesh& mesh, const std::vector<char>& isFlat)
{
  std::vector<char> used(mesh.points.size(), 0);
  for (std::size_t t = 0; t < mesh.triangles.size(); ++t)
  {
    for (const Id point : mesh.triangles[t])
    {
      used[point] |= !isFlat[t];
    }
  }
  return used;
}

/// Returns the points that have a function of their own, along the Morton curve.
Array<SortEntry> SortPoints(const TriangleMesh& mesh, const std::vector<char>& used,
  const Array<Index>& pointClass, int threads)
{
  const Grid grid = EmbedInGrid(mesh.points, used, MaximumDepth);
  return SortByKey(static_cast<Id>(mesh.points.size()), 3 * MaximumDepth, threads,
    [&](Id begin, Id end, const auto& add)
    {
      for (Id point = begin; point < end; ++point)
      {
        if (used[point] && (pointClass.empty() || pointClass[point] == point))
        {
          add(MortonEncode(grid.CellAt(mesh.points[point])), point);
        }
      }
    });
}

void NumberPoints(const TriangleMesh& mesh, const std::vector<char>& isFlat,
  const HatOptions& options, HatFunctions& hats)
{
  std::vector<char> used = PointsWithFunction(mesh, isFlat);
  const Array<Index> pointClass = options.weldCoincidentPoints
                                    ? WeldCoincidentPoints(mesh.points, UsedPoints(mesh))
                                    : Array<Index>();
  // Points whose triangles are all flat share the function of coincident points.
  for (std::size_t point = 0; point < pointClass.size(); ++point)
  {
    used[pointClass[point]] |= used[point];
  }
  const Array<SortEntry> sorted = SortPoints(mesh, used, pointClass, options.threads);
  RequireIndices(static_cast<double>(sorted.size()), "hat functions");
  hats.ofPoint.assign(mesh.points.size(), -1);
  for (std::size_t k = 0; k < sorted.size(); ++k)
  {
    hats.ofPoint[sorted[k].item] = static_cast<Index>(k);
  }
  for (std::size_t point = 0; point < pointClass.size(); ++point)
  {
    hats.ofPoint[point] = hats.ofPoint[pointClass[point]];
  }
  hats.component.resize(sorted.size());
}

void ListTriangles(const TriangleMesh& mesh, const std::vector<char>& isFlat, HatFunctions& hats)
{
  // The corners of flat triangles form the last group, which is dropped.
  const Index none = hats.Count();
  RequireIndices(3.0 * static_cast<double>(mesh.triangles.size()), "corners of triangles");
  Array<Index> functionOfCorner(3 * mesh.triangles.size());
  for (std::size_t t = 0; t < mesh.triangles.size(); ++t)
  {
    for (int k = 0; k < 3; ++k)
    {
      functionOfCorner[3 * t + k] = isFlat[t] ? none : hats.ofPoint[mesh.triangles[t][k]];
    }
  }
  Groups groups = GroupItems(functionOfCorner, Id{ none } + 1);
  groups.begin.pop_back();
  hats.corners.reserve(groups.begin.back());
  for (Index k = 0; k < groups.begin.back(); ++k)
  {
    hats.corners.push_back({ groups.item[k] });
  }
  hats.begin = std::move(groups.begin);
}

void FindComponents(const TriangleMesh& mesh, const std::vector<char>& isFlat, HatFunctions& hats)
{
  UnionFind sets(hats.Count());
  for (std::size_t t = 0; t < mesh.triangles.size(); ++t)
  {
    for (int k = 1; k < 3 && !isFlat[t]; ++k)
    {
      sets.Unite(hats.ofPoint[mesh.triangles[t][0]], hats.ofPoint[mesh.triangles[t][k]]);
    }
  }
  const Array<Index> component = NumberSets(sets, hats.numberOfComponents);
  hats.component.assign(component.begin(), component.end());
}

} // namespace

HatTriangle::HatTriangle(const TriangleMesh& mesh, Id triangle, double unitLength)
{
  const std::array<Id, 3>& corner = mesh.triangles[triangle];
  for (int k = 0; k < 3; ++k)
  {
    edge[k] = (mesh.points[corner[(k + 2) % 3]] - mesh.points[corner[(k + 1) % 3]]) / unitLength;
  }
  areaVector = edge[0].cross(edge[1]);
  area = 0.5 * areaVector.norm();
}

bool HatTriangle::IsFlat() const
{
  constexpr double SmallestHeight = 1e-10; // as a fraction of the longest edge
  const double longest2 =
    std::max({ edge[0].squaredNorm(), edge[1].squaredNorm(), edge[2].squaredNorm() });
  // Written so that a size outside the range of doubles counts as flat.
  return !(2.0 * area > SmallestHeight * longest2 && std::isfinite(longest2));
}

HatFunctions NumberHatFunctions(const TriangleMesh& mesh, const HatOptions& options)
{
  if (!(options.unitLength > 0.0) || std::isinf(options.unitLength))
  {
    throw InvalidInput("The unit of length of the hat functions is " +
                       std::to_string(options.unitLength) + "; it must be a positive number.");
  }
  Validate(mesh);
  HatFunctions hats;
  hats.unitLength = options.unitLength;
  const std::vector<char> isFlat = FlatTriangles(mesh, options);
  NumberPoints(mesh, isFlat, options, hats);
  ListTriangles(mesh, isFlat, hats);
  FindComponents(mesh, isFlat, hats);
  return hats;
}

MultiVector ValuesAtPoints(const HatFunctions& hats, const MultiVector& coefficients, int threads)
{
  if (coefficients.rows() != hats.Count())
  {
    throw InvalidInput("There are " + std::to_string(coefficients.rows()) + " coefficients for " +
                       std::to_string(hats.Count()) + " hat functions.");
  }
  const auto points = static_cast<Id>(hats.ofPoint.size());
  MultiVector values = MultiVector::Zero(points, coefficients.cols());
  ParallelRanges(points, threads,
    [&](Id begin, Id end)
    {
      for (Id point = begin; point < end; ++point)
      {
        if (hats.ofPoint[point] >= 0)
        {
          values.row(point) = coefficients.row(hats.ofPoint[point]);
        }
      }
    });
  return values;
}

MultiVector GradientsOnTriangles(
  const HatFunctions& hats, const TriangleMesh& mesh, const MultiVector& coefficients, int threads)
{
  const MultiVector values = ValuesAtPoints(hats, coefficients, threads);
  const auto triangles = static_cast<Id>(mesh.triangles.size());
  MultiVector gradients = MultiVector::Zero(triangles, 3 * coefficients.cols());
  ParallelRanges(triangles, threads,
    [&](Id begin, Id end)
    {
      for (Id t = begin; t < end; ++t)
      {
        const HatTriangle triangle(mesh, t, 1.0);
        for (int k = 0; k < 3 && !triangle.IsFlat(); ++k)
        {
          const Vec3 gradient = triangle.Gradient(k);
          for (Id c = 0; c < coefficients.cols(); ++c)
          {
            gradients.row(t).segment<3>(3 * c) +=
              values(mesh.triangles[t][k], c) * gradient.transpose();
          }
        }
      }
    });
  return gradients;
}

Id CountFlattened(const HatFunctions& hats, const TriangleMesh& moved, int threads)
{
  return ParallelSum(static_cast<Id>(hats.corners.size()), threads, Id{ 0 },
    [&](Id begin, Id end)
    {
      Id count = 0;
      for (Id k = begin; k < end; ++k)
      {
        const TriangleCorner corner = hats.corners[k];
        count +=
          corner.Corner() == 0 && HatTriangle(moved, corner.Triangle(), hats.unitLength).IsFlat();
      }
      return count;
    });
}

} // namespace gridfem
