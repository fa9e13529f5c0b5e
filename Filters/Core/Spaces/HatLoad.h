// Right-hand sides for hat functions: exact integrals of given fields. [T (4.3), (4.4)]
#ifndef GridFEM_HatLoad_h
#define GridFEM_HatLoad_h

#include "Grid/Field.h"
#include "Integrals/EdgeSamples.h"
#include "Spaces/HatFunctions.h"

namespace gridfem
{

/// Fields are linear or constant on every triangle, as in LoadVector.h, so all integrals are exact.
/// Values on points may differ at coincident points. All functions throw InvalidInput when the rows
/// or columns of a field do not fit the mesh. Same bits for any number of threads.

/// Returns ∫ f φ_i in squared units of length: rows = functions, columns = components of f.
/// @param weight  weight w on each triangle, ∫ w f φ_i; null: 1
MultiVector IntegrateValues(const HatFunctions& hats, const TriangleMesh& mesh, const Field& f,
  int threads = 0, const std::vector<double>* weight = nullptr);

/// Returns ∫ <s, ∇φ_i> in world units, in which the stiffness is dimensionless. Vector c of s is in
/// columns 3c .. 3c+2; its part normal to the triangle is ignored.
/// @param scale  field with one column that multiplies s; null: 1
/// @return rows = functions, one column per vector
MultiVector IntegrateGradients(const HatFunctions& hats, const TriangleMesh& mesh, const Field& s,
  const Field* scale, int threads = 0);

/// Integrates the field n x s like IntegrateGradients, but without a scale. The vector n is the
/// unit normal of each triangle.
MultiVector IntegrateTurnedGradients(
  const HatFunctions& hats, const TriangleMesh& mesh, const Field& s, int threads = 0);

/// Integrates the field s = ∇f like IntegrateGradients. The field f is linear on each triangle and
/// must be on points.
MultiVector IntegrateGradientsOf(const HatFunctions& hats, const TriangleMesh& mesh, const Field& f,
  const Field* scale, int threads = 0);

/// Returns samples as for a grid (EdgeSamples.h): three per segment, because hats are linear on it.
EdgeSamples SampleSegments(
  const HatFunctions& hats, const TriangleMesh& mesh, const std::vector<TriangleSegment>& segments);

} // namespace gridfem

#endif
