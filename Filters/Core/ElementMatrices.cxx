// Integration of element matrices patch by patch, and their Galerkin coarsening.
#include "ElementMatrices.h"

#include "Grouping.h"
#include "PieceSamples.h"
#include "TrilinearBasis.h"

namespace gridfem
{
namespace
{

/// Patches per parallel job: some ten thousand samples.
constexpr Id PatchesPerBlock = 256;

constexpr int Half = FunctionsPerPatch / 2;

/// A symmetric 8 x 8 matrix while it is summed; whole SIMD rows, of which the block below the
/// diagonal is left out.
class RankOneSum
{
public:
  void Add(double weight, const CornerValues& v)
  {
    for (int i = 0; i < Half; ++i)
    {
      const double factor = weight * v[i];
      for (int j = 0; j < FunctionsPerPatch; ++j)
      {
        upper_[i][j] += factor * v[j];
      }
    }
    for (int i = 0; i < Half; ++i)
    {
      const double factor = weight * v[Half + i];
      for (int j = 0; j < Half; ++j)
      {
        lower_[i][j] += factor * v[Half + j];
      }
    }
  }

  ElementMatrix Packed() const
  {
    ElementMatrix packed;
    int entry = 0;
    for (int i = 0; i < FunctionsPerPatch; ++i)
    {
      for (int j = i; j < FunctionsPerPatch; ++j)
      {
        packed[entry++] = i < Half ? upper_[i][j] : lower_[i - Half][j - Half];
      }
    }
    return packed;
  }

private:
  double upper_[Half][FunctionsPerPatch] = {};
  double lower_[Half][Half] = {};
};

/// Adds the integrals over one piece.
void AddPiece(const ClippedMesh& clipped, Id piece, const Vec3& origin, const QuadratureRule& rule,
  RankOneSum& mass, RankOneSum& stiffness)
{
  const Vec3 normal = UnitNormal(clipped, piece);
  if (normal.isZero(0.0))
  {
    return;
  }
  // <∇b_i, ∇b_j> of the tangential parts is a sum of two products in an orthonormal frame.
  const Vec3 u = normal.unitOrthogonal();
  const Vec3 v = normal.cross(u);
  ForEachFanTriangle(clipped, piece, origin,
    [&](const FanTriangle& triangle)
    {
      CornerValues b;
      for (const QuadratureRule::Point& point : rule.points)
      {
        const Vec3 local = triangle.At(point.barycentric);
        const double weight = point.weight * triangle.area;
        TrilinearValues(local, b);
        mass.Add(weight, b);
        TrilinearDerivatives(local, u, b);
        stiffness.Add(weight, b);
        TrilinearDerivatives(local, v, b);
        stiffness.Add(weight, b);
      }
    });
}

using DenseElement = Eigen::Matrix<double, FunctionsPerPatch, FunctionsPerPatch, Eigen::RowMajor>;

DenseElement Unpack(const ElementMatrix& packed)
{
  DenseElement dense;
  int entry = 0;
  for (int i = 0; i < FunctionsPerPatch; ++i)
  {
    for (int j = i; j < FunctionsPerPatch; ++j)
    {
      dense(i, j) = dense(j, i) = packed[entry++];
    }
  }
  return dense;
}

ElementMatrix Pack(const DenseElement& dense)
{
  ElementMatrix packed;
  int entry = 0;
  for (int i = 0; i < FunctionsPerPatch; ++i)
  {
    for (int j = i; j < FunctionsPerPatch; ++j)
    {
      packed[entry++] = dense(i, j);
    }
  }
  return packed;
}

std::array<OctantWeights, 8> MakeChildWeights()
{
  // Along one axis the child's nodes lie at 0, 1/2 or 1 of the parent: octant bit + corner bit.
  const double axis[3][2] = { { 1.0, 0.0 }, { 0.5, 0.5 }, { 0.0, 1.0 } };
  std::array<OctantWeights, 8> weights;
  for (int octant = 0; octant < 8; ++octant)
  {
    for (int c = 0; c < FunctionsPerPatch; ++c)
    {
      for (int p = 0; p < FunctionsPerPatch; ++p)
      {
        double product = 1.0;
        for (int bit = 0; bit < 3; ++bit)
        {
          product *= axis[((octant >> bit) & 1) + ((c >> bit) & 1)][(p >> bit) & 1];
        }
        weights[octant][c][p] = product;
      }
    }
  }
  return weights;
}

} // namespace

void EvaluateTrilinear(const Vec3& local, std::array<double, FunctionsPerPatch>& value)
{
  TrilinearValues(local, value);
}

void EvaluateTrilinearGradient(const Vec3& local, std::array<Vec3, FunctionsPerPatch>& gradient)
{
  std::array<CornerValues, 3> derivative;
  TrilinearGradients(local, derivative);
  for (int c = 0; c < FunctionsPerPatch; ++c)
  {
    gradient[c] = Vec3(derivative[0][c], derivative[1][c], derivative[2][c]);
  }
}

ElementMatrices IntegrateElements(
  const FunctionSpace& space, const QuadratureRule& rule, int threads, const Progress& progress)
{
  const Level& level = space.Finest();
  const Groups pieces = GroupItems(space.piecePatch, level.NumberOfPatches());
  ElementMatrices elements;
  elements.mass.resize(level.NumberOfPatches());
  elements.stiffness.resize(level.NumberOfPatches());
  ParallelRanges(
    level.NumberOfPatches(), threads,
    [&](Id begin, Id end)
    {
      for (Id patch = begin; patch < end; ++patch)
      {
        const Vec3 origin = CellCorner(level.cell[patch]);
        RankOneSum mass;
        RankOneSum stiffness;
        for (Id k = pieces.begin[patch]; k < pieces.begin[patch + 1]; ++k)
        {
          AddPiece(space.clipped, pieces.item[k], origin, rule, mass, stiffness);
        }
        elements.mass[patch] = mass.Packed();
        elements.stiffness[patch] = stiffness.Packed();
      }
    },
    PatchesPerBlock, progress);
  return elements;
}

std::vector<ElementMatrix> CoarsenElements(
  const Level& fine, const Level& coarse, const std::vector<ElementMatrix>& matrices, int threads)
{
  const Groups children = GroupItems(fine.parent, coarse.NumberOfPatches());
  std::vector<ElementMatrix> result(coarse.NumberOfPatches());
  ParallelRanges(coarse.NumberOfPatches(), threads,
    [&](Id begin, Id end)
    {
      for (Id parent = begin; parent < end; ++parent)
      {
        DenseElement sum = DenseElement::Zero();
        for (Id k = children.begin[parent]; k < children.begin[parent + 1]; ++k)
        {
          const Id child = children.item[k];
          const Eigen::Map<const DenseElement> weights(
            ChildWeights(fine.Octant(child)).front().data());
          const DenseElement product = Unpack(matrices[child]) * weights;
          sum.noalias() += weights.transpose() * product;
        }
        result[parent] = Pack(sum);
      }
    });
  return result;
}

const OctantWeights& ChildWeights(int octant)
{
  static const std::array<OctantWeights, 8> weights = MakeChildWeights();
  return weights[octant];
}

} // namespace gridfem
