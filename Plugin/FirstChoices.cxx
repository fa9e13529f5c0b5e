#include "FirstChoices.h"

#include "Hints.h"
#include "Watch.h"

#include "vtkDataObject.h"
#include "vtkDataSetAttributes.h"
#include "vtkPVArrayInformation.h"
#include "vtkPVDataInformation.h"
#include "vtkPVDataSetAttributesInformation.h"
#include "vtkPVXMLElement.h"
#include "vtkSMArrayListDomain.h"
#include "vtkSMProperty.h"
#include "vtkSMPropertyHelper.h"
#include "vtkSMSourceProxy.h"
#include "vtkSMStringVectorProperty.h"
#include "vtkSMTrace.h"

#include <string>
#include <vector>

namespace
{

/// The source and the port that the filter's port 0 is connected to. Null if there is none.
vtkSMSourceProxy* InputOf(vtkSMProxy* filter, int& port)
{
  const vtkSMPropertyHelper input(filter, "Input", true);
  if (input.GetNumberOfElements() == 0)
  {
    return nullptr;
  }
  port = static_cast<int>(input.GetOutputPort());
  return vtkSMSourceProxy::SafeDownCast(input.GetAsProxy());
}

struct Array
{
  int association = vtkDataObject::POINT;
  std::string name; // empty: none
};

/// The array that colors the input in a view.
Array ColoringArray(vtkSMProxy* filter)
{
  int port = 0;
  vtkSMSourceProxy* input = InputOf(filter, port);
  if (input)
  {
    for (const auto& [view, shown] : gridfem::ViewsOf(input, port))
    {
      const vtkSMPropertyHelper colors(shown, "ColorArrayName", true);
      const char* name =
        colors.GetNumberOfElements() == 5 ? colors.GetInputArrayNameToProcess() : nullptr;
      if (name && *name)
      {
        return { colors.GetInputArrayAssociation(), name };
      }
    }
  }
  return {};
}

/// Whether an array describes the geometry or numbers the points, so that no one wants to filter
/// it.
bool ServesTheMesh(vtkPVDataInformation* data, const Array& array)
{
  vtkPVDataSetAttributesInformation* attributes = data->GetAttributeInformation(array.association);
  for (int kind : { vtkDataSetAttributes::NORMALS, vtkDataSetAttributes::TCOORDS,
         vtkDataSetAttributes::GLOBALIDS, vtkDataSetAttributes::PEDIGREEIDS })
  {
    vtkPVArrayInformation* special =
      attributes ? attributes->GetAttributeInformation(kind) : nullptr;
    if (special && special->GetName() == array.name)
    {
      return true;
    }
  }
  return array.name == "Normals" || array.name.compare(0, 3, "vtk") == 0;
}

/// The array with which the list should begin: the array that colors the input if it is offered, or
/// else the only array.
Array ChooseFrom(vtkSMArrayListDomain* list, const std::string& none, vtkPVDataInformation* data,
  const Array& coloring)
{
  Array only;
  int candidates = 0;
  for (unsigned int k = 0; k < list->GetNumberOfStrings(); ++k)
  {
    const Array offered = { list->GetFieldAssociation(k), list->GetString(k) };
    if (offered.name == none)
    {
      continue;
    }
    if (offered.name == coloring.name && offered.association == coloring.association)
    {
      return offered;
    }
    if (!ServesTheMesh(data, offered))
    {
      only = offered;
      ++candidates;
    }
  }
  return candidates == 1 ? only : Array();
}

/// Gives a property the value of a hint, unless it has another than its default.
void SetNumber(vtkSMProperty* property, vtkPVXMLElement* hint)
{
  double value = 0.0;
  if (property && property->IsValueDefault() && hint->GetScalarAttribute("value", &value))
  {
    vtkSMPropertyHelper(property).Set(value);
  }
}

/// Chooses the array of a property.
void ChooseArray(vtkSMProxy* filter, vtkPVXMLElement* hint)
{
  auto* property = vtkSMStringVectorProperty::SafeDownCast(
    filter->GetProperty(hint->GetAttributeOrEmpty("property")));
  auto* list = property ? property->FindDomain<vtkSMArrayListDomain>() : nullptr;
  int port = 0;
  vtkSMSourceProxy* input = InputOf(filter, port);
  if (!list || !input || !property->IsValueDefault())
  {
    return;
  }
  const Array array = ChooseFrom(
    list, property->GetDefaultValue(4), input->GetDataInformation(port), ColoringArray(filter));
  if (!array.name.empty())
  {
    vtkSMPropertyHelper(property).SetInputArrayToProcess(array.association, array.name.c_str());
    return;
  }
  SetNumber(filter->GetProperty(hint->GetAttributeOrEmpty("otherwise")), hint);
}

/// Fills a table of points and values with an example.
void ChoosePoints(vtkSMProxy* filter, vtkPVXMLElement* hint)
{
  constexpr vtkTypeInt64 Steps = 3; // between the points
  vtkSMProperty* property = filter->GetProperty(hint->GetAttributeOrEmpty("property"));
  int port = 0;
  vtkSMSourceProxy* input = InputOf(filter, port);
  vtkPVDataInformation* data = input ? input->GetDataInformation(port) : nullptr;
  if (!property || !property->IsValueDefault() || !data || data->IsCompositeDataSet() ||
      !data->DataSetTypeIsA("vtkPolyData") || data->GetNumberOfPoints() <= Steps)
  {
    return;
  }
  std::vector<double> table;
  for (vtkTypeInt64 k = 0; k <= Steps; ++k)
  {
    table.push_back(static_cast<double>(k * (data->GetNumberOfPoints() - 1) / Steps));
    table.push_back(static_cast<double>(k));
  }
  vtkSMPropertyHelper(property).Set(table.data(), static_cast<unsigned int>(table.size()));
}

} // namespace

void gridfem::MakeFirstChoices(vtkSMProxy* filter)
{
  const auto arrays = HintsOf(filter, "ChoosesArray");
  const auto numbers = HintsOf(filter, "ChoosesNumber");
  const auto points = HintsOf(filter, "ChoosesPoints");
  if (arrays.empty() && numbers.empty() && points.empty())
  {
    return;
  }
  SM_SCOPED_TRACE(PropertiesModified).arg("proxy", filter);
  for (vtkPVXMLElement* hint : arrays)
  {
    ChooseArray(filter, hint);
  }
  for (vtkPVXMLElement* hint : numbers)
  {
    SetNumber(filter->GetProperty(hint->GetAttributeOrEmpty("property")), hint);
  }
  for (vtkPVXMLElement* hint : points)
  {
    ChoosePoints(filter, hint);
  }
  filter->UpdateVTKObjects();
}
