#include "FirstApply.h"

#include "ParaViewVersions.h"

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
#include "vtkSMProxyIterator.h"
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

/// Calls a function at each event of a kind, until it returns true.
class Watcher : public vtkCommand
{
public:
  vtkTypeMacro(Watcher, vtkCommand);
  static Watcher* New() { return new Watcher; }

  void Execute(vtkObject* caller, unsigned long, void* data) override
  {
    if (this->IsBusy) // the function causes events as well
    {
      return;
    }
    this->IsBusy = true;
    if (this->IsDone(data))
    {
      caller->RemoveObserver(this);
    }
    this->IsBusy = false;
  }

  std::function<bool(void*)> IsDone;

private:
  bool IsBusy = false;
};

void Watch(vtkObject* object, unsigned long event, std::function<bool(void*)> isDone)
{
  vtkNew<Watcher> watcher;
  watcher->IsDone = std::move(isDone);
  object->AddObserver(event, watcher);
}

/// Whether ParaView's window is in use. Only there changes can be undone.
bool HasWindow()
{
  return vtkSMProxyManager::GetProxyManager()->GetUndoStackBuilder() != nullptr;
}

/// The views that show a port of a filter, with their representations.
std::vector<std::pair<vtkSMViewProxy*, vtkSMProxy*>> ViewsOf(vtkSMSourceProxy* filter, int port)
{
  std::vector<std::pair<vtkSMViewProxy*, vtkSMProxy*>> views;
  vtkNew<vtkSMProxyIterator> each;
  each->SetSessionProxyManager(filter->GetSessionProxyManager());
  each->SetModeToOneGroup();
  for (each->Begin("views"); !each->IsAtEnd(); each->Next())
  {
    auto* view = vtkSMViewProxy::SafeDownCast(each->GetProxy());
    vtkSMProxy* shown = view ? view->FindRepresentation(filter, port) : nullptr;
    if (shown && vtkSMPropertyHelper(shown, "Visibility", true).GetAsInt() != 0)
    {
      views.emplace_back(view, shown);
    }
  }
  return views;
}

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

bool ShowsPort(vtkSMProxy* representation, vtkSMSourceProxy* filter, int port)
{
  const vtkSMPropertyHelper input(representation, "Input", true);
  return input.GetNumberOfElements() == 1 && input.GetAsProxy() == filter &&
         static_cast<int>(input.GetOutputPort()) == port;
}

/// Calls a function with the first representation of a port of a filter, before it is drawn.
void WhenShown(const vtkWeakPointer<vtkSMSourceProxy>& filter, int port,
  const std::function<void(vtkSMProxy*)>& act)
{
  Watch(filter->GetSessionProxyManager(), vtkCommand::RegisterEvent,
    [filter, port, act](void* data)
    {
      if (!filter)
      {
        return true;
      }
      const auto* made = static_cast<vtkSMProxyManager::RegisteredProxyInformation*>(data);
      auto* representation = vtkSMRepresentationProxy::SafeDownCast(made->Proxy);
      // Axes around the data have the same input, and are registered earlier, among helpers.
      if (!representation || made->GroupName != std::string("representations") ||
          !ShowsPort(representation, filter, port))
      {
        return false;
      }
      act(representation);
      return true;
    });
}

/// Does the same after the first data of the filter, if ParaView has a window.
void WhenFirstShown(
  vtkSMProxy* proxy, int port, std::function<void(vtkSMProxy* shown, vtkSMSourceProxy* filter)> act)
{
  const vtkWeakPointer<vtkSMSourceProxy> filter = vtkSMSourceProxy::SafeDownCast(proxy);
  Watch(proxy, vtkCommand::UpdateDataEvent,
    [filter, port, act = std::move(act)](void*)
    {
      if (HasWindow())
      {
        WhenShown(filter, port, [filter, act](vtkSMProxy* shown) { act(shown, filter); });
      }
      return true;
    });
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
    int port = 1;
    xml->GetScalarAttribute("port", &port);
    WhenFirstShown(proxy, port, ReturnFrom);
  }

private:
  static void ReturnFrom(vtkSMProxy* chart, const vtkWeakPointer<vtkSMSourceProxy>& filter)
  {
    Watch(chart, vtkCommand::UpdateDataEvent,
      [filter](void*)
      {
        if (filter)
        {
          ActivateFirstPort(filter);
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
      [filter, name, direct](void*)
      {
        vtkPVDataInformation* data = filter ? filter->GetDataInformation(0) : nullptr;
        for (int association : { vtkDataObject::POINT, vtkDataObject::CELL })
        {
          vtkPVArrayInformation* array =
            data ? data->GetArrayInformation(name.c_str(), association) : nullptr;
          if (array)
          {
            if (HasWindow())
            {
              ColorBy(filter, array, association, AreColors(array, direct));
            }
            return true;
          }
        }
        return false;
      });
  }

private:
  /// The representation that shows the filter already. If ParaView's own choice is wrong, a later
  /// one.
  static void ColorBy(
    vtkSMSourceProxy* filter, vtkPVArrayInformation* array, int association, bool areColors)
  {
    const auto views = ViewsOf(filter, 0);
    for (const auto& [view, shown] : views)
    {
      if (shown->GetProperty("ColorArrayName") && !gridfem::Coloring::GetUsingScalarColoring(shown))
      {
        vtkSMPropertyHelper(shown, "MapScalars", true).Set(areColors ? 0 : 1);
        gridfem::Coloring::SetScalarColoring(shown, array->GetName(), association);
        gridfem::Coloring::RescaleTransferFunctionToDataRange(shown, false, false);
        if (!areColors && ShowsColorBars(filter->GetSessionProxyManager()))
        {
          gridfem::Coloring::SetScalarBarVisibility(shown, view, true);
        }
      }
    }
    if (areColors && views.empty())
    {
      const vtkWeakPointer<vtkSMSourceProxy> weak = filter;
      WhenShown(weak, 0, [weak](vtkSMProxy* shown) { ShowDirectly(shown, weak); });
    }
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

class vtkSMShowsEdges : public vtkSMProxyInitializationHelper
{
public:
  static vtkSMShowsEdges* New();
  vtkTypeMacro(vtkSMShowsEdges, vtkSMProxyInitializationHelper);

  void PostInitializeProxy(vtkSMProxy* proxy, vtkPVXMLElement* xml, vtkMTimeType) override
  {
    int most = 0;
    xml->GetScalarAttribute("most", &most);
    WhenFirstShown(proxy, 0,
      [most](vtkSMProxy* shown, vtkSMSourceProxy* filter) { ShowEdges(shown, filter, most); });
  }

private:
  static void ShowEdges(vtkSMProxy* shown, vtkSMSourceProxy* filter, vtkIdType most)
  {
    const vtkIdType cells = filter->GetDataInformation(0)->GetNumberOfCells();
    const vtkSMPropertyHelper type(shown, "Representation", true);
    if (type.GetNumberOfElements() == 1 && type.GetAsString() == std::string("Surface") &&
        cells > 0 && cells <= most)
    {
      vtkSMPropertyHelper(shown, "Representation").Set("Surface With Edges");
      shown->UpdateVTKObjects();
    }
  }
};

vtkStandardNewMacro(vtkSMShowsEdges);

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
  interpreter->AddNewInstanceFunction("vtkSMColorsLater", NewHelper<vtkSMColorsLater>);
  interpreter->AddNewInstanceFunction("vtkSMShowsEdges", NewHelper<vtkSMShowsEdges>);
  interpreter->AddNewInstanceFunction("vtkSMAxisTitles", NewHelper<vtkSMAxisTitles>);
}

} // namespace

void gridfem::RegisterFirstApply()
{
  vtkClientServerInterpreterInitializer::GetInitializer()->RegisterCallback(AddToInterpreter);
}
