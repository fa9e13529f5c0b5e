// Right-hand sides for hat functions: exact integrals of given fields. [T (4.3), (4.4)]
#ifndef GridFEM_HatLoad_h
#define GridFEM_HatLoad_h

#include "Grid/Field.h"
#include "Integrals/EdgeSamples.h"
#include "Spaces/HatFunctions.h"

namespace gridfem
{

/// Fields are linear or constant on every triangle, as for LoadVector.h, so that all integrals are
/// exact; values on points need not agree at coincident points. All throw InvalidInput when the
/// rows or columns of a field do not fit the mesh; same bits for any number of threads.

/// ∫ f φ_i, in the unit of length squared: rows = functions, columns = components of f.
/// @param weight  on each triangle: ∫ w f φ_i; null: 1
MultiVector IntegrateValues(const HatFunctions& hats, const TriangleMesh& mesh, const Field& f,
  int threads = 0, const std::vector<double>* weight = nullptr);

/// ∫ <s, ∇φ_i> in world units, in which the stiffness has none. Vector c of s lies in columns
/// 3c .. 3c+2; its part normal to the triangle is ignored.
/// @return rows = functions, one column per vector; multiplied by `scale` (one column, or null)
MultiVector IntegrateGradients(const HatFunctions& hats, const TriangleMesh& mesh, const Field& s,
  const Field* scale, int threads = 0);

/// The same with n x s, n the unit normal of each triangle, and without a scale.
MultiVector IntegrateTurnedGradients(
  const HatFunctions& hats, const TriangleMesh& mesh, const Field& s, int threads = 0);

/// The same with s = ∇f, f linear on each triangle (f must live on points).
MultiVector IntegrateGradientsOf(const HatFunctions& hats, const TriangleMesh& mesh, const Field& f,
  const Field* scale, int threads = 0);

/// The same samples as of a grid (EdgeSamples.h), three on each segment, on which hats are linear.
EdgeSamples SampleSegments(
  const HatFunctions& hats, const TriangleMesh& mesh, const std::vector<TriangleSegment>& segments);

} // namespace gridfem

#endif
