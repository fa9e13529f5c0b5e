// Between the hat functions of a mesh and the finest functions of a grid. [T §4.2]
#ifndef GridFEM_HatTransfer_h
#define GridFEM_HatTransfer_h

#include "Algebra/SparseMatrix.h"
#include "Grid/GridFunctions.h"
#include "Spaces/HatFunctions.h"

namespace gridfem
{

/// How a hat gets its value from the grid. On meshes finer than the grid the two need the same
/// iterations. On a much coarser mesh a residual at a point becomes a load on single grid functions
/// under Evaluation, whose answer peaks like a logarithm of the ratio: repeated cycles slow down
/// and conjugate gradients need one or two iterations more; PseudoEvaluation does not notice.
enum class HatTransfer
{
  /// The values of the grid functions at the hats' points. Where sheets of the surface meet in a
  /// point and have functions of their own there, their mean, weighted with area. Eight entries per
  /// row, but for such points.
  Evaluation = 0,
  /// Rᵀ with the pseudo-evaluation matrix R = E_fᵀ M_f P M_c⁻¹: the mean of a grid function,
  /// weighted with the hat, taken at the points of the clipped mesh.
  PseudoEvaluation = 1
};

/// Grid coefficients to hat coefficients: rows = hats, columns = finest functions of the grid; its
/// transpose takes hat residuals to the grid. Each row sums to 1, so constants stay constant; rows
/// of hats that no piece reaches are empty. `mesh` is what both were made from; throws InvalidInput
/// when it is not. Cost O(pieces); same bits for any number of threads.
SparseMatrix BuildHatProlongation(const HatFunctions& hats, const GridFunctions& space,
  const TriangleMesh& mesh, HatTransfer transfer, int threads = 0);

/// What such a prolongation is made of: rows of weights, which are yet to be divided by their sums,
/// so that processes that have pieces around the same point may add up theirs.
/// @param isBare  per hat: no process has pieces with an area there, and the functions in the best
///                patch at its point are taken; may be empty
SparseMatrix BuildHatWeights(const HatFunctions& hats, const GridFunctions& space,
  const TriangleMesh& mesh, HatTransfer transfer, const std::vector<char>& isBare, int threads = 0);

/// Of sums of rows: which of them have no weight.
std::vector<char> BareRows(const MultiVector& sum);

} // namespace gridfem

#endif
