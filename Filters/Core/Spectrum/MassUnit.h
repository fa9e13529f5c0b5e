// The size of the mass of a space in a metric. Eigenproblems divide by it, because their iterations
// and their single precision need masses of the usual size.
#ifndef GridFEM_MassUnit_h
#define GridFEM_MassUnit_h

#include "Spectrum/Spectrum.h"

namespace gridfem
{

/// A power of four near the area in the metric over the area of the mesh; 1 if both are nearly the
/// same. Division by it rounds nothing. It is 1 if processes divide all levels, because they know
/// no metric.
double MassUnit(const SpaceLevels& space, int threads);

void DivideBy(double unit, SparseMatrix& mass);

/// Converts a spectrum of the problem with the mass M / from to the mass M / to.
void ConvertUnit(double from, double to, Spectrum& spectrum);

/// Whether a metric stretches the surface so much that its box does not determine its lowest value.
/// @param mass  of the finest level
bool IsStretched(const SpaceLevels& space, const SparseMatrix& mass, int threads);

/// The lowest value above 0 of L x = θ M / unit x on the coarsest level. It is 0 if that level is
/// too large for a dense solve, or has only constants.
double LowestOnCoarsest(const SpaceLevels& space, double unit, int threads);

} // namespace gridfem

#endif
