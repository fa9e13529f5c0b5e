// Right-hand sides: integrals of given fields against the functions. [T (4.3), (4.4), Alg. 4.2]
#ifndef GridFEM_LoadVector_h
#define GridFEM_LoadVector_h

#include "FunctionSpace.h"
#include "QuadratureRule.h"

namespace gridfem
{

/// Where the rows of a field live.
enum class FieldAssociation
{
  Points,   // one row per input point, linear along each source triangle
  Triangles // one row per source triangle, constant on it
};

struct Field
{
  FieldAssociation association = FieldAssociation::Points;
  MultiVector values; // rows: points or triangles; columns: components

  /// Rows of `values` at the corners of a source triangle.
  /// (All three are the triangle's own row for FieldAssociation::Triangles.)
  std::array<Id, 3> RowsOf(Id triangle, const std::array<Id, 3>& points) const
  {
    return association == FieldAssociation::Points
             ? points
             : std::array<Id, 3>{ triangle, triangle, triangle };
  }
};

/// All integrals throw InvalidInput when the rows or columns of a field do not fit the mesh.
/// f_i = ∫ f b_i in grid units (field unit x cell sides squared): rows = functions of the finest
/// level, columns = components of f. Same bits for any number of threads.
MultiVector IntegrateValues(const FunctionSpace& space, const TriangleMesh& mesh, const Field& f,
  const QuadratureRule& rule, int threads = 0, const Progress& progress = {});

/// s_i = ∫ <s, ∇b_i> in the units of λM + L in grid units (the world's integral: spacing times the
/// one over grid units), for vector fields in world units: s.values has 3 C columns, the three
/// components of vector c in columns 3c .. 3c+2; the part normal to the surface is ignored.
/// @return rows = functions, C columns; multiplied by `scale` (a Field with one column, or none)
MultiVector IntegrateGradients(const FunctionSpace& space, const TriangleMesh& mesh, const Field& s,
  const Field* scale, const QuadratureRule& rule, int threads = 0, const Progress& progress = {});

/// The same with s = ∇f, f linear on each triangle (f must live on points).
MultiVector IntegrateGradientsOf(const FunctionSpace& space, const TriangleMesh& mesh,
  const Field& f, const Field* scale, const QuadratureRule& rule, int threads = 0,
  const Progress& progress = {});

} // namespace gridfem

#endif
