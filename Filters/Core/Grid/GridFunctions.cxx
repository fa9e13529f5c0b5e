#include "Grid/GridFunctions.h"

#include "Base/Parallel.h"
#include "Grid/PatchChoice.h"
#include "Grid/PieceAdjacency.h"
#include "Grid/StoredFunctions.h"

#include <algorithm>
#include <array>
#include <atomic>
#include <map>

namespace gridfem
{

namespace
{

GridFunctions Complete(ClippedMesh clipped, Array<Index> piecePatch, PatchLevel finest,
  Array<Link> links, FunctionSupport support, const Job& job)
{
  GridFunctions space;
  space.support = support;
  space.clipped = std::move(clipped);
  space.piecePatch = std::move(piecePatch);
  space.pointPatch = FindPointPatches(space.clipped, space.piecePatch, finest.NumberOfPatches(),
    space.clipped.numberOfInputPoints, job.threads);
  Release(space.clipped.links); // the links of the patches replace them
  job.Check(0.3);
  space.levels = BuildLevels(std::move(finest), std::move(links), support, job.Part(0.3, 0.9));
  FindComponents(space, job.threads);
  job.Check(1.0);
  return space;
}

/// Replaces the choice by a better patch. The result does not depend on the order of the threads.
void Improve(std::atomic<Index>& choice, Index patch, const PatchChoice& patches)
{
  Index known = choice.load(std::memory_order_relaxed);
  while (patches.IsBetter(patch, known) &&
         !choice.compare_exchange_weak(known, patch, std::memory_order_relaxed))
  {
  }
}

/// Offers a patch to the corners of one of its pieces, except to points whose choice is final.
void ImprovePoints(const ClippedMesh& clipped, Id piece, Index patch, const PatchChoice& patches,
  const std::vector<char>& isFinal, std::vector<std::atomic<Index>>& choice)
{
  for (Index k = clipped.pieceBegin[piece]; k < clipped.pieceBegin[piece + 1]; ++k)
  {
    const Index point = clipped.corners[k];
    if (point < static_cast<Id>(choice.size()) && !isFinal[point])
    {
      Improve(choice[point], patch, patches);
    }
  }
}

/// Gives each point whose patch has no area the patch of a coincident point, if that patch has an
/// area. No equation determines the functions of a patch without area.
void TakeCoincidentPatches(
  const ClippedMesh& clipped, const PatchChoice& patches, Array<Index>& pointPatch)
{
  const auto placeOf = [&](std::size_t point)
  {
    const Vec3& position = clipped.position[point];
    return std::array<double, 3>{ position[0], position[1], position[2] };
  };
  std::map<std::array<double, 3>, Index> best; // per place of such points
  std::vector<std::size_t> without;
  for (std::size_t point = 0; point < pointPatch.size(); ++point)
  {
    if (pointPatch[point] >= 0 && !patches.HasArea(pointPatch[point]))
    {
      without.push_back(point);
      best.emplace(placeOf(point), -1);
    }
  }
  for (std::size_t point = 0; point < pointPatch.size() && !without.empty(); ++point)
  {
    const Index patch = pointPatch[point];
    const auto found = patch >= 0 ? best.find(placeOf(point)) : best.end();
    if (found != best.end() && patches.HasArea(patch) && patches.IsBetter(patch, found->second))
    {
      found->second = patch;
    }
  }
  for (const std::size_t point : without)
  {
    const Index patch = best.at(placeOf(point));
    pointPatch[point] = patch >= 0 ? patch : pointPatch[point];
  }
}

} // namespace

void FindComponents(GridFunctions& space, int threads)
{
  space.component = FunctionComponents(space.Finest(), threads);
  space.numberOfComponents = NumberOfComponents(space.component);
}

Array<Index> FindPointPatches(const ClippedMesh& clipped, const Array<Index>& piecePatch,
  Id numberOfPatches, Id points, int threads)
{
  const PatchChoice patches(clipped, piecePatch, numberOfPatches, threads);
  std::vector<std::atomic<Index>> choice(points);
  for (std::atomic<Index>& patch : choice)
  {
    patch.store(-1, std::memory_order_relaxed);
  }
  std::vector<char> isFinal(points, 0);
  for (const bool needsArea : { true, false })
  {
    ParallelRanges(clipped.NumberOfPieces(), threads,
      [&](Id begin, Id end)
      {
        for (Id piece = begin; piece < end; ++piece)
        {
          if (!needsArea || PieceArea(clipped, piece) >= SmallestPatchArea)
          {
            ImprovePoints(clipped, piece, piecePatch[piece], patches, isFinal, choice);
          }
        }
      });
    std::transform(choice.begin(), choice.end(), isFinal.begin(),
      [](const std::atomic<Index>& patch) { return patch.load() >= 0; });
  }
  Array<Index> pointPatch(choice.size());
  std::transform(choice.begin(), choice.end(), pointPatch.begin(),
    [](const std::atomic<Index>& patch) { return patch.load(); });
  if (clipped.isWelded)
  {
    TakeCoincidentPatches(clipped, patches, pointPatch);
  }
  return pointPatch;
}

GridFunctions BuildGridFunctions(
  const TriangleMesh& mesh, const SpaceOptions& options, const Progress& progress)
{
  return BuildGridFunctions(Clip(mesh, options, progress.Part(0.0, 0.7)),
    options.connectivityAware ? FunctionSupport::ConnectivityAware : FunctionSupport::Plain,
    { options.threads, progress.Part(0.7, 1.0) });
}

GridFunctions BuildGridFunctions(ClippedMesh clipped, FunctionSupport support, const Job& job)
{
  PatchPartition patches = BuildPatches(clipped, support, job.threads);
  job.Check(0.4);
  PatchLevel finest = BuildFinestLevel(clipped.grid.depth, patches, support, job.threads);
  return Complete(std::move(clipped), std::move(patches.piecePatch), std::move(finest),
    std::move(patches.links), support, job.Part(0.5, 1.0));
}

GridFunctions RestoreGridFunctions(ClippedMesh clipped, Array<Index> piecePatch, PatchLevel finest,
  FunctionSupport support, const Progress& progress)
{
  RequireStoredFunctions(clipped, piecePatch, finest, support);
  finest.depth = clipped.grid.depth;
  Array<Link> links = LinksOfGroups(clipped.links, piecePatch);
  return Complete(std::move(clipped), std::move(piecePatch), std::move(finest), std::move(links),
    support, { 0, progress });
}

Array<Link> FindLinks(
  const ClippedMesh& clipped, const Array<Index>& pointClass, const Progress& progress)
{
  struct PieceEdge
  {
    Index low;
    Index high;
    Index piece;
  };
  std::vector<PieceEdge> pieceEdges;
  pieceEdges.reserve(clipped.corners.size());
  const auto classOf = [&](Index point)
  { return point < static_cast<Index>(pointClass.size()) ? pointClass[point] : point; };
  for (Index piece = 0; piece < clipped.NumberOfPieces(); ++piece)
  {
    const Id begin = clipped.pieceBegin[piece];
    const Id end = clipped.pieceBegin[piece + 1];
    for (Id k = begin; k < end; ++k)
    {
      const Index a = classOf(clipped.corners[k]);
      const Index b = classOf(clipped.corners[k + 1 == end ? begin : k + 1]);
      if (a != b)
      {
        pieceEdges.push_back({ std::min(a, b), std::max(a, b), piece });
      }
    }
  }
  progress.Check(0.2);
  std::sort(pieceEdges.begin(), pieceEdges.end(),
    [](const PieceEdge& a, const PieceEdge& b)
    {
      return a.low != b.low     ? a.low < b.low
             : a.high != b.high ? a.high < b.high
                                : a.piece < b.piece;
    });
  progress.Check(0.7);
  Array<EdgeUse> uses;
  uses.reserve(pieceEdges.size());
  Index edge = -1;
  for (std::size_t k = 0; k < pieceEdges.size(); ++k)
  {
    const bool same = k > 0 && pieceEdges[k].low == pieceEdges[k - 1].low &&
                      pieceEdges[k].high == pieceEdges[k - 1].high;
    edge += same ? 0 : 1;
    uses.push_back({ edge, pieceEdges[k].piece });
  }
  Array<Link> links;
  LinkStars(uses, Id{ edge } + 1, PieceCells(clipped), 1, links);
  progress.Check(1.0);
  return links;
}

} // namespace gridfem
