// Level matrices from element matrices, and the prolongation between levels.
#ifndef GridFEM_Assembly_h
#define GridFEM_Assembly_h

#include "ElementMatrices.h"
#include "SparseMatrix.h"

namespace gridfem
{

/// Patches that touch each function: patches of f are patch[begin[f] .. begin[f + 1]), ascending;
/// corner gives the function's place in the patch.
struct FunctionPatches
{
  std::vector<Id> begin;
  std::vector<Id> patch;
  std::vector<std::uint8_t> corner;
};
FunctionPatches PatchesOfFunctions(const Level& level);

/// The pattern of every matrix of a level, values zero.
SparseMatrix BuildPattern(const Level& level, const FunctionPatches& patches, int threads = 0);

/// Fills a matrix of that pattern with the sum of combine(mass, stiffness) = a mass + b stiffness.
/// Either may be empty when its factor is 0. Same bits for any number of threads.
void AssembleValues(const Level& level, const FunctionPatches& patches,
  const std::vector<ElementMatrix>& mass, double a, const std::vector<ElementMatrix>& stiffness,
  double b, SparseMatrix& matrix, int threads = 0);

/// Rows = functions of `fine`, columns = functions of `coarse`: a coarse function written in fine
/// ones. Any patch of a fine function's support gives the same row [T (6.1)]; the first is used.
SparseMatrix BuildProlongation(const Level& fine, const Level& coarse, int threads = 0);

} // namespace gridfem

#endif
