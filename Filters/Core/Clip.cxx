#include "Clip.h"

#include "Links.h"
#include "MeshEdges.h"
#include "Parallel.h"
#include "RadixSort.h"
#include "TriangleClipper.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>

namespace gridfem
{

namespace
{

/// A coordinate this near to a grid plane (in cells) lies on it.
double SnapTolerance(const TriangleMesh& mesh, const std::vector<char>& used, const Grid& grid)
{
  double largest = 0.0;
  for (std::size_t i = 0; i < mesh.points.size(); ++i)
  {
    if (used[i])
    {
      largest = std::max(largest, mesh.points[i].cwiseAbs().maxCoeff());
    }
  }
  const double rounding = 8.0 * std::numeric_limits<double>::epsilon() * largest / grid.spacing;
  return std::clamp(rounding, 1e-10, 1e-3);
}

std::vector<Vec3> SnapToPlanes(const std::vector<Vec3>& points, const std::vector<char>& used,
  double side, double tolerance, int threads)
{
  std::vector<Vec3> snapped(points.size(), Vec3::Zero());
  ParallelRanges(static_cast<Id>(points.size()), threads,
    [&](Id begin, Id end)
    {
      for (Id i = begin; i < end; ++i)
      {
        for (int axis = 0; axis < 3 && used[i]; ++axis)
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
std::vector<Id> SplitWork(
  const std::vector<std::array<Id, 3>>& triangles, const std::vector<Vec3>& position)
{
  constexpr double PiecesPerBlock = 8192.0;
  std::vector<Id> begin{ 0 };
  double pieces = 0.0;
  for (std::size_t t = 0; t < triangles.size(); ++t)
  {
    const Vec3& a = position[triangles[t][0]];
    const Vec3& b = position[triangles[t][1]];
    const Vec3& c = position[triangles[t][2]];
    const Vec3 extent = a.cwiseMax(b).cwiseMax(c) - a.cwiseMin(b).cwiseMin(c);
    pieces += 1.0 + extent.sum() + 0.5 * (b - a).cross(c - a).norm();
    if (pieces > PiecesPerBlock)
    {
      begin.push_back(static_cast<Id>(t) + 1);
      pieces = 0.0;
    }
  }
  if (begin.back() != static_cast<Id>(triangles.size()))
  {
    begin.push_back(static_cast<Id>(triangles.size()));
  }
  return begin;
}

/// Where each block's entries begin in the joined arrays; one more entry than blocks.
struct BlockOffsets
{
  std::vector<Id> piece;
  std::vector<Id> corner;
  std::vector<Id> interior;
  std::vector<Id> link;
};

BlockOffsets OffsetsOf(const std::vector<ClipBlock>& blocks)
{
  BlockOffsets offsets;
  const auto scan = [&](auto count)
  {
    std::vector<Id> begin;
    for (const ClipBlock& block : blocks)
    {
      begin.push_back(static_cast<Id>(count(block)));
    }
    begin.push_back(0);
    ExclusiveScan(begin);
    return begin;
  };
  offsets.piece = scan([](const ClipBlock& b) { return b.key.size(); });
  offsets.corner = scan([](const ClipBlock& b) { return b.corner.size(); });
  offsets.interior = scan([](const ClipBlock& b) { return b.interior.size(); });
  offsets.link = scan([](const ClipBlock& b) { return b.links.size(); });
  return offsets;
}

/// Sorts the pieces of all blocks by cell; returns the place of each piece in the sorted order.
std::vector<Id> SortPieces(const std::vector<ClipBlock>& blocks, const BlockOffsets& offsets,
  int depth, int threads, ClippedMesh& clipped)
{
  const Id numberOfPieces = offsets.piece.back();
  std::vector<SortEntry> entries(numberOfPieces);
  ParallelBlocks(static_cast<Id>(blocks.size()), threads,
    [&](Id b)
    {
      for (std::size_t k = 0; k < blocks[b].key.size(); ++k)
      {
        const Id piece = offsets.piece[b] + static_cast<Id>(k);
        entries[piece] = { blocks[b].key[k], piece };
      }
    });
  RadixSort(entries, 3 * depth, threads);
  std::vector<Id> place(numberOfPieces);
  clipped.pieceCell.resize(numberOfPieces);
  for (Id k = 0; k < numberOfPieces; ++k)
  {
    if (k == 0 || entries[k].key != entries[k - 1].key)
    {
      clipped.cells.push_back(entries[k].key);
    }
    clipped.pieceCell[k] = static_cast<Id>(clipped.cells.size()) - 1;
    place[entries[k].item] = k;
  }
  return place;
}

void FillPieces(const std::vector<ClipBlock>& blocks, const BlockOffsets& offsets,
  const std::vector<Id>& place, Id firstInterior, int threads, ClippedMesh& clipped)
{
  const Id numberOfPieces = offsets.piece.back();
  clipped.pieceTriangle.resize(numberOfPieces);
  clipped.pieceBegin.assign(numberOfPieces + 1, 0);
  clipped.corners.resize(offsets.corner.back());
  const auto forPieces = [&](auto body)
  {
    ParallelBlocks(static_cast<Id>(blocks.size()), threads,
      [&](Id b)
      {
        std::size_t corner = 0;
        for (std::size_t k = 0; k < blocks[b].key.size(); ++k)
        {
          body(blocks[b], b, k, corner, place[offsets.piece[b] + static_cast<Id>(k)]);
          corner += blocks[b].size[k];
        }
      });
  };
  forPieces(
    [&](const ClipBlock& block, Id, std::size_t k, std::size_t, Id piece)
    {
      clipped.pieceTriangle[piece] = block.triangle[k];
      clipped.pieceBegin[piece] = block.size[k];
    });
  ExclusiveScan(clipped.pieceBegin);
  forPieces(
    [&](const ClipBlock& block, Id b, std::size_t k, std::size_t corner, Id piece)
    {
      for (int i = 0; i < block.size[k]; ++i)
      {
        const Id id = block.corner[corner + i];
        clipped.corners[clipped.pieceBegin[piece] + i] =
          id >= 0 ? id : firstInterior + offsets.interior[b] - 1 - id;
      }
    });
}

/// Cut points of mesh edges, and the interior ones of each triangle, before unused ones are
/// dropped.
std::vector<CutPoint> CollectCutPoints(const TriangleMesh& mesh, const MeshEdges& edges,
  const std::vector<Id>& pointClass, const std::vector<Vec3>& position,
  const std::vector<ClipBlock>& blocks, const BlockOffsets& offsets, int threads)
{
  std::vector<CutPoint> points(edges.NumberOfCuts() + offsets.interior.back());
  std::vector<Id> triangleOfEdge(edges.ends.size());
  std::vector<int> localEdge(edges.ends.size());
  for (Id t = static_cast<Id>(mesh.triangles.size()) - 1; t >= 0; --t)
  {
    for (int k = 0; k < 3; ++k)
    {
      triangleOfEdge[edges.ofTriangle[t][k]] = t;
      localEdge[edges.ofTriangle[t][k]] = k;
    }
  }
  ParallelRanges(static_cast<Id>(edges.ends.size()), threads,
    [&](Id begin, Id end)
    {
      for (Id e = begin; e < end; ++e)
      {
        const Id t = triangleOfEdge[e];
        const bool forward = pointClass[mesh.triangles[t][localEdge[e]]] == edges.ends[e][0];
        const int from = forward ? localEdge[e] : (localEdge[e] + 1) % 3;
        const int to = forward ? (localEdge[e] + 1) % 3 : localEdge[e];
        Id next = edges.cutBegin[e];
        for (int axis = 0; axis < 3; ++axis)
        {
          const double a = position[edges.ends[e][0]][axis];
          const double b = position[edges.ends[e][1]][axis];
          const PlaneRange planes = PlanesBetween(a, b);
          for (int k = 0; k < planes.count; ++k)
          {
            CutPoint& point = points[next++];
            const double s = (planes.first + k - a) / (b - a);
            point = { t, { 0.0, 0.0, 0.0 } };
            point.weight[from] = 1.0 - s;
            point.weight[to] = s;
          }
        }
      }
    });
  ParallelBlocks(static_cast<Id>(blocks.size()), threads,
    [&](Id b)
    {
      std::copy(blocks[b].interior.begin(), blocks[b].interior.end(),
        points.begin() + edges.NumberOfCuts() + offsets.interior[b]);
    });
  return points;
}

/// Where several planes cut an edge in one point only one of its numbers is used: drops the others.
void DropUnusedCutPoints(std::vector<CutPoint> points, int threads, ClippedMesh& clipped)
{
  const Id inputs = clipped.numberOfInputPoints;
  std::vector<Id> number(points.size(), 0);
  for (const Id corner : clipped.corners)
  {
    if (corner >= inputs)
    {
      number[corner - inputs] = 1;
    }
  }
  Id used = 0;
  for (std::size_t k = 0; k < points.size(); ++k)
  {
    if (number[k])
    {
      points[used] = points[k];
      number[k] = used++;
    }
  }
  points.resize(used);
  clipped.cutPoints = std::move(points);
  ParallelRanges(static_cast<Id>(clipped.corners.size()), threads,
    [&](Id begin, Id end)
    {
      for (Id k = begin; k < end; ++k)
      {
        if (clipped.corners[k] >= inputs)
        {
          clipped.corners[k] = inputs + number[clipped.corners[k] - inputs];
        }
      }
    });
}

void PlacePoints(
  const TriangleMesh& mesh, std::vector<Vec3> inputPosition, int threads, ClippedMesh& clipped)
{
  const Id inputs = clipped.numberOfInputPoints;
  clipped.position = std::move(inputPosition);
  clipped.position.resize(inputs + clipped.cutPoints.size());
  ParallelRanges(static_cast<Id>(clipped.cutPoints.size()), threads,
    [&](Id begin, Id end)
    {
      for (Id k = begin; k < end; ++k)
      {
        const CutPoint& cut = clipped.cutPoints[k];
        const auto& corner = mesh.triangles[cut.triangle];
        clipped.position[inputs + k] = cut.weight[0] * clipped.position[corner[0]] +
                                       cut.weight[1] * clipped.position[corner[1]] +
                                       cut.weight[2] * clipped.position[corner[2]];
      }
    });
}

/// Calls visit(number) for every stretch of a mesh edge, between two of its cut points, that bounds
/// piece k of a block. A stretch is numbered by its end nearer to the edge's lower end.
template<class Visit>
void ForMeshEdges(const ClipBlock& block, std::size_t k, std::size_t firstCorner,
  const std::vector<std::array<Id, 3>>& triangles, const MeshEdges& edges,
  const std::vector<Id>& pointClass, Id numberOfPoints, const Visit& visit)
{
  const Id t = block.triangle[k];
  for (int i = 0; i < block.size[k]; ++i)
  {
    const int tag = block.tag[firstCorner + i];
    if (tag >= PlaneTag)
    {
      continue;
    }
    const Id e = edges.ofTriangle[t][tag];
    if (edges.ends[e][0] == edges.ends[e][1])
    {
      continue;
    }
    const bool forward = pointClass[triangles[t][tag]] == edges.ends[e][0];
    const int near = forward ? i : (i + 1 == block.size[k] ? 0 : i + 1);
    const Id id = block.corner[firstCorner + near];
    visit(edges.cutBegin[e] + e +
          (id < numberOfPoints ? 0 : 1 + id - numberOfPoints - edges.cutBegin[e]));
  }
}

std::vector<PieceLink> CollectLinks(const std::vector<ClipBlock>& blocks,
  const BlockOffsets& offsets, const std::vector<Id>& place,
  const std::vector<std::array<Id, 3>>& triangles, const MeshEdges& edges,
  const std::vector<Id>& pointClass, const ClippedMesh& clipped, int threads,
  const Progress& progress)
{
  std::vector<PieceLink> links(offsets.link.back());
  ParallelBlocks(static_cast<Id>(blocks.size()), threads,
    [&](Id b)
    {
      for (std::size_t k = 0; k < blocks[b].links.size(); ++k)
      {
        const PieceLink& link = blocks[b].links[k];
        const Id first = place[offsets.piece[b] + link.first];
        const Id second = place[offsets.piece[b] + link.second];
        links[offsets.link[b] + k] = { std::min(first, second), std::max(first, second) };
      }
    });
  const Id inputs = clipped.numberOfInputPoints;
  const auto forUses = [&](Id b, const auto& visit)
  {
    std::size_t corner = 0;
    for (std::size_t k = 0; k < blocks[b].key.size(); ++k)
    {
      ForMeshEdges(blocks[b], k, corner, triangles, edges, pointClass, inputs,
        [&](Id stretch) { visit(stretch, place[offsets.piece[b] + static_cast<Id>(k)]); });
      corner += blocks[b].size[k];
    }
  };
  LinkByEdges(static_cast<Id>(blocks.size()), forUses,
    edges.NumberOfCuts() + static_cast<Id>(edges.ends.size()), clipped.pieceCell, threads, links,
    progress);
  return links;
}

} // namespace

ClippedMesh Clip(const TriangleMesh& mesh, const ClipOptions& options, const Progress& progress)
{
  Validate(mesh);
  const int threads = NumberOfThreads(options.threads);
  const std::vector<char> used = UsedPoints(mesh);
  ClippedMesh clipped;
  clipped.grid = EmbedInGrid(mesh.points, used, options.depth);
  clipped.numberOfInputPoints = static_cast<Id>(mesh.points.size());
  progress.Check(0.05);

  std::vector<Vec3> inputPosition(mesh.points.size());
  ParallelRanges(static_cast<Id>(mesh.points.size()), threads,
    [&](Id begin, Id end)
    {
      for (Id i = begin; i < end; ++i)
      {
        inputPosition[i] = used[i] ? clipped.grid.ToGrid(mesh.points[i]) : Vec3::Zero();
      }
    });
  const double tolerance = SnapTolerance(mesh, used, clipped.grid);
  const std::vector<Vec3> snapped =
    SnapToPlanes(inputPosition, used, clipped.grid.CellsPerSide(), tolerance, threads);
  std::vector<Id> pointClass(mesh.points.size());
  if (options.weldCoincidentPoints)
  {
    pointClass = WeldCoincidentPoints(mesh.points, used);
  }
  else
  {
    std::iota(pointClass.begin(), pointClass.end(), Id{ 0 });
  }
  progress.Check(0.15);
  const MeshEdges edges = BuildMeshEdges(mesh.triangles, pointClass, snapped, threads);
  progress.Check(0.25);

  const std::vector<Id> work = SplitWork(mesh.triangles, snapped);
  std::vector<ClipBlock> blocks(work.size() - 1);
  ParallelBlocks(
    static_cast<Id>(blocks.size()), threads,
    [&](Id b)
    {
      TriangleClipper clipper(
        mesh.triangles, pointClass, snapped, edges, clipped.grid.CellsPerSide(), tolerance);
      for (Id t = work[b]; t < work[b + 1]; ++t)
      {
        clipper.Clip(t, blocks[b]);
      }
    },
    progress.Part(0.25, 0.6));

  const BlockOffsets offsets = OffsetsOf(blocks);
  const std::vector<Id> place = SortPieces(blocks, offsets, clipped.grid.depth, threads, clipped);
  progress.Check(0.7);
  FillPieces(
    blocks, offsets, place, clipped.numberOfInputPoints + edges.NumberOfCuts(), threads, clipped);
  progress.Check(0.8);
  std::vector<CutPoint> cutPoints =
    CollectCutPoints(mesh, edges, pointClass, snapped, blocks, offsets, threads);
  progress.Check(0.83);
  DropUnusedCutPoints(std::move(cutPoints), threads, clipped);
  progress.Check(0.86);
  PlacePoints(mesh, std::move(inputPosition), threads, clipped);
  clipped.links = CollectLinks(blocks, offsets, place, mesh.triangles, edges, pointClass, clipped,
    threads, progress.Part(0.9, 1.0));
  progress.Check(1.0);
  return clipped;
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
