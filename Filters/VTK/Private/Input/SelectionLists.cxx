#include "Input/SelectionLists.h"

#include "Base/Errors.h"
#include "Base/Types.h"

#include "vtkCellData.h"
#include "vtkCompositeDataIterator.h"
#include "vtkCompositeDataSet.h"
#include "vtkDataArray.h"
#include "vtkDataSet.h"
#include "vtkDoubleArray.h"
#include "vtkInformation.h"
#include "vtkPointData.h"
#include "vtkSelectionNode.h"
#include "vtkSmartPointer.h"
#include "vtkStringArray.h"

#include <cmath>
#include <limits>
#include <string>

namespace gridfem
{
namespace
{

[[noreturn]] void RefuseNode(vtkSelectionNode* node, const std::string& reason)
{
  throw InvalidInput("The Selection of the kind " +
                     std::string(vtkSelectionNode::GetContentTypeAsString(node->GetContentType())) +
                     " " + reason);
}

bool IsInteger(int type)
{
  return type != VTK_FLOAT && type != VTK_DOUBLE;
}

template<class Test>
bool AllOf(vtkDataArray* list, const Test& test)
{
  for (vtkIdType k = 0; k < list->GetNumberOfTuples(); ++k)
  {
    for (int c = 0; c < list->GetNumberOfComponents(); ++c)
    {
      if (!test(list->GetComponent(k, c)))
      {
        return false;
      }
    }
  }
  return true;
}

/// Requires what a frustum's planes are computed from: eight finite corners around a volume.
void RequireFrustum(vtkSelectionNode* node)
{
  constexpr int Coordinates = 4; // homogeneous
  auto* corners = vtkDoubleArray::SafeDownCast(node->GetSelectionList());
  if (!corners || corners->GetNumberOfValues() != 8 * Coordinates)
  {
    throw InvalidInput("A Selection by a frustum needs the eight corners of the frustum.");
  }
  const auto corner = [&](int k) { return Vec3(corners->GetPointer(k * Coordinates)); };
  // Three corners of each face, as VTK makes its planes.
  constexpr int Faces[][3] = { { 0, 2, 3 }, { 7, 6, 4 }, { 5, 4, 0 }, { 2, 6, 7 }, { 6, 2, 0 },
    { 1, 3, 7 } };
  for (const auto& face : Faces)
  {
    const Vec3 first = corner(face[0]);
    const Vec3 normal = (corner(face[1]) - first).cross(corner(face[2]) - first);
    if (!(normal.squaredNorm() > 0.0) || !std::isfinite(normal.squaredNorm()))
    {
      throw InvalidInput("The Selection by a frustum needs finite corners around a volume.");
    }
  }
}

void RequirePlaces(vtkSelectionNode* node, vtkDataArray* list)
{
  if (list->GetNumberOfComponents() != 3 || !AllOf(list, [](double x) { return std::isfinite(x); }))
  {
    RefuseNode(node, "needs a list of finite numbers with three components.");
  }
  const double radius = node->GetProperties()->Get(vtkSelectionNode::EPSILON());
  if (!(radius >= 0.0) || std::isinf(radius))
  {
    RefuseNode(node, "needs a finite distance that is not negative.");
  }
}

/// VTK keeps 32 bits of the ids, and takes a data set without blocks whatever they are.
void RequireBlocks(vtkSelectionNode* node, vtkDataArray* list, vtkDataObject* data)
{
  const auto isId = [](double id)
  { return id >= 0.0 && id <= double(std::numeric_limits<unsigned int>::max()); };
  if (!IsInteger(list->GetDataType()) || list->GetNumberOfComponents() > 2 || !AllOf(list, isId))
  {
    RefuseNode(node, "needs a list of numbers of blocks.");
  }
  if (!vtkCompositeDataSet::SafeDownCast(data))
  {
    RefuseNode(node, "needs an input with blocks.");
  }
}

/// Requires values that can be sorted, or pairs of the limits of ranges.
void RequireValues(vtkSelectionNode* node, vtkDataArray* list)
{
  const int components = list->GetNumberOfComponents();
  const bool isRange = node->GetContentType() == vtkSelectionNode::THRESHOLDS;
  if (components > 2 || (isRange && components == 1 && list->GetNumberOfTuples() % 2 != 0))
  {
    RefuseNode(node, "needs a list of numbers with one component, or two for a range.");
  }
  if (components == 1 && !isRange && !AllOf(list, [](double x) { return !std::isnan(x); }))
  {
    RefuseNode(node, "has a list with values that are not numbers.");
  }
}

/// Returns the array that VTK compares with the list. Null if the data have none.
vtkAbstractArray* ComparedArray(vtkSelectionNode* node, vtkDataSetAttributes* attributes)
{
  switch (node->GetContentType())
  {
    case vtkSelectionNode::GLOBALIDS:
      return attributes->GetAbstractAttribute(vtkDataSetAttributes::GLOBALIDS);
    case vtkSelectionNode::PEDIGREEIDS:
      return attributes->GetAbstractAttribute(vtkDataSetAttributes::PEDIGREEIDS);
    default:
      break;
  }
  const char* name = node->GetSelectionList()->GetName();
  return name && *name ? attributes->GetAbstractArray(name)
                       : attributes->GetAbstractAttribute(vtkDataSetAttributes::SCALARS);
}

/// Requires an array of a data set that VTK can compare with the list.
void RequireComparable(vtkSelectionNode* node, vtkDataArray* list, vtkDataSet* data)
{
  const bool ofPoints = node->GetFieldType() == vtkSelectionNode::POINT;
  vtkAbstractArray* const array =
    ComparedArray(node, data->GetAttributes(ofPoints ? vtkDataObject::POINT : vtkDataObject::CELL));
  if (!array)
  {
    return;
  }
  const std::string name = array->GetName() ? array->GetName() : "";
  const vtkIdType count = ofPoints ? data->GetNumberOfPoints() : data->GetNumberOfCells();
  if (!vtkDataArray::SafeDownCast(array) || array->GetNumberOfTuples() != count)
  {
    RefuseNode(node, "compares the array '" + name + "', which does not have numbers for all " +
                       (ofPoints ? "points." : "cells."));
  }
  const int components = array->GetNumberOfComponents();
  vtkInformation* const properties = node->GetProperties();
  const int component = properties->Get(vtkSelectionNode::COMPONENT_NUMBER());
  const bool isOfOneType = vtkDataTypesCompare(array->GetDataType(), list->GetDataType());
  constexpr int Magnitude = -1; // VTK has it only for lists of the array's own type
  if (component >= components || component < (isOfOneType ? Magnitude : 0))
  {
    RefuseNode(node, "compares the component " + std::to_string(component) + " of the array '" +
                       name + "', which has " + std::to_string(components) + ".");
  }
  const bool isRange =
    list->GetNumberOfComponents() == 2 || node->GetContentType() == vtkSelectionNode::THRESHOLDS;
  if (!isRange && !isOfOneType)
  {
    RefuseNode(node, "compares the array '" + name + "' of the type " +
                       array->GetDataTypeAsString() + " with a list of the type " +
                       list->GetDataTypeAsString() + ". Both must be of one type.");
  }
}

void RequireComparable(vtkSelectionNode* node, vtkDataArray* list, vtkDataObject* data)
{
  RequireValues(node, list);
  if (auto* dataSet = vtkDataSet::SafeDownCast(data))
  {
    RequireComparable(node, list, dataSet);
  }
  auto* blocks = vtkCompositeDataSet::SafeDownCast(data);
  if (!blocks)
  {
    return;
  }
  const auto leaf = vtkSmartPointer<vtkCompositeDataIterator>::Take(blocks->NewIterator());
  for (leaf->InitTraversal(); !leaf->IsDoneWithTraversal(); leaf->GoToNextItem())
  {
    if (auto* dataSet = vtkDataSet::SafeDownCast(leaf->GetCurrentDataObject()))
    {
      RequireComparable(node, list, dataSet);
    }
  }
}

/// Requires names of blocks, which new versions of VTK select by.
void RequireNames(vtkSelectionNode* node, vtkDataObject* data)
{
  if (!vtkStringArray::SafeDownCast(node->GetSelectionList()) ||
      !vtkCompositeDataSet::SafeDownCast(data))
  {
    RefuseNode(node, "needs a list of names, and an input with blocks.");
  }
}

/// VTK takes other points for ranges that begin outside.
void RequireIds(vtkSelectionNode* node, vtkDataArray* list)
{
  if (!IsInteger(list->GetDataType()) || list->GetNumberOfComponents() != 1)
  {
    RefuseNode(node, "needs a list of integers with one component.");
  }
}

vtkDataArray* NumbersOf(vtkSelectionNode* node)
{
  auto* const numbers = vtkDataArray::SafeDownCast(node->GetSelectionList());
  if (!numbers || numbers->GetDataType() == VTK_BIT)
  {
    RefuseNode(node, "needs a list of numbers.");
  }
  return numbers;
}

bool HasItems(vtkSelectionNode* node)
{
  vtkAbstractArray* const list = node->GetSelectionList();
  return list && list->GetNumberOfTuples() > 0;
}

} // namespace

void RequireList(vtkSelectionNode* node, vtkDataObject* data)
{
  switch (node->GetContentType())
  {
    case vtkSelectionNode::QUERY:
      break;
    case vtkSelectionNode::FRUSTUM:
      RequireFrustum(node);
      break;
    case vtkSelectionNode::BLOCKS:
      RequireBlocks(node, NumbersOf(node), data);
      break;
    case vtkSelectionNode::LOCATIONS:
      if (HasItems(node))
      {
        RequirePlaces(node, NumbersOf(node));
      }
      break;
    case vtkSelectionNode::INDICES:
      if (HasItems(node))
      {
        RequireIds(node, NumbersOf(node));
      }
      break;
    case vtkSelectionNode::GLOBALIDS:
    case vtkSelectionNode::PEDIGREEIDS:
    case vtkSelectionNode::VALUES:
    case vtkSelectionNode::THRESHOLDS:
      if (HasItems(node))
      {
        RequireComparable(node, NumbersOf(node), data);
      }
      break;
    default:
      RequireNames(node, data);
  }
}

} // namespace gridfem
