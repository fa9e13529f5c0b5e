#include "ColorsLater.h"

#include "ArrayColors.h"
#include "Hints.h"
#include "ParaViewVersions.h"
#include "Watch.h"

#include "vtkCommand.h"
#include "vtkDataObject.h"
#include "vtkPVArrayInformation.h"
#include "vtkPVDataInformation.h"
#include "vtkPVDataSetAttributesInformation.h"
#include "vtkPVXMLElement.h"
#include "vtkSMPropertyHelper.h"
#include "vtkSMSessionProxyManager.h"
#include "vtkSMSourceProxy.h"
#include "vtkSMViewProxy.h"
#include "vtkWeakPointer.h"

#include <optional>
#include <set>
#include <string>
#include <utility>

namespace
{

using gridfem::Coloring;
using gridfem::ViewsOf;
using gridfem::Watch;

/// The port of a hint.
int PortOf(vtkPVXMLElement* hint)
{
  int port = 0;
  hint->GetScalarAttribute("port", &port); // stays 0 without it
  return port;
}

/// The array of a hint in its port of the filter.
struct Found
{
  vtkPVArrayInformation* array = nullptr; // null: the filter has no such array
  int association = vtkDataObject::POINT;
  bool areColors = false; // its values are themselves colors
};

/// Whether the values of an array are themselves colors.
/// @param direct  "bytes", or "fractions": numbers from 0 to 1 as well
bool AreColors(vtkPVArrayInformation* array, const std::string& direct)
{
  const int components = array->GetNumberOfComponents();
  if (direct.empty() || (components != 3 && components != 4))
  {
    return false;
  }
  bool areFractions = direct == "fractions" &&
                      (array->GetDataType() == VTK_FLOAT || array->GetDataType() == VTK_DOUBLE);
  for (int c = 0; c < array->GetNumberOfComponents(); ++c)
  {
    const double* range = array->GetComponentRange(c);
    areFractions = areFractions && range[0] >= 0.0 && range[1] <= 1.0;
  }
  return areFractions || array->GetDataType() == VTK_UNSIGNED_CHAR;
}

Found Find(vtkSMSourceProxy* filter, vtkPVXMLElement* hint)
{
  const int port = PortOf(hint);
  const std::string array = hint->GetAttributeOrEmpty("array");
  const std::string name = port == 0 ? gridfem::ResultName(filter, array) : array;
  vtkPVDataInformation* data = filter->GetDataInformation(port);
  for (int association : { vtkDataObject::POINT, vtkDataObject::CELL })
  {
    vtkPVArrayInformation* found =
      data ? data->GetArrayInformation(name.c_str(), association) : nullptr;
    if (found)
    {
      return { found, association, AreColors(found, hint->GetAttributeOrEmpty("direct")) };
    }
  }
  return {};
}

using ArrayKey = std::pair<int, std::string>; // association and name

/// Adds the arrays that a port has now.
void NoteArrays(vtkSMSourceProxy* filter, int port, std::set<ArrayKey>& noted)
{
  vtkPVDataInformation* data = filter->GetDataInformation(port);
  for (int association : { vtkDataObject::POINT, vtkDataObject::CELL })
  {
    vtkPVDataSetAttributesInformation* all =
      data ? data->GetAttributeInformation(association) : nullptr;
    for (int k = 0; all && k < all->GetNumberOfArrays(); ++k)
    {
      const char* name = all->GetArrayInformation(k)->GetName();
      noted.emplace(association, name ? name : "");
    }
  }
}

/// Whether a port once had the array that colors a picture. A picture has arrays of its own, such
/// as the colors of blocks.
bool HasLostItsArray(
  vtkSMProxy* shown, vtkSMSourceProxy* filter, int port, const std::set<ArrayKey>& noted)
{
  const vtkSMPropertyHelper colors(shown, "ColorArrayName");
  const char* name = colors.GetInputArrayNameToProcess();
  const int association = colors.GetInputArrayAssociation();
  return noted.count({ association, name ? name : "" }) > 0 &&
         !filter->GetDataInformation(port)->GetArrayInformation(name, association);
}

bool IsColoredBy(vtkSMProxy* shown, vtkPVArrayInformation* array)
{
  return array->GetName() ==
         std::string(vtkSMPropertyHelper(shown, "ColorArrayName").GetInputArrayNameToProcess());
}

/// The user's setting. With 0, ParaView itself shows color bars.
bool ShowsColorBars(vtkSMSessionProxyManager* proxies)
{
  vtkSMProxy* settings = proxies->GetProxy("settings", "GeneralSettings");
  return settings && vtkSMPropertyHelper(settings, "ScalarBarMode", true).GetAsInt() == 0;
}

void ColorBy(vtkSMViewProxy* view, vtkSMProxy* shown, const Found& found)
{
  if (Coloring::GetUsingScalarColoring(shown))
  {
    Coloring::SetScalarBarVisibility(shown, view, false);
  }
  vtkSMPropertyHelper(shown, "MapScalars", true).Set(found.areColors ? 0 : 1);
  Coloring::SetScalarColoring(shown, found.array->GetName(), found.association);
  if (!gridfem::HasRangeOfHint(vtkSMPropertyHelper(shown, "LookupTable").GetAsProxy()))
  {
    Coloring::RescaleTransferFunctionToDataRange(shown, false, false);
  }
  if (!found.areColors && ShowsColorBars(shown->GetSessionProxyManager()))
  {
    Coloring::SetScalarBarVisibility(shown, view, true);
  }
}

void HideColorBar(const vtkWeakPointer<vtkSMProxy>& shown, vtkSMViewProxy* view)
{
  Watch(view, vtkCommand::StartEvent,
    [shown, view, draws = 0](void*) mutable
    {
      if (!shown || ++draws > 2)
      {
        return true;
      }
      const bool isThere = Coloring::IsScalarBarVisible(shown, view);
      if (isThere)
      {
        Coloring::SetScalarBarVisibility(shown, view, false);
      }
      return isThere;
    });
}

/// ParaView shows a color bar before or after it has drawn the data for the first time.
void ShowDirectly(vtkSMProxy* shown, const vtkWeakPointer<vtkSMSourceProxy>& filter, int port)
{
  Watch(shown, vtkCommand::UpdateDataEvent,
    [filter, port](void*)
    {
      if (filter)
      {
        for (const auto& [view, drawn] : ViewsOf(filter, port))
        {
          vtkSMPropertyHelper(drawn, "MapScalars", true).Set(0);
          drawn->UpdateVTKObjects();
          HideColorBar(drawn, view);
        }
      }
      return true;
    });
}

} // namespace

void gridfem::ColorFirst(vtkSMSourceProxy* filter, vtkPVXMLElement* hint)
{
  Watch(filter, vtkCommand::UpdateDataEvent,
    [filter, hint](void*)
    {
      const Found found = Find(filter, hint);
      if (!found.array)
      {
        return false;
      }
      const int port = PortOf(hint);
      const auto views = ViewsOf(filter, port);
      for (const auto& [view, shown] : views)
      {
        if (shown->GetProperty("ColorArrayName") && !Coloring::GetUsingScalarColoring(shown))
        {
          ColorBy(view, shown, found);
        }
      }
      if (found.areColors && views.empty())
      {
        const vtkWeakPointer<vtkSMSourceProxy> kept = filter;
        WhenShown(kept, port, [kept, port](vtkSMProxy* shown) { ShowDirectly(shown, kept, port); });
      }
      return true;
    });
}

void gridfem::ReplaceLostColors(vtkSMSourceProxy* filter, vtkPVXMLElement* hint)
{
  Watch(filter, vtkCommand::UpdateDataEvent,
    [filter, hint, noted = std::set<ArrayKey>(), were = std::optional<bool>()](void*) mutable
    {
      const int port = PortOf(hint);
      const Found found = HasWindow() ? Find(filter, hint) : Found();
      if (found.array)
      {
        const bool isOther = were && *were != found.areColors;
        for (const auto& [view, shown] : ViewsOf(filter, port))
        {
          if (Coloring::GetUsingScalarColoring(shown) &&
              (HasLostItsArray(shown, filter, port, noted) ||
                (isOther && IsColoredBy(shown, found.array))))
          {
            ColorBy(view, shown, found);
          }
        }
        were = found.areColors;
      }
      NoteArrays(filter, port, noted);
      return false;
    });
}
