#include "FirstApply.h"

#include "ArrayColors.h"
#include "ParaViewVersions.h"
#include "Views.h"
#include "Watch.h"

#include "vtkClientServerInterpreter.h"
#include "vtkClientServerInterpreterInitializer.h"
#include "vtkCommand.h"
#include "vtkDataObject.h"
#include "vtkNew.h"
#include "vtkObjectFactory.h"
#include "vtkPVArrayInformation.h"
#include "vtkPVDataInformation.h"
#include "vtkPVXMLElement.h"
#include "vtkSMAnimationSceneProxy.h"
#include "vtkSMParaViewPipelineController.h"
#include "vtkSMPropertyHelper.h"
#include "vtkSMProxyInitializationHelper.h"
#include "vtkSMProxyManager.h"
#include "vtkSMProxySelectionModel.h"
#include "vtkSMRepresentationProxy.h"
#include "vtkSMSessionProxyManager.h"
#include "vtkSMSourceProxy.h"
#include "vtkSMViewProxy.h"
#include "vtkWeakPointer.h"

#include <functional>
#include <string>
#include <utility>
#include <vector>

namespace
{

using gridfem::HasWindow;
using gridfem::ShowsPort;
using gridfem::ViewsOf;
using gridfem::Watch;
using gridfem::WhenFirstShown;
using gridfem::WhenShown;

/// Activates a view that shows port 0.
void ActivateFirstPort(vtkSMSourceProxy* filter)
{
  vtkSMProxySelectionModel* active =
    filter->GetSessionProxyManager()->GetSelectionModel("ActiveView");
  const auto views = ViewsOf(filter, 0);
  if (active && !views.empty())
  {
    active->SetCurrentProxy(views.front().first, vtkSMProxySelectionModel::CLEAR_AND_SELECT);
  }
}

/// The port that a hint names.
int PortOf(vtkPVXMLElement* hint)
{
  int port = 1;
  hint->GetScalarAttribute("port", &port);
  return port;
}

class vtkSMOpensBeside : public vtkSMProxyInitializationHelper
{
public:
  static vtkSMOpensBeside* New();
  vtkTypeMacro(vtkSMOpensBeside, vtkSMProxyInitializationHelper);

  /// A new view becomes active before it shows anything. Another view stays active only if it is
  /// activated later. So this waits for the first data of the representation.
  void PostInitializeProxy(vtkSMProxy* proxy, vtkPVXMLElement* xml, vtkMTimeType) override
  {
    const int port = PortOf(xml);
    WhenFirstShown(proxy, port,
      [port](vtkSMProxy* chart, vtkSMSourceProxy* filter) { ReturnFrom(chart, filter, port); });
  }

private:
  static void ReturnFrom(
    vtkSMProxy* chart, const vtkWeakPointer<vtkSMSourceProxy>& filter, int port)
  {
    Watch(chart, vtkCommand::UpdateDataEvent,
      [filter, port](void*)
      {
        if (filter)
        {
          ActivateFirstPort(filter);
          gridfem::FitCameras(filter);
          gridfem::CloseWithFilter(filter, port);
        }
        return true;
      });
  }
};

vtkStandardNewMacro(vtkSMOpensBeside);

std::vector<double> TimeSteps(vtkSMProxy* proxy)
{
  return vtkSMPropertyHelper(proxy, "TimestepValues", true).GetDoubleArray();
}

class vtkSMShowsLastStep : public vtkSMProxyInitializationHelper
{
public:
  static vtkSMShowsLastStep* New();
  vtkTypeMacro(vtkSMShowsLastStep, vtkSMProxyInitializationHelper);

  void PostInitializeProxy(vtkSMProxy* proxy, vtkPVXMLElement*, vtkMTimeType) override
  {
    Watch(proxy, vtkCommand::UpdateDataEvent,
      [proxy](void*)
      {
        if (HasWindow())
        {
          ShowLastStep(proxy);
        }
        return true;
      });
  }

private:
  static void ShowLastStep(vtkSMProxy* filter)
  {
    vtkNew<vtkSMParaViewPipelineController> controller;
    vtkSMProxy* scene = controller->GetAnimationScene(filter->GetSession());
    if (!vtkSMAnimationSceneProxy::UpdateAnimationUsingDataTimeSteps(scene))
    {
      return;
    }
    const std::vector<double> steps = TimeSteps(filter);
    if (steps.size() > 1 && steps == TimeSteps(controller->FindTimeKeeper(filter->GetSession())))
    {
      vtkSMPropertyHelper(scene, "AnimationTime").Set(steps.back());
      scene->UpdateVTKObjects();
    }
  }
};

vtkStandardNewMacro(vtkSMShowsLastStep);

class vtkSMDrawsTubes : public vtkSMProxyInitializationHelper
{
public:
  static vtkSMDrawsTubes* New();
  vtkTypeMacro(vtkSMDrawsTubes, vtkSMProxyInitializationHelper);

  /// Lines as wide as a pixel vanish in the surface that they lie in.
  void PostInitializeProxy(vtkSMProxy* proxy, vtkPVXMLElement* xml, vtkMTimeType) override
  {
    WhenFirstShown(proxy, PortOf(xml),
      [](vtkSMProxy* lines, vtkSMSourceProxy*)
      {
        constexpr double Width = 6.0; // pixels
        vtkSMPropertyHelper(lines, "LineWidth", true).Set(Width);
        vtkSMPropertyHelper(lines, "RenderLinesAsTubes", true).Set(1);
        lines->UpdateVTKObjects();
      });
    WhenFirstShown(proxy, 0,
      [](vtkSMProxy* surface, vtkSMSourceProxy*)
      {
        constexpr double Opacity = 0.5;
        vtkSMPropertyHelper(surface, "Opacity", true).Set(Opacity);
        surface->UpdateVTKObjects();
      });
  }
};

vtkStandardNewMacro(vtkSMDrawsTubes);

class vtkSMFitsCameras : public vtkSMProxyInitializationHelper
{
public:
  static vtkSMFitsCameras* New();
  vtkTypeMacro(vtkSMFitsCameras, vtkSMProxyInitializationHelper);

  /// The data of the port lie beside the surface.
  void PostInitializeProxy(vtkSMProxy* proxy, vtkPVXMLElement* xml, vtkMTimeType) override
  {
    WhenFirstShown(proxy, PortOf(xml),
      [](vtkSMProxy*, vtkSMSourceProxy* filter)
      {
        gridfem::FitCameras(filter);
        gridfem::FitCamerasWithout(filter);
      });
  }
};

vtkStandardNewMacro(vtkSMFitsCameras);

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

class vtkSMColorsLater : public vtkSMProxyInitializationHelper
{
public:
  static vtkSMColorsLater* New();
  vtkTypeMacro(vtkSMColorsLater, vtkSMProxyInitializationHelper);

  void PostInitializeProxy(vtkSMProxy* proxy, vtkPVXMLElement* xml, vtkMTimeType) override
  {
    const std::string name = xml->GetAttributeOrEmpty("array");
    const std::string direct = xml->GetAttributeOrEmpty("direct");
    auto* filter = vtkSMSourceProxy::SafeDownCast(proxy);
    Watch(proxy, vtkCommand::UpdateDataEvent,
      [filter, name, direct, isFirst = true, wereColors = false](void*) mutable
      {
        vtkPVDataInformation* data = filter ? filter->GetDataInformation(0) : nullptr;
        for (int association : { vtkDataObject::POINT, vtkDataObject::CELL })
        {
          vtkPVArrayInformation* array =
            data && HasWindow() ? data->GetArrayInformation(name.c_str(), association) : nullptr;
          if (array)
          {
            const bool areColors = AreColors(array, direct);
            ColorBy(filter, array, association, areColors, isFirst, areColors != wereColors);
            isFirst = false;
            wereColors = areColors;
          }
        }
        return false;
      });
  }

private:
  /// The representation that shows the filter already, if it has no coloring yet, has lost its
  /// array, or its array has become colors. If ParaView's own choice is wrong, a later
  /// representation.
  static void ColorBy(vtkSMSourceProxy* filter, vtkPVArrayInformation* array, int association,
    bool areColors, bool isFirst, bool isOther)
  {
    const auto views = ViewsOf(filter, 0);
    for (const auto& [view, shown] : views)
    {
      const bool isColored = gridfem::Coloring::GetUsingScalarColoring(shown);
      if (shown->GetProperty("ColorArrayName") &&
          (isColored ? HasLostItsArray(shown, filter) || (isOther && IsColoredBy(shown, array))
                     : isFirst))
      {
        if (isColored)
        {
          gridfem::Coloring::SetScalarBarVisibility(shown, view, false);
        }
        vtkSMPropertyHelper(shown, "MapScalars", true).Set(areColors ? 0 : 1);
        gridfem::Coloring::SetScalarColoring(shown, array->GetName(), association);
        if (!gridfem::HasRangeOfHint(vtkSMPropertyHelper(shown, "LookupTable").GetAsProxy()))
        {
          gridfem::Coloring::RescaleTransferFunctionToDataRange(shown, false, false);
        }
        if (!areColors && ShowsColorBars(filter->GetSessionProxyManager()))
        {
          gridfem::Coloring::SetScalarBarVisibility(shown, view, true);
        }
      }
    }
    if (areColors && isFirst && views.empty())
    {
      const vtkWeakPointer<vtkSMSourceProxy> weak = filter;
      WhenShown(weak, 0, [weak](vtkSMProxy* shown) { ShowDirectly(shown, weak); });
    }
  }

  static bool IsColoredBy(vtkSMProxy* shown, vtkPVArrayInformation* array)
  {
    return array->GetName() ==
           std::string(vtkSMPropertyHelper(shown, "ColorArrayName").GetInputArrayNameToProcess());
  }

  static bool HasLostItsArray(vtkSMProxy* shown, vtkSMSourceProxy* filter)
  {
    const vtkSMPropertyHelper colors(shown, "ColorArrayName");
    return !filter->GetDataInformation(0)->GetArrayInformation(
      colors.GetInputArrayNameToProcess(), colors.GetInputArrayAssociation());
  }

  /// ParaView shows a color bar before or after it has drawn the data for the first time.
  static void ShowDirectly(vtkSMProxy* shown, const vtkWeakPointer<vtkSMSourceProxy>& filter)
  {
    Watch(shown, vtkCommand::UpdateDataEvent,
      [filter](void*)
      {
        if (filter)
        {
          for (const auto& [view, drawn] : ViewsOf(filter, 0))
          {
            vtkSMPropertyHelper(drawn, "MapScalars", true).Set(0);
            drawn->UpdateVTKObjects();
            HideColorBar(drawn, view);
          }
        }
        return true;
      });
  }

  static void HideColorBar(const vtkWeakPointer<vtkSMProxy>& shown, vtkSMViewProxy* view)
  {
    Watch(view, vtkCommand::StartEvent,
      [shown, view, draws = 0](void*) mutable
      {
        if (!shown || ++draws > 2)
        {
          return true;
        }
        const bool isThere = gridfem::Coloring::IsScalarBarVisible(shown, view);
        if (isThere)
        {
          gridfem::Coloring::SetScalarBarVisibility(shown, view, false);
        }
        return isThere;
      });
  }

  /// The user's setting. With 0, ParaView itself shows color bars.
  static bool ShowsColorBars(vtkSMSessionProxyManager* proxies)
  {
    vtkSMProxy* settings = proxies->GetProxy("settings", "GeneralSettings");
    return settings && vtkSMPropertyHelper(settings, "ScalarBarMode", true).GetAsInt() == 0;
  }
};

vtkStandardNewMacro(vtkSMColorsLater);

class vtkSMAxisTitles : public vtkSMProxyInitializationHelper
{
public:
  static vtkSMAxisTitles* New();
  vtkTypeMacro(vtkSMAxisTitles, vtkSMProxyInitializationHelper);

  void PostInitializeProxy(vtkSMProxy* proxy, vtkPVXMLElement* xml, vtkMTimeType) override
  {
    const std::string bottom = xml->GetAttributeOrEmpty("bottom");
    const std::string left = xml->GetAttributeOrEmpty("left");
    Watch(proxy, vtkCommand::UpdateDataEvent,
      [proxy, bottom, left](void*)
      {
        for (unsigned int k = 0; k < proxy->GetNumberOfConsumers(); ++k)
        {
          if (auto* view = vtkSMViewProxy::SafeDownCast(proxy->GetConsumerProxy(k)))
          {
            SetTitle(view, "BottomAxisTitle", bottom);
            SetTitle(view, "LeftAxisTitle", left);
            view->UpdateVTKObjects();
          }
        }
        return true;
      });
  }

private:
  static void SetTitle(vtkSMProxy* view, const char* property, const std::string& title)
  {
    vtkSMPropertyHelper present(view, property, true);
    const char* text = present.GetNumberOfElements() == 1 ? present.GetAsString() : "none";
    if (!text || !*text)
    {
      present.Set(title.c_str());
    }
  }
};

vtkStandardNewMacro(vtkSMAxisTitles);

template<class Helper>
vtkObjectBase* NewHelper(void*)
{
  return Helper::New();
}

void AddToInterpreter(vtkClientServerInterpreter* interpreter)
{
  interpreter->AddNewInstanceFunction("vtkSMOpensBeside", NewHelper<vtkSMOpensBeside>);
  interpreter->AddNewInstanceFunction("vtkSMShowsLastStep", NewHelper<vtkSMShowsLastStep>);
  interpreter->AddNewInstanceFunction("vtkSMDrawsTubes", NewHelper<vtkSMDrawsTubes>);
  interpreter->AddNewInstanceFunction("vtkSMFitsCameras", NewHelper<vtkSMFitsCameras>);
  interpreter->AddNewInstanceFunction("vtkSMColorsLater", NewHelper<vtkSMColorsLater>);
  interpreter->AddNewInstanceFunction("vtkSMAxisTitles", NewHelper<vtkSMAxisTitles>);
}

} // namespace

void gridfem::RegisterFirstApply()
{
  vtkClientServerInterpreterInitializer::GetInitializer()->RegisterCallback(AddToInterpreter);
}
