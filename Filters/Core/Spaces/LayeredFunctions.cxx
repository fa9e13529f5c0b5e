#include "Spaces/LayeredFunctions.h"

#include "Algebra/FillRows.h"
#include "Integrals/TrilinearBasis.h"
#include "Spaces/BoxLevel.h"
#include "Spaces/HiddenFunctions.h"
#include "Spaces/PatchOrdering.h"

#include <algorithm>

namespace gridfem
{
namespace
{

/// Exponent of the width of the finest boxes that are corrected. Halving once would double the
/// work and hardly change a count.
constexpr int FirstWidth = 2;

constexpr Index CoarsestSize = 256;

/// The axis of every finest function: of the least ∫ n_a² per area in a patch of its support.
std::vector<int> AxesOfFunctions(const PatchLevel& level, const Array<ElementMatrix>& stiffness)
{
  std::vector<int> axis(level.numberOfFunctions, 0);
  std::vector<double> least(level.numberOfFunctions, 2.0);
  for (Id patch = 0; patch < level.NumberOfPatches(); ++patch)
  {
    // ∫ 1 - n_a²; half of their sum is the area.
    const Eigen::Vector3d tangential = StiffnessOfCoordinates(stiffness[patch]).diagonal();
    int across = 0;
    const double most = tangential.maxCoeff(&across);
    const double share = 1.0 - 2.0 * most / tangential.sum();
    for (const Index function : level.dof[patch])
    {
      if (share < least[function]) // not for NaN of patches without area
      {
        least[function] = share;
        axis[function] = across;
      }
    }
  }
  return axis;
}

/// Where the boxes of one cell are, and whom they serve.
struct FinestBoxes
{
  std::vector<int> axis;                        // per function
  std::vector<std::array<Index, 3>> boxOfPatch; // per axis; -1: no function of the patch has it
};

/// The patches as boxes of one cell, once for each axis of their functions.
FinestBoxes FindBoxes(const PatchLevel& finest, std::vector<int> axis, std::vector<Box>& boxes)
{
  std::vector<std::array<Index, 3>> boxOfPatch(finest.NumberOfPatches());
  for (Index patch = 0; patch < static_cast<Index>(finest.NumberOfPatches()); ++patch)
  {
    for (int a = 0; a < 3; ++a)
    {
      const auto& dof = finest.dof[patch];
      const bool isUsed =
        std::any_of(dof.begin(), dof.end(), [&](Index f) { return axis[f] == a; });
      boxOfPatch[patch][a] = isUsed ? static_cast<Index>(boxes.size()) : -1;
      if (isUsed)
      {
        boxes.push_back({ finest.cell[patch], a, patch });
      }
    }
  }
  return { std::move(axis), std::move(boxOfPatch) };
}

/// Energies of the heights times the functions of each box that belong to its axis.
Array<ElementMatrix> ElementsOf(const std::vector<Box>& boxes, const PatchLevel& finest,
  const ElementMatrices& elements, const std::vector<int>& axis, const std::vector<double>& height,
  int threads)
{
  Array<ElementMatrix> scaled(boxes.size());
  ParallelRanges(static_cast<Id>(boxes.size()), threads,
    [&](Id begin, Id end)
    {
      for (Id k = begin; k < end; ++k)
      {
        const auto& dof = finest.dof[boxes[k].patch];
        CornerValues factor;
        for (int c = 0; c < FunctionsPerPatch; ++c)
        {
          factor[c] = axis[dof[c]] == boxes[k].axis ? height[dof[c]] : 0.0;
        }
        scaled[k] = ScaledEnergy(elements, boxes[k].patch, factor);
      }
    });
  return scaled;
}

/// Of a function on the functions of a box.
using CornerWeights = Eigen::Matrix<double, 1, FunctionsPerPatch>;

/// Any box of a function's support gives the same row; the first is used.
SparseMatrix ProlongationBetween(const BoxLevel& boxes, const PatchLevel& fine,
  const FunctionPlaces& places, const PatchLevel& coarse, int threads)
{
  SparseMatrix prolongation;
  prolongation.rows = fine.numberOfFunctions;
  prolongation.columns = coarse.numberOfFunctions;
  FillRows(prolongation, threads,
    [&](Index row, Array<Index>& columns, Array<double>& values)
    {
      const Index place = places.item[places.begin[row]];
      const Index box = place / FunctionsPerPatch;
      const CornerWeights weights =
        WeightsInParent(boxes, boxes.boxes[box]).row(place % FunctionsPerPatch);
      AppendRow(coarse.dof[boxes.parent[box]], weights.data(), columns, values);
    });
  return prolongation;
}

/// Rows: finest functions, times their heights; columns: functions of the first level of boxes.
SparseMatrix ProlongationToFinest(const FinestBoxes& finest, const std::vector<BoxLevel>& skipped,
  const FunctionPlaces& places, const std::vector<double>& height, const PatchLevel& coarse,
  int threads)
{
  SparseMatrix prolongation;
  prolongation.rows = static_cast<Index>(height.size());
  prolongation.columns = coarse.numberOfFunctions;
  FillRows(prolongation, threads,
    [&](Index row, Array<Index>& columns, Array<double>& values)
    {
      if (height[row] == 0.0)
      {
        return;
      }
      const Index place = places.item[places.begin[row]];
      Index box = finest.boxOfPatch[place / FunctionsPerPatch][finest.axis[row]];
      CornerWeights weights = CornerWeights::Zero();
      weights[place % FunctionsPerPatch] = height[row];
      for (const BoxLevel& level : skipped)
      {
        weights = (weights * WeightsInParent(level, level.boxes[box])).eval();
        box = level.parent[box];
      }
      AppendRow(coarse.dof[box], weights.data(), columns, values);
    });
  return prolongation;
}

MultigridLevel MakeMultigridLevel(
  const PatchLevel& level, const FunctionPlaces& places, const BoxLevel& boxes, int threads)
{
  MultigridLevel result;
  result.A = BuildPattern(level, places, threads);
  AssembleValues(level, places, {}, 0.0, boxes.elements, 1.0, result.A, threads);
  result.order = OrderPatches(level);
  return result;
}

} // namespace

void AddLayeredFunctions(
  const GridFunctions& space, const LevelOperators& system, HiddenLevels& hidden, int threads)
{
  const int widest = static_cast<int>(space.levels.size()) - 1;
  if (widest < FirstWidth)
  {
    return;
  }
  const PatchLevel& finest = space.Finest();
  const ElementMatrices& elements = system.elements.front();
  std::vector<BoxLevel> skipped(1);
  const FinestBoxes finestBoxes =
    FindBoxes(finest, AxesOfFunctions(finest, elements.stiffness), skipped[0].boxes);
  skipped[0].elements =
    ElementsOf(skipped[0].boxes, finest, elements, finestBoxes.axis, hidden.height, threads);
  while (static_cast<int>(skipped.size()) < FirstWidth)
  {
    BoxLevel next = CoarsenBoxes(space, skipped.back(), threads);
    skipped.push_back(std::move(next));
  }
  BoxLevel boxes = CoarsenBoxes(space, skipped.back(), threads);
  PatchLevel level = MakeLevel(space, boxes);
  hidden.layeredProlongation = ProlongationToFinest(
    finestBoxes, skipped, system.places.front(), hidden.height, level, threads);
  skipped.clear();
  while (true)
  {
    const FunctionPlaces places = PlacesOfFunctions(level, threads);
    hidden.layered.push_back(MakeMultigridLevel(level, places, boxes, threads));
    if (level.numberOfFunctions <= CoarsestSize || boxes.width == widest)
    {
      return;
    }
    BoxLevel coarserBoxes = CoarsenBoxes(space, boxes, threads);
    PatchLevel coarser = MakeLevel(space, coarserBoxes);
    hidden.layered.back().prolongation =
      ProlongationBetween(boxes, level, places, coarser, threads);
    boxes = std::move(coarserBoxes);
    level = std::move(coarser);
  }
}

} // namespace gridfem
