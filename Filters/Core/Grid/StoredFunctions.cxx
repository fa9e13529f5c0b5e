#include "Grid/StoredFunctions.h"

#include "Base/Errors.h"

#include <algorithm>
#include <limits>
#include <string>

namespace gridfem
{
namespace
{

constexpr MortonKey NoPoint = std::numeric_limits<MortonKey>::max();

MortonKey LatticePointOf(MortonKey cell, int corner)
{
  const CellIndex index = MortonDecode(cell);
  return MortonEncode(
    { index[0] + (corner & 1), index[1] + (corner >> 1 & 1), index[2] + (corner >> 2 & 1) });
}

void RequireSizes(
  const ClippedMesh& clipped, const Array<Index>& piecePatch, const PatchLevel& finest)
{
  if (static_cast<Id>(piecePatch.size()) != clipped.NumberOfPieces())
  {
    throw InvalidInput("There are " + std::to_string(piecePatch.size()) + " patch ids for " +
                       std::to_string(clipped.NumberOfPieces()) + " clipped triangles.");
  }
  if (finest.cell.size() != finest.dof.size())
  {
    throw InvalidInput("There are " + std::to_string(finest.cell.size()) +
                       " patch cells but functions for " + std::to_string(finest.dof.size()) +
                       " patches.");
  }
  for (std::size_t piece = 0; piece < piecePatch.size(); ++piece)
  {
    if (piecePatch[piece] < 0 || piecePatch[piece] >= finest.NumberOfPatches())
    {
      throw InvalidInput("Clipped triangle " + std::to_string(piece) + " has patch " +
                         std::to_string(piecePatch[piece]) + ", but there are " +
                         std::to_string(finest.NumberOfPatches()) + " patches.");
    }
  }
}

void RequireMortonOrder(const PatchLevel& finest, FunctionSupport support)
{
  for (std::size_t patch = 1; patch < finest.cell.size(); ++patch)
  {
    if (finest.cell[patch] < finest.cell[patch - 1])
    {
      throw InvalidInput("Patch " + std::to_string(patch) + " is not in Morton order.");
    }
    if (support == FunctionSupport::Plain && finest.cell[patch] == finest.cell[patch - 1])
    {
      throw InvalidInput("Patches " + std::to_string(patch - 1) + " and " + std::to_string(patch) +
                         " are in one cell, but the basis is not connectivity-aware.");
    }
  }
}

/// Returns the lattice point of each function.
std::vector<MortonKey> PointsOfFunctions(const PatchLevel& finest)
{
  std::vector<MortonKey> point(finest.numberOfFunctions, NoPoint);
  for (std::size_t patch = 0; patch < finest.dof.size(); ++patch)
  {
    for (int corner = 0; corner < FunctionsPerPatch; ++corner)
    {
      const Index function = finest.dof[patch][corner];
      if (function < 0 || function >= finest.numberOfFunctions)
      {
        throw InvalidInput("Patch " + std::to_string(patch) + " has function " +
                           std::to_string(function) + ", but there are " +
                           std::to_string(finest.numberOfFunctions) + " functions.");
      }
      const MortonKey here = LatticePointOf(finest.cell[patch], corner);
      if (point[function] != NoPoint && point[function] != here)
      {
        throw InvalidInput("Patch " + std::to_string(patch) + " has function " +
                           std::to_string(function) + " at corner " + std::to_string(corner) +
                           ", but the function belongs to another corner of the grid.");
      }
      point[function] = here;
    }
  }
  const auto unused = std::find(point.begin(), point.end(), NoPoint);
  if (unused != point.end())
  {
    throw InvalidInput("No patch has function " + std::to_string(unused - point.begin()) + " of " +
                       std::to_string(point.size()) + ".");
  }
  return point;
}

void RequireOneFunctionPerPoint(std::vector<MortonKey> point)
{
  std::sort(point.begin(), point.end());
  if (std::adjacent_find(point.begin(), point.end()) != point.end())
  {
    throw InvalidInput(
      "Two functions belong to one corner of the grid, but the basis is not connectivity-aware.");
  }
}

/// Whether the functions of the common corners are the same.
bool ShareFunctions(const PatchLevel& finest, Index first, Index second)
{
  for (int a = 0; a < FunctionsPerPatch; ++a)
  {
    const MortonKey point = LatticePointOf(finest.cell[first], a);
    for (int b = 0; b < FunctionsPerPatch; ++b)
    {
      if (finest.dof[first][a] != finest.dof[second][b] &&
          LatticePointOf(finest.cell[second], b) == point)
      {
        return false;
      }
    }
  }
  return true;
}

/// Whether two pieces have two points in common. Coincident points do not count: two points may
/// coincide only since they were stored in single precision.
bool ShareAnEdge(const ClippedMesh& clipped, Index first, Index second)
{
  const auto begin = clipped.corners.begin();
  const auto other = begin + clipped.pieceBegin[second];
  const auto otherEnd = begin + clipped.pieceBegin[second + 1];
  return std::count_if(begin + clipped.pieceBegin[first], begin + clipped.pieceBegin[first + 1],
           [&](Index point) { return std::find(other, otherEnd, point) != otherEnd; }) >= 2;
}

void RequireJoinedAlongEdges(
  const ClippedMesh& clipped, const Array<Index>& piecePatch, const PatchLevel& finest)
{
  const Array<Index> pieceCell = PieceCells(clipped);
  for (const auto& [first, second] : clipped.links)
  {
    const Index a = piecePatch[first];
    const Index b = piecePatch[second];
    const bool isJoined =
      a == b || (pieceCell[first] != pieceCell[second] && ShareFunctions(finest, a, b));
    if (!isJoined && ShareAnEdge(clipped, first, second))
    {
      throw InvalidInput("Clipped triangles " + std::to_string(clipped.pieceTriangle[first]) +
                         " and " + std::to_string(clipped.pieceTriangle[second]) +
                         " share an edge, but their patches " + std::to_string(a) + " and " +
                         std::to_string(b) + " do not share their functions.");
    }
  }
}

} // namespace

void RequireStoredFunctions(const ClippedMesh& clipped, const Array<Index>& piecePatch,
  const PatchLevel& finest, FunctionSupport support)
{
  RequireSizes(clipped, piecePatch, finest);
  RequireMortonOrder(finest, support);
  std::vector<MortonKey> point = PointsOfFunctions(finest);
  if (support == FunctionSupport::Plain)
  {
    RequireOneFunctionPerPoint(std::move(point));
  }
  RequireJoinedAlongEdges(clipped, piecePatch, finest);
}

} // namespace gridfem
