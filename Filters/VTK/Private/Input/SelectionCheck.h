// Refuses selections that VTK cannot evaluate, or evaluates without a check of their lists.
#ifndef GridFEM_SelectionCheck_h
#define GridFEM_SelectionCheck_h

#include <string>

class vtkDataObject;
class vtkSelection;

namespace gridfem
{

/// Refuses a selection on several ranks, because each evaluates only its own data.
/// @param what  the beginning of the message
void RequireOneProcess(const std::string& what);

/// Throws InvalidInput for a selection that vtkExtractSelection cannot evaluate on the data. VTK
/// itself crashes on some of them, and takes wrong points or none for others.
void RequireEvaluable(vtkSelection* selection, vtkDataObject* data);

/// Throws InvalidInput for a data set with cells that VTK cannot read.
void RequireReadable(vtkDataObject* data);

/// Whether RequireReadable throws nothing.
bool IsReadable(vtkDataObject* data);

} // namespace gridfem

#endif
