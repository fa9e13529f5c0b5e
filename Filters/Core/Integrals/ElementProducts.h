// Multiplies a level's matrix by vectors, using its element matrices. The weight of an element can
// then change without a new matrix.
#ifndef GridFEM_ElementProducts_h
#define GridFEM_ElementProducts_h

#include "Integrals/Assembly.h"

namespace gridfem
{

/// Returns the sum over the patches of scale * matrix * u. Cost O(patches x columns); same bits for
/// any number of threads.
/// @param places  places of the level's functions
/// @param scale   one number per patch; empty: 1
/// @param u       rows = functions of the level; the result has its size
/// Throws InvalidInput when a number of rows does not fit.
MultiVector MultiplyElements(const PatchLevel& level, const FunctionPlaces& places,
  const Array<ElementMatrix>& matrices, const std::vector<double>& scale, const MultiVector& u,
  int threads = 0);

} // namespace gridfem

#endif
