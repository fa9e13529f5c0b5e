#include "Parallel/RankClip.h"

#include "Base/Parallel.h"
#include "Base/SortEachOnce.h"
#include "Parallel/LevelNumbering.h"
#include "Parallel/OwnPieces.h"
#include "Parallel/RankMemory.h"
#include "Solvers/MemoryEstimate.h"
#include "Solvers/Requirements.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <iterator>

namespace gridfem
{

namespace
{

Grid WithDepth(Grid grid, int depth)
{
  grid.spacing = std::ldexp(grid.spacing, grid.depth - depth);
  grid.depth = depth;
  return grid;
}

/// Collective. Number of points. Points on borders count once, as far as the triangles tell.
double SumOfPoints(const Communicator& ranks, const TriangleMesh& own)
{
  double points = WeldedPoints(own);
  ranks.Sum(&points, 1);
  return points;
}

/// Collective. Expected number of functions of the surface of all ranks in a grid.
double SumOfFunctions(const Communicator& ranks, const TriangleMesh& own, const Grid& grid)
{
  double patches = 0.0;
  ranks.Together(
    [&] { patches = own.triangles.empty() ? 0.0 : EstimateMemory(own, grid).patches; });
  ranks.Sum(&patches, 1);
  return FunctionsOfPatches(patches);
}

/// Collective. The depth that one rank would suggest, or a coarser one that fits into memory.
int SuggestDepth(const Communicator& ranks, const TriangleMesh& own, const Grid& grid, bool hasHats)
{
  const int suggested = SuggestedDepth(SumOfPoints(ranks, own),
    [&](int depth) { return SumOfFunctions(ranks, own, WithDepth(grid, depth)); });
  return FinestDepth(suggested, MinimumDepth,
    [&](int depth) { return FitsMemory(ranks, own, WithDepth(grid, depth), hasHats); });
}

/// Collective. DepthForPoints for the surface of all ranks.
int LimitDepth(
  const Communicator& ranks, const TriangleMesh& own, double functionsPerPoint, const Grid& grid)
{
  const double functions = functionsPerPoint * SumOfPoints(ranks, own);
  return FinestDepth(grid.depth, MinimumDepth,
    [&](int depth) { return SumOfFunctions(ranks, own, WithDepth(grid, depth)) <= functions; });
}

/// Collective. The frame in which the surface of all ranks is clipped.
ClipFrame FrameOf(
  const Communicator& ranks, const TriangleMesh& own, const RankSpaceOptions& rankOptions)
{
  const SpaceOptions& options = rankOptions.space.functions;
  const bool isAutomatic = options.depth == AutomaticDepth && !rankOptions.given;
  const int depth = rankOptions.given ? rankOptions.given->grid.depth
                    : isAutomatic     ? CoarsestSuggestion
                                      : options.depth;
  constexpr double Infinity = std::numeric_limits<double>::infinity();
  std::array<double, 7> extremes; // largest of -x, -y, -z, x, y, z and of all magnitudes
  ranks.Together(
    [&]
    {
      Validate(own, options.threads);
      EmbedInGrid({}, {}, depth); // throws for a wrong depth
      const Bounds bounds = BoundsOf(own.points, UsedPoints(own, options.threads), options.threads);
      for (int axis = 0; axis < 3; ++axis)
      {
        extremes[axis] = -bounds.low[axis];
        extremes[3 + axis] = bounds.high[axis];
      }
      extremes[6] = 0.0;
    });
  ranks.Maximum(extremes.data(), 6);
  ClipFrame frame;
  if (extremes[0] == -Infinity)
  {
    frame.grid = EmbedInGrid({}, {}, depth); // no rank has a triangle
  }
  else
  {
    const Vec3 low(-extremes[0], -extremes[1], -extremes[2]);
    const Vec3 high(extremes[3], extremes[4], extremes[5]);
    frame.grid = EmbedInGrid({ low, high }, {}, depth);
    extremes[6] = low.cwiseAbs().cwiseMax(high.cwiseAbs()).maxCoeff();
  }
  if (isAutomatic)
  {
    frame.grid =
      WithDepth(frame.grid, SuggestDepth(ranks, own, frame.grid, rankOptions.isBelowHats));
  }
  if (rankOptions.isBelowHats && std::isfinite(rankOptions.functionsPerPoint))
  {
    frame.grid =
      WithDepth(frame.grid, LimitDepth(ranks, own, rankOptions.functionsPerPoint, frame.grid));
  }
  if (rankOptions.given)
  {
    frame.grid = rankOptions.given->grid;
  }
  frame.tolerance = SnapTolerance(extremes[6], frame.grid);
  return frame;
}

/// Collective. The cells of the received triangles, and the cells among them in this rank's region.
GivenCells SendCells(
  const Redistribution& distribution, const GivenCells& given, const CellRegion& region)
{
  MultiVector keys(static_cast<Id>(given.ofTriangle.size()), 1); // of 42 bits at most
  std::copy(given.ofTriangle.begin(), given.ofTriangle.end(), keys.data());
  keys = distribution.SendTriangles(keys);
  GivenCells received;
  received.grid = given.grid;
  received.ofTriangle.assign(keys.data(), keys.data() + keys.size());
  std::vector<MortonKey> cells = received.ofTriangle;
  SortEachOnce(cells);
  std::copy_if(cells.begin(), cells.end(), std::back_inserter(received.cells),
    [&](MortonKey cell) { return region.Contains(MortonDecode(cell)); });
  return received;
}

} // namespace

RankClip::RankClip(const Communicator& ranks, const TriangleMesh& own,
  const RankSpaceOptions& options, const Progress& progress, const TriangleList& copiesOfOthers)
{
  ClipFrame frame = FrameOf(ranks, own, options);
  const auto* const cells = options.given ? &options.given->ofTriangle : nullptr;
  partition = std::make_shared<const BlockPartition>(ranks, own, frame, options.granularity, cells);
  distribution = std::make_shared<Redistribution>(ranks, own, frame.grid, *partition, cells);
  auto received = std::make_shared<TriangleMesh>(distribution->TakeMesh());
  copies = std::make_shared<const TriangleCopies>(
    ranks, own, copiesOfOthers, frame.grid, *partition, *received);
  RequireMemory(ranks, *received, frame.grid, options.isBelowHats);
  const CellRegion region = partition->RegionOf(ranks.Rank());
  GivenCells given;
  if (options.given)
  {
    given = SendCells(*distribution, *options.given, region);
  }
  ranks.Together(
    [&]
    {
      progress.Check(0.25);
      const SpaceOptions& functions = options.space.functions;
      if (options.given)
      {
        clipped = ClipOfGivenCells(
          *received, given, functions.weldCoincidentPoints, progress.Part(0.25, 1.0));
        return;
      }
      frame.region = &region;
      ClipOptions clip = functions;
      clip.depth = frame.grid.depth;
      clipped = ClipPart(*received, frame, clip, progress.Part(0.25, 1.0));
    });
  mesh = std::move(received);
}

void RankClip::KeepOwn(const Communicator& ranks)
{
  ranks.Together(
    [&]
    {
      PatchLevel cells; // a patch is all that is in a cell
      cells.depth = clipped.grid.depth;
      cells.cell = clipped.cells;
      const PatchRange own = OwnPatches(cells, *partition, ranks.Rank());
      Release(clipped.links);
      GridFunctions all;
      all.piecePatch = PieceCells(clipped);
      all.clipped = std::move(clipped);
      KeepPieces(own.first, own.last, all);
      clipped = std::move(all.clipped);
    });
}

} // namespace gridfem
