#include "Equations/EdgeConditions.h"

#include "Algebra/RowBuilder.h"
#include "Base/Errors.h"
#include "Base/SortEachOnce.h"
#include "Grid/TriangleArea.h"

#include <algorithm>
#include <cstdint>
#include <iterator>
#include <string>
#include <tuple>

namespace gridfem
{
namespace
{

void CheckValues(const TriangleMesh& mesh, const MultiVector& values)
{
  if (values.rows() != static_cast<Id>(mesh.points.size()))
  {
    throw InvalidInput("There are " + std::to_string(values.rows()) + " values on edges for " +
                       std::to_string(mesh.points.size()) + " points.");
  }
}

/// The shortest edge along which values count, in units of length. The ends hold the functions
/// along shorter edges.
constexpr double ShortestEdge = 0.25;

/// Pull of the values on an edge, per unit of length, over the number of units along the surface.
/// A pull that grows with the resolution keeps the second order of the functions, because their own
/// error on an edge falls as fast. On discs, four times this pull doubles errors at depth 5, and an
/// eighth makes them half as large again at depth 8. Values that are held exactly along the edges
/// would fix the slope across them, too. [Babuška: The Finite Element Method with Penalty, 1973]
constexpr double PullOfEdge = 3.0;

/// An edge between two classes of points, and the place opposite to it in its triangle.
struct MarkedSide
{
  Index low;
  Index high;
  std::array<double, 3> opposite;
  TriangleEdge edge;

  bool operator<(const MarkedSide& other) const
  {
    return std::tie(low, high, opposite, edge.triangle) <
           std::tie(other.low, other.high, other.opposite, other.edge.triangle);
  }
  bool operator==(const MarkedSide& other) const { return low == other.low && high == other.high; }
};

/// The mean of the given values at each point, or NaN.
MultiVector MeansAtPoints(
  const std::vector<Id>& points, const MultiVector& values, const std::vector<char>& isMarked)
{
  MultiVector mean = MultiVector::Zero(static_cast<Id>(isMarked.size()), values.cols());
  Eigen::ArrayXd count = Eigen::ArrayXd::Zero(mean.rows());
  for (std::size_t k = 0; k < points.size(); ++k)
  {
    mean.row(points[k]) += values.row(static_cast<Id>(k));
    count[points[k]] += 1.0;
  }
  for (Id point = 0; point < mean.rows(); ++point)
  {
    mean.row(point) /= count[point]; // 0 / 0 is the NaN of an unknown value
  }
  return mean;
}

/// The values of a function at the samples. It is linear along the edges.
MultiVector AtSamples(const EdgeSamples& samples, const TriangleMesh& mesh,
  const std::vector<TriangleEdge>& edges, const MultiVector& values)
{
  MultiVector result(samples.rows.rows, values.cols());
  for (Id k = 0; k < result.rows(); ++k)
  {
    const auto ends = edges[samples.edge[k]].Ends(mesh);
    const double t = samples.position[k];
    result.row(k) = (1.0 - t) * values.row(ends[0]) + t * values.row(ends[1]);
  }
  return result;
}

void AppendRow(const SparseMatrix& matrix, Index row, RowBuilder& rows)
{
  RowBuilder::Entries entries;
  for (Id k = matrix.rowBegin[row]; k < matrix.rowBegin[row + 1]; ++k)
  {
    entries.emplace_back(matrix.column[k], matrix.value[k]);
  }
  rows.Append(entries);
}

} // namespace

HeldValues HoldPoints(
  const FiniteElementSpace& space, const std::vector<Id>& points, MultiVector values)
{
  return { space.RowsAtPoints(points), std::move(values) };
}

HeldValues HoldPointsAndEdges(const FiniteElementSpace& space, const TriangleMesh& mesh,
  bool weldCoincidentPoints, const std::vector<Id>& points, const MultiVector& values)
{
  HeldValues held = HoldPoints(space, points, values);
  std::vector<char> isHeld(mesh.points.size(), 0);
  for (const Id point : points)
  {
    isHeld[point] = 1;
  }
  return Join(held, HoldWithinEdges(space, mesh, EdgesBetween(mesh, isHeld, weldCoincidentPoints),
                      MeansAtPoints(points, values, isHeld)));
}

HeldValues Join(const HeldValues& first, const HeldValues& second)
{
  HeldValues both;
  both.values.resize(first.values.rows() + second.values.rows(), first.values.cols());
  both.values << first.values, second.values;
  RowBuilder rows;
  std::vector<double> pull;
  for (const HeldValues* part : { &first, &second })
  {
    for (Index row = 0; row < part->rows.rows; ++row)
    {
      AppendRow(part->rows, row, rows);
      pull.push_back(part->rows.IsPulled(row) ? part->rows.pull[row] : 0.0);
    }
  }
  both.rows = HeldRows(rows.Finish(first.rows.columns), std::move(pull));
  return both;
}

std::vector<TriangleEdge> EdgesBetween(
  const TriangleMesh& mesh, const std::vector<char>& isMarked, bool weldCoincidentPoints)
{
  const Array<Index> welded =
    weldCoincidentPoints ? WeldCoincidentPoints(mesh.points, isMarked) : Array<Index>();
  const auto classOf = [&](Id point)
  { return welded.empty() ? static_cast<Index>(point) : welded[point]; };
  std::vector<MarkedSide> sides;
  for (Id triangle = 0; triangle < static_cast<Id>(mesh.triangles.size()); ++triangle)
  {
    const std::array<Id, 3>& corners = mesh.triangles[triangle];
    if (isMarked[corners[0]] + isMarked[corners[1]] + isMarked[corners[2]] < 2 ||
        !(AreaOf(mesh, triangle) > 0.0))
    {
      continue;
    }
    for (int corner = 0; corner < 3; ++corner)
    {
      const TriangleEdge edge{ triangle, corner };
      const auto [first, last] = edge.Ends(mesh);
      if (isMarked[first] && isMarked[last])
      {
        const Vec3& place = mesh.points[corners[(corner + 2) % 3]];
        const auto [low, high] = std::minmax({ classOf(first), classOf(last) });
        sides.push_back({ low, high, { place[0], place[1], place[2] }, edge });
      }
    }
  }
  SortEachOnce(sides);
  std::vector<TriangleEdge> edges;
  for (const MarkedSide& side : sides)
  {
    edges.push_back(side.edge);
  }
  return edges;
}

std::vector<TriangleEdge> KnownEdges(
  const TriangleMesh& mesh, const std::vector<TriangleEdge>& edges, const MultiVector& values)
{
  CheckValues(mesh, values);
  std::vector<TriangleEdge> known;
  std::copy_if(edges.begin(), edges.end(), std::back_inserter(known),
    [&](const TriangleEdge& edge)
    {
      const auto own = edge.Ends(mesh);
      return !values.row(own[0]).hasNaN() && !values.row(own[1]).hasNaN();
    });
  return known;
}

HeldValues HoldWithinEdges(const FiniteElementSpace& space, const TriangleMesh& mesh,
  const std::vector<TriangleEdge>& edges, const MultiVector& values)
{
  const double shortest = ShortestEdge * space.UnitLength();
  std::vector<TriangleEdge> longEdges;
  for (const TriangleEdge& edge : edges)
  {
    const auto own = edge.Ends(mesh);
    if ((mesh.points[own[1]] - mesh.points[own[0]]).norm() > shortest)
    {
      longEdges.push_back(edge);
    }
  }
  EdgeSamples samples = space.SamplesOfSegments(SegmentsOf(longEdges, mesh));
  const std::vector<char>& isBent = samples.isMiddle; // only where functions are not linear
  if (std::none_of(isBent.begin(), isBent.end(), [](char bent) { return bent; }))
  {
    return HoldPoints(space, {}, MultiVector(0, values.cols())); // the ends hold the functions
  }
  HeldValues held;
  held.values = AtSamples(samples, mesh, longEdges, values);
  std::vector<double> pull = std::move(samples.length);
  for (double& length : pull)
  {
    length *= PullOfEdge * space.Extent() / space.UnitLength();
  }
  held.rows = HeldRows(std::move(samples.rows), std::move(pull));
  return held;
}

HeldValues HoldEdges(const FiniteElementSpace& space, const TriangleMesh& mesh,
  const std::vector<TriangleEdge>& edges, const MultiVector& values)
{
  const std::vector<TriangleEdge> known = KnownEdges(mesh, edges, values);
  const std::vector<Id> ends = EndsOf(known, mesh);
  MultiVector atEnds(static_cast<Id>(ends.size()), values.cols());
  for (Id k = 0; k < atEnds.rows(); ++k)
  {
    atEnds.row(k) = values.row(ends[k]);
  }
  return Join(
    HoldPoints(space, ends, std::move(atEnds)), HoldWithinEdges(space, mesh, known, values));
}

MultiVector LoadOnEdges(const FiniteElementSpace& space, const TriangleMesh& mesh,
  const std::vector<TriangleEdge>& edges, const MultiVector& values)
{
  CheckValues(mesh, values);
  const EdgeSamples samples = space.SamplesOfSegments(SegmentsOf(edges, mesh));
  return IntegrateAlong(samples, AtSamples(samples, mesh, edges, values));
}

namespace
{

/// Mixes the bits of a number. [Steele, Lea, Flood: Fast Splittable Pseudorandom Number Generators,
/// 2014]
std::uint64_t MixBits(std::uint64_t x)
{
  x = (x ^ (x >> 30)) * 0xbf58476d1ce4e5b9u;
  x = (x ^ (x >> 27)) * 0x94d049bb133111ebu;
  return x ^ (x >> 31);
}

/// Whether each side of a triangle is passed as often in one direction as in the other, so that no
/// side is a boundary. The sum over all sides needs a twentieth of the time that finding them
/// takes. A sum of 0 by accident has a probability of 1e-19.
bool IsClosed(const TriangleMesh& mesh)
{
  std::uint64_t sum = 0;
  for (const auto& corner : mesh.triangles)
  {
    for (int k = 0; k < 3; ++k)
    {
      const auto first = static_cast<std::uint64_t>(corner[k]);
      const auto second = static_cast<std::uint64_t>(corner[k == 2 ? 0 : k + 1]);
      const std::uint64_t side =
        MixBits(MixBits(std::min(first, second) + 1) + std::max(first, second));
      sum += first < second ? side : first > second ? 0 - side : 0;
    }
  }
  return sum == 0;
}

} // namespace

BoundaryTerms TermsOnBoundary(const FiniteElementSpace& space, const TriangleMesh& mesh,
  bool weldCoincidentPoints, const MultiVector* flux, const MultiVector* values)
{
  BoundaryTerms terms;
  if (IsClosed(mesh))
  {
    return terms;
  }
  const std::vector<TriangleEdge> edges = FindSurfaceEdges(mesh, weldCoincidentPoints).boundary;
  terms.isThere = !edges.empty();
  if (terms.isThere && flux)
  {
    terms.load = LoadOnEdges(space, mesh, edges, *flux);
  }
  if (terms.isThere && values)
  {
    terms.held = HoldEdges(space, mesh, edges, *values);
  }
  return terms;
}

EdgeSamples SampleBoundary(
  const FiniteElementSpace& space, const TriangleMesh& mesh, bool weldCoincidentPoints)
{
  std::vector<TriangleEdge> edges;
  if (!IsClosed(mesh))
  {
    edges = FindSurfaceEdges(mesh, weldCoincidentPoints).boundary;
  }
  return space.SamplesOfSegments(SegmentsOf(edges, mesh));
}

} // namespace gridfem
