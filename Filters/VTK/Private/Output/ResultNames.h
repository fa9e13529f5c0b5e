// Names the results of a filter, so that no array of its input is lost.
#ifndef GridFEM_ResultNames_h
#define GridFEM_ResultNames_h

#include <string>

class vtkPolyData;

namespace gridfem
{

/// Puts a prefix before the names of all point and cell arrays that a filter has made. An array of
/// the input that a result would replace stays, as `name_input`. Normals that moved with the points
/// replace the normals of the input. An output with cells of its own stays as it is.
void NameResults(vtkPolyData* input, const std::string& prefix, vtkPolyData* output);

} // namespace gridfem

#endif
