// Requires lists of selections that VTK reads without a check.
#ifndef GridFEM_SelectionLists_h
#define GridFEM_SelectionLists_h

class vtkDataObject;
class vtkSelectionNode;

namespace gridfem
{

/// Throws InvalidInput for a node of points or cells if its list does not fit its kind or the
/// arrays of the data. No list, and an array that the data lacks, select nothing.
void RequireList(vtkSelectionNode* node, vtkDataObject* data);

} // namespace gridfem

#endif
