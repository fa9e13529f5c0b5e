// The order in which a smoother relaxes hat functions.
#ifndef GridFEM_MatrixOrdering_h
#define GridFEM_MatrixOrdering_h

#include "Multigrid/Smoother.h"

namespace gridfem
{

/// Blocks of consecutive unknowns, colored so that the matrix couples no two blocks of one color. A
/// sweep over them is a Gauss-Seidel sweep whose result does not depend on threads. Neighboring
/// unknowns should have close numbers.
PatchOrder OrderInBlocks(const SparseMatrix& A);

/// Groups of `size` coupled unknowns. Each grows from an unknown that is in no group yet, by the
/// strongest coupling -a_ij / sqrt(a_ii a_jj). A group is smaller only where no positive coupling
/// leads on.
/// Across thin triangles a Gauss-Seidel sweep leaves errors that no coarser grid can see. Groups
/// follow the strong couplings there, and solve for as many unknowns at once everywhere else.
/// Groups overlap. Blocks of one color are not coupled. Cost O(entries of A), partly serial; same
/// for any number of threads.
PatchOrder GroupByCoupling(const SparseMatrix& A, int threads = 0, int size = PatchKernelWidth);

} // namespace gridfem

#endif
