// Splits a vector field along a surface into three parts: the flow out of sources, the flow in
// eddies, and the flow that only runs around handles and holes.
#ifndef GridFEM_HodgeDecomposition_h
#define GridFEM_HodgeDecomposition_h

#include "Equations/Poisson.h"
#include "Spaces/FiniteElementSpace.h"

namespace gridfem
{

/// The solve with held values goes to the tolerance, or to 1e-4 if that is 0.
struct HodgeOptions : EquationOptions
{
  bool weldCoincidentPoints = true; // coincident points count as one where triangles meet
};

/// The three parts of a field, in world units; vectors have three columns. v is the field without
/// its normal part.
struct HodgeDecomposition
{
  /// Means over the triangles. The three parts add up to the mean of v.
  MultiVector gradientOnTriangles; // ∇u
  MultiVector rotationOnTriangles; // n x ∇w
  MultiVector restOnTriangles;     // harmonic, up to the part that the functions cannot represent
  /// The same parts, each projected into the space; 0 at points that no function reaches.
  MultiVector gradientAtPoints;
  MultiVector rotationAtPoints;
  MultiVector restAtPoints;
  MultiVector potentialAtPoints; // u, with mean 0 on each component
  MultiVector streamAtPoints;    // w, 0 at boundaries, else with mean 0
  Index numberOfComponents = 0;
  Index numberOfOneSided = 0; // components without two sides; w is 0 there
  SolveReport report;         // of the solve with the most iterations
  SolutionAccuracy accuracy;  // of the worst solve
};

/// Splits v = ∇u + n x ∇w + h into mutually orthogonal parts.
///   ∫ <∇u, ∇b> = ∫ <v, ∇b> for all b,
///   ∫ <n x ∇w, n x ∇b> = ∫ <v, n x ∇b> for all b that are 0 where the surface ends; w is 0 there,
///   too.
/// So h has no sources, no eddies, and does not cross a boundary. It is 0 on a disk and on a
/// sphere. Other surfaces have one such field for each hole except the first, and two for each
/// handle.
///
/// Triangles with the opposite orientation to their component are treated as turned around. Vectors
/// at points are then replaced by their means over triangles. Edges of more than two triangles
/// count as a boundary for w.
/// @param v  three columns
/// Throws InvalidInput when the field does not fit, and Aborted. Same bits for any number of
/// threads.
HodgeDecomposition DecomposeField(const FiniteElementSpace& space, const TriangleMesh& mesh,
  const Field& v, const HodgeOptions& options, const Job& job = {});

} // namespace gridfem

#endif
