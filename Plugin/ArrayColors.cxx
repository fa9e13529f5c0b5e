#include "ArrayColors.h"

#include "ColorMaps.h"
#include "Hints.h"
#include "ParaViewVersions.h"
#include "Watch.h"

#include "vtkCommand.h"
#include "vtkDataObject.h"
#include "vtkNew.h"
#include "vtkPVArrayInformation.h"
#include "vtkPVDataInformation.h"
#include "vtkPVDataSetAttributesInformation.h"
#include "vtkPVXMLElement.h"
#include "vtkSMCoreUtilities.h"
#include "vtkSMProperty.h"
#include "vtkSMPropertyHelper.h"
#include "vtkSMProxyIterator.h"
#include "vtkSMProxyManager.h"
#include "vtkSMProxySelectionModel.h"
#include "vtkSMSessionProxyManager.h"
#include "vtkSMSettings.h"
#include "vtkSMSourceProxy.h"
#include "vtkSMTransferFunctionManager.h"
#include "vtkSMTransferFunctionProxy.h"
#include "vtkSMViewProxy.h"
#include "vtkWeakPointer.h"

#include <algorithm>
#include <cmath>
#include <limits>
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

/// The colors that a hint chooses for arrays.
struct Choice
{
  std::string array; // ends in *: all that begin so
  int port = 0;
  Colors colors = Colors::Diverging;
  bool stepsApart = false;
  double limit = 0.0; // values farther from 0 have the last color; 0: no limit

  explicit Choice(vtkPVXMLElement* hint)
  {
    const std::string name = hint->GetAttributeOrEmpty("colors");
    array = hint->GetAttributeOrEmpty("array");
    hint->GetScalarAttribute("port", &port);
    hint->GetScalarAttribute("limit", &limit);
    stepsApart = hint->GetAttributeOrEmpty("steps") == std::string("apart");
    colors = name == "sequential"    ? Colors::Sequential
             : name == "stripes"     ? Colors::Stripes
             : name == "categorical" ? Colors::Categorical
                                     : Colors::Diverging;
  }

  bool Fits(const std::string& name, vtkSMProxy* filter) const
  {
    const std::string wanted = port == 0 ? gridfem::ResultName(filter, array) : array;
    const bool isStart = !wanted.empty() && wanted.back() == '*';
    return isStart ? name.compare(0, wanted.size() - 1, wanted, 0, wanted.size() - 1) == 0
                   : name == wanted;
  }
};

struct Range
{
  double low = 0.0;
  double high = -1.0; // below low: no range

  bool IsKnown() const { return low <= high; }
};

/// The name of an array as ParaView uses it in the names of maps and settings.
std::string NameInMaps(vtkPVArrayInformation* array)
{
  return vtkSMCoreUtilities::SanitizeName(array->GetName());
}

/// The name under which the map of an array is registered.
std::string MapOf(vtkPVArrayInformation* array)
{
  return NameInMaps(array) + ".PVLookupTable";
}

bool UserHasColors(vtkPVArrayInformation* array)
{
  vtkSMSettings* settings = vtkSMSettings::GetInstance();
  return settings->HasSetting((".standard_presets." + NameInMaps(array)).c_str()) ||
         settings->HasSetting((".array_lookup_tables." + NameInMaps(array)).c_str());
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

/// Whether something visible uses a map, other than a filter. The first Apply will hide the input
/// of the filter in the active view.
bool IsUsedElsewhere(vtkSMProxy* map, vtkSMSourceProxy* filter)
{
  const vtkSMProxy* input = vtkSMPropertyHelper(filter, "Input", true).GetAsProxy();
  vtkSMSessionProxyManager* proxies = filter->GetSessionProxyManager();
  vtkSMProxySelectionModel* active = proxies->GetSelectionModel("ActiveView");
  const vtkSMProxy* applied =
    active && gridfem::ViewsOf(filter, 0).empty() ? active->GetCurrentProxy() : nullptr;
  vtkNew<vtkSMProxyIterator> each;
  each->SetSessionProxyManager(proxies);
  each->SetModeToOneGroup();
  for (each->Begin("representations"); !each->IsAtEnd(); each->Next())
  {
    vtkSMProxy* shown = each->GetProxy();
    const vtkSMProxy* source = vtkSMPropertyHelper(shown, "Input", true).GetAsProxy();
    if (source && source != filter &&
        vtkSMPropertyHelper(shown, "Visibility", true).GetAsInt() != 0 &&
        vtkSMPropertyHelper(shown, "LookupTable", true).GetAsProxy() == map &&
        !(source == input && applied && vtkSMViewProxy::FindView(shown) == applied))
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
  /// The ranges in a state fit its picture, and the filter that it brings has not changed.
  ArrayFollower(vtkSMSourceProxy* filter, Choice choice)
    : filter_(filter), choice_(std::move(choice)),
      hasChanged_(!filter->GetSessionProxyManager()->GetInLoadXMLState())
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
      vtkSMProxy* map =
        filter_->GetSessionProxyManager()->GetProxy("lookup_tables", MapOf(array).c_str());
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
      if (name == MapOf(array) && !UserHasColors(array))
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
  static constexpr double NotYet = std::numeric_limits<double>::lowest();

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
        if (array->GetName() && !isKnown && choice_.Fits(array->GetName(), filter_))
        {
          found.push_back(array);
        }
      }
    }
    return found;
  }

  vtkWeakPointer<vtkSMSourceProxy> filter_;
  Choice choice_;
  bool hasChanged_ = true;
  double time_ = NotYet; // of the last run
};

void Follow(vtkSMSourceProxy* filter, const Choice& choice)
{
  const auto follower = std::make_shared<ArrayFollower>(filter, choice);
  gridfem::Watch(filter, vtkCommand::PropertyModifiedEvent,
    [follower](void* name)
    {
      follower->NoteChange(static_cast<const char*>(name));
      return false;
    });
  gridfem::Watch(filter, vtkCommand::UpdateDataEvent,
    [follower](void*)
    {
      follower->FitRanges();
      return false;
    });
  gridfem::Watch(filter->GetSessionProxyManager(), vtkCommand::RegisterEvent,
    [follower](void* data)
    {
      const auto* made = static_cast<vtkSMProxyManager::RegisteredProxyInformation*>(data);
      return made->Proxy && made->ProxyName && made->GroupName && // links have no group
             made->GroupName == std::string("lookup_tables") &&
             follower->Color(made->ProxyName, made->Proxy);
    });
}

} // namespace

bool gridfem::HasRangeOfHint(vtkSMProxy* map)
{
  return map && map->GetAnnotation(RangeNote);
}

void gridfem::RegisterArrayColors()
{
  WhenRegistered("sources",
    [](vtkSMProxy* proxy)
    {
      auto* filter = vtkSMSourceProxy::SafeDownCast(proxy);
      for (vtkPVXMLElement* hint : HintsOf(proxy, "ArrayColors"))
      {
        const Choice choice(hint);
        if (choice.colors == Colors::Stripes && HasWindow())
        {
          OfferStripes();
        }
        if (filter)
        {
          Follow(filter, choice);
        }
      }
    });
}
