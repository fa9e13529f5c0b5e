#include "Clip.h"

#include "CutPoints.h"
#include "Errors.h"
#include "Links.h"
#include "Parallel.h"
#include "RadixSort.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>

namespace gridfem
{

namespace
{

/// A coordinate this near to a grid plane (in cells) lies on it.
double SnapTolerance(
  const TriangleMesh& mesh, const std::vector<char>& used, const Grid& grid, int threads)
{
  struct Largest
  {
    double value = 0.0;
    void operator+=(const Largest& other) { value = std::max(value, other.value); }
  };
  const double largest = ParallelSum(static_cast<Id>(mesh.points.size()), threads, Largest(),
    [&](Id begin, Id end)
    {
      Largest part;
      for (Id i = begin; i < end; ++i)
      {
        part.value =
          used[i] ? std::max(part.value, mesh.points[i].cwiseAbs().maxCoeff()) : part.value;
      }
      return part;
    }).value;
  const double rounding = 8.0 * std::numeric_limits<double>::epsilon() * largest / grid.spacing;
  return std::clamp(rounding, 1e-10, 1e-3);
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

/// Consecutive triangles with about the same number of pieces in each range; depends on the mesh
/// alone.
struct WorkRanges
{
  std::vector<Id> begin; // one more than ranges
  double pieces = 0.0;   // expected in all
};

WorkRanges SplitWork(
  const std::vector<std::array<Id, 3>>& triangles, const Array<Vec3>& position, int threads)
{
  constexpr float PiecesPerRange = 8192.0f;
  Array<float> pieces(triangles.size());
  ParallelRanges(static_cast<Id>(triangles.size()), threads,
    [&](Id begin, Id end)
    {
      for (Id t = begin; t < end; ++t)
      {
        const Vec3& a = position[triangles[t][0]];
        const Vec3& b = position[triangles[t][1]];
        const Vec3& c = position[triangles[t][2]];
        const Vec3 extent = a.cwiseMax(b).cwiseMax(c) - a.cwiseMin(b).cwiseMin(c);
        pieces[t] = static_cast<float>(1.0 + extent.sum() + 0.5 * (b - a).cross(c - a).norm());
      }
    });
  WorkRanges work;
  work.begin.push_back(0);
  float sum = 0.0f;
  for (std::size_t t = 0; t < triangles.size(); ++t)
  {
    sum += pieces[t];
    if (sum > PiecesPerRange || t + 1 == triangles.size())
    {
      work.begin.push_back(static_cast<Id>(t) + 1);
      work.pieces += sum;
      sum = 0.0f;
    }
  }
  return work;
}

/// One range of triangles: its part of the store of the thread that clipped it.
struct ClipBlock
{
  const PieceStore* store;
  Index firstPiece;
  Index firstCorner;
  Index firstInterior;
  Index firstLink;
  Index pieces;
  Index corners;
  Index interiors;
  Index links;
};

struct ClippedTriangles
{
  std::vector<PieceStore> stores; // per thread
  std::vector<ClipBlock> blocks;  // per range of triangles
};

/// A store with room for its share, so that it need not move; memory that is not used costs
/// nothing.
PieceStore MakeStore(double pieces)
{
  const auto room = static_cast<std::size_t>(std::min(1.2 * pieces, 2e9)) + 64;
  PieceStore store;
  store.key.reserve(room);
  store.triangle.reserve(room);
  store.cornerBegin.reserve(room + 1);
  store.corner.reserve(4 * room);
  store.interior.reserve(room / 4);
  store.links.reserve(room);
  store.cornerBegin.push_back(0);
  return store;
}

/// Ends a block that began when the store was as `block` says.
void Close(ClipBlock& block)
{
  const PieceStore& store = *block.store;
  const double corners = static_cast<double>(store.corner.size());
  RequireIndices(corners, "corners of pieces");
  block.pieces = static_cast<Index>(store.key.size()) - block.firstPiece;
  block.corners = static_cast<Index>(store.corner.size()) - block.firstCorner;
  block.interiors = static_cast<Index>(store.interior.size()) - block.firstInterior;
  block.links = static_cast<Index>(store.links.size()) - block.firstLink;
}

ClippedTriangles ClipTriangles(const ClipInput& input, const WorkRanges& work, Stretches& stretches,
  ClippedMesh& clipped, int threads, const Progress& progress)
{
  ClippedTriangles result;
  const int team = NumberOfThreads(threads);
  std::vector<TriangleClipper> clippers;
  for (int t = 0; t < team; ++t)
  {
    result.stores.push_back(MakeStore(work.pieces / team));
    clippers.emplace_back(input, clipped);
  }
  result.blocks.resize(work.begin.size() - 1);
  ParallelBlocks(
    static_cast<Id>(result.blocks.size()), team,
    [&](Id b, int thread)
    {
      PieceStore& store = result.stores[thread];
      ClipBlock& block = result.blocks[b];
      block.store = &store;
      block.firstPiece = static_cast<Index>(store.key.size());
      block.firstCorner = static_cast<Index>(store.corner.size());
      block.firstInterior = static_cast<Index>(store.interior.size());
      block.firstLink = static_cast<Index>(store.links.size());
      for (Id t = work.begin[b]; t < work.begin[b + 1]; ++t)
      {
        clippers[thread].Clip(t, store, stretches.piece.data() + stretches.begin[t]);
      }
      Close(block);
    },
    progress);
  return result;
}

/// Where each block's entries begin in the joined arrays; one more entry than blocks.
struct BlockOffsets
{
  std::vector<Index> piece;
  std::vector<Index> interior;
  std::vector<Index> link;
  Index corners = 0; // of all pieces
};

BlockOffsets OffsetsOf(const std::vector<ClipBlock>& blocks)
{
  const auto scan = [&](const char* what, Index ClipBlock::*count)
  {
    double total = 0.0;
    std::vector<Index> begin;
    for (const ClipBlock& block : blocks)
    {
      begin.push_back(block.*count);
      total += begin.back();
    }
    RequireIndices(total, what);
    begin.push_back(0);
    ExclusiveScan(begin);
    return begin;
  };
  return { scan("pieces", &ClipBlock::pieces), scan("cut points", &ClipBlock::interiors),
    scan("links", &ClipBlock::links), scan("corners of pieces", &ClipBlock::corners).back() };
}

/// A piece by its block (upper half) and its number in the block's store, sorted by cell.
Array<SortEntry> SortPieces(ClippedTriangles& parts, int depth, int threads)
{
  constexpr Id BlocksPerRange = 4;
  Array<SortEntry> entries = SortByKey(
    static_cast<Id>(parts.blocks.size()), 3 * depth, threads,
    [&](Id begin, Id end, const auto& add)
    {
      for (Id b = begin; b < end; ++b)
      {
        const ClipBlock& block = parts.blocks[b];
        for (Index number = block.firstPiece; number < block.firstPiece + block.pieces; ++number)
        {
          add(block.store->key[number], b << 32 | Id{ number });
        }
      }
    },
    BlocksPerRange);
  for (PieceStore& store : parts.stores)
  {
    Release(store.key);
  }
  return entries;
}

/// Lists the cells that the sorted pieces lie in.
void ListCells(const Array<SortEntry>& entries, int threads, ClippedMesh& clipped)
{
  const Id count = static_cast<Id>(entries.size());
  const auto isFirst = [&](Id k) { return k == 0 || entries[k].key != entries[k - 1].key; };
  std::vector<Index> firstCell((count + DefaultBlockSize - 1) / DefaultBlockSize + 1, 0);
  ParallelRanges(count, threads,
    [&](Id begin, Id end)
    {
      for (Id k = begin; k < end; ++k)
      {
        firstCell[begin / DefaultBlockSize] += isFirst(k) ? 1 : 0;
      }
    });
  const Index cells = ExclusiveScan(firstCell);
  clipped.cells.resize(cells);
  clipped.cellBegin.resize(cells + 1);
  clipped.cellBegin[cells] = static_cast<Index>(count);
  ParallelRanges(count, threads,
    [&](Id begin, Id end)
    {
      Index cell = firstCell[begin / DefaultBlockSize];
      for (Id k = begin; k < end; ++k)
      {
        if (isFirst(k))
        {
          clipped.cells[cell] = entries[k].key;
          clipped.cellBegin[cell++] = static_cast<Index>(k);
        }
      }
    });
}

/// Copies the pieces in their sorted order.
/// @return the place of each piece, pieces numbered block after block
Array<Index> JoinPieces(const std::vector<ClipBlock>& blocks, const BlockOffsets& offsets,
  const Array<SortEntry>& entries, Index firstInterior, int threads, ClippedMesh& clipped)
{
  const Id count = static_cast<Id>(entries.size());
  const auto blockOf = [&](Id k) { return entries[k].item >> 32; };
  const auto numberOf = [&](Id k) { return entries[k].item & 0xffffffff; };
  Array<Index> place(count);
  clipped.pieceTriangle.resize(count);
  clipped.pieceBegin.resize(count + 1);
  clipped.corners.resize(offsets.corners);
  ParallelRanges(count, threads,
    [&](Id begin, Id end)
    {
      for (Id k = begin; k < end; ++k)
      {
        const ClipBlock& block = blocks[blockOf(k)];
        const Id number = numberOf(k);
        place[offsets.piece[blockOf(k)] + number - block.firstPiece] = static_cast<Index>(k);
        clipped.pieceTriangle[k] = block.store->triangle[number];
        clipped.pieceBegin[k] =
          block.store->cornerBegin[number + 1] - block.store->cornerBegin[number];
      }
    });
  clipped.pieceBegin[count] = 0;
  ExclusiveScan(clipped.pieceBegin);
  ParallelRanges(count, threads,
    [&](Id begin, Id end)
    {
      for (Id k = begin; k < end; ++k)
      {
        const ClipBlock& block = blocks[blockOf(k)];
        const Index interior =
          firstInterior + offsets.interior[blockOf(k)] - block.firstInterior - 1;
        const Index* corner = block.store->corner.data() + block.store->cornerBegin[numberOf(k)];
        for (Index i = clipped.pieceBegin[k]; i < clipped.pieceBegin[k + 1]; ++i, ++corner)
        {
          clipped.corners[i] = *corner >= 0 ? *corner : interior - *corner;
        }
      }
    });
  return place;
}

/// Appends the interior points of all blocks.
void AppendInteriorPoints(const ClipInput& input, const std::vector<ClipBlock>& blocks,
  const BlockOffsets& offsets, int threads, ClippedMesh& clipped)
{
  const Id first = static_cast<Id>(clipped.position.size());
  clipped.cutPoints.resize(clipped.cutPoints.size() + offsets.interior.back());
  clipped.position.resize(clipped.position.size() + offsets.interior.back());
  ParallelBlocks(static_cast<Id>(blocks.size()), threads,
    [&](Id b)
    {
      const ClipBlock& block = blocks[b];
      for (Index k = 0; k < block.interiors; ++k)
      {
        const CutPoint& cut = block.store->interior[block.firstInterior + k];
        PlaceCutPoint(first + offsets.interior[b] + k, cut, input, clipped);
      }
    });
}

/// Links inside triangles; gives the stretches the final numbers of their pieces.
void PlaceLinks(const std::vector<ClipBlock>& blocks, const BlockOffsets& offsets,
  const WorkRanges& work, const Array<Index>& place, int threads, Stretches& stretches,
  ClippedMesh& clipped)
{
  clipped.links.resize(offsets.link.back());
  ParallelBlocks(static_cast<Id>(blocks.size()), threads,
    [&](Id b)
    {
      const ClipBlock& block = blocks[b];
      const Index shift = offsets.piece[b] - block.firstPiece;
      for (Index k = 0; k < block.links; ++k)
      {
        const Link& link = block.store->links[block.firstLink + k];
        const auto [low, high] = std::minmax(place[shift + link.first], place[shift + link.second]);
        clipped.links[offsets.link[b] + k] = { low, high };
      }
      for (Index k = stretches.begin[work.begin[b]]; k < stretches.begin[work.begin[b + 1]]; ++k)
      {
        Index& piece = stretches.piece[k];
        piece = piece < 0 ? piece : place[shift + piece];
      }
    });
}

/// Clips with everything that depends on the mesh alone at hand; clipped.position holds the input
/// points.
void ClipAndJoin(
  const ClipInput& input, int threads, const Progress& progress, ClippedMesh& clipped)
{
  Stretches stretches = AllocateStretches(input.edges, threads);
  const WorkRanges work = SplitWork(input.triangles, input.position, threads);
  progress.Check(0.05);
  const double points = static_cast<double>(input.position.size()) + input.edges.NumberOfCuts();
  RequireIndices(points, "points of the clipped mesh");
  AllocateEdgeCuts(input.edges, threads, clipped);
  ClippedTriangles parts =
    ClipTriangles(input, work, stretches, clipped, threads, progress.Part(0.05, 0.5));
  const BlockOffsets offsets = OffsetsOf(parts.blocks);
  RequireIndices(points + offsets.interior.back(), "points of the clipped mesh");
  Array<SortEntry> entries = SortPieces(parts, clipped.grid.depth, threads);
  progress.Check(0.6);
  ListCells(entries, threads, clipped);
  const Index firstInterior =
    static_cast<Index>(clipped.numberOfInputPoints) + input.edges.NumberOfCuts();
  Array<Index> place = JoinPieces(parts.blocks, offsets, entries, firstInterior, threads, clipped);
  Release(entries);
  progress.Check(0.75);
  AppendInteriorPoints(input, parts.blocks, offsets, threads, clipped);
  DropUnmadeCutPoints(threads, clipped);
  progress.Check(0.85);
  PlaceLinks(parts.blocks, offsets, work, place, threads, stretches, clipped);
  parts = ClippedTriangles();
  Release(place);
  LinkAlongEdges(input.edges, stretches, threads, progress.Part(0.9, 1.0), clipped);
}

} // namespace

ClippedMesh Clip(const TriangleMesh& mesh, const ClipOptions& options, const Progress& progress)
{
  Validate(mesh, options.threads);
  const int threads = NumberOfThreads(options.threads);
  const std::vector<char> used = UsedPoints(mesh);
  ClippedMesh clipped;
  clipped.grid = EmbedInGrid(mesh.points, used, options.depth);
  clipped.numberOfInputPoints = static_cast<Id>(mesh.points.size());
  progress.Check(0.05);

  clipped.position.resize(mesh.points.size());
  ParallelRanges(static_cast<Id>(mesh.points.size()), threads,
    [&](Id begin, Id end)
    {
      for (Id i = begin; i < end; ++i)
      {
        clipped.position[i] = used[i] ? clipped.grid.ToGrid(mesh.points[i]) : Vec3::Zero();
      }
    });
  const double tolerance = SnapTolerance(mesh, used, clipped.grid, threads);
  const Array<Vec3> snapped =
    SnapToPlanes(clipped.position, clipped.grid.CellsPerSide(), tolerance, threads);
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
  progress.Check(0.15);
  const MeshEdges edges = BuildMeshEdges(mesh.triangles, pointClass, snapped, threads);
  progress.Check(0.25);
  ClipAndJoin(
    { mesh.triangles, pointClass, snapped, edges, clipped.grid.CellsPerSide(), tolerance }, threads,
    progress.Part(0.25, 1.0), clipped);
  progress.Check(1.0);
  return clipped;
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
