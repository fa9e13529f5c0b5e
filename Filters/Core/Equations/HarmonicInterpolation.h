// The smoothest function on a surface with given values at some of its points.
#ifndef GridFEM_HarmonicInterpolation_h
#define GridFEM_HarmonicInterpolation_h

#include "Equations/PointConstraints.h"
#include "Spaces/FiniteElementSpace.h"

namespace gridfem
{

enum class Smoothness
{
  Harmonic,  // the least ∫ |∇u|²: never beyond the values, with peaks at isolated points
  Biharmonic // the least ∫ |Δu|²: smooth at the points, may overshoot
};

struct InterpolationOptions
{
  Smoothness smoothness = Smoothness::Harmonic;
  ConstraintOptions constraints; // of harmonic functions
  MultigridOptions multigrid;
  SolveOptions solve;
  /// Biharmonic functions of up to this many points are found directly, with one solve and one
  /// vector per point. More points are solved by iteration (BiharmonicIteration.h).
  Id mostAtOnce = 256;
};

/// Interpolates values at points. The result is NaN on components without a point. Errors are
/// estimated, except for biharmonic functions of many points.
/// Biharmonic: u = G μ + c with the Green's function G = L⁺ M L⁺ of the points, c constant on each
/// connected component. The multipliers μ solve (C G Cᵀ) μ + c = g, Σ μ = 0. Contradictory values
/// are met in the mean. For many points see IterateBiharmonic.
/// @param rows    RowsAtPoints of the points, or HoldPointsAndEdges for harmonic functions
/// @param values  a row for each of them, one column per component
/// Throws InvalidInput when there is no point or shapes do not fit, and Aborted. Same bits for any
/// number of threads.
ConstrainedSolution InterpolateHarmonically(const FiniteElementSpace& space, const HeldRows& rows,
  const MultiVector& values, const InterpolationOptions& options, const Progress& progress = {});

} // namespace gridfem

#endif
