// Fields given on a mesh. Right-hand sides are integrals of such fields.
#ifndef GridFEM_Field_h
#define GridFEM_Field_h

#include "Grid/TriangleMesh.h"

namespace gridfem
{

/// The items of the mesh that the rows of a field belong to.
enum class FieldAssociation
{
  Points,    // one row per input point, linear on each source triangle
  Triangles, // one row per source triangle, constant on it
  Corners    // three rows per source triangle, linear on it
};

struct Field
{
  FieldAssociation association = FieldAssociation::Points;
  MultiVector values; // rows: points, triangles or corners; columns: components

  /// Returns the rows of `values` at the corners of a source triangle. For
  /// FieldAssociation::Triangles, all three are the row of the triangle.
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

/// Returns the coordinates of the points as a field.
Field CoordinatesOf(const TriangleMesh& mesh);

/// Throws InvalidInput when the number of rows does not fit the mesh.
void RequireField(const Field& field, const TriangleMesh& mesh);

/// Throws InvalidInput like RequireField, and when the number of columns is not a multiple of 3.
/// Vector c is in columns 3c .. 3c+2.
void RequireVectors(const Field& field, const TriangleMesh& mesh);

/// Throws InvalidInput like RequireField, and unless there is exactly one column. Accepts null.
void RequireScale(const Field* scale, const TriangleMesh& mesh);

/// Throws InvalidInput unless every triangle has a finite weight of at least 0.
void RequireWeights(const std::vector<double>& weight, const TriangleMesh& mesh);

/// Multiplies two lists of weights, entry by entry.
std::vector<double> ProductOf(const std::vector<double>& a, const std::vector<double>& b);

/// Returns the means of values on triangles over the cells that the triangles come from, weighted
/// by area. Cells without an area have NaN.
MultiVector MeansOnCells(const TriangleMesh& mesh, const std::vector<Id>& sourceCell,
  const MultiVector& onTriangles, Id cells);

/// Throws InvalidInput like RequireField, and unless the field is given on points.
void RequireOnPoints(const Field& field, const TriangleMesh& mesh);

} // namespace gridfem

#endif
