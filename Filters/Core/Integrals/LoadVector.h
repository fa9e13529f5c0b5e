// Right-hand sides: integrals of given fields against the functions [T (4.3), (4.4), Alg. 4.2]. All
// functions throw InvalidInput when the rows or columns of a field do not fit the mesh.
#ifndef GridFEM_LoadVector_h
#define GridFEM_LoadVector_h

#include "Base/Job.h"
#include "Grid/Field.h"
#include "Grid/GridFunctions.h"
#include "Integrals/QuadratureRule.h"

namespace gridfem
{

/// Returns f_i = ∫ f b_i in grid units (field unit x squared cell sides): rows = functions of the
/// level, columns = components of f. Same bits for any number of threads.
/// @param level   functions on the finest patches of the space
/// @param weight  weight w on each source triangle, ∫ w f b_i; null: 1
template<int Functions>
MultiVector IntegrateValues(const GridFunctions& space, const BasicPatchLevel<Functions>& level,
  const TriangleMesh& mesh, const Field& f, const QuadratureRule& rule, const Job& job = {},
  const std::vector<double>* weight = nullptr);

/// Returns s_i = ∫ <s, ∇b_i> for vector fields in world units. The result has the units of λM + L
/// in grid units: it is the integral over the world, or spacing times the integral over grid units.
/// The values of s have 3 C columns, with vector c in columns 3c .. 3c+2. The part of s normal to
/// the surface is ignored.
/// @param scale  field with one column that multiplies s; null: 1
/// @return rows = functions, C columns
template<int Functions>
MultiVector IntegrateGradients(const GridFunctions& space, const BasicPatchLevel<Functions>& level,
  const TriangleMesh& mesh, const Field& s, const Field* scale, const QuadratureRule& rule,
  const Job& job = {});

/// Integrates the field n x s like IntegrateGradients, but without a scale. The vector n is the
/// unit normal of each triangle.
template<int Functions>
MultiVector IntegrateTurnedGradients(const GridFunctions& space,
  const BasicPatchLevel<Functions>& level, const TriangleMesh& mesh, const Field& s,
  const QuadratureRule& rule, const Job& job = {});

/// Integrates the field s = ∇u / |∇u| (0 where ∇u = 0) like IntegrateGradients. Each column of
/// `coefficients` is a function u of the level.
template<int Functions>
MultiVector IntegrateDirections(const GridFunctions& space, const BasicPatchLevel<Functions>& level,
  const TriangleMesh& mesh, const MultiVector& coefficients, const Field* scale,
  const QuadratureRule& rule, const Job& job = {});

/// Integrates the field s = ∇f like IntegrateGradients. The field f is linear on each triangle and
/// must be on points.
template<int Functions>
MultiVector IntegrateGradientsOf(const GridFunctions& space,
  const BasicPatchLevel<Functions>& level, const TriangleMesh& mesh, const Field& f,
  const Field* scale, const QuadratureRule& rule, const Job& job = {});

/// Integrates the gradients of the coordinates of the mesh's points, in world units:
/// ∫ <(I - n nᵀ + s n nᵀ) e_k, ∇b_i> for coordinate k. The normal derivative of a coordinate is
/// known: n_k. With the weight s of the system, the coordinates therefore remain the system's
/// solution.
/// @return  three columns
template<int Functions>
MultiVector IntegrateGradientsOfCoordinates(const GridFunctions& space,
  const BasicPatchLevel<Functions>& level, const TriangleMesh& mesh, const Field* scale,
  const QuadratureRule& rule, double normalStabilization, const Job& job = {});

///@{ The same for the trilinear functions of the grid.
inline MultiVector IntegrateValues(const GridFunctions& space, const TriangleMesh& mesh,
  const Field& f, const QuadratureRule& rule, const Job& job = {},
  const std::vector<double>* weight = nullptr)
{
  return IntegrateValues(space, space.Finest(), mesh, f, rule, job, weight);
}
inline MultiVector IntegrateGradients(const GridFunctions& space, const TriangleMesh& mesh,
  const Field& s, const Field* scale, const QuadratureRule& rule, const Job& job = {})
{
  return IntegrateGradients(space, space.Finest(), mesh, s, scale, rule, job);
}
inline MultiVector IntegrateGradientsOf(const GridFunctions& space, const TriangleMesh& mesh,
  const Field& f, const Field* scale, const QuadratureRule& rule, const Job& job = {})
{
  return IntegrateGradientsOf(space, space.Finest(), mesh, f, scale, rule, job);
}
inline MultiVector IntegrateGradientsOfCoordinates(const GridFunctions& space,
  const TriangleMesh& mesh, const Field* scale, const QuadratureRule& rule,
  double normalStabilization, const Job& job = {})
{
  return IntegrateGradientsOfCoordinates(
    space, space.Finest(), mesh, scale, rule, normalStabilization, job);
}
///@}

} // namespace gridfem

#endif
