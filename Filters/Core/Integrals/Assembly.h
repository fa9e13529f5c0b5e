// Assembles the matrices of a level from its element matrices, and the prolongation between levels.
#ifndef GridFEM_Assembly_h
#define GridFEM_Assembly_h

#include "Algebra/SparseMatrix.h"
#include "Base/Grouping.h"
#include "Integrals/ElementMatrices.h"

namespace gridfem
{

/// The places of each function in the table of patches. Item 8 p + c is corner c of patch p.
using FunctionPlaces = Groups;
FunctionPlaces PlacesOfFunctions(const PatchLevel& level, int threads = 0);

/// Returns the pattern of every matrix of a level, without values.
SparseMatrix BuildPattern(const PatchLevel& level, const FunctionPlaces& places, int threads = 0);

/// Computes the values of a matrix with this pattern: a mass + b stiffness, summed over the
/// patches. Either array may be empty if its factor is 0. Same bits for any number of threads.
void AssembleValues(const PatchLevel& level, const FunctionPlaces& places,
  const Array<ElementMatrix>& mass, double a, const Array<ElementMatrix>& stiffness, double b,
  SparseMatrix& matrix, int threads = 0);

/// Returns the matrix that expresses coarse functions by fine functions: rows = functions of
/// `fine`, columns = functions of `coarse`. Every patch in a fine function's support gives the same
/// row [T (6.1)]; the first one is used.
/// @param places  places of the fine functions
SparseMatrix BuildProlongation(
  const PatchLevel& fine, const FunctionPlaces& places, const PatchLevel& coarse, int threads = 0);

} // namespace gridfem

#endif
