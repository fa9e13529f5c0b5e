// Galerkin coarsening of element matrices. It writes the functions of a parent in terms of its
// children's functions, for several parents at once, one per SIMD lane. [T (4.6)]
#include "Base/Grouping.h"
#include "Base/Prefetch.h"
#include "Integrals/ElementLanes.h"

#include <algorithm>

namespace gridfem
{
namespace
{

/// The four entries between two pairs of corners. The two corners of a pair differ along one axis.
struct PairBlock
{
  int entry[2][2];
};

/// All blocks of the upper triangle. No two blocks share an entry. In the block of a pair with
/// itself, [0][1] equals [1][0].
using PairBlocks = std::array<PairBlock, 10>;

constexpr PairBlocks MakePairBlocks(int axis)
{
  const int step = 1 << axis;
  PairBlocks blocks{};
  int block = 0;
  for (int i = 0; i < FunctionsPerPatch; ++i)
  {
    for (int j = i; j < FunctionsPerPatch; ++j)
    {
      if (((i | j) & step) == 0)
      {
        blocks[block++] = { { { PackedIndex(i, j), PackedIndex(i, j + step) },
          { PackedIndex(i + step, j), PackedIndex(i + step, j + step) } } };
      }
    }
  }
  return blocks;
}

constexpr PairBlocks BlocksAlong[3] = { MakePairBlocks(0), MakePairBlocks(1), MakePairBlocks(2) };

/// Combines the matrices of two neighbors along an axis into the matrix of linear functions on
/// their union. The corners of `lower` lie at 0 and 1/2 of the union, the corners of `upper` at 1/2
/// and 1.
/// @param lower  overwritten by the result
void Join(const PairBlocks& blocks, ElementLanes& lower, const ElementLanes& upper)
{
  for (const auto& [entry] : blocks)
  {
    const auto& [e00, e01] = entry[0];
    const auto& [e10, e11] = entry[1];
    const Lanes middle = 0.25 * (lower[e11] + upper[e00]);
    const Lanes across = 0.5 * (lower[e01] + upper[e01]) + middle;
    const Lanes back = 0.5 * (lower[e10] + upper[e10]) + middle;
    lower[e00] += 0.5 * (lower[e01] + lower[e10]) + middle;
    lower[e11] = upper[e11] + 0.5 * (upper[e01] + upper[e10]) + middle;
    lower[e01] = across;
    lower[e10] = back;
  }
}

/// Computes the matrices of `count` parents from `begin` on; `count` is at most LaneCount.
void SumChildren(const PatchLevel& fine, const Groups& children, Id begin, int count,
  const Array<ElementMatrix>& matrices, ElementMatrix* result)
{
  const auto forChildren = [&](const auto& visit)
  {
    for (int lane = 0; lane < count; ++lane)
    {
      for (Index k = children.begin[begin + lane]; k < children.begin[begin + lane + 1]; ++k)
      {
        visit(fine.Octant(children.item[k]), lane, matrices[children.item[k]].data());
      }
    }
  };
  const Id parents = static_cast<Id>(children.begin.size()) - 1;
  const Index endOfNext = children.begin[std::min<Id>(begin + 2 * LaneCount, parents)];
  for (Index k = children.begin[begin + count]; k < endOfNext; ++k)
  {
    FetchAll(matrices[children.item[k]]);
  }
  static constexpr ElementMatrix Zero{};
  MatrixPointers ofOctant[8];
  for (MatrixPointers& pointers : ofOctant)
  {
    pointers.fill(Zero.data());
  }
  forChildren([&](int octant, int lane, const double* matrix) { ofOctant[octant][lane] = matrix; });
  std::array<ElementLanes, 8> sum;
  for (int octant = 0; octant < 8; ++octant)
  {
    Gather(ofOctant[octant], sum[octant]);
  }
  forChildren(
    [&](int octant, int lane, const double* matrix)
    {
      if (matrix == ofOctant[octant][lane])
      {
        return;
      }
      // An octant has several patches if several parts of the surface are close to each other.
      for (int entry = 0; entry < ElementEntries; ++entry)
      {
        sum[octant][entry][lane] += matrix[entry];
      }
    });
  for (int axis = 0; axis < 3; ++axis)
  {
    const int step = 1 << axis;
    for (int lower = 0; lower < 8; lower += 2 * step)
    {
      Join(BlocksAlong[axis], sum[lower], sum[lower + step]);
    }
  }
  Scatter(sum[0], count, result);
}

std::array<OctantWeights, 8> MakeChildWeights()
{
  // Along an axis, the child's nodes lie at 0, 1/2 or 1 of the parent. The index is
  // octant bit + corner bit.
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

void CoarsenElements(const PatchLevel& fine, const PatchLevel& coarse,
  const ElementMatrices& elements, ElementMatrices& result, int threads, ElementParts parts)
{
  const bool both = parts == ElementParts::Both;
  const Groups children = GroupItems(fine.parent, coarse.NumberOfPatches(), threads);
  result.mass.resize(coarse.NumberOfPatches());
  if (both)
  {
    result.stiffness.resize(coarse.NumberOfPatches());
  }
  ForEachLaneGroup(coarse.NumberOfPatches(), threads,
    [&](Id begin, int count)
    {
      SumChildren(fine, children, begin, count, elements.mass, result.mass.data() + begin);
      if (both)
      {
        SumChildren(
          fine, children, begin, count, elements.stiffness, result.stiffness.data() + begin);
      }
    });
}

template<>
const OctantWeights& ChildWeights<FunctionsPerPatch>(int octant)
{
  static const std::array<OctantWeights, 8> weights = MakeChildWeights();
  return weights[octant];
}

} // namespace gridfem
