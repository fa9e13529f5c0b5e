// Right-hand sides: integrals of given fields against the functions. [T (4.3), (4.4), Alg. 4.2]
#ifndef GridFEM_LoadVector_h
#define GridFEM_LoadVector_h

#include "Base/Job.h"
#include "Grid/Field.h"
#include "Grid/GridFunctions.h"
#include "Integrals/QuadratureRule.h"

namespace gridfem
{

/// All integrals throw InvalidInput when the rows or columns of a field do not fit the mesh.
/// f_i = ∫ f b_i in grid units (field unit x cell sides squared): rows = functions of the finest
/// level, columns = components of f. Same bits for any number of threads.
/// @param weight  on each source triangle: ∫ w f b_i; null: 1
MultiVector IntegrateValues(const GridFunctions& space, const TriangleMesh& mesh, const Field& f,
  const QuadratureRule& rule, const Job& job = {}, const std::vector<double>* weight = nullptr);

/// s_i = ∫ <s, ∇b_i> in the units of λM + L in grid units (the world's integral: spacing times the
/// one over grid units), for vector fields in world units: s.values has 3 C columns, the three
/// components of vector c in columns 3c .. 3c+2; the part normal to the surface is ignored.
/// @return rows = functions, C columns; multiplied by `scale` (a Field with one column, or none)
MultiVector IntegrateGradients(const GridFunctions& space, const TriangleMesh& mesh, const Field& s,
  const Field* scale, const QuadratureRule& rule, const Job& job = {});

/// The same with n x s, n the unit normal of each triangle, and without a scale.
MultiVector IntegrateTurnedGradients(const GridFunctions& space, const TriangleMesh& mesh,
  const Field& s, const QuadratureRule& rule, const Job& job = {});

/// The same with s = ∇u / |∇u| for functions given by their coefficients, one for each column; 0
/// where ∇u = 0.
MultiVector IntegrateDirections(const GridFunctions& space, const TriangleMesh& mesh,
  const MultiVector& coefficients, const Field* scale, const QuadratureRule& rule,
  const Job& job = {});

/// The same with s = ∇f, f linear on each triangle (f must live on points).
MultiVector IntegrateGradientsOf(const GridFunctions& space, const TriangleMesh& mesh,
  const Field& f, const Field* scale, const QuadratureRule& rule, const Job& job = {});

/// The same for the coordinates of the mesh's points, in world units: ∫ <(I - n nᵀ + s n nᵀ) e_k,
/// ∇b_i> for coordinate k. Coordinates are functions in space whose normal derivative is known,
/// n_k, so that with the weight s of the system they stay its solution.
/// @return  three columns
MultiVector IntegrateGradientsOfCoordinates(const GridFunctions& space, const TriangleMesh& mesh,
  const Field* scale, const QuadratureRule& rule, double normalStabilization, const Job& job = {});

} // namespace gridfem

#endif
