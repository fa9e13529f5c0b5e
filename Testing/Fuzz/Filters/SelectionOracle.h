// Finds selected points without VTK's selectors.
#ifndef GridFEM_Testing_SelectionOracle_h
#define GridFEM_Testing_SelectionOracle_h

#include "DamagedInput.h"

class vtkPolyData;
class vtkSelection;

namespace gridfem::testing
{

/// Returns values that the integer type holds: without fractions, and others as zero.
std::vector<double> IntegersIn(int type, const std::vector<double>& values);

/// Requires the points that the selection takes, by the meaning of its kinds. Selections with an
/// expression, layers, or cells at places are not followed: only the number of values is required.
/// @param block     the flat index of the surface in its blocks; -1 without blocks
/// @param selected  a flag for each point
void RequireSelected(vtkSelection* selection, vtkPolyData* surface, int block,
  const std::vector<double>& selected, DamagedCase& outcome);

} // namespace gridfem::testing

#endif
