#include "Integrals/SmoothElements.h"

#include "Base/Grouping.h"
#include "Integrals/QuadraticMoments.h"

#include <algorithm>

namespace gridfem
{
namespace
{

constexpr int Size = SmoothFunctionsPerPatch;
using FullMatrix = Eigen::Matrix<double, Size, Size, Eigen::RowMajor>;

/// The weight of a parent's function for the coefficient of a function of its child, along one
/// axis. A coarse B-spline is the sum of four fine ones with the weights 1/4, 3/4, 3/4 and 1/4.
double AxisWeight(int octantBit, int child, int parent)
{
  switch (octantBit + child + 1 - 2 * parent)
  {
    case -1:
    case 2:
      return 0.25;
    case 0:
    case 1:
      return 0.75;
    default:
      return 0.0;
  }
}

std::array<BasicOctantWeights<Size>, 8> MakeSmoothWeights()
{
  std::array<BasicOctantWeights<Size>, 8> weights;
  for (int octant = 0; octant < 8; ++octant)
  {
    for (int c = 0; c < Size; ++c)
    {
      for (int p = 0; p < Size; ++p)
      {
        weights[octant][c][p] = AxisWeight(octant & 1, c % 3, p % 3) *
                                AxisWeight((octant >> 1) & 1, c / 3 % 3, p / 3 % 3) *
                                AxisWeight(octant >> 2, c / 9, p / 9);
      }
    }
  }
  return weights;
}

/// The weights that are not zero: eight for each function of the child.
struct SparseWeights
{
  std::array<std::array<int, 8>, Size> parent;
  std::array<std::array<double, 8>, Size> weight;

  explicit SparseWeights(const BasicOctantWeights<Size>& weights)
  {
    for (int c = 0; c < Size; ++c)
    {
      int count = 0;
      for (int p = 0; p < Size; ++p)
      {
        if (weights[c][p] != 0.0)
        {
          parent[c][count] = p;
          weight[c][count++] = weights[c][p];
        }
      }
    }
  }
};

const SparseWeights& SparseWeightsOf(int octant)
{
  static const std::array<SparseWeights, 8> all = { SparseWeights(ChildWeights<Size>(0)),
    SparseWeights(ChildWeights<Size>(1)), SparseWeights(ChildWeights<Size>(2)),
    SparseWeights(ChildWeights<Size>(3)), SparseWeights(ChildWeights<Size>(4)),
    SparseWeights(ChildWeights<Size>(5)), SparseWeights(ChildWeights<Size>(6)),
    SparseWeights(ChildWeights<Size>(7)) };
  return all[octant];
}

/// result += Pᵀ matrix, with the weights P of an octant.
void AddTransposed(const SparseWeights& P, const FullMatrix& matrix, FullMatrix& result)
{
  for (int c = 0; c < Size; ++c)
  {
    for (int k = 0; k < 8; ++k)
    {
      result.row(P.parent[c][k]) += P.weight[c][k] * matrix.row(c);
    }
  }
}

FullMatrix Unpack(const SmoothElementMatrix& packed)
{
  FullMatrix matrix;
  for (int i = 0, k = 0; i < Size; ++i)
  {
    for (int j = i; j < Size; ++j, ++k)
    {
      matrix(i, j) = matrix(j, i) = packed[k];
    }
  }
  return matrix;
}

/// Σ Pᵀ E P over the children of a parent, in their order.
SmoothElementMatrix SumOfChildren(const SmoothLevel& fine, const Groups& children, Id parent,
  const Array<SmoothElementMatrix>& matrices)
{
  FullMatrix sum = FullMatrix::Zero();
  for (Index k = children.begin[parent]; k < children.begin[parent + 1]; ++k)
  {
    const Index child = children.item[k];
    const SparseWeights& P = SparseWeightsOf(fine.Octant(child));
    FullMatrix half = FullMatrix::Zero();
    AddTransposed(P, Unpack(matrices[child]), half);
    const FullMatrix turned = half.transpose();
    AddTransposed(P, turned, sum);
  }
  SmoothElementMatrix packed;
  for (int i = 0, k = 0; i < Size; ++i)
  {
    for (int j = i; j < Size; ++j, ++k)
    {
      packed[k] = 0.5 * (sum(i, j) + sum(j, i));
    }
  }
  return packed;
}

} // namespace

SmoothElementMatrices IntegrateSmoothElements(const GridFunctions& grid, const QuadratureRule& rule,
  double normalStabilization, const SmoothWeights& weights, const Job& job)
{
  // This share determines the number of iterations. With half of it, there are a quarter more.
  constexpr double BendShare = 0.2;
  SmoothElementMatrices elements;
  elements.mass.resize(grid.Finest().NumberOfPatches());
  elements.stiffness.resize(grid.Finest().NumberOfPatches());
  ForEachPatch(grid, rule, job,
    [&](Id patch, auto&& forEachBatch)
    {
      QuadraticMoments moments;
      forEachBatch(
        [&](const TriangleBatch& batch)
        {
          const TrianglePlanes planes(batch);
          BatchWeights ofBatch(
            grid.clipped, batch, planes.normal, weights.mass, weights.tensor, 0.0);
          const Lanes normalWeight =
            normalStabilization * OnBatch(grid.clipped, batch, weights.normal);
          ofBatch.AddNormal(planes.normal, normalWeight);
          moments.Add(batch, planes, rule, ofBatch, BendShare * normalWeight);
        });
      elements.mass[patch] = moments.Mass();
      elements.stiffness[patch] = moments.Stiffness();
    });
  return elements;
}

void CoarsenElements(const SmoothLevel& fine, const SmoothLevel& coarse,
  const SmoothElementMatrices& elements, SmoothElementMatrices& result, int threads)
{
  const Groups children = GroupItems(fine.parent, coarse.NumberOfPatches(), threads);
  result.mass.resize(coarse.NumberOfPatches());
  result.stiffness.resize(coarse.NumberOfPatches());
  ParallelRanges(
    coarse.NumberOfPatches(), threads,
    [&](Id begin, Id end)
    {
      for (Id parent = begin; parent < end; ++parent)
      {
        result.mass[parent] = SumOfChildren(fine, children, parent, elements.mass);
        result.stiffness[parent] = SumOfChildren(fine, children, parent, elements.stiffness);
      }
    },
    PatchesPerBlock);
}

template<>
const BasicOctantWeights<Size>& ChildWeights<Size>(int octant)
{
  static const std::array<BasicOctantWeights<Size>, 8> weights = MakeSmoothWeights();
  return weights[octant];
}

} // namespace gridfem
