#include "Integrals/EdgeSamples.h"

#include "Algebra/RowBuilder.h"
#include "Grid/MeshEdges.h"
#include "Grid/TriangleSides.h"
#include "Integrals/CellBasis.h"
#include "Integrals/QuadratureSamples.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace gridfem
{
namespace
{

struct CellPiece
{
  MortonKey cell;
  Index piece; // -1: the piece of another process
  bool operator<(const CellPiece& other) const { return cell < other.cell; }
};

/// The pieces of the triangles that contain some segments, sorted by cell.
class PiecesOfSegments
{
public:
  PiecesOfSegments(const GridFunctions& space, const TriangleMesh& mesh,
    const std::vector<TriangleSegment>& segments)
    : space_(space), mesh_(mesh), list_(mesh.triangles.size(), -1)
  {
    RequireSegments(segments, mesh);
    for (const TriangleSegment& segment : segments)
    {
      if (list_[segment.triangle] < 0)
      {
        list_[segment.triangle] = static_cast<Index>(pieces_.size());
        pieces_.emplace_back();
      }
    }
    const ClippedMesh& clipped = space.clipped;
    for (std::size_t c = 0; c < clipped.cells.size(); ++c)
    {
      for (Index piece = clipped.cellBegin[c]; piece < clipped.cellBegin[c + 1]; ++piece)
      {
        const Index list = list_[clipped.pieceTriangle[piece]];
        if (list >= 0)
        {
          pieces_[list].push_back({ clipped.cells[c], piece }); // cells are in ascending order
        }
      }
    }
    this->AddElsewhere();
  }

  /// Returns the patch of a triangle at one of its points. Returns -1 if the triangle has no piece
  /// there or another process has the piece. On a face between cells, the functions of both patches
  /// agree, so either patch will do.
  Index PatchAt(Id triangle, const Vec3& position) const
  {
    const std::vector<CellPiece>& pieces = pieces_[list_[triangle]];
    if (pieces.empty())
    {
      return -1;
    }
    const CellPiece* found = PieceInCell(pieces, this->Inwards(triangle, position));
    if (!found)
    {
      found = this->NearestPiece(pieces, position);
    }
    return found && found->piece >= 0 ? space_.piecePatch[found->piece] : -1;
  }

private:
  /// Moves a point slightly toward the triangle's center, because a segment may lie on faces of
  /// cells.
  Vec3 Inwards(Id triangle, const Vec3& position) const
  {
    constexpr double Step = 1e-6;
    const auto& corner = mesh_.triangles[triangle];
    const Array<Vec3>& point = space_.clipped.position;
    const Vec3 inwards = (point[corner[0]] + point[corner[1]] + point[corner[2]]) / 3.0 - position;
    return position + Step / std::max(1.0, inwards.norm()) * inwards;
  }

  /// Adds pieces of other processes, so that all processes with pieces near a point choose the same
  /// piece.
  void AddElsewhere()
  {
    std::vector<char> isShared(pieces_.size(), 0);
    for (const PieceElsewhere& other : space_.elsewhere)
    {
      const Index list = list_[other.triangle];
      if (list >= 0)
      {
        pieces_[list].push_back({ other.cell, -1 });
        isShared[list] = 1;
      }
    }
    for (std::size_t list = 0; list < pieces_.size(); ++list)
    {
      if (isShared[list])
      {
        std::stable_sort(pieces_[list].begin(), pieces_[list].end());
      }
    }
  }

  const CellPiece* PieceInCell(const std::vector<CellPiece>& pieces, const Vec3& position) const
  {
    CellIndex cell;
    for (int axis = 0; axis < 3; ++axis)
    {
      cell[axis] = std::clamp(
        static_cast<int>(std::floor(position[axis])), 0, space_.GetGrid().CellsPerSide() - 1);
    }
    const CellPiece wanted{ MortonEncode(cell), 0 };
    const auto found = std::lower_bound(pieces.begin(), pieces.end(), wanted);
    return found != pieces.end() && found->cell == wanted.cell ? &*found : nullptr;
  }

  /// Returns the piece whose cell is nearest. If processes divide the surface, it returns null when
  /// this cell is not near, because the piece at the position is then unknown here.
  const CellPiece* NearestPiece(const std::vector<CellPiece>& pieces, const Vec3& position) const
  {
    constexpr double Near = 1e-3; // cells
    double least = space_.isPart ? Near : std::numeric_limits<double>::infinity();
    const CellPiece* nearest = nullptr;
    for (const CellPiece& own : pieces)
    {
      const CellIndex cell = MortonDecode(own.cell);
      const Vec3 local = position - Vec3(cell[0], cell[1], cell[2]);
      const double distance = (local - local.cwiseMax(0.0).cwiseMin(1.0)).norm();
      if (distance < least)
      {
        least = distance;
        nearest = &own;
      }
    }
    return nearest;
  }

  const GridFunctions& space_;
  const TriangleMesh& mesh_;
  std::vector<Index> list_; // list of each triangle; -1: none
  std::vector<std::vector<CellPiece>> pieces_;
};

template<class Positions>
std::array<Vec3, 2> EndsOf(
  const TriangleSegment& segment, const TriangleMesh& mesh, const Positions& position)
{
  const auto& corner = mesh.triangles[segment.triangle];
  const Vec3& a = position[corner[0]];
  const Vec3& b = position[corner[1]];
  const Vec3& c = position[corner[2]];
  return { PointOfSegment(segment, 0.0, a, b, c), PointOfSegment(segment, 1.0, a, b, c) };
}

/// Returns the parameters in [0, 1] where the line from a to b crosses faces of cells, including
/// both ends.
std::vector<double> Crossings(const Vec3& a, const Vec3& b)
{
  std::vector<double> at{ 0.0, 1.0 };
  for (int axis = 0; axis < 3; ++axis)
  {
    const PlaneRange planes = PlanesBetween(a[axis], b[axis]);
    for (int k = 0; k < planes.count; ++k)
    {
      at.push_back((planes.first + k - a[axis]) / (b[axis] - a[axis]));
    }
  }
  std::sort(at.begin(), at.end());
  return at;
}

} // namespace

template<int Functions>
EdgeSamples SampleSegments(const GridFunctions& space, const BasicPatchLevel<Functions>& level,
  const TriangleMesh& mesh, const std::vector<TriangleSegment>& segments)
{
  const PiecesOfSegments pieces(space, mesh, segments);
  EdgeSamples samples;
  RowBuilder rows;
  RowBuilder::Entries entries;
  for (std::size_t s = 0; s < segments.size(); ++s)
  {
    const TriangleSegment& segment = segments[s];
    const auto [a, b] = EndsOf(segment, mesh, space.clipped.position);
    const auto [first, last] = EndsOf(segment, mesh, mesh.points);
    const double length = (last - first).norm();
    const std::vector<double> at = Crossings(a, b);
    for (std::size_t k = 0; k + 1 < at.size(); ++k)
    {
      const double stretch = at[k + 1] - at[k];
      for (const GaussPoint& gauss : GaussPoints)
      {
        const double t = at[k] + gauss.position * stretch;
        const Vec3 position = a + t * (b - a);
        const Index patch = pieces.PatchAt(segment.triangle, position);
        if (patch < 0 || !(stretch > 0.0))
        {
          continue;
        }
        std::array<double, Functions> value;
        BasisValues(position - CellCorner(level.cell[patch]), value);
        entries.clear();
        for (int i = 0; i < Functions; ++i)
        {
          entries.emplace_back(level.dof[patch][i], value[i]);
        }
        rows.Append(entries);
        samples.edge.push_back(static_cast<Index>(s));
        samples.position.push_back(t);
        samples.isMiddle.push_back(gauss.position == 0.5);
        samples.length.push_back(gauss.weight * stretch * length);
      }
    }
  }
  samples.rows = rows.Finish(level.numberOfFunctions);
  return samples;
}

template EdgeSamples SampleSegments(const GridFunctions&, const PatchLevel&, const TriangleMesh&,
  const std::vector<TriangleSegment>&);
template EdgeSamples SampleSegments(const GridFunctions&, const SmoothLevel&, const TriangleMesh&,
  const std::vector<TriangleSegment>&);

MultiVector IntegrateAlong(const EdgeSamples& samples, const MultiVector& values)
{
  MultiVector load = MultiVector::Zero(samples.rows.columns, values.cols());
  for (Index row = 0; row < samples.rows.rows; ++row)
  {
    for (Id k = samples.rows.rowBegin[row]; k < samples.rows.rowBegin[row + 1]; ++k)
    {
      load.row(samples.rows.column[k]) +=
        samples.length[row] * samples.rows.value[k] * values.row(row);
    }
  }
  return load;
}

} // namespace gridfem
