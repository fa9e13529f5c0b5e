// Random right-hand sides whose covariance is a matrix of the space, such as white noise.
#ifndef GridFEM_RandomLoads_h
#define GridFEM_RandomLoads_h

#include "Spaces/FiniteElementSpace.h"

#include <cstdint>

namespace gridfem
{

/// Returns normal vectors with mean 0 and covariance a M + b L: rows = functions, one column for
/// each of the samples `first` .. `first` + `count` - 1. With a = 1 and b = 0 they are the
/// integrals of white noise against the functions.
///
/// The matrix is the sum of element matrices F Fᵀ, so the sum of F z over the elements has exactly
/// this covariance for independent normal numbers z. No factor of the whole matrix is needed. A
/// sample depends only on its number, on the seed and on the functions, up to rounding not on the
/// order of the mesh. Same bits for any number of
/// threads. Throws InvalidInput for hats in another metric than the mesh's, and Aborted.
/// @param a, b  0 or more
MultiVector RandomLoads(const FiniteElementSpace& space, double a, double b, std::uint64_t seed,
  Id first, Id count, const Job& job = {});

} // namespace gridfem

#endif
