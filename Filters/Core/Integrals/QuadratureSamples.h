// What all integrals over the clipped mesh share: the plane of a piece and its quadrature samples.
// A piece is integrated as the fan of triangles around its first corner. [T Alg. 4.1]
#ifndef GridFEM_QuadratureSamples_h
#define GridFEM_QuadratureSamples_h

#include "Grid/Clip.h"
#include "Integrals/QuadratureRule.h"

#include <Eigen/Geometry>

namespace gridfem
{

/// Lowest corner of the cell with this key, grid units: the origin of its local coordinates.
inline Vec3 CellCorner(MortonKey key)
{
  const CellIndex cell = MortonDecode(key);
  return Vec3(cell[0], cell[1], cell[2]);
}

/// Sum of the area vectors of the fan: twice the area along the normal, which is less sensitive to
/// short edges than the normal of any of its triangles.
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

/// Unit normal of a piece, zero for a piece without area.
inline Vec3 UnitNormal(const ClippedMesh& clipped, Id piece)
{
  const Vec3 area = AreaVector(clipped, piece);
  const double norm = area.norm();
  return norm > 0.0 ? Vec3(area / norm) : Vec3(Vec3::Zero());
}

/// A triangle of a piece's fan: its corners are the piece's corners 0, k and k + 1.
struct FanTriangle
{
  Id k;
  std::array<Vec3, 3> corner; // relative to the given origin, grid units
  Vec3 areaVector;            // along the normal
  double area;                // its length, grid units, > 0

  Vec3 At(const std::array<double, 3>& barycentric) const
  {
    return barycentric[0] * corner[0] + barycentric[1] * corner[1] + barycentric[2] * corner[2];
  }
};

/// Calls body(FanTriangle) for the triangles of a piece that have an area.
template<class Body>
void ForEachFanTriangle(const ClippedMesh& clipped, Id piece, const Vec3& origin, Body&& body)
{
  const Index* corner = clipped.corners.data() + clipped.pieceBegin[piece];
  const Id count = clipped.pieceBegin[piece + 1] - clipped.pieceBegin[piece];
  FanTriangle triangle;
  triangle.corner[0] = clipped.position[corner[0]] - origin;
  for (Id k = 1; k + 1 < count; ++k)
  {
    triangle.k = k;
    triangle.corner[1] = clipped.position[corner[k]] - origin;
    triangle.corner[2] = clipped.position[corner[k + 1]] - origin;
    triangle.areaVector =
      0.5 *
      (triangle.corner[1] - triangle.corner[0]).cross(triangle.corner[2] - triangle.corner[0]);
    triangle.area = triangle.areaVector.norm();
    if (triangle.area > 0.0)
    {
      body(triangle);
    }
  }
}

/// Samples of all pieces have one numbering: piece after piece, triangle after triangle of a fan
/// (those without area too), point after point of the rule.
inline Id FirstSample(const ClippedMesh& clipped, Id piece, const QuadratureRule& rule)
{
  return clipped.FirstTriangle(piece) * static_cast<Id>(rule.points.size());
}

inline Id NumberOfSamples(const ClippedMesh& clipped, const QuadratureRule& rule)
{
  return clipped.NumberOfTriangles() * static_cast<Id>(rule.points.size());
}

/// Calls body(sample, local, weight) for the samples of a piece: number, position relative to the
/// origin, area it stands for; grid units.
template<class Body>
void ForEachSample(
  const ClippedMesh& clipped, Id piece, const Vec3& origin, const QuadratureRule& rule, Body&& body)
{
  const Id points = static_cast<Id>(rule.points.size());
  const Id first = FirstSample(clipped, piece, rule);
  ForEachFanTriangle(clipped, piece, origin,
    [&](const FanTriangle& triangle)
    {
      Id sample = first + (triangle.k - 1) * points;
      for (const QuadratureRule::Point& point : rule.points)
      {
        body(sample++, triangle.At(point.barycentric), point.weight * triangle.area);
      }
    });
}

} // namespace gridfem

#endif
