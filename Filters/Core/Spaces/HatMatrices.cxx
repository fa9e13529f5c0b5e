#include "Spaces/HatMatrices.h"

#include "Base/Errors.h"
#include "Base/Parallel.h"

#include <algorithm>

namespace gridfem
{
namespace
{

/// The contribution of a triangle to its element matrices.
struct TriangleTerms
{
  std::array<double, 3> halfCotangent; // of the angle at each corner
  double twelfthOfArea;
};

TriangleTerms TermsOf(const HatTriangle& triangle)
{
  TriangleTerms terms;
  for (int k = 0; k < 3; ++k)
  {
    terms.halfCotangent[k] =
      -triangle.edge[(k + 1) % 3].dot(triangle.edge[(k + 2) % 3]) / (4.0 * triangle.area);
  }
  terms.twelfthOfArea = triangle.area / 12.0;
  return terms;
}

/// Computes the stiffness with weights along and across a direction. If the direction has no part
/// in the plane, both share the stiffness equally, as in DirectionalElements.
void SplitStiffness(const HatTriangle& triangle, const Vec3& direction,
  const std::array<double, 2>& weight, TriangleTerms& terms)
{
  constexpr double SmallestPart = 1e-10;
  const Vec3 normal = triangle.areaVector.normalized();
  const Vec3 unit = direction.stableNormalized();
  Vec3 along = unit - normal.dot(unit) * normal;
  const bool isThere = along.norm() > SmallestPart;
  along.normalize();
  const Vec3 across = normal.cross(along);
  for (int k = 0; k < 3; ++k)
  {
    const Vec3& u = triangle.edge[(k + 1) % 3];
    const Vec3& v = triangle.edge[(k + 2) % 3];
    // Gradients are edges turned by a right angle, so `along` takes the part of the edges across.
    const double ofAlong = isThere ? across.dot(u) * across.dot(v) : 0.5 * u.dot(v);
    const double ofAcross = isThere ? along.dot(u) * along.dot(v) : 0.5 * u.dot(v);
    terms.halfCotangent[k] = -(weight[0] * ofAlong + weight[1] * ofAcross) / (4.0 * triangle.area);
  }
}

void SetMetric(
  const HatTriangle& triangle, double area, const Eigen::Matrix3d& tensor, TriangleTerms& terms)
{
  terms.twelfthOfArea *= area;
  for (int k = 0; k < 3; ++k)
  {
    terms.halfCotangent[k] =
      -triangle.area * triangle.Gradient((k + 1) % 3).dot(tensor * triangle.Gradient((k + 2) % 3));
  }
}

TriangleTerms WeightedTermsOf(const HatTriangle& triangle, Id t, const HatWeights& weights)
{
  TriangleTerms terms = TermsOf(triangle);
  if (weights.metric)
  {
    SetMetric(triangle, weights.metric->area[t], weights.metric->tensor[t], terms);
  }
  if (weights.weights)
  {
    const ElementWeights& own = (*weights.weights)[t];
    terms.twelfthOfArea *= own.mass;
    if (weights.direction && !weights.metric)
    {
      SplitStiffness(triangle, (*weights.direction)[t], own.stiffness, terms);
    }
  }
  return terms;
}

std::vector<TriangleTerms> ComputeTerms(
  const TriangleMesh& mesh, const HatFunctions& hats, const HatWeights& weights, int threads)
{
  std::vector<TriangleTerms> terms(mesh.triangles.size());
  ParallelRanges(static_cast<Id>(terms.size()), threads,
    [&](Id begin, Id end)
    {
      for (Id t = begin; t < end; ++t)
      {
        const HatTriangle triangle(mesh, t, hats.unitLength);
        if (!triangle.IsFlat()) // no function lists a flat triangle, and one flattened by a move
                                // adds nothing
        {
          terms[t] = WeightedTermsOf(triangle, t, weights);
        }
      }
    });
  return terms;
}

/// The contribution of one triangle to an off-diagonal entry of a row.
struct Contribution
{
  Index column;
  int order; // of the triangle around the function; fixes the order of sums
  double mass;
  double stiffness;

  bool operator<(const Contribution& other) const
  {
    return column != other.column ? column < other.column : order < other.order;
  }
};

/// The rows of a block, before their place in the matrices is known.
struct RowBlock
{
  std::vector<Index> column;
  std::vector<double> mass;
  std::vector<double> stiffness;

  void Append(Index col, double m, double s)
  {
    column.push_back(col);
    mass.push_back(m);
    stiffness.push_back(s);
  }
};

void CollectRow(const TriangleMesh& mesh, const HatFunctions& hats,
  const std::vector<TriangleTerms>& terms, Index row, std::vector<Contribution>& contributions)
{
  contributions.clear();
  for (Id k = hats.begin[row]; k < hats.begin[row + 1]; ++k)
  {
    const TriangleCorner corner = hats.corners[k];
    const TriangleTerms& term = terms[corner.Triangle()];
    for (int side = 1; side < 3; ++side)
    {
      const int neighbor = (corner.Corner() + side) % 3;
      const int opposite = (corner.Corner() + 3 - side) % 3;
      contributions.push_back({ hats.ofPoint[mesh.triangles[corner.Triangle()][neighbor]],
        static_cast<int>(k - hats.begin[row]), term.twelfthOfArea, -term.halfCotangent[opposite] });
    }
  }
  std::sort(contributions.begin(), contributions.end());
}

/// Appends a row and returns ∫ φ_row. The diagonal follows from the other entries.
double AppendRow(Index row, const std::vector<Contribution>& contributions, RowBlock& block)
{
  double massSum = 0.0;
  double stiffnessSum = 0.0;
  const std::size_t first = block.column.size();
  std::size_t diagonal = first;
  for (const Contribution& c : contributions)
  {
    if (block.column.size() > first && block.column.back() == c.column)
    {
      block.mass.back() += c.mass;
      block.stiffness.back() += c.stiffness;
    }
    else
    {
      block.Append(c.column, c.mass, c.stiffness);
      diagonal += c.column < row;
    }
  }
  for (std::size_t k = first; k < block.column.size(); ++k)
  {
    massSum += block.mass[k];
    stiffnessSum += block.stiffness[k];
  }
  const auto place = static_cast<std::ptrdiff_t>(diagonal);
  block.column.insert(block.column.begin() + place, row);
  block.mass.insert(block.mass.begin() + place, massSum);
  block.stiffness.insert(block.stiffness.begin() + place, -stiffnessSum);
  return 2.0 * massSum;
}

} // namespace

HatMatrices AssembleHatMatrices(
  const TriangleMesh& mesh, const HatFunctions& hats, const HatWeights& weights, int threads)
{
  const std::vector<TriangleTerms> terms = ComputeTerms(mesh, hats, weights, threads);
  const Index rows = hats.Count();
  HatMatrices matrices;
  matrices.integral.resize(rows);
  matrices.mass.rows = matrices.mass.columns = rows;
  Array<Id> rowBegin(rows + 1, 0);
  std::vector<RowBlock> blocks((rows + DefaultBlockSize - 1) / DefaultBlockSize);
  ParallelRanges(rows, threads,
    [&](Id begin, Id end)
    {
      std::vector<Contribution> contributions;
      RowBlock& block = blocks[begin / DefaultBlockSize];
      for (Index row = static_cast<Index>(begin); row < end; ++row)
      {
        const std::size_t before = block.column.size();
        CollectRow(mesh, hats, terms, row, contributions);
        matrices.integral[row] = AppendRow(row, contributions, block);
        rowBegin[row] = static_cast<Id>(block.column.size() - before);
      }
    });
  Array<Index> column(ExclusiveScan(rowBegin));
  matrices.mass.value.resize(column.size());
  matrices.stiffness.value.resize(column.size());
  ParallelRanges(rows, threads,
    [&](Id begin, Id)
    {
      const RowBlock& block = blocks[begin / DefaultBlockSize];
      const Id place = rowBegin[begin];
      std::copy(block.column.begin(), block.column.end(), column.begin() + place);
      std::copy(block.mass.begin(), block.mass.end(), matrices.mass.value.begin() + place);
      std::copy(
        block.stiffness.begin(), block.stiffness.end(), matrices.stiffness.value.begin() + place);
    });
  matrices.mass.rowBegin = std::move(rowBegin);
  matrices.mass.column = std::move(column);
  matrices.stiffness.rows = matrices.stiffness.columns = rows;
  matrices.stiffness.rowBegin = matrices.mass.rowBegin;
  matrices.stiffness.column = matrices.mass.column;
  return matrices;
}

MultiVector MultiplyHats(const TriangleMesh& mesh, const HatFunctions& hats,
  const HatWeights& weights, const std::vector<double>& scale, const MultiVector& u, int threads)
{
  if (u.rows() != hats.Count() || (!scale.empty() && scale.size() != mesh.triangles.size()))
  {
    throw InvalidInput(
      "The coefficients need a row per function, and the scales one per triangle.");
  }
  const std::vector<TriangleTerms> terms = ComputeTerms(mesh, hats, weights, threads);
  MultiVector result = MultiVector::Zero(u.rows(), u.cols());
  ParallelRanges(u.rows(), threads,
    [&](Id begin, Id end)
    {
      for (Id i = begin; i < end; ++i)
      {
        for (Id k = hats.begin[i]; k < hats.begin[i + 1]; ++k)
        {
          const Id t = hats.corners[k].Triangle();
          const int corner = hats.corners[k].Corner();
          const double factor = scale.empty() ? 1.0 : scale[t];
          for (int side = 1; side < 3; ++side)
          {
            const Index j = hats.ofPoint[mesh.triangles[t][(corner + side) % 3]];
            const double stiffness = factor * terms[t].halfCotangent[(corner + 3 - side) % 3];
            result.row(i) += stiffness * (u.row(i) - u.row(j));
          }
        }
      }
    });
  return result;
}

} // namespace gridfem
