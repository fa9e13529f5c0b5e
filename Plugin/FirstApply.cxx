#include "FirstApply.h"

#include "ColorsLater.h"
#include "Hints.h"
#include "Views.h"
#include "Watch.h"

#include "vtkCommand.h"
#include "vtkNew.h"
#include "vtkPVXMLElement.h"
#include "vtkSMAnimationSceneProxy.h"
#include "vtkSMParaViewPipelineController.h"
#include "vtkSMPropertyHelper.h"
#include "vtkSMProxySelectionModel.h"
#include "vtkSMSessionProxyManager.h"
#include "vtkSMSourceProxy.h"
#include "vtkSMViewProxy.h"
#include "vtkWeakPointer.h"

#include <algorithm>
#include <string>
#include <vector>

namespace
{

using gridfem::HasWindow;
using gridfem::HintsOf;
using gridfem::ViewsOf;
using gridfem::Watch;
using gridfem::WhenFirstShown;

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

/// A new view becomes active before it shows anything. Another view stays active only if it is
/// activated later. So this waits for the first data of the representation.
void OpenBeside(vtkSMSourceProxy* filter, int port)
{
  WhenFirstShown(filter, port,
    [](vtkSMProxy* chart, const vtkWeakPointer<vtkSMSourceProxy>& kept)
    {
      Watch(chart, vtkCommand::UpdateDataEvent,
        [kept](void*)
        {
          if (kept)
          {
            ActivateFirstPort(kept);
            gridfem::FitCameras(kept);
          }
          return true;
        });
    });
}

std::vector<double> TimeSteps(vtkSMProxy* proxy)
{
  return vtkSMPropertyHelper(proxy, "TimestepValues", true).GetDoubleArray();
}

void ShowLastStep(vtkSMProxy* filter)
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

/// Lines as wide as a pixel vanish in the surface that they lie in.
void DrawTubes(vtkSMSourceProxy* filter, int port)
{
  WhenFirstShown(filter, port,
    [](vtkSMProxy* lines, vtkSMSourceProxy*)
    {
      constexpr double Width = 6.0; // pixels
      vtkSMPropertyHelper(lines, "LineWidth", true).Set(Width);
      vtkSMPropertyHelper(lines, "RenderLinesAsTubes", true).Set(1);
      lines->UpdateVTKObjects();
    });
  WhenFirstShown(filter, 0,
    [](vtkSMProxy* surface, vtkSMSourceProxy*)
    {
      constexpr double Opacity = 0.5;
      vtkSMPropertyHelper(surface, "Opacity", true).Set(Opacity);
      surface->UpdateVTKObjects();
    });
}

/// Puts the views in order again when a filter is deleted that has changed them. A state has its
/// representations before its filters, so that these bring the filter.
void RestoreViews(vtkSMProxy* shown)
{
  const vtkSMPropertyHelper input(shown, "Input", true);
  const vtkWeakPointer<vtkSMSourceProxy> filter =
    vtkSMSourceProxy::SafeDownCast(input.GetNumberOfElements() == 1 ? input.GetAsProxy() : nullptr);
  if (!filter || !HasWindow())
  {
    return;
  }
  const int port = static_cast<int>(input.GetOutputPort());
  const auto names = [&filter, port](const char* name)
  {
    const auto hints = HintsOf(filter, name);
    return std::any_of(
      hints.begin(), hints.end(), [port](vtkPVXMLElement* hint) { return PortOf(hint) == port; });
  };
  const bool opens = names("OpensBeside");
  if (opens || names("FitsCameras"))
  {
    Watch(shown, vtkCommand::UpdateDataEvent,
      [filter, port, opens](void*)
      {
        if (filter && opens)
        {
          gridfem::CloseWithFilter(filter, port);
        }
        else if (filter)
        {
          gridfem::FitCamerasWithout(filter);
        }
        return true;
      });
  }
}

void SetTitle(vtkSMProxy* view, const char* property, const std::string& title)
{
  vtkSMPropertyHelper present(view, property, true);
  const char* text = present.GetNumberOfElements() == 1 ? present.GetAsString() : "none";
  if (!text || !*text)
  {
    present.Set(title.c_str());
  }
}

/// Gives the axes of a new chart their titles. The chart of a state has those of the user.
void SetTitles(vtkSMProxy* chart, vtkPVXMLElement* hint)
{
  if (chart->GetSessionProxyManager()->GetInLoadXMLState())
  {
    return;
  }
  const std::string bottom = hint->GetAttributeOrEmpty("bottom");
  const std::string left = hint->GetAttributeOrEmpty("left");
  Watch(chart, vtkCommand::UpdateDataEvent,
    [chart, bottom, left](void*)
    {
      for (unsigned int k = 0; k < chart->GetNumberOfConsumers(); ++k)
      {
        if (auto* view = vtkSMViewProxy::SafeDownCast(chart->GetConsumerProxy(k)))
        {
          SetTitle(view, "BottomAxisTitle", bottom);
          SetTitle(view, "LeftAxisTitle", left);
          view->UpdateVTKObjects();
        }
      }
      return true;
    });
}

} // namespace

void gridfem::AwaitFirstApply(vtkSMSourceProxy* filter)
{
  for (vtkPVXMLElement* hint : HintsOf(filter, "OpensBeside"))
  {
    OpenBeside(filter, PortOf(hint));
  }
  for (vtkPVXMLElement* hint : HintsOf(filter, "DrawsTubes"))
  {
    DrawTubes(filter, PortOf(hint));
  }
  for (vtkPVXMLElement* hint : HintsOf(filter, "FitsCameras"))
  {
    WhenFirstShown(filter, PortOf(hint),
      [](vtkSMProxy*, vtkSMSourceProxy* shown) { gridfem::FitCameras(shown); });
  }
  for (vtkPVXMLElement* hint : HintsOf(filter, "ColorsLater"))
  {
    ColorFirst(filter, hint);
  }
  if (!HintsOf(filter, "ShowsLastStep").empty())
  {
    Watch(filter, vtkCommand::UpdateDataEvent,
      [filter](void*)
      {
        ShowLastStep(filter);
        return true;
      });
  }
}

void gridfem::RegisterFirstApply()
{
  WhenRegistered("sources",
    [](vtkSMProxy* proxy)
    {
      auto* filter = vtkSMSourceProxy::SafeDownCast(proxy);
      for (vtkPVXMLElement* hint : HintsOf(proxy, "ColorsLater"))
      {
        ReplaceLostColors(filter, hint);
      }
    });
  WhenRegistered("representations",
    [](vtkSMProxy* shown)
    {
      RestoreViews(shown);
      for (vtkPVXMLElement* hint : HintsOf(shown, "AxisTitles"))
      {
        SetTitles(shown, hint);
      }
    });
}
