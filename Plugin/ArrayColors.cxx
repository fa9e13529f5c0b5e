#include "ArrayColors.h"

#include "ColorMaps.h"
#include "ParaViewVersions.h"
#include "Watch.h"

#include "vtkClientServerInterpreter.h"
#include "vtkClientServerInterpreterInitializer.h"
#include "vtkCommand.h"
#include "vtkDataObject.h"
#include "vtkNew.h"
#include "vtkObjectFactory.h"
#include "vtkPVArrayInformation.h"
#include "vtkPVDataInformation.h"
#include "vtkPVDataSetAttributesInformation.h"
#include "vtkPVXMLElement.h"
#include "vtkSMProperty.h"
#include "vtkSMPropertyHelper.h"
#include "vtkSMProxyInitializationHelper.h"
#include "vtkSMProxyIterator.h"
#include "vtkSMProxyManager.h"
#include "vtkSMSessionProxyManager.h"
#include "vtkSMSettings.h"
#include "vtkSMSourceProxy.h"
#include "vtkSMTransferFunctionManager.h"
#include "vtkSMTransferFunctionProxy.h"
#include "vtkWeakPointer.h"

#include <algorithm>
#include <cmath>
#include <memory>
#include <sstream>
#include <string>
#include <vector>

namespace
{

enum class Colors
{
  Diverging,
  Sequential,
  Stripes,
  Categorical
};

constexpr const char* MapEnding = ".PVLookupTable"; // of the name under which a map is registered

/// The colors that a hint chooses for arrays.
struct Choice
{
  std::string array; // ends in *: all that begin so
  int port = 0;
  Colors colors = Colors::Diverging;
  bool stepsApart = false;
  double limit = 0.0; // values farther from 0 have the last color; 0: no limit

  bool Fits(const std::string& name) const
  {
    const bool isStart = !array.empty() && array.back() == '*';
    return isStart ? name.compare(0, array.size() - 1, array, 0, array.size() - 1) == 0
                   : name == array;
  }
};

struct Range
{
  double low = 0.0;
  double high = -1.0; // below low: no range

  bool IsKnown() const { return low <= high; }
};

bool UserHasColors(const std::string& array)
{
  vtkSMSettings* settings = vtkSMSettings::GetInstance();
  return settings->HasSetting((".standard_presets." + array).c_str()) ||
         settings->HasSetting((".array_lookup_tables." + array).c_str());
}

/// The range that a color map should have for an array. Unknown for several components.
Range WantedRange(vtkPVArrayInformation* array, const Choice& choice)
{
  Range range;
  if (array->GetNumberOfComponents() == 1 && choice.colors != Colors::Categorical)
  {
    double ends[2];
    array->GetComponentFiniteRange(0, ends);
    range = { ends[0], ends[1] };
  }
  if (range.IsKnown() && (choice.colors == Colors::Diverging || range.low < 0.0))
  {
    double largest = std::max(std::abs(range.low), std::abs(range.high));
    largest = choice.limit > 0.0 ? std::min(largest, choice.limit) : largest;
    range = largest > 0.0 ? Range{ -largest, largest } : Range();
  }
  return range;
}

/// The range that this class has given to a map is noted with the map, also in states.
constexpr const char* RangeNote = "GridFEM.Range";

void SetRange(vtkSMProxy* map, const Range& wanted, bool grows)
{
  vtkSMTransferFunctionProxy::RescaleTransferFunction(map, wanted.low, wanted.high, grows);
  double range[2];
  if (vtkSMTransferFunctionProxy::GetRange(map, range))
  {
    std::ostringstream note;
    note.precision(17);
    note << range[0] << ' ' << range[1];
    map->SetAnnotation(RangeNote, note.str().c_str());
  }
}

/// Whether the range of a map is as this class has set it, and may change. With a limit, ParaView
/// may not change it, which would extend it to all values.
bool HasOurRange(vtkSMProxy* map, bool hasLimit)
{
  double range[2];
  double noted[2];
  const char* note = map->GetAnnotation(RangeNote);
  if (!note || !vtkSMTransferFunctionProxy::GetRange(map, range) ||
      (!hasLimit && vtkSMPropertyHelper(map, "AutomaticRescaleRangeMode").GetAsInt() ==
                      vtkSMTransferFunctionManager::NEVER))
  {
    return false;
  }
  std::istringstream(note) >> noted[0] >> noted[1];
  const double tolerance = 1e-6 * (noted[1] - noted[0]);
  return std::abs(range[0] - noted[0]) <= tolerance && std::abs(range[1] - noted[1]) <= tolerance;
}

/// Whether something visible uses a map, other than a filter. The filter's input will be hidden.
bool IsUsedElsewhere(vtkSMProxy* map, vtkSMSourceProxy* filter)
{
  const vtkSMProxy* hidden = vtkSMPropertyHelper(filter, "Input", true).GetAsProxy();
  vtkNew<vtkSMProxyIterator> each;
  each->SetSessionProxyManager(filter->GetSessionProxyManager());
  each->SetModeToOneGroup();
  for (each->Begin("representations"); !each->IsAtEnd(); each->Next())
  {
    vtkSMProxy* shown = each->GetProxy();
    const vtkSMProxy* source = vtkSMPropertyHelper(shown, "Input", true).GetAsProxy();
    if (source && source != filter && source != hidden &&
        vtkSMPropertyHelper(shown, "Visibility", true).GetAsInt() != 0 &&
        vtkSMPropertyHelper(shown, "LookupTable", true).GetAsProxy() == map)
    {
      return true;
    }
  }
  return false;
}

/// Gives a new map the colors of an array.
void SetColors(vtkSMProxy* map, vtkPVArrayInformation* array, Colors colors)
{
  const bool isMagnitude = array->GetNumberOfComponents() > 1;
  const bool hasNegative = !isMagnitude && array->GetComponentFiniteRange(0)[0] < 0.0;
  if (colors == Colors::Categorical)
  {
    gridfem::SetCategories(map, array->GetComponentFiniteRange(0)[1] > 7.0);
  }
  else if (colors == Colors::Stripes && !hasNegative)
  {
    gridfem::SetStripes(map);
  }
  else if (isMagnitude || (colors == Colors::Sequential && !hasNegative))
  {
    vtkSMTransferFunctionProxy::ApplyPreset(map, gridfem::ViridisPreset(), true);
  }
}

/// Follows the arrays of one filter.
class ArrayFollower
{
public:
  ArrayFollower(vtkSMSourceProxy* filter, Choice choice)
    : filter_(filter), choice_(std::move(choice))
  {
  }

  /// Notes that the filter has other properties than in its last run.
  void NoteChange(const char* property)
  {
    vtkSMProperty* changed = filter_ && property ? filter_->GetProperty(property) : nullptr;
    hasChanged_ = hasChanged_ || (changed && !changed->GetInformationOnly());
  }

  /// Fits the ranges of the maps to the data of the last run.
  void FitRanges()
  {
    const bool grows = !hasChanged_ && !choice_.stepsApart && this->GetTime() != time_;
    for (vtkPVArrayInformation* array : this->Arrays())
    {
      vtkSMProxy* map = filter_->GetSessionProxyManager()->GetProxy(
        "lookup_tables", (array->GetName() + std::string(MapEnding)).c_str());
      const Range wanted = WantedRange(array, choice_);
      if (map && wanted.IsKnown() && HasOurRange(map, choice_.limit > 0.0))
      {
        SetRange(map, wanted, grows || IsUsedElsewhere(map, filter_));
      }
    }
    hasChanged_ = false;
    time_ = this->GetTime();
  }

  /// Called with the name of each color map as it is made.
  /// @return  whether the filter is gone
  bool Color(const std::string& name, vtkSMProxy* map)
  {
    if (!filter_)
    {
      return true;
    }
    for (vtkPVArrayInformation* array : this->Arrays())
    {
      if (name == array->GetName() + std::string(MapEnding) && !UserHasColors(array->GetName()))
      {
        SetColors(map, array, choice_.colors);
        const Range wanted = WantedRange(array, choice_);
        if (wanted.IsKnown())
        {
          SetRange(map, wanted, false);
        }
        if (choice_.limit > 0.0)
        {
          vtkSMPropertyHelper(map, "AutomaticRescaleRangeMode")
            .Set(vtkSMTransferFunctionManager::NEVER);
          map->UpdateVTKObjects();
        }
      }
    }
    return false;
  }

private:
  double GetTime() const { return filter_->GetDataInformation(choice_.port)->GetTime(); }

  /// The arrays that fit, with points before cells: a map serves both arrays of a name.
  std::vector<vtkPVArrayInformation*> Arrays() const
  {
    std::vector<vtkPVArrayInformation*> found;
    vtkPVDataInformation* data = filter_->GetDataInformation(choice_.port);
    for (int association : { vtkDataObject::POINT, vtkDataObject::CELL })
    {
      vtkPVDataSetAttributesInformation* all =
        data ? data->GetAttributeInformation(association) : nullptr;
      for (int k = 0; all && k < all->GetNumberOfArrays(); ++k)
      {
        vtkPVArrayInformation* array = all->GetArrayInformation(k);
        const bool isKnown = std::any_of(found.begin(), found.end(),
          [array](auto* other)
          { return array->GetName() && array->GetName() == std::string(other->GetName()); });
        if (array->GetName() && !isKnown && choice_.Fits(array->GetName()))
        {
          found.push_back(array);
        }
      }
    }
    return found;
  }

  vtkWeakPointer<vtkSMSourceProxy> filter_;
  Choice choice_;
  double time_ = 0.0;
  bool hasChanged_ = true;
};

class vtkSMArrayColors : public vtkSMProxyInitializationHelper
{
public:
  static vtkSMArrayColors* New();
  vtkTypeMacro(vtkSMArrayColors, vtkSMProxyInitializationHelper);

  void PostInitializeProxy(vtkSMProxy* proxy, vtkPVXMLElement* xml, vtkMTimeType) override
  {
    Choice choice;
    const std::string colors = xml->GetAttributeOrEmpty("colors");
    choice.array = xml->GetAttributeOrEmpty("array");
    xml->GetScalarAttribute("port", &choice.port);
    xml->GetScalarAttribute("limit", &choice.limit);
    choice.stepsApart = xml->GetAttributeOrEmpty("steps") == std::string("apart");
    choice.colors = colors == "sequential"    ? Colors::Sequential
                    : colors == "stripes"     ? Colors::Stripes
                    : colors == "categorical" ? Colors::Categorical
                                              : Colors::Diverging;
    if (choice.colors == Colors::Stripes && gridfem::HasWindow())
    {
      gridfem::OfferStripes();
    }
    const auto follower =
      std::make_shared<ArrayFollower>(vtkSMSourceProxy::SafeDownCast(proxy), choice);
    gridfem::Watch(proxy, vtkCommand::PropertyModifiedEvent,
      [follower](void* name)
      {
        follower->NoteChange(static_cast<const char*>(name));
        return false;
      });
    gridfem::Watch(proxy, vtkCommand::UpdateDataEvent,
      [follower](void*)
      {
        follower->FitRanges();
        return false;
      });
    gridfem::Watch(proxy->GetSessionProxyManager(), vtkCommand::RegisterEvent,
      [follower](void* data)
      {
        const auto* made = static_cast<vtkSMProxyManager::RegisteredProxyInformation*>(data);
        return made->Proxy && made->ProxyName && made->GroupName && // links have no group
               made->GroupName == std::string("lookup_tables") &&
               follower->Color(made->ProxyName, made->Proxy);
      });
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

bool gridfem::HasRangeOfHint(vtkSMProxy* map)
{
  return map && map->GetAnnotation(RangeNote);
}

void gridfem::RegisterArrayColors()
{
  vtkClientServerInterpreterInitializer::GetInitializer()->RegisterCallback(AddToInterpreter);
}
