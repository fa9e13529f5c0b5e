// Fields given on a mesh: what right-hand sides are integrated from.
#ifndef GridFEM_Field_h
#define GridFEM_Field_h

#include "Grid/TriangleMesh.h"

namespace gridfem
{

/// Where the rows of a field live.
enum class FieldAssociation
{
  Points,    // one row per input point, linear along each source triangle
  Triangles, // one row per source triangle, constant on it
  Corners    // three rows per source triangle, linear along it
};

struct Field
{
  FieldAssociation association = FieldAssociation::Points;
  MultiVector values; // rows: points, triangles or corners; columns: components

  /// Rows of `values` at the corners of a source triangle.
  /// (All three are the triangle's own row for FieldAssociation::Triangles.)
  std::array<Id, 3> RowsOf(Id triangle, const std::array<Id, 3>& points) const
  {
    switch (association)
    {
      case FieldAssociation::Triangles:
        return { triangle, triangle, triangle };
      case FieldAssociation::Corners:
        return { 3 * triangle, 3 * triangle + 1, 3 * triangle + 2 };
      case FieldAssociation::Points:
        break;
    }
    return points;
  }
};

/// The coordinates of the points.
Field CoordinatesOf(const TriangleMesh& mesh);

/// Throws InvalidInput when the rows of a field do not fit the mesh.
void RequireField(const Field& field, const TriangleMesh& mesh);

/// The same, and when the columns are no vectors: 3 C columns, vector c in 3c .. 3c+2.
void RequireVectors(const Field& field, const TriangleMesh& mesh);

/// The same, and when there is more than one column. Null is let through.
void RequireScale(const Field* scale, const TriangleMesh& mesh);

/// Throws InvalidInput unless there is one weight for each triangle, finite and 0 or more.
void RequireWeights(const std::vector<double>& weight, const TriangleMesh& mesh);

/// Weight by weight.
std::vector<double> ProductOf(const std::vector<double>& a, const std::vector<double>& b);

/// The same as RequireField, and when the field is constant on triangles.
void RequireOnPoints(const Field& field, const TriangleMesh& mesh);

} // namespace gridfem

#endif
