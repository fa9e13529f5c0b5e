#include "Grid/ClipPart.h"

#include "Base/Errors.h"
#include "Base/Job.h"
#include "Base/Parallel.h"
#include "Base/PerThreadLists.h"
#include "Grid/CutPoints.h"
#include "Grid/MergePieces.h"
#include "Grid/PieceAdjacency.h"

#include <algorithm>
#include <atomic>
#include <cmath>
#include <limits>
#include <numeric>

namespace gridfem
{

namespace
{

/// Returns the largest absolute value of the used points' coordinates.
double LargestCoordinate(const TriangleMesh& mesh, const std::vector<char>& used, int threads)
{
  struct Largest
  {
    double value = 0.0;
    void operator+=(const Largest& other) { value = std::max(value, other.value); }
  };
  return ParallelSum(static_cast<Id>(mesh.points.size()), threads, Largest(),
    [&](Id begin, Id end)
    {
      Largest part;
      for (Id i = begin; i < end; ++i)
      {
        part.value =
          used[i] ? std::max(part.value, mesh.points[i].cwiseAbs().maxCoeff()) : part.value;
      }
      return part;
    })
    .value;
}

Array<Vec3> SnapToPlanes(const Array<Vec3>& points, double side, double tolerance, int threads)
{
  Array<Vec3> snapped(points.size());
  ParallelRanges(static_cast<Id>(points.size()), threads,
    [&](Id begin, Id end)
    {
      for (Id i = begin; i < end; ++i)
      {
        for (int axis = 0; axis < 3; ++axis)
        {
          const double value = std::clamp(points[i][axis], 0.0, side);
          const double nearest = std::nearbyint(value);
          snapped[i][axis] = std::abs(value - nearest) <= tolerance ? nearest : value;
        }
      }
    });
  return snapped;
}

/// Consecutive triangles that one thread clips.
struct WorkRange
{
  Id begin;
  Id end;
  double pieces; // expected
};

/// Splits the triangles into ranges whose expected number of pieces hardly exceeds PiecesPerRange.
/// The ranges depend on the mesh alone.
Array<WorkRange> SplitWork(
  const std::vector<std::array<Id, 3>>& triangles, const Array<Vec3>& position, int threads)
{
  constexpr double PiecesPerRange = 8192.0;
  Array<WorkRange> work;
  AppendRanges(static_cast<Id>(triangles.size()), threads, work,
    [&](Id begin, Id end, Array<WorkRange>& ranges)
    {
      WorkRange range{ begin, begin, 0.0 };
      for (Id t = begin; t < end; ++t)
      {
        const Vec3& a = position[triangles[t][0]];
        const Vec3& b = position[triangles[t][1]];
        const Vec3& c = position[triangles[t][2]];
        const Vec3 extent = a.cwiseMax(b).cwiseMax(c) - a.cwiseMin(b).cwiseMin(c);
        range.pieces += 1.0 + extent.sum() + 0.5 * (b - a).cross(c - a).norm();
        range.end = t + 1;
        if (range.pieces > PiecesPerRange || range.end == end)
        {
          ranges.push_back(range);
          range = { range.end, range.end, 0.0 };
        }
      }
    });
  return work;
}

/// Makes a store with room for its share, so that it need not move. Unused memory costs nothing.
ClipBuffer MakeStore(double pieces)
{
  const auto room = static_cast<std::size_t>(std::min(1.2 * pieces, 2e9)) + 64;
  ClipBuffer store;
  store.key.reserve(room);
  store.triangle.reserve(room);
  store.cornerBegin.reserve(room + 1);
  store.corner.reserve(4 * room);
  store.interior.reserve(room / 4);
  store.links.reserve(room);
  store.cornerBegin.push_back(0);
  return store;
}

ClipBlock BeginBlock(ClipBuffer& store)
{
  ClipBlock block{};
  block.store = &store;
  block.firstPiece = store.Size();
  block.firstCorner = static_cast<Index>(store.corner.size());
  block.firstInterior = static_cast<Index>(store.interior.size());
  block.firstLink = static_cast<Index>(store.links.size());
  return block;
}

void EndBlock(ClipBlock& block)
{
  const ClipBuffer& store = *block.store;
  RequireIndices(static_cast<double>(store.corner.size()), "corners of pieces");
  block.pieces = store.Size() - block.firstPiece;
  block.corners = static_cast<Index>(store.corner.size()) - block.firstCorner;
  block.interiors = static_cast<Index>(store.interior.size()) - block.firstInterior;
  block.links = static_cast<Index>(store.links.size()) - block.firstLink;
}

ClippedTriangles ClipTriangles(const ClipInput& input, const Array<WorkRange>& work,
  Array<Index>& stretches, ClippedMesh& clipped, const Job& job)
{
  ClippedTriangles result;
  const int team = NumberOfThreads(job.threads);
  double pieces = 0.0;
  for (const WorkRange& range : work)
  {
    pieces += range.pieces;
  }
  std::atomic<Index> nextChunk{ 0 };
  std::vector<TriangleClipper> clippers;
  for (int t = 0; t < team; ++t)
  {
    result.stores.push_back(MakeStore(pieces / team));
    clippers.emplace_back(input, clipped, stretches, nextChunk);
  }
  result.blocks.resize(work.size());
  ParallelBlocks(
    static_cast<Id>(result.blocks.size()), team,
    [&](Id b, int thread)
    {
      ClipBlock& block = result.blocks[b];
      block = BeginBlock(result.stores[thread]);
      for (Id t = work[b].begin; t < work[b].end; ++t)
      {
        clippers[thread].Clip(t, *block.store);
      }
      EndBlock(block);
    },
    job.progress);
  return result;
}

/// Clips the mesh and joins the pieces. clipped.position holds the input points.
void ClipAndJoin(const ClipInput& input, const Job& job, ClippedMesh& clipped)
{
  const Array<WorkRange> work = SplitWork(input.triangles, input.position, job.threads);
  job.Check(0.05);
  RequireIndices(static_cast<double>(input.position.size()) + input.edges.numberOfCuts,
    "points of the clipped mesh");
  AllocateEdgeCuts(input.edges.numberOfCuts, job.threads, clipped);
  Array<Index> stretches(input.edges.numberOfPlaces);
  ParallelRanges(input.edges.numberOfPlaces, job.threads,
    [&](Id begin, Id end) { std::fill(stretches.begin() + begin, stretches.begin() + end, -1); });
  const Array<Index> place =
    JoinPieces(ClipTriangles(input, work, stretches, clipped, job.Part(0.05, 0.5)), input,
      job.Part(0.5, 0.85), clipped);
  DropUnmadeCutPoints(job.threads, clipped);
  job.Check(0.9);
  LinkAlongEdges(input.edges, stretches, place, job.Part(0.9, 1.0), clipped);
}

/// Clips a mesh whose triangles are valid.
ClippedMesh ClipInFrame(const TriangleMesh& mesh, const std::vector<char>& used,
  const ClipFrame& frame, const ClipOptions& options, const Progress& progress)
{
  const int threads = NumberOfThreads(options.threads);
  ClippedMesh clipped;
  clipped.grid = frame.grid;
  clipped.numberOfInputPoints = static_cast<Id>(mesh.points.size());
  clipped.isWelded = options.weldCoincidentPoints;
  clipped.position.resize(mesh.points.size());
  ParallelRanges(static_cast<Id>(mesh.points.size()), threads,
    [&](Id begin, Id end)
    {
      for (Id i = begin; i < end; ++i)
      {
        clipped.position[i] = used[i] ? clipped.grid.ToGrid(mesh.points[i]) : Vec3::Zero();
      }
    });
  const Array<Vec3> snapped =
    SnapToPlanes(clipped.position, clipped.grid.CellsPerSide(), frame.tolerance, threads);
  Array<Index> pointClass;
  if (options.weldCoincidentPoints)
  {
    pointClass = WeldCoincidentPoints(mesh.points, used, threads);
  }
  else
  {
    RequireIndices(static_cast<double>(mesh.points.size()), "points");
    pointClass.resize(mesh.points.size());
    std::iota(pointClass.begin(), pointClass.end(), Index{ 0 });
  }
  progress.Check(0.1);
  const MeshEdges edges = BuildMeshEdges(mesh.triangles, pointClass, snapped, threads);
  progress.Check(0.2);
  ClipAndJoin({ mesh.triangles, pointClass, snapped, edges, clipped.grid.CellsPerSide(),
                frame.tolerance, frame.region },
    { threads, progress.Part(0.2, 1.0) }, clipped);
  if (options.joinAtPoints)
  {
    LinkAtPoints(pointClass, threads, clipped);
  }
  progress.Check(1.0);
  return clipped;
}

} // namespace

double SnapTolerance(double largest, const Grid& grid)
{
  const double rounding = 8.0 * std::numeric_limits<double>::epsilon() * largest / grid.spacing;
  return std::clamp(rounding, 1e-10, 1e-3);
}

ClippedMesh Clip(const TriangleMesh& mesh, const ClipOptions& options, const Progress& progress)
{
  Validate(mesh, options.threads);
  const int threads = NumberOfThreads(options.threads);
  const std::vector<char> used = UsedPoints(mesh, threads);
  ClipFrame frame;
  frame.grid = EmbedInGrid(mesh.points, used, options.depth, threads);
  frame.tolerance = SnapTolerance(LargestCoordinate(mesh, used, threads), frame.grid);
  progress.Check(0.05);
  return ClipInFrame(mesh, used, frame, options, progress.Part(0.05, 1.0));
}

ClippedMesh ClipPart(const TriangleMesh& mesh, const ClipFrame& frame, const ClipOptions& options,
  const Progress& progress)
{
  Validate(mesh, options.threads);
  return ClipInFrame(mesh, UsedPoints(mesh, options.threads), frame, options, progress);
}

Index ClippedMesh::CellOf(Id piece) const
{
  const auto next = std::upper_bound(cellBegin.begin(), cellBegin.end(), piece);
  return static_cast<Index>(next - cellBegin.begin()) - 1;
}

Array<Index> PieceCells(const ClippedMesh& clipped, int threads)
{
  Array<Index> cell(clipped.NumberOfPieces());
  ParallelRanges(static_cast<Id>(clipped.cells.size()), threads,
    [&](Id begin, Id end)
    {
      for (Id c = begin; c < end; ++c)
      {
        std::fill(cell.begin() + clipped.cellBegin[c], cell.begin() + clipped.cellBegin[c + 1],
          static_cast<Index>(c));
      }
    });
  return cell;
}

double PieceArea(const ClippedMesh& clipped, Id piece)
{
  const Id begin = clipped.pieceBegin[piece];
  const Vec3& apex = clipped.position[clipped.corners[begin]];
  Vec3 sum = Vec3::Zero();
  for (Id k = begin + 1; k + 1 < clipped.pieceBegin[piece + 1]; ++k)
  {
    sum += (clipped.position[clipped.corners[k]] - apex)
             .cross(clipped.position[clipped.corners[k + 1]] - apex);
  }
  return 0.5 * sum.norm();
}

} // namespace gridfem
