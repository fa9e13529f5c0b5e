#include "SelectionOracle.h"

#include "FilterSupport.h"

#include "vtkIdList.h"
#include "vtkInformation.h"
#include "vtkSelection.h"
#include "vtkSelectionNode.h"

#include <limits>
#include <optional>

namespace gridfem::testing
{
namespace
{

using Node = vtkSelectionNode;
using Flags = std::vector<char>;

bool IsOfPoints(Node* node)
{
  return node->GetFieldType() == Node::POINT;
}

vtkIdType CountOf(Node* node, vtkPolyData* surface)
{
  return IsOfPoints(node) ? surface->GetNumberOfPoints() : surface->GetNumberOfCells();
}

/// Returns the values that are compared with the list. Empty without an array.
std::vector<double> Compared(Node* node, vtkPolyData* surface)
{
  vtkDataSetAttributes* attributes =
    surface->GetAttributes(IsOfPoints(node) ? vtkDataObject::POINT : vtkDataObject::CELL);
  vtkDataArray* array = node->GetContentType() == Node::GLOBALIDS ? attributes->GetGlobalIds()
                        : node->GetContentType() == Node::PEDIGREEIDS
                          ? vtkDataArray::SafeDownCast(attributes->GetPedigreeIds())
                          : attributes->GetArray(node->GetSelectionList()->GetName());
  const int component = node->GetProperties()->Get(Node::COMPONENT_NUMBER());
  std::vector<double> values;
  for (vtkIdType k = 0; array && k < array->GetNumberOfTuples(); ++k)
  {
    double squares = 0.0;
    for (int c = 0; c < array->GetNumberOfComponents(); ++c)
    {
      squares += array->GetComponent(k, c) * array->GetComponent(k, c);
    }
    values.push_back(array->GetNumberOfComponents() == 1 ? array->GetComponent(k, 0)
                     : component >= 0                    ? array->GetComponent(k, component)
                                                         : std::sqrt(squares));
  }
  return values;
}

Flags ByValues(Node* node, const std::vector<double>& list, bool areRanges, vtkPolyData* surface)
{
  const std::vector<double> values = Compared(node, surface);
  Flags flags(CountOf(node, surface), 0);
  for (std::size_t k = 0; k < values.size(); ++k)
  {
    for (std::size_t j = 0; j + areRanges < list.size(); j += areRanges ? 2 : 1)
    {
      flags[k] |= values[k] >= list[j] && values[k] <= list[j + areRanges];
    }
  }
  return flags;
}

Flags ByIds(Node* node, const std::vector<double>& list, vtkPolyData* surface)
{
  Flags flags(CountOf(node, surface), 0);
  for (const double id : list)
  {
    if (id >= 0.0 && id < double(flags.size()))
    {
      flags[static_cast<std::size_t>(id)] = 1;
    }
  }
  return flags;
}

/// Returns the nearest point of each place if it is near enough. Nothing for near ties, which
/// rounding decides.
std::optional<Flags> ByPlaces(Node* node, const std::vector<double>& list, vtkPolyData* surface)
{
  const double radius = node->GetProperties()->Get(Node::EPSILON());
  Flags flags(CountOf(node, surface), 0);
  for (std::size_t j = 0; j + 2 < list.size(); j += 3)
  {
    const Vec3 place(list[j], list[j + 1], list[j + 2]);
    std::vector<std::pair<double, vtkIdType>> distances;
    for (vtkIdType point = 0; point < surface->GetNumberOfPoints(); ++point)
    {
      distances.emplace_back((Vec3(surface->GetPoint(point)) - place).norm(), point);
    }
    std::sort(distances.begin(), distances.end());
    constexpr double Near = 1.0 + 1e-9;
    const double nearest = distances[0].first;
    const bool isTie = distances[1].first <= nearest * Near;
    const bool isAtLimit = nearest <= radius * Near && radius <= nearest * Near;
    if (isTie || (isAtLimit && radius > 0.0) || !std::isfinite(nearest * nearest))
    {
      return std::nullopt;
    }
    if (nearest <= radius)
    {
      flags[distances[0].second] = 1;
    }
  }
  return flags;
}

/// Returns the points of a box between the first and the last corner. Nothing for other frusta, and
/// for cells, which can overlap the box without a point in it.
std::optional<Flags> ByFrustum(Node* node, const std::vector<double>& list, vtkPolyData* surface)
{
  const Vec3 first(list[0], list[1], 10.0);
  const Vec3 last(list[28], list[29], -10.0);
  for (std::size_t corner = 0; corner < 8; ++corner)
  {
    const Vec3 expected((corner & 4u ? last : first)[0], (corner & 2u ? last : first)[1],
      (corner & 1u ? last : first)[2]);
    if (!IsOfPoints(node) || Vec3(&list[4 * corner]) != expected)
    {
      return std::nullopt;
    }
  }
  if (!(first[0] < last[0] && first[1] < last[1]))
  {
    return std::nullopt; // inside out
  }
  Flags flags(surface->GetNumberOfPoints(), 0);
  for (vtkIdType point = 0; point < surface->GetNumberOfPoints(); ++point)
  {
    const Vec3 at(surface->GetPoint(point));
    flags[point] = at[0] > first[0] && at[0] < last[0] && at[1] > first[1] && at[1] < last[1];
  }
  return flags;
}

std::optional<Flags> Taken(Node* node, vtkPolyData* surface, int block)
{
  auto* array = vtkDataArray::SafeDownCast(node->GetSelectionList());
  const std::vector<double> list = Values(array);
  const bool isPair = array && array->GetNumberOfComponents() == 2;
  const Flags none(CountOf(node, surface), 0);
  if (list.empty() && node->GetContentType() != Node::FRUSTUM)
  {
    return none;
  }
  switch (node->GetContentType())
  {
    case Node::GLOBALIDS:
    case Node::PEDIGREEIDS:
    case Node::VALUES:
      return ByValues(node, list, isPair, surface);
    case Node::THRESHOLDS:
      return ByValues(node, list, true, surface);
    case Node::INDICES:
      return ByIds(node, list, surface);
    case Node::LOCATIONS:
      return IsOfPoints(node) ? ByPlaces(node, list, surface) : std::nullopt;
    case Node::FRUSTUM:
      return ByFrustum(node, list, surface);
    case Node::BLOCKS: // pairs are of levels that these blocks do not have
      return !isPair && (std::find(list.begin(), list.end(), double(block)) != list.end() ||
                          std::find(list.begin(), list.end(), 0.0) != list.end())
               ? Flags(none.size(), 1)
               : none;
    default:
      return std::nullopt;
  }
}

/// Returns the flags of a node after its properties: its block, cells of its points, and inversion.
std::optional<Flags> Selected(Node* node, vtkPolyData* surface, int block)
{
  vtkInformation* const properties = node->GetProperties();
  if (properties->Get(Node::CONNECTED_LAYERS()) >= 1)
  {
    return std::nullopt;
  }
  std::optional<Flags> flags = Taken(node, surface, block);
  const int only = properties->Get(Node::COMPOSITE_INDEX());
  const bool ofOneBlock = block >= 0 && node->GetContentType() != Node::BLOCKS;
  if (flags && ofOneBlock && properties->Has(Node::COMPOSITE_INDEX()) && only != block && only != 0)
  {
    flags->assign(flags->size(), 0);
  }
  if (flags && IsOfPoints(node) && properties->Get(Node::CONTAINING_CELLS()))
  {
    Flags cells(surface->GetNumberOfCells(), 0);
    vtkNew<vtkIdList> points;
    for (vtkIdType cell = 0; cell < surface->GetNumberOfCells(); ++cell)
    {
      surface->GetCellPoints(cell, points);
      cells[cell] = std::any_of(
        points->begin(), points->end(), [&](vtkIdType point) { return (*flags)[point]; });
    }
    flags = cells;
  }
  if (flags && properties->Get(Node::INVERSE()))
  {
    for (char& flag : *flags)
    {
      flag = !flag;
    }
  }
  return flags;
}

} // namespace

std::vector<double> IntegersIn(int type, const std::vector<double>& values)
{
  const bool isWide = type == VTK_ID_TYPE;
  const double low = isWide ? -9e18 : type == VTK_UNSIGNED_INT ? 0.0 : -2147483648.0;
  const double high = isWide ? 9e18 : type == VTK_UNSIGNED_INT ? 4294967295.0 : 2147483647.0;
  std::vector<double> integers;
  for (const double value : values)
  {
    const double integer = std::trunc(value);
    integers.push_back(integer >= low && integer <= high ? integer : 0.0);
  }
  return integers;
}

void RequireSelected(vtkSelection* selection, vtkPolyData* surface, int block,
  const std::vector<double>& selected, DamagedCase& outcome)
{
  const auto points = static_cast<std::size_t>(surface->GetNumberOfPoints());
  outcome.Require(selected.size() == points, std::to_string(selected.size()) + " flags");
  std::vector<double> expected(points, 0.0);
  if (!selection->GetExpression().empty())
  {
    return;
  }
  for (unsigned int k = 0; k < selection->GetNumberOfNodes(); ++k)
  {
    Node* const node = selection->GetNode(k);
    vtkInformation* const properties = node->GetProperties();
    const bool hasProcess = properties->Has(Node::PROCESS_ID());
    const int process = hasProcess ? properties->Get(Node::PROCESS_ID()) : -1;
    if (process != -1 && process != 0)
    {
      continue;
    }
    const std::optional<Flags> flags = Selected(node, surface, block);
    if (!flags)
    {
      return;
    }
    vtkNew<vtkIdList> corners;
    const bool takesCells = !IsOfPoints(node) || properties->Get(Node::CONTAINING_CELLS());
    for (std::size_t place = 0; place < flags->size(); ++place)
    {
      corners->SetNumberOfIds(1);
      corners->SetId(0, static_cast<vtkIdType>(place));
      if (takesCells)
      {
        surface->GetCellPoints(static_cast<vtkIdType>(place), corners);
      }
      for (vtkIdType corner = 0; (*flags)[place] && corner < corners->GetNumberOfIds(); ++corner)
      {
        expected[corners->GetId(corner)] = 1.0;
      }
    }
  }
  const double error = Difference(selected, expected);
  outcome.Require(error == 0.0, "other points than the selected ones");
}

} // namespace gridfem::testing
