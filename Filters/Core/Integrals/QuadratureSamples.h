// The common parts of all integrals over the clipped mesh: the plane of a piece and its quadrature
// samples. A piece is integrated as the fan of triangles around its first corner. [T Alg. 4.1]
#ifndef GridFEM_QuadratureSamples_h
#define GridFEM_QuadratureSamples_h

#include "Grid/Clip.h"
#include "Integrals/QuadratureRule.h"

#include <Eigen/Geometry>

namespace gridfem
{

/// Returns the lowest corner of a cell in grid units. It is the origin of the cell's local
/// coordinates.
inline Vec3 CellCorner(MortonKey key)
{
  const CellIndex cell = MortonDecode(key);
  return Vec3(cell[0], cell[1], cell[2]);
}

/// Returns the sum of the area vectors of the fan: a normal with twice the area as its length. It
/// is less sensitive to short edges than the normal of a single triangle.
inline Vec3 AreaVector(const ClippedMesh& clipped, Id piece)
{
  const Id begin = clipped.pieceBegin[piece];
  const Id end = clipped.pieceBegin[piece + 1];
  const Vec3& apex = clipped.position[clipped.corners[begin]];
  Vec3 sum = Vec3::Zero();
  for (Id k = begin + 1; k + 1 < end; ++k)
  {
    sum += (clipped.position[clipped.corners[k]] - apex)
             .cross(clipped.position[clipped.corners[k + 1]] - apex);
  }
  return sum;
}

/// Returns the unit normal of a piece, or zero for a piece without area.
inline Vec3 UnitNormal(const ClippedMesh& clipped, Id piece)
{
  const Vec3 area = AreaVector(clipped, piece);
  const double norm = area.norm();
  return norm > 0.0 ? Vec3(area / norm) : Vec3(Vec3::Zero());
}

/// Returns the number of a piece's first sample. Samples are numbered piece after piece, then
/// triangle after triangle of the fan (including triangles without area), then point after point of
/// the rule.
inline Id FirstSample(const ClippedMesh& clipped, Id piece, const QuadratureRule& rule)
{
  return clipped.FirstTriangle(piece) * static_cast<Id>(rule.points.size());
}

inline Id NumberOfSamples(const ClippedMesh& clipped, const QuadratureRule& rule)
{
  return clipped.NumberOfTriangles() * static_cast<Id>(rule.points.size());
}

/// Calls body(local, weight) for the samples of a piece on triangles with area. `local` is the
/// position relative to `origin`, `weight` the area that the sample represents, both in grid units.
template<class Body>
void ForEachSample(
  const ClippedMesh& clipped, Id piece, const Vec3& origin, const QuadratureRule& rule, Body&& body)
{
  const Index* corner = clipped.corners.data() + clipped.pieceBegin[piece];
  const Index* const last = clipped.corners.data() + clipped.pieceBegin[piece + 1] - 1;
  const Vec3 apex = clipped.position[*corner] - origin;
  while (++corner < last)
  {
    const Vec3 a = clipped.position[corner[0]] - origin;
    const Vec3 b = clipped.position[corner[1]] - origin;
    const double area = 0.5 * (a - apex).cross(b - apex).norm();
    for (const QuadratureRule::Point& point : rule.points)
    {
      const auto& [ofApex, ofA, ofB] = point.barycentric;
      if (area > 0.0)
      {
        body(Vec3(ofApex * apex + ofA * a + ofB * b), point.weight * area);
      }
    }
  }
}

} // namespace gridfem

#endif
