// From a mesh and values at its points to a solution at its points, as accurate as a default solve:
// ours beside algebraic multigrid on hat functions.
#ifndef GridFEM_Benchmarks_AccuracyPeers_h
#define GridFEM_Benchmarks_AccuracyPeers_h

#include "Grid/TriangleMesh.h"

namespace gridfem::benchmarks
{

/// Solves λ u - Δu = λ f, λ = 100 / area, on the grid of `depth` with `Accuracy` 0.1. The peers are
/// conjugate gradients with BoomerAMG and with GAMG, with the fewest iterations that give the same
/// accuracy. Errors are in the mean square over the points, against a grid two levels finer. Prints
/// a table and the ratio to the faster peer. MessagePassing must be up.
/// @param f  a column: values at the points
void ComparePeers(const char* name, const TriangleMesh& mesh, int depth, const MultiVector& f);

} // namespace gridfem::benchmarks

#endif
