// The clipped mesh is a refinement, so M_f P is the vertex rule on its triangles. The entry of hat
// k and grid function i is Σ m λ_k b_i / Σ m λ_k, over the corners of all pieces of the hat's
// triangles. The mass m is a third of the area of each triangle. Summing corner by corner, not
// point by point, keeps sheets that touch in a point apart and needs no numbers of points.
#include "Spaces/HatTransfer.h"

#include "Algebra/FillRows.h"
#include "Base/Errors.h"
#include "Base/Grouping.h"
#include "Grid/PatchChoice.h"
#include "Grid/SourceTriangle.h"
#include "Integrals/QuadratureSamples.h"
#include "Integrals/TrilinearBasis.h"

#include <algorithm>

namespace gridfem
{
namespace
{

struct PatchWeights
{
  Id patch;
  CornerValues weight;
};

/// One row, patch by patch.
using Row = std::vector<PatchWeights>;

/// Returns the weights of a patch if it is among the last in the row, otherwise new weights. A
/// patch may therefore occur twice.
PatchWeights& WeightsOf(Id patch, Row& row)
{
  constexpr std::size_t Recent = 8; // more than most rows have
  const auto oldest = row.rbegin() + static_cast<std::ptrdiff_t>(std::min(Recent, row.size()));
  const auto found = std::find_if(
    row.rbegin(), oldest, [&](const PatchWeights& weights) { return weights.patch == patch; });
  if (found != oldest)
  {
    return *found;
  }
  row.push_back({ patch, {} });
  return row.back();
}

void AddScaled(double factor, const CornerValues& values, CornerValues& sum)
{
  for (int i = 0; i < FunctionsPerPatch; ++i)
  {
    sum[i] += factor * values[i];
  }
}

/// Adds Σ m λ b over the corners of a piece, for one corner of its source triangle.
void AddPiece(
  const GridFunctions& space, const SourceTriangle& source, int corner, Id piece, Row& row)
{
  const ClippedMesh& clipped = space.clipped;
  const Id patch = space.piecePatch[piece];
  const Vec3 origin = CellCorner(space.Finest().cell[patch]);
  const Index* point = clipped.corners.data() + clipped.pieceBegin[piece];
  CornerValues& sum = WeightsOf(patch, row).weight;
  const auto add = [&](Id k, double mass)
  {
    const double lambda = source.Locate(point[k])[corner];
    if (lambda > 0.0)
    {
      CornerValues b;
      TrilinearValues(clipped.position[point[k]] - origin, b);
      AddScaled(mass * lambda, b, sum);
    }
  };
  double previous = 0.0; // the point's share of the previous fan triangle
  double all = 0.0;
  const Id last = clipped.pieceBegin[piece + 1] - clipped.pieceBegin[piece] - 1;
  for (Id k = 1; k < last; ++k)
  {
    const Vec3& apex = clipped.position[point[0]];
    const double third =
      (clipped.position[point[k]] - apex).cross(clipped.position[point[k + 1]] - apex).norm() / 6.0;
    add(k, previous + third);
    previous = third;
    all += third;
  }
  add(last, previous);
  add(0, all);
}

/// If the point is a corner of the piece, adds the values at the point, times the area of the
/// piece. All sheets that meet in the point then have their share. The sheets may have different
/// functions at the point, so the values of one sheet would say nothing about the others.
void AddPieceAtPoint(const GridFunctions& space, Id point, Id piece, Row& row)
{
  const ClippedMesh& clipped = space.clipped;
  const Index* const begin = clipped.corners.data() + clipped.pieceBegin[piece];
  const Index* const end = clipped.corners.data() + clipped.pieceBegin[piece + 1];
  if (std::find(begin, end, point) != end)
  {
    const Id patch = space.piecePatch[piece];
    CornerValues b;
    TrilinearValues(clipped.position[point] - CellCorner(space.Finest().cell[patch]), b);
    AddScaled(PieceArea(clipped, piece), b, WeightsOf(patch, row).weight);
  }
}

/// Adds the values at a point, for a hat without pieces of any area.
void AddPoint(const GridFunctions& space, Id point, Row& row)
{
  const Id patch = space.pointPatch[point];
  if (patch >= 0)
  {
    TrilinearValues(space.clipped.position[point] - CellCorner(space.Finest().cell[patch]),
      WeightsOf(patch, row).weight);
  }
}

/// Appends the entries of a row, sorted by column.
void AppendEntries(
  const PatchLevel& level, const Row& row, Array<Index>& columns, Array<double>& values)
{
  std::vector<std::pair<Index, double>> entries;
  for (const PatchWeights& weights : row)
  {
    for (int c = 0; c < FunctionsPerPatch; ++c)
    {
      if (weights.weight[c] > 0.0)
      {
        entries.emplace_back(level.dof[weights.patch][c], weights.weight[c]);
      }
    }
  }
  std::stable_sort(
    entries.begin(), entries.end(), [](const auto& a, const auto& b) { return a.first < b.first; });
  const std::size_t begin = columns.size();
  for (const auto& [column, value] : entries)
  {
    if (columns.size() > begin && columns.back() == column)
    {
      values.back() += value;
    }
    else
    {
      columns.push_back(column);
      values.push_back(value);
    }
  }
}

/// Returns one point of every function. Among the points that share a function, it is the point in
/// the best patch, or the lowest of several such points.
std::vector<Id> PointsOfFunctions(const HatFunctions& hats, const GridFunctions& space, int threads)
{
  const PatchChoice patches(
    space.clipped, space.piecePatch, space.Finest().NumberOfPatches(), threads);
  std::vector<Id> point(hats.Count(), -1);
  for (Id p = 0; p < static_cast<Id>(hats.ofPoint.size()); ++p)
  {
    if (hats.ofPoint[p] >= 0)
    {
      Id& best = point[hats.ofPoint[p]];
      const Index known = best < 0 ? -1 : space.pointPatch[best];
      best = best < 0 || patches.IsBetter(space.pointPatch[p], known) ? p : best;
    }
  }
  return point;
}

void CheckMeshes(const HatFunctions& hats, const GridFunctions& space, const TriangleMesh& mesh)
{
  const std::size_t points = mesh.points.size();
  const auto last =
    std::max_element(space.clipped.pieceTriangle.begin(), space.clipped.pieceTriangle.end());
  if (hats.ofPoint.size() != points || space.pointPatch.size() != points ||
      (last != space.clipped.pieceTriangle.end() &&
        *last >= static_cast<Id>(mesh.triangles.size())))
  {
    throw InvalidInput("The hat functions and the function space were made from different meshes.");
  }
}

/// Fills a matrix row by row. fillRow(hat, row) lists the weights.
template<class FillRow>
SparseMatrix BuildRows(
  const HatFunctions& hats, const GridFunctions& space, int threads, FillRow&& fillRow)
{
  SparseMatrix matrix;
  matrix.rows = hats.Count();
  matrix.columns = space.Finest().numberOfFunctions;
  FillRows(matrix, threads,
    [&](Index hat, Array<Index>& columns, Array<double>& values)
    {
      Row row;
      fillRow(hat, row);
      AppendEntries(space.Finest(), row, columns, values);
    });
  return matrix;
}

} // namespace

SparseMatrix BuildHatWeights(const HatFunctions& hats, const GridFunctions& space,
  const TriangleMesh& mesh, HatTransfer transfer, const std::vector<char>& isBare, int threads)
{
  CheckMeshes(hats, space, mesh);
  const std::vector<Id> pointOfHat =
    isBare.empty() ? std::vector<Id>() : PointsOfFunctions(hats, space, threads);
  const Groups pieces = GroupItems(space.clipped.pieceTriangle.data(),
    space.clipped.NumberOfPieces(), static_cast<Id>(mesh.triangles.size()), threads);
  const auto addTriangle = [&](Id triangle, int corner, Row& row)
  {
    const SourceTriangle source(space.clipped, mesh, triangle);
    for (Id p = pieces.begin[triangle]; p < pieces.begin[triangle + 1]; ++p)
    {
      if (transfer == HatTransfer::Evaluation)
      {
        AddPieceAtPoint(space, mesh.triangles[triangle][corner], pieces.item[p], row);
      }
      else
      {
        AddPiece(space, source, corner, pieces.item[p], row);
      }
    }
  };
  return BuildRows(hats, space, threads,
    [&](Index hat, Row& row)
    {
      if (!isBare.empty() && isBare[hat])
      {
        AddPoint(space, pointOfHat[hat], row);
        return;
      }
      for (Id k = hats.begin[hat]; k < hats.begin[hat + 1]; ++k)
      {
        addTriangle(hats.corners[k].Triangle(), hats.corners[k].Corner(), row);
      }
    });
}

SparseMatrix BuildHatProlongation(const HatFunctions& hats, const GridFunctions& space,
  const TriangleMesh& mesh, HatTransfer transfer, int threads)
{
  SparseMatrix prolongation = BuildHatWeights(hats, space, mesh, transfer, {}, threads);
  MultiVector sum = RowSums(prolongation, threads);
  if ((sum.array() == 0.0).any())
  {
    prolongation = BuildHatWeights(hats, space, mesh, transfer, BareRows(sum), threads);
    sum = RowSums(prolongation, threads);
  }
  DivideRows(sum, prolongation, threads);
  return prolongation;
}

std::vector<char> BareRows(const MultiVector& sum)
{
  std::vector<char> isBare(sum.rows());
  std::transform(
    sum.data(), sum.data() + sum.rows(), isBare.begin(), [](double s) { return s == 0.0; });
  return isBare;
}

} // namespace gridfem
