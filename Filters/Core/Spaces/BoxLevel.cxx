#include "Spaces/BoxLevel.h"

#include "Base/Grouping.h"
#include "Base/Parallel.h"

#include <algorithm>

namespace gridfem
{
namespace
{

/// Weights of a parent's corners (columns) in a child's (rows). Bits of `octant` say in which half
/// of the parent the child lies.
DenseElement MakeWeights(int halvedAxes, int octant)
{
  DenseElement weights = DenseElement::Ones();
  for (int c = 0; c < FunctionsPerPatch; ++c)
  {
    for (int p = 0; p < FunctionsPerPatch; ++p)
    {
      for (int bit = 1; bit < FunctionsPerPatch; bit <<= 1)
      {
        const double upper =
          halvedAxes & bit ? 0.5 * (bool(octant & bit) + bool(c & bit)) : bool(c & bit);
        weights(c, p) *= p & bit ? upper : 1.0 - upper;
      }
    }
  }
  return weights;
}

const DenseElement& Weights(int halvedAxes, int octant)
{
  static const auto table = []
  {
    std::array<std::array<DenseElement, 8>, 8> all;
    for (int halved = 0; halved < 8; ++halved)
    {
      for (int o = 0; o < 8; ++o)
      {
        all[halved][o] = MakeWeights(halved, o);
      }
    }
    return all;
  }();
  return table[halvedAxes][octant];
}

/// The parents of all boxes, box by box.
std::vector<Box> ParentsOf(const BoxLevel& level, const Array<Index>& parentOfPatch)
{
  std::vector<Box> parents;
  parents.reserve(level.boxes.size());
  for (const Box& box : level.boxes)
  {
    CellIndex cell = MortonDecode(box.cell);
    for (int d = 0; d < 3; ++d)
    {
      cell[d] >>= level.HalvedAxes(box) >> d & 1;
    }
    parents.push_back({ MortonEncode(cell), box.axis, parentOfPatch[box.patch] });
  }
  return parents;
}

/// Galerkin coarsening, as of patches.
Array<ElementMatrix> CoarsenElements(const BoxLevel& fine, Id parents, int threads)
{
  const Groups children = GroupItems(fine.parent, parents, threads);
  Array<ElementMatrix> elements(parents);
  ParallelRanges(
    parents, threads,
    [&](Id begin, Id end)
    {
      for (Id parent = begin; parent < end; ++parent)
      {
        DenseElement sum = DenseElement::Zero();
        for (Index k = children.begin[parent]; k < children.begin[parent + 1]; ++k)
        {
          const Index child = children.item[k];
          const DenseElement& weights = WeightsInParent(fine, fine.boxes[child]);
          const DenseElement product = Unpack(fine.elements[child]) * weights;
          sum += weights.transpose() * product;
        }
        elements[parent] = Pack(sum);
      }
    },
    PatchesPerBlock);
  return elements;
}

/// A function is one of the grid of the box's width, at the lower end of a cell along the axis, and
/// a layer: the top of a cell belongs to the next one.
std::uint64_t KeyOfFunction(
  const PatchLevel& level, const BoxLevel& boxes, const Box& box, int corner)
{
  const int bit = 1 << box.axis;
  const int layersOfCell = boxes.width - boxes.thickness;
  const int layer = MortonDecode(box.cell)[box.axis];
  const int end = ((layer >> layersOfCell) + 1) << layersOfCell;
  const int place = layer + bool(corner & bit);
  const int gridCorner = place == end ? corner | bit : corner & ~bit;
  const auto function = static_cast<std::uint64_t>(level.dof[box.patch][gridCorner]);
  constexpr int LayerBits = MaximumDepth + 1;
  constexpr int FunctionBits = 31;
  return (std::uint64_t(box.axis) << FunctionBits | function) << LayerBits | std::uint64_t(place);
}

} // namespace

const DenseElement& WeightsInParent(const BoxLevel& level, const Box& box)
{
  return Weights(level.HalvedAxes(box), static_cast<int>(box.cell & 7));
}

BoxLevel CoarsenBoxes(const GridFunctions& space, BoxLevel& fine, int threads)
{
  BoxLevel coarse;
  coarse.width = fine.width + 1;
  coarse.thickness =
    fine.thickness + (coarse.width - fine.thickness > BoxLevel::LargestRatio ? 1 : 0);
  const std::vector<Box> parents = ParentsOf(fine, space.levels[fine.width].parent);
  coarse.boxes = parents;
  std::sort(coarse.boxes.begin(), coarse.boxes.end());
  coarse.boxes.erase(std::unique(coarse.boxes.begin(), coarse.boxes.end()), coarse.boxes.end());
  fine.parent.resize(fine.boxes.size());
  ParallelRanges(static_cast<Id>(parents.size()), threads,
    [&](Id begin, Id end)
    {
      for (Id k = begin; k < end; ++k)
      {
        const auto found = std::lower_bound(coarse.boxes.begin(), coarse.boxes.end(), parents[k]);
        fine.parent[k] = static_cast<Index>(found - coarse.boxes.begin());
      }
    });
  coarse.elements = CoarsenElements(fine, static_cast<Id>(coarse.boxes.size()), threads);
  return coarse;
}

PatchLevel MakeLevel(const GridFunctions& space, const BoxLevel& boxes)
{
  PatchLevel level;
  std::vector<std::uint64_t> keys;
  keys.reserve(FunctionsPerPatch * boxes.boxes.size());
  for (const Box& box : boxes.boxes)
  {
    for (int corner = 0; corner < FunctionsPerPatch; ++corner)
    {
      keys.push_back(KeyOfFunction(space.levels[boxes.width], boxes, box, corner));
    }
  }
  std::vector<std::uint64_t> functions = keys;
  std::sort(functions.begin(), functions.end());
  functions.erase(std::unique(functions.begin(), functions.end()), functions.end());
  level.numberOfFunctions = static_cast<Index>(functions.size());
  level.dof.resize(boxes.boxes.size());
  for (std::size_t k = 0; k < keys.size(); ++k)
  {
    const auto found = std::lower_bound(functions.begin(), functions.end(), keys[k]);
    level.dof[k / FunctionsPerPatch][k % FunctionsPerPatch] =
      static_cast<Index>(found - functions.begin());
  }
  for (const Box& box : boxes.boxes)
  {
    level.cell.push_back(box.cell);
  }
  return level;
}

} // namespace gridfem
