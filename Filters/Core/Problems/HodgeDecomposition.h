// A field of vectors along a surface taken apart: into what flows out of sources, what turns in
// eddies, and what only flows around handles and holes.
#ifndef GridFEM_HodgeDecomposition_h
#define GridFEM_HodgeDecomposition_h

#include "Problems/Poisson.h"
#include "Spaces/FiniteElementSpace.h"

namespace gridfem
{

/// What is held is solved for to the tolerance, or to 1e-4 where that is 0.
struct HodgeOptions : EquationOptions
{
  bool weldCoincidentPoints = true; // coincident points count as one where triangles meet
};

/// World units; vectors have three columns. v is the field without its part along the normal.
struct HodgeDecomposition
{
  /// Means over the triangles; the three add up to that of v.
  MultiVector gradientOnTriangles; // ∇u
  MultiVector rotationOnTriangles; // n x ∇w
  MultiVector restOnTriangles;     // harmonic, up to what the functions cannot follow
  /// The same, each projected into the space; 0 at points that no function reaches.
  MultiVector gradientAtPoints;
  MultiVector rotationAtPoints;
  MultiVector restAtPoints;
  MultiVector potentialAtPoints; // u, of mean 0 on each component
  MultiVector streamAtPoints;    // w, 0 at boundaries, else of mean 0
  Index numberOfComponents = 0;
  Index numberOfOneSided = 0; // components without two sides: w is 0 there
  SolveReport report;         // of the solve that took most iterations
  SolutionAccuracy accuracy;  // of the worst solve
};

/// v = ∇u + n x ∇w + h, each part orthogonal to the others: ∫ <∇u, ∇b> = ∫ <v, ∇b> for all b, and
/// ∫ <n x ∇w, n x ∇b> = ∫ <v, n x ∇b> for all b that are 0 where the surface ends, as w is. So h
/// has no sources, no eddies, and does not cross a boundary. It is 0 on a disc and on a sphere; on
/// others there is one such field for each hole but the first, and two for each handle.
///
/// Triangles that face the other way than their component are taken to face alike; then vectors at
/// points count by their means over triangles. Edges of more than two triangles count as a
/// boundary for w.
/// @param v  three columns
/// Throws InvalidInput when the field does not fit, and Aborted. Same bits for any number of
/// threads.
HodgeDecomposition DecomposeField(const FiniteElementSpace& space, const TriangleMesh& mesh,
  const Field& v, const HodgeOptions& options, const Job& job = {});

} // namespace gridfem

#endif
