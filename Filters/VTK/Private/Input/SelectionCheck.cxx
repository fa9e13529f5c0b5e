#include "Input/SelectionCheck.h"

#include "Pieces/Ranks.h"

#include "Base/Errors.h"

#include "vtkDoubleArray.h"
#include "vtkInformation.h"
#include "vtkSelection.h"
#include "vtkSelectionNode.h"

namespace gridfem
{
namespace
{

constexpr bool HasQueries = VTK_MODULE_ENABLE_ParaView_VTKExtensionsExtractionPython;

/// Returns whether the node selects points or cells: POINT or CELL.
int KindOf(vtkSelectionNode* node)
{
  const int kind = node->GetFieldType();
  if (kind != vtkSelectionNode::POINT && kind != vtkSelectionNode::CELL)
  {
    throw InvalidInput("The Selection must consist of points or of cells, but its kind is " +
                       std::string(vtkSelectionNode::GetFieldTypeAsString(kind)) + ".");
  }
  vtkInformation* properties = node->GetProperties();
  const bool takesCells = properties->Has(vtkSelectionNode::CONTAINING_CELLS()) &&
                          properties->Get(vtkSelectionNode::CONTAINING_CELLS());
  return takesCells ? static_cast<int>(vtkSelectionNode::CELL) : kind;
}

/// Requires the list that VTK reads without a check.
void RequireList(vtkSelectionNode* node)
{
  vtkAbstractArray* const list = node->GetSelectionList();
  const int content = node->GetContentType();
  const bool isByPlace = content == vtkSelectionNode::LOCATIONS;
  const bool isByNumbers =
    content == vtkSelectionNode::GLOBALIDS || content == vtkSelectionNode::PEDIGREEIDS ||
    content == vtkSelectionNode::VALUES || content == vtkSelectionNode::INDICES ||
    content == vtkSelectionNode::THRESHOLDS || content == vtkSelectionNode::BLOCKS;
  if (!list || !(isByPlace || isByNumbers))
  {
    return;
  }
  const int components = list->GetNumberOfComponents();
  const bool fits = isByPlace ? components == 3 : components == 1 || components == 2;
  if (!vtkDataArray::SafeDownCast(list) || !fits)
  {
    throw InvalidInput("The Selection of the kind " +
                       std::string(vtkSelectionNode::GetContentTypeAsString(content)) +
                       " needs a list of numbers with " +
                       (isByPlace ? "three components." : "one component, or two for a range."));
  }
}

} // namespace

void RequireOneProcess(const std::string& what)
{
  if (Ranks::AreSeveral())
  {
    throw InvalidInput(what + " works on one MPI rank only. Convert it to an array with Extract "
                              "Selection and Preserve Topology, and choose the array instead.");
  }
}

void RequireEvaluable(vtkSelection* selection)
{
  for (unsigned int k = 0; k < selection->GetNumberOfNodes(); ++k)
  {
    vtkSelectionNode* node = selection->GetNode(k);
    if (KindOf(node) != KindOf(selection->GetNode(0)))
    {
      throw InvalidInput("The Selection has both points and cells. Choose one of them.");
    }
    const int content = node->GetContentType();
    if (content == vtkSelectionNode::USER || (content == vtkSelectionNode::QUERY && !HasQueries))
    {
      throw InvalidInput("The Selection is of the kind " +
                         std::string(vtkSelectionNode::GetContentTypeAsString(content)) +
                         ", which cannot be evaluated here.");
    }
    if (content == vtkSelectionNode::QUERY)
    {
      RequireOneProcess("A Selection by a query");
    }
    RequireList(node);
    vtkAbstractArray* list = node->GetSelectionList();
    constexpr vtkIdType FrustumNumbers = 8 * 4; // corners, homogeneous
    if (content == vtkSelectionNode::FRUSTUM &&
        !(vtkDoubleArray::SafeDownCast(list) && list->GetNumberOfValues() == FrustumNumbers))
    {
      throw InvalidInput("A Selection by a frustum needs the eight corners of the frustum.");
    }
  }
}

} // namespace gridfem
