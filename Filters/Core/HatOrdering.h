// The order in which hat functions are relaxed.
#ifndef GridFEM_HatOrdering_h
#define GridFEM_HatOrdering_h

#include "Smoother.h"

namespace gridfem
{

/// Blocks of consecutive unknowns, coloured so that the matrix couples no two blocks of one colour:
/// a sweep over them is a Gauss-Seidel sweep whose result does not depend on threads. Unknowns that
/// are near should have near numbers.
PatchOrder OrderInBlocks(const SparseMatrix& A);

/// Groups of up to eight strongly coupled unknowns, in the same blocks and colours: those across
/// thin triangles, along which a Gauss-Seidel sweep leaves errors that no coarser grid can see.
/// Relaxed as groups, they are as easy as the others. Unknowns without a strong coupling are in
/// none. Strong: -a_ij > 0.3 sqrt(a_ii a_jj); right and equilateral triangles have at most 0.25.
PatchOrder GroupStronglyCoupled(const SparseMatrix& A, int threads = 0);

} // namespace gridfem

#endif
