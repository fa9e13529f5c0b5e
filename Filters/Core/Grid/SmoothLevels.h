// The quadratic B-splines of a grid: once continuously differentiable functions on the same patches
// as the trilinear ones. [T §7.2]
#ifndef GridFEM_SmoothLevels_h
#define GridFEM_SmoothLevels_h

#include "Base/Job.h"
#include "Grid/GridFunctions.h"

#include <vector>

namespace gridfem
{

/// Numbers the quadratic functions of every level of a grid. The function of a cell has the cell
/// and the 26 cells around it as its support, where its value is the product of one quadratic
/// B-spline per axis. Function k of a patch belongs to the cell at the offset
/// (k % 3 - 1, k / 3 % 3 - 1, k / 9 - 1) from the patch's cell. This cell may lie outside the grid.
/// As for trilinear functions, each connected component of a support has a function of its own, and
/// the plain space has one function per support. Cells, parents and patches are the same as in the
/// grid. Functions are numbered in the order of their first patch. Throws InvalidInput when there
/// are too many, and Aborted. The result is the same for any number of threads.
std::vector<SmoothLevel> BuildSmoothLevels(const GridFunctions& grid, const Job& job = {});

} // namespace gridfem

#endif
