// Writes paths along a surface as lines.
#ifndef GridFEM_PathOutput_h
#define GridFEM_PathOutput_h

#include "Input/InputMesh.h"
#include "Solvers/PathSolver.h"

class vtkPolyData;

namespace gridfem
{

/// Writes a polyline for each path, with the arrays that vtkGeodesicPaths describes, and the point
/// arrays of the input along the paths. Real numbers and colors are linear in every triangle. Other
/// values are those of the nearest corner. Throws InvalidInput naming an array of wrong length.
void WritePaths(const std::vector<PathSolver::Path>& paths, const InputMesh& mesh,
  vtkPolyData* input, vtkPolyData* output);

/// Returns, for each cell, the number of the first path through it, or -1.
std::vector<Id> FirstPathThroughCells(
  const std::vector<PathSolver::Path>& paths, const InputMesh& mesh, Id cells);

} // namespace gridfem

#endif
