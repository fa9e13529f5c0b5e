// The order in which hat functions are relaxed.
#ifndef GridFEM_MatrixOrdering_h
#define GridFEM_MatrixOrdering_h

#include "Multigrid/Smoother.h"

namespace gridfem
{

/// Blocks of consecutive unknowns, coloured so that the matrix couples no two blocks of one colour:
/// a sweep over them is a Gauss-Seidel sweep whose result does not depend on threads. Unknowns that
/// are near should have near numbers.
PatchOrder OrderInBlocks(const SparseMatrix& A);

/// Groups of `size` coupled unknowns, grown from every unknown that is in none by the strongest
/// coupling -a_ij / sqrt(a_ii a_jj); fewer only where no positive coupling leads on. Across thin
/// triangles a Gauss-Seidel sweep leaves errors that no coarser grid can see; groups follow these
/// couplings, and solve for as many unknowns at once everywhere else. Groups overlap. Blocks of one
/// colour are not coupled. Cost O(entries of A), partly serial; same for any number of threads.
PatchOrder GroupByCoupling(const SparseMatrix& A, int threads = 0, int size = PatchKernelWidth);

} // namespace gridfem

#endif
