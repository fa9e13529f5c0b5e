#include "ArrayColors.h"

#include "vtkClientServerInterpreter.h"
#include "vtkClientServerInterpreterInitializer.h"
#include "vtkCommand.h"
#include "vtkDataObject.h"
#include "vtkNew.h"
#include "vtkObjectFactory.h"
#include "vtkPVArrayInformation.h"
#include "vtkPVDataInformation.h"
#include "vtkPVXMLElement.h"
#include "vtkSMPropertyHelper.h"
#include "vtkSMProxyInitializationHelper.h"
#include "vtkSMSessionProxyManager.h"
#include "vtkSMSettings.h"
#include "vtkSMSourceProxy.h"
#include "vtkSMTransferFunctionManager.h"
#include "vtkSMTransferFunctionProxy.h"

#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

namespace
{

enum class Colors
{
  Diverging,
  Sequential,
  Categorical
};

/// ColorBrewer's Set2 and, in the same order of hues, Dark2.
constexpr unsigned char Categories[16][3] = { { 102, 194, 165 }, { 252, 141, 98 },
  { 141, 160, 203 }, { 231, 138, 195 }, { 166, 216, 84 }, { 255, 217, 47 }, { 229, 196, 148 },
  { 179, 179, 179 }, { 27, 158, 119 }, { 217, 95, 2 }, { 117, 112, 179 }, { 231, 41, 138 },
  { 102, 166, 30 }, { 230, 171, 2 }, { 166, 118, 29 }, { 102, 102, 102 } };

/// Does not look at the array again, because its values are known: 0 to 7, or 0 to 15.
void SetCategories(vtkSMProxy* map, bool all)
{
  const unsigned int count = all ? 16 : 8;
  std::vector<double> points;
  for (unsigned int value = 0; value < count; ++value)
  {
    points.push_back(value);
    for (unsigned char channel : Categories[value])
    {
      points.push_back(channel / 255.0);
    }
  }
  vtkSMPropertyHelper(map, "RGBPoints")
    .Set(points.data(), static_cast<unsigned int>(points.size()));
  // There are as many entries as values, one for each value. Annotated values would look the same,
  // but are looked up one by one.
  vtkSMPropertyHelper(map, "Discretize").Set(1);
  vtkSMPropertyHelper(map, "NumberOfTableValues").Set(static_cast<int>(count));
  vtkSMPropertyHelper(map, "ScalarRangeInitialized").Set(1);
  map->UpdateVTKObjects();
}

/// The color map of the arrays with this name, or null if there is none.
vtkSMProxy* FindMap(const std::string& array, vtkSMSessionProxyManager* proxies)
{
  return proxies->GetProxy("lookup_tables", (array + ".PVLookupTable").c_str());
}

bool UserHasColors(const std::string& array)
{
  vtkSMSettings* settings = vtkSMSettings::GetInstance();
  return settings->HasSetting((".standard_presets." + array).c_str()) ||
         settings->HasSetting((".array_lookup_tables." + array).c_str());
}

/// Widens the range symmetrically about 0 until it holds the range of the data. A range that the
/// user has chosen or locked stays.
void KeepZeroInTheMiddle(vtkSMProxy* map, const double dataRange[2])
{
  double range[2];
  if (!vtkSMTransferFunctionProxy::GetRange(map, range))
  {
    return;
  }
  const bool isNew = vtkSMPropertyHelper(map, "ScalarRangeInitialized").GetAsInt() == 0;
  const bool isLocked = vtkSMPropertyHelper(map, "AutomaticRescaleRangeMode").GetAsInt() ==
                        vtkSMTransferFunctionManager::NEVER;
  if (!isNew && (isLocked || range[0] != -range[1]))
  {
    return;
  }
  const double largest = std::max(std::abs(dataRange[0]), std::abs(dataRange[1]));
  if (largest > 0.0)
  {
    vtkSMTransferFunctionProxy::RescaleTransferFunction(map, -largest, largest, !isNew);
  }
}

/// Looks at the array after every run of the filter, before ParaView shows it.
class ArrayObserver : public vtkCommand
{
public:
  vtkTypeMacro(ArrayObserver, vtkCommand);
  static ArrayObserver* New() { return new ArrayObserver; }

  void Execute(vtkObject* caller, unsigned long, void*) override
  {
    auto* filter = vtkSMSourceProxy::SafeDownCast(caller);
    vtkPVDataInformation* data = filter ? filter->GetDataInformation(0) : nullptr;
    for (int association : { vtkDataObject::POINT, vtkDataObject::CELL })
    {
      vtkPVArrayInformation* array =
        data ? data->GetArrayInformation(this->Array.c_str(), association) : nullptr;
      if (array && array->GetNumberOfComponents() == 1)
      {
        this->Show(filter->GetSessionProxyManager(), array);
        return;
      }
    }
  }

  std::string Array;
  Colors Kind = Colors::Diverging;

private:
  void Show(vtkSMSessionProxyManager* proxies, vtkPVArrayInformation* array)
  {
    double range[2];
    array->GetComponentFiniteRange(0, range);
    if (!(range[0] <= range[1]))
    {
      return;
    }
    vtkSMProxy* map = FindMap(this->Array, proxies);
    if (!map && !UserHasColors(this->Array))
    {
      map = this->MakeMap(proxies, range);
    }
    if (map && (this->Kind == Colors::Diverging || range[0] < 0.0))
    {
      KeepZeroInTheMiddle(map, range);
    }
  }

  vtkSMProxy* MakeMap(vtkSMSessionProxyManager* proxies, const double range[2]) const
  {
    vtkNew<vtkSMTransferFunctionManager> manager;
    vtkSMProxy* map = manager->GetColorTransferFunction(this->Array.c_str(), proxies);
    if (map && this->Kind == Colors::Sequential && range[0] >= 0.0)
    {
      vtkSMTransferFunctionProxy::ApplyPreset(map, "Viridis (matplotlib)", true);
    }
    else if (map && this->Kind == Colors::Categorical)
    {
      SetCategories(map, range[1] > 7.0);
    }
    return map;
  }
};

class vtkSMArrayColors : public vtkSMProxyInitializationHelper
{
public:
  static vtkSMArrayColors* New();
  vtkTypeMacro(vtkSMArrayColors, vtkSMProxyInitializationHelper);

  void PostInitializeProxy(vtkSMProxy* proxy, vtkPVXMLElement* xml, vtkMTimeType) override
  {
    const std::string colors = xml->GetAttributeOrEmpty("colors");
    vtkNew<ArrayObserver> observer;
    observer->Array = xml->GetAttributeOrEmpty("array");
    observer->Kind = colors == "sequential"    ? Colors::Sequential
                     : colors == "categorical" ? Colors::Categorical
                                               : Colors::Diverging;
    proxy->AddObserver(vtkCommand::UpdateDataEvent, observer);
  }
};

vtkStandardNewMacro(vtkSMArrayColors);

vtkObjectBase* NewArrayColors(void*)
{
  return vtkSMArrayColors::New();
}

void AddToInterpreter(vtkClientServerInterpreter* interpreter)
{
  interpreter->AddNewInstanceFunction("vtkSMArrayColors", NewArrayColors);
}

} // namespace

void gridfem::RegisterArrayColors()
{
  vtkClientServerInterpreterInitializer::GetInitializer()->RegisterCallback(AddToInterpreter);
}
