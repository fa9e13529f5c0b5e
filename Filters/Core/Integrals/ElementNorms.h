// Computes integrals of squares from the element matrices of a level.
#ifndef GridFEM_ElementNorms_h
#define GridFEM_ElementNorms_h

#include "Algebra/ColumnAlgebra.h"
#include "Integrals/ElementMatrices.h"

namespace gridfem
{

/// Returns the sum over the patches of uᵀ mass u, for every column of u (rows = functions of the
/// level). Cost O(patches x columns); same bits for any number of threads.
Columns SquaredNorms(
  const PatchLevel& level, const Array<ElementMatrix>& mass, const MultiVector& u, int threads = 0);

} // namespace gridfem

#endif
