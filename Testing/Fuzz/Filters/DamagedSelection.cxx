// Makes selections at random, damages them, and asks a filter for the selected points.
#include "DamagedInput.h"
#include "SelectionOracle.h"

#include "FilterSupport.h"

#include "vtkIdTypeArray.h"
#include "vtkInformation.h"
#include "vtkIntArray.h"
#include "vtkMultiBlockDataSet.h"
#include "vtkSelection.h"
#include "vtkSelectionNode.h"
#include "vtkStringArray.h"
#include "vtkSurfaceDetail.h"
#include "vtkUnsignedIntArray.h"

#include <iostream>
#include <limits>

namespace gridfem::testing
{
namespace
{

using Node = vtkSelectionNode;

/// A surface with arrays that selections compare: f, v, label, and global ids.
vtkSmartPointer<vtkPolyData> Surface(const TriangleMesh& mesh)
{
  auto surface = ToPolyData(mesh);
  for (vtkDataSetAttributes* attributes :
    { static_cast<vtkDataSetAttributes*>(surface->GetPointData()),
      static_cast<vtkDataSetAttributes*>(surface->GetCellData()) })
  {
    const vtkIdType count = attributes == surface->GetPointData() ? surface->GetNumberOfPoints()
                                                                  : surface->GetNumberOfCells();
    vtkNew<vtkDoubleArray> vectors;
    vectors->SetName("v");
    vectors->SetNumberOfComponents(3);
    vtkNew<vtkIntArray> labels;
    labels->SetName("label");
    vtkNew<vtkIdTypeArray> ids;
    ids->SetName("ids");
    for (vtkIdType k = 0; k < count; ++k)
    {
      vectors->InsertNextTuple3(0.1 * double(k), -1.0, std::sin(double(k)));
      labels->InsertNextValue(static_cast<int>(k % 5));
      ids->InsertNextValue(1000 - 2 * k);
    }
    attributes->AddArray(vectors);
    attributes->AddArray(labels);
    attributes->SetGlobalIds(ids);
  }
  return surface;
}

vtkSmartPointer<vtkDataObject> SurfaceOrBlocks(bool hasBlocks)
{
  if (!hasBlocks)
  {
    return Surface(GeodesicSphere(3));
  }
  auto blocks = vtkSmartPointer<vtkMultiBlockDataSet>::New();
  blocks->SetBlock(0, Surface(GeodesicSphere(2)));
  blocks->SetBlock(1, Surface(FlatRectangle(4, 3)));
  return blocks;
}

/// A filter that is kept, because its surface does not change.
struct Detail
{
  explicit Detail(bool hasBlocks)
  {
    filter->SetInputDataObject(0, SurfaceOrBlocks(hasBlocks));
    filter->SetDepth(2);
    filter->SetTransitionWidth(0.0);
    filter->SetNumberOfThreads(1);
  }

  vtkNew<vtkSurfaceDetail> filter;
  Messages messages{ filter };
};

Detail& DetailOf(bool hasBlocks)
{
  static Detail ofSurface(false);
  static Detail ofBlocks(true);
  return hasBlocks ? ofBlocks : ofSurface;
}

vtkSmartPointer<vtkDataArray> ListOf(
  int type, const char* name, int components, const std::vector<double>& numbers)
{
  auto list = vtkSmartPointer<vtkDataArray>::Take(vtkDataArray::CreateDataArray(type));
  list->SetName(name);
  list->SetNumberOfComponents(components);
  list->SetNumberOfTuples(static_cast<vtkIdType>(numbers.size()) / components);
  for (vtkIdType k = 0; k < list->GetNumberOfTuples() * components; ++k)
  {
    list->SetComponent(k / components, static_cast<int>(k % components), numbers[k]);
  }
  return list;
}

std::vector<double> SomeIntegers(Choice& choice, Id largest, Id step)
{
  std::vector<double> numbers;
  for (Id k = choice.Integer(1, 6); k > 0; --k)
  {
    numbers.push_back(double(step * choice.Integer(0, largest)));
  }
  return numbers;
}

std::vector<double> SomeReals(Choice& choice, Id count, double largest)
{
  std::vector<double> numbers;
  for (Id k = 0; k < count; ++k)
  {
    numbers.push_back(choice.Real(-largest, largest));
  }
  return numbers;
}

/// Returns the corners of a frustum that is a box: x and y between random bounds.
vtkSmartPointer<vtkDataArray> Box(Choice& choice)
{
  const double low[] = { choice.Real(-1.1, 0.0), choice.Real(-1.1, 0.0) };
  const double high[] = { choice.Real(0.1, 1.1), choice.Real(0.1, 1.1) };
  std::vector<double> corners;
  for (const double x : { low[0], high[0] })
  {
    for (const double y : { low[1], high[1] })
    {
      for (const double z : { 10.0, -10.0 })
      {
        corners.insert(corners.end(), { x, y, z, 1.0 });
      }
    }
  }
  return ListOf(VTK_DOUBLE, "corners", 4, corners);
}

vtkSmartPointer<vtkDataArray> GoodList(Choice& choice, int content, Node* node)
{
  switch (content)
  {
    case Node::GLOBALIDS:
    case Node::PEDIGREEIDS:
      return ListOf(VTK_ID_TYPE, "ids", 1, SomeIntegers(choice, 600, 2));
    case Node::VALUES:
      return ListOf(VTK_INT, "label", 1, SomeIntegers(choice, 7, 1));
    case Node::INDICES:
      return ListOf(VTK_ID_TYPE, "ids", 1, SomeIntegers(choice, 100, 1));
    case Node::FRUSTUM:
      return Box(choice);
    case Node::LOCATIONS:
      node->GetProperties()->Set(Node::EPSILON(), choice.Real(0.0, 0.5));
      return ListOf(VTK_DOUBLE, "places", 3, SomeReals(choice, 3 * choice.Integer(1, 4), 1.0));
    case Node::BLOCKS:
      return ListOf(VTK_UNSIGNED_INT, "blocks", 1, SomeIntegers(choice, 4, 1));
    default:
      node->GetProperties()->Set(Node::COMPONENT_NUMBER(), static_cast<int>(choice.Integer(0, 2)));
      return ListOf(VTK_DOUBLE, "v", choice.Of({ 1, 2 }), SomeReals(choice, 4, 3.0));
  }
}

/// Replaces the list of a node, or changes its numbers.
void DamageList(Choice& choice, Node* node, DamagedCase& outcome)
{
  auto* list = vtkDataArray::SafeDownCast(node->GetSelectionList());
  switch (choice.Integer(0, 5))
  {
    case 0:
      outcome.description += ", no list";
      node->SetSelectionList(nullptr);
      break;
    case 1:
    {
      outcome.description += ", a list of texts";
      vtkNew<vtkStringArray> texts;
      texts->InsertNextValue("//f");
      texts->InsertNextValue("");
      texts->SetName(choice.OneIn(2) ? "f" : nullptr);
      node->SetSelectionList(texts);
      break;
    }
    case 2:
    {
      const int type = choice.Of({ VTK_FLOAT, VTK_DOUBLE, VTK_BIT, VTK_CHAR, VTK_INT,
        VTK_UNSIGNED_INT, VTK_LONG_LONG, VTK_UNSIGNED_LONG_LONG, VTK_ID_TYPE });
      outcome.description += ", a list of the type " + std::to_string(type);
      node->SetSelectionList(ListOf(type, choice.Of({ "v", "label", "ids", "x", "" }),
        static_cast<int>(choice.Integer(1, 4)), SomeIntegers(choice, 100, 1)));
      break;
    }
    default:
    {
      outcome.description += ", ";
      vtkNew<vtkDoubleArray> numbers; // holds any value
      if (list)
      {
        numbers->DeepCopy(list);
      }
      numbers->SetName(list && list->GetName() ? list->GetName() : "v");
      DamageArray(choice, numbers, outcome);
      const std::vector<double> values = Values(numbers);
      const int type = list && !choice.OneIn(4) ? list->GetDataType() : VTK_DOUBLE;
      node->SetSelectionList(
        type == VTK_DOUBLE
          ? ListOf(type, numbers->GetName(), numbers->GetNumberOfComponents(), values)
          : ListOf(type, numbers->GetName(), numbers->GetNumberOfComponents(),
              IntegersIn(type, values)));
    }
  }
}

void DamageProperty(Choice& choice, Node* node, DamagedCase& outcome)
{
  struct Property
  {
    const char* name;
    vtkInformationIntegerKey* key;
  };
  const auto property = choice.Of<Property>({ { "CONTENT_TYPE", Node::CONTENT_TYPE() },
    { "FIELD_TYPE", Node::FIELD_TYPE() }, { "CONTAINING_CELLS", Node::CONTAINING_CELLS() },
    { "COMPONENT_NUMBER", Node::COMPONENT_NUMBER() },
    { "COMPOSITE_INDEX", Node::COMPOSITE_INDEX() }, { "PROCESS_ID", Node::PROCESS_ID() },
    { "INVERSE", Node::INVERSE() }, { "CONNECTED_LAYERS", Node::CONNECTED_LAYERS() },
    { "HIERARCHICAL_LEVEL", Node::HIERARCHICAL_LEVEL() } });
  const int value = choice.Of({ -1, 0, 1, 2, 3, 5, 8, 9, 10, 11, 12, -7, 1000,
    std::numeric_limits<int>::max(), std::numeric_limits<int>::min() });
  outcome.description += std::string(", ") + property.name + " " + std::to_string(value);
  node->GetProperties()->Set(property.key, value);
  if (choice.OneIn(4))
  {
    const double radius = choice.Of({ -1.0, std::nan(""), double(INFINITY), 1e300, 0.0 });
    outcome.description += ", EPSILON " + std::to_string(radius);
    node->GetProperties()->Set(Node::EPSILON(), radius);
  }
}

void DamageNode(Choice& choice, Node* node, DamagedCase& outcome)
{
  if (choice.OneIn(20))
  {
    outcome.description += ", no data";
    node->SetSelectionData(nullptr);
  }
  else if (choice.OneIn(3))
  {
    DamageProperty(choice, node, outcome);
  }
  else
  {
    DamageList(choice, node, outcome);
  }
}

vtkSmartPointer<Node> AnyNode(Choice& choice, int kind, bool hasBlocks, DamagedCase& outcome)
{
  auto node = vtkSmartPointer<Node>::New();
  const int contents[] = { Node::INDICES, Node::GLOBALIDS, Node::PEDIGREEIDS, Node::VALUES,
    Node::FRUSTUM, Node::LOCATIONS, Node::THRESHOLDS, Node::BLOCKS };
  const int content = contents[choice.Integer(0, hasBlocks ? 7 : 6)];
  node->SetContentType(content);
  node->SetFieldType(kind);
  node->SetSelectionList(GoodList(choice, content, node));
  if (hasBlocks && choice.OneIn(3))
  {
    node->GetProperties()->Set(Node::COMPOSITE_INDEX(), static_cast<int>(choice.Integer(0, 3)));
  }
  if (choice.OneIn(4))
  {
    node->GetProperties()->Set(Node::INVERSE(), 1);
  }
  outcome.description += std::string(", ") + Node::GetContentTypeAsString(content);
  return node;
}

vtkSmartPointer<vtkSelection> AnySelection(
  Choice& choice, bool hasBlocks, bool& isWhole, DamagedCase& outcome)
{
  auto selection = vtkSmartPointer<vtkSelection>::New();
  const int kind = choice.Of<int>({ Node::POINT, Node::POINT, Node::CELL });
  for (Id k = choice.Of<Id>({ 1, 1, 1, 2, 3 }); k > 0; --k)
  {
    const auto node = AnyNode(choice, kind, hasBlocks, outcome);
    for (Id damage = choice.Of<Id>({ 0, 1, 1, 2 }); damage > 0; --damage)
    {
      isWhole = false;
      DamageNode(choice, node, outcome);
    }
    selection->SetNode(std::string(1, static_cast<char>('A' + k)), node);
  }
  if (choice.OneIn(8))
  {
    isWhole = false;
    selection->SetExpression(choice.Of({ "B", "!B", "B&C", "(B|C)&!D", "Z", "(", "B)", "&", "!",
      "B&", "((B)", "!(B|", " ", "B C", "|&!()" }));
    outcome.description += ", expression '" + selection->GetExpression() + "'";
  }
  return selection;
}

/// Runs the filter. Each surface gives one message, or each gives a result.
bool TakesSelection(Detail& detail, std::size_t surfaces, DamagedCase& outcome)
{
  std::cerr << outcome.description << ' ' << std::flush; // a crash shows it
  std::vector<std::string>& errors = detail.messages.errors;
  errors.clear();
  detail.filter->Modified();
  detail.filter->GetExecutive()->Update();
  if (errors.empty())
  {
    return true;
  }
  outcome.refusal = errors.front();
  outcome.Require(errors.size() == surfaces, std::to_string(errors.size()) + " messages");
  return false;
}

} // namespace

void SelectByDamagedNodes(Choice& choice, DamagedCase& outcome)
{
  const bool hasBlocks = choice.OneIn(3);
  outcome.description += hasBlocks ? "blocks" : "surface";
  bool isWhole = true;
  const auto selection = AnySelection(choice, hasBlocks, isWhole, outcome);
  Detail& detail = DetailOf(hasBlocks);
  vtkSurfaceDetail* const filter = detail.filter;
  filter->SetInputDataObject(2, selection);
  if (!TakesSelection(detail, hasBlocks ? 2 : 1, outcome))
  {
    outcome.Require(!isWhole, "a whole selection is refused: " + outcome.refusal);
    outcome.Require(outcome.refusal.find("Selection") != std::string::npos,
      "a message without the name of the input");
    return;
  }
  auto* const blocks = vtkMultiBlockDataSet::SafeDownCast(filter->GetInputDataObject(0, 0));
  auto* const outputs = vtkMultiBlockDataSet::SafeDownCast(filter->GetOutputDataObject(0));
  for (unsigned int block = 0; block < (blocks ? blocks->GetNumberOfBlocks() : 1); ++block)
  {
    auto* const surface = vtkPolyData::SafeDownCast(
      blocks ? blocks->GetBlock(block) : filter->GetInputDataObject(0, 0));
    const std::vector<double> selected =
      PointValues(outputs ? outputs->GetBlock(block) : filter->GetOutputDataObject(0), "Selected");
    RequireSelected(
      selection, surface, blocks ? static_cast<int>(block) + 1 : -1, selected, outcome);
  }
}

} // namespace gridfem::testing
