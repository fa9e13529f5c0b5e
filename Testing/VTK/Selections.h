// Selections in the form that ParaView makes them.
#ifndef GridFEM_Testing_Selections_h
#define GridFEM_Testing_Selections_h

#include "vtkIdTypeArray.h"
#include "vtkSelection.h"
#include "vtkSelectionNode.h"
#include "vtkSmartPointer.h"

#include <vector>

namespace gridfem::testing
{

inline vtkSmartPointer<vtkSelectionNode> NodeOf(int kind, int content, vtkAbstractArray* list)
{
  auto node = vtkSmartPointer<vtkSelectionNode>::New();
  node->SetFieldType(kind);
  node->SetContentType(content);
  node->SetSelectionList(list);
  return node;
}

inline vtkSmartPointer<vtkSelection> SelectionOf(vtkSelectionNode* node)
{
  auto selection = vtkSmartPointer<vtkSelection>::New();
  if (node)
  {
    selection->AddNode(node);
  }
  return selection;
}

inline vtkSmartPointer<vtkIdTypeArray> IdArray(const std::vector<vtkIdType>& ids)
{
  auto array = vtkSmartPointer<vtkIdTypeArray>::New();
  for (const vtkIdType id : ids)
  {
    array->InsertNextValue(id);
  }
  return array;
}

/// @param kind  vtkSelectionNode::POINT or CELL
inline vtkSmartPointer<vtkSelection> SelectIds(int kind, const std::vector<vtkIdType>& ids)
{
  return SelectionOf(NodeOf(kind, vtkSelectionNode::INDICES, IdArray(ids)));
}

inline vtkSmartPointer<vtkSelection> SelectPoints(const std::vector<vtkIdType>& ids)
{
  return SelectIds(vtkSelectionNode::POINT, ids);
}

} // namespace gridfem::testing

#endif
