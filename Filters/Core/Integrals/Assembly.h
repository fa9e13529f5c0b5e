// Level matrices from element matrices, and the prolongation between levels.
#ifndef GridFEM_Assembly_h
#define GridFEM_Assembly_h

#include "Algebra/SparseMatrix.h"
#include "Base/Grouping.h"
#include "Integrals/ElementMatrices.h"

namespace gridfem
{

/// Where each function stands in the table of the patches: item 8 p + c is corner c of patch p.
using FunctionPlaces = Groups;
FunctionPlaces PlacesOfFunctions(const PatchLevel& level, int threads = 0);

/// The pattern of every matrix of a level, without values.
SparseMatrix BuildPattern(const PatchLevel& level, const FunctionPlaces& places, int threads = 0);

/// Gives a matrix of that pattern its values: the sum of combine(mass, stiffness) = a mass + b
/// stiffness. Either may be empty when its factor is 0. Same bits for any number of threads.
void AssembleValues(const PatchLevel& level, const FunctionPlaces& places,
  const Array<ElementMatrix>& mass, double a, const Array<ElementMatrix>& stiffness, double b,
  SparseMatrix& matrix, int threads = 0);

/// Rows = functions of `fine`, columns = functions of `coarse`: a coarse function written in fine
/// ones. Any patch of a fine function's support gives the same row [T (6.1)]; the first is used.
/// @param places  of the fine functions
SparseMatrix BuildProlongation(
  const PatchLevel& fine, const FunctionPlaces& places, const PatchLevel& coarse, int threads = 0);

} // namespace gridfem

#endif
