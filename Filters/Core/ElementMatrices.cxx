// Integration of element matrices patch by patch, and their Galerkin coarsening.
#include "ElementMatrices.h"

#include "Grouping.h"
#include "PatchMoments.h"
#include "PieceSamples.h"
#include "TrilinearBasis.h"

namespace gridfem
{
namespace
{

/// Patches per parallel job: some ten thousand samples.
constexpr Id PatchesPerBlock = 256;

/// Adds the integrals over one piece.
void AddPiece(const ClippedMesh& clipped, Id piece, const Vec3& origin, const QuadratureRule& rule,
  PatchMoments& patch)
{
  Moments moments;
  Vec3 areaVector = Vec3::Zero();
  ForEachFanTriangle(clipped, piece, origin,
    [&](const FanTriangle& triangle)
    {
      areaVector += triangle.areaVector;
      for (const QuadratureRule::Point& point : rule.points)
      {
        moments.AddSample(triangle.At(point.barycentric), point.weight * triangle.area);
      }
    });
  patch.AddPiece(moments, areaVector);
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
  const Groups pieces = GroupItems(space.piecePatch, level.NumberOfPatches(), threads);
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
        PatchMoments moments;
        for (Id k = pieces.begin[patch]; k < pieces.begin[patch + 1]; ++k)
        {
          AddPiece(space.clipped, pieces.item[k], origin, rule, moments);
        }
        elements.mass[patch] = moments.Mass();
        elements.stiffness[patch] = moments.Stiffness();
      }
    },
    PatchesPerBlock, progress);
  return elements;
}

Array<ElementMatrix> CoarsenElements(
  const Level& fine, const Level& coarse, const Array<ElementMatrix>& matrices, int threads)
{
  const Groups children = GroupItems(fine.parent, coarse.NumberOfPatches(), threads);
  Array<ElementMatrix> result(coarse.NumberOfPatches());
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
