// Transfer between the hat functions of a mesh and the finest functions of a grid. [T §4.2]
#ifndef GridFEM_HatTransfer_h
#define GridFEM_HatTransfer_h

#include "Algebra/SparseMatrix.h"
#include "Grid/GridFunctions.h"
#include "Spaces/HatFunctions.h"

namespace gridfem
{

/// How a hat gets its value from the grid. On meshes finer than the grid, both ways need the same
/// number of iterations. On a much coarser mesh, Evaluation turns a residual at a point into a load
/// on single grid functions. The response peaks like the logarithm of the ratio of both sizes.
/// Repeated cycles then slow down, and conjugate gradients need one or two more iterations.
/// PseudoEvaluation is not affected.
enum class HatTransfer
{
  /// Takes the values of the grid functions at the hats' points. Sheets that meet in a point may
  /// have different functions there; the hat then takes their area-weighted mean. A row has eight
  /// entries, except at such points.
  Evaluation = 0,
  /// Uses Rᵀ with the pseudo-evaluation matrix R = E_fᵀ M_f P M_c⁻¹. It takes the mean of a grid
  /// function, weighted with the hat, over the points of the clipped mesh.
  PseudoEvaluation = 1
};

/// Returns the matrix from grid coefficients to hat coefficients: rows = hats, columns = finest
/// functions of the grid. Its transpose takes hat residuals to the grid. Each row sums to 1, so
/// constants remain constant. Rows of hats that no piece reaches are empty. Cost O(pieces); same
/// bits for any number of threads.
/// @param mesh  the mesh that both were made from; otherwise throws InvalidInput
SparseMatrix BuildHatProlongation(const HatFunctions& hats, const GridFunctions& space,
  const TriangleMesh& mesh, HatTransfer transfer, int threads = 0);

/// Returns the weights of such a prolongation, before each row is divided by its sum. Processes
/// that have pieces around the same point can therefore add up their weights first.
/// @param isBare  for each hat, whether no process has pieces with area there; the hat then takes
///   the functions in the best patch at its point. May be empty
SparseMatrix BuildHatWeights(const HatFunctions& hats, const GridFunctions& space,
  const TriangleMesh& mesh, HatTransfer transfer, const std::vector<char>& isBare, int threads = 0);

/// Returns which rows have no weight, given the sums of rows.
std::vector<char> BareRows(const MultiVector& sum);

} // namespace gridfem

#endif
