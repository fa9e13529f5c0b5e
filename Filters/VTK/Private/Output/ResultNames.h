// Names the results of a filter, so that no array of its input is lost.
#ifndef GridFEM_ResultNames_h
#define GridFEM_ResultNames_h

#include <string>

class vtkPolyData;

namespace gridfem
{

/// Puts a prefix before the names of all point and cell arrays that a filter has made. An array of
/// the input that a result would replace stays, as `name_input`. Normals that moved with the points
/// replace those of the input. Without effect on an output that has cells of its own.
void NameResults(vtkPolyData* input, const std::string& prefix, vtkPolyData* output);

} // namespace gridfem

#endif
