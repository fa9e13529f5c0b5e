#include "Input/SelectionCheck.h"

#include "Input/InputValidation.h"
#include "Input/SelectionLists.h"
#include "Pieces/GatheredSurface.h"
#include "Pieces/Ranks.h"

#include "Base/Errors.h"

#include "vtkDataObject.h"
#include "vtkDataSet.h"
#include "vtkInformation.h"
#include "vtkNew.h"
#include "vtkPolyData.h"
#include "vtkSelection.h"
#include "vtkSelectionNode.h"
#include "vtkSignedCharArray.h"
#include "vtkSmartPointer.h"

#include <string>
#include <vector>

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

/// Requires a kind of content that VTK has an operation for.
void RequireContent(vtkSelectionNode* node)
{
  if (!node->GetSelectionData()) // VTK 9.3 looks for colors in them
  {
    throw InvalidInput("The Selection has a node without data.");
  }
  const int content = node->GetContentType();
  const bool isKnown = content >= 0 && content < vtkSelectionNode::NUM_CONTENT_TYPES;
  const bool isQuery = content == vtkSelectionNode::QUERY;
  if (!isKnown || content == vtkSelectionNode::USER || (isQuery && !HasQueries))
  {
    throw InvalidInput("The Selection is of the kind " +
                       std::string(vtkSelectionNode::GetContentTypeAsString(content)) +
                       ", which cannot be evaluated here.");
  }
  if (isQuery)
  {
    RequireOneProcess("A Selection by a query");
    if (!node->GetQueryString())
    {
      throw InvalidInput("The Selection by a query has no query.");
    }
  }
}

/// VTK tells two values of this property apart in one place, and zero from others in another.
void RequireSwitch(vtkSelectionNode* node)
{
  const int value = node->GetProperties()->Get(vtkSelectionNode::CONTAINING_CELLS());
  if (value != 0 && value != 1)
  {
    throw InvalidInput("The property CONTAINING_CELLS of the Selection is " +
                       std::to_string(value) + ". It must be 0 or 1.");
  }
}

/// VTK adds one layer after the other, however many there are.
void RequireLayers(vtkSelectionNode* node, vtkDataObject* data)
{
  const int layers = node->GetProperties()->Get(vtkSelectionNode::CONNECTED_LAYERS());
  const vtkIdType cells = data->GetNumberOfElements(vtkDataObject::CELL);
  if (layers > cells)
  {
    throw InvalidInput("The Selection has " + std::to_string(layers) +
                       " layers of neighbors, but there are only " + std::to_string(cells) +
                       " cells.");
  }
}

/// Requires an expression that combines the nodes.
void RequireExpression(vtkSelection* selection)
{
  if (selection->GetExpression().empty())
  {
    return; // any node
  }
  vtkNew<vtkSignedCharArray> one;
  one->SetNumberOfTuples(1);
  one->Fill(0.0);
  const std::vector<vtkSignedCharArray*> nodes(selection->GetNumberOfNodes(), one.GetPointer());
  if (!selection->Evaluate(nodes.data(), selection->GetNumberOfNodes()))
  {
    throw InvalidInput("The Selection has the expression '" + selection->GetExpression() +
                       "', which cannot be evaluated.");
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

void RequireEvaluable(vtkSelection* selection, vtkDataObject* data)
{
  for (unsigned int k = 0; k < selection->GetNumberOfNodes(); ++k)
  {
    vtkSelectionNode* node = selection->GetNode(k);
    if (KindOf(node) != KindOf(selection->GetNode(0)))
    {
      throw InvalidInput("The Selection has both points and cells. Choose one of them.");
    }
    RequireContent(node);
    RequireSwitch(node);
    RequireLayers(node, data);
    RequireList(node, data);
  }
  RequireExpression(selection);
}

void RequireReadable(vtkDataObject* data)
{
  if (auto* surface = vtkPolyData::SafeDownCast(data))
  {
    RequireGoodCells(surface, "mesh");
    return;
  }
  RequireSoundCells(vtkDataSet::SafeDownCast(data));
}

bool IsReadable(vtkDataObject* data)
{
  try
  {
    RequireReadable(data);
    return true;
  }
  catch (const InvalidInput&)
  {
    return false;
  }
}

} // namespace gridfem
