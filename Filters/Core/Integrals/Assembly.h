// Assembles the matrices of a level from its element matrices, and the prolongation between levels.
#ifndef GridFEM_Assembly_h
#define GridFEM_Assembly_h

#include "Algebra/SparseMatrix.h"
#include "Base/Grouping.h"
#include "Integrals/ElementMatrices.h"

namespace gridfem
{

/// The places of each function in the table of patches. Item n p + c is function c of patch p, with
/// n functions per patch.
using FunctionPlaces = Groups;
template<int Functions>
FunctionPlaces PlacesOfFunctions(const BasicPatchLevel<Functions>& level, int threads = 0);

/// Returns the pattern of every matrix of a level, without values.
template<int Functions>
SparseMatrix BuildPattern(
  const BasicPatchLevel<Functions>& level, const FunctionPlaces& places, int threads = 0);

/// Computes the values of a matrix with this pattern: a mass + b stiffness, summed over the
/// patches. Either array may be empty if its factor is 0. Same bits for any number of threads.
template<int Functions>
void AssembleValues(const BasicPatchLevel<Functions>& level, const FunctionPlaces& places,
  const Array<BasicElementMatrix<Functions>>& mass, double a,
  const Array<BasicElementMatrix<Functions>>& stiffness, double b, SparseMatrix& matrix,
  int threads = 0);

/// Returns the matrix that expresses coarse functions by fine functions: rows = functions of
/// `fine`, columns = functions of `coarse`. Every patch in a fine function's support gives the same
/// row [T (6.1)]; the first one is used.
/// @param places  places of the fine functions
template<int Functions>
SparseMatrix BuildProlongation(const BasicPatchLevel<Functions>& fine, const FunctionPlaces& places,
  const BasicPatchLevel<Functions>& coarse, int threads = 0);

} // namespace gridfem

#endif
