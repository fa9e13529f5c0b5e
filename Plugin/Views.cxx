#include "Views.h"

#include "Watch.h"

#include "vtkCommand.h"
#include "vtkNew.h"
#include "vtkSMParaViewPipelineController.h"
#include "vtkSMPropertyHelper.h"
#include "vtkSMProxyManager.h"
#include "vtkSMProxySelectionModel.h"
#include "vtkSMRenderViewProxy.h"
#include "vtkSMSessionProxyManager.h"
#include "vtkSMSourceProxy.h"
#include "vtkSMViewLayoutProxy.h"
#include "vtkSMViewProxy.h"
#include "vtkWeakPointer.h"

#include <string>
#include <vector>

namespace
{

std::vector<int> SizeOf(vtkSMProxy* view)
{
  return vtkSMPropertyHelper(view, "ViewSize", true).GetIntArray();
}

bool ShowsNothing(vtkSMViewProxy* view)
{
  const vtkSMPropertyHelper shown(view, "Representations", true);
  for (unsigned int k = 0; k < shown.GetNumberOfElements(); ++k)
  {
    if (shown.GetAsProxy(k) && shown.GetAsProxy(k)->GetProperty("Input"))
    {
      return false;
    }
  }
  return true;
}

/// Takes a view out of its layout and removes it. Another view of the layout becomes active.
void CloseView(vtkSMViewProxy* view)
{
  vtkSMViewLayoutProxy* layout = vtkSMViewLayoutProxy::FindLayout(view);
  const int location = layout ? layout->RemoveView(view) : -1;
  vtkSMSessionProxyManager* proxies = view->GetSessionProxyManager();
  vtkNew<vtkSMParaViewPipelineController> controller;
  controller->UnRegisterProxy(view);
  if (location >= 0)
  {
    layout->Collapse(location);
    const std::vector<vtkSMViewProxy*> left = layout->GetViews();
    vtkSMProxySelectionModel* active = proxies->GetSelectionModel("ActiveView");
    if (active && !active->GetCurrentProxy() && !left.empty())
    {
      active->SetCurrentProxy(left.front(), vtkSMProxySelectionModel::CLEAR_AND_SELECT);
    }
  }
}

void FitWhenDrawn(vtkSMViewProxy* view)
{
  auto* drawn = vtkSMRenderViewProxy::SafeDownCast(view);
  if (!drawn)
  {
    return;
  }
  gridfem::Watch(drawn, vtkCommand::StartEvent,
    [drawn, size = SizeOf(drawn), draws = 0](void*) mutable
    {
      constexpr int MostDraws = 3; // the window gives views their sizes after the first drawing
      drawn->ResetCamera();
      return ++draws == MostDraws || SizeOf(drawn) != size;
    });
}

/// Calls a function for each view that shows a port of a filter, when the filter is deleted. Views
/// that are closed before do not count.
void WhenDeleted(vtkSMSourceProxy* filter, int port, void (*act)(vtkSMViewProxy* view))
{
  const vtkWeakPointer<vtkSMSourceProxy> kept = filter;
  for (const auto& [view, shown] : gridfem::ViewsOf(filter, port))
  {
    const vtkWeakPointer<vtkSMViewProxy> left = view;
    gridfem::Watch(filter->GetSessionProxyManager(), vtkCommand::UnRegisterEvent,
      [kept, left, act](void* data)
      {
        const auto* gone = static_cast<vtkSMProxyManager::RegisteredProxyInformation*>(data);
        const bool isGone =
          !kept || (gone->Proxy == kept && gone->GroupName == std::string("sources"));
        if (isGone && left)
        {
          act(left);
        }
        return isGone || !left;
      });
  }
}

} // namespace

void gridfem::FitCameras(vtkSMSourceProxy* filter)
{
  for (const auto& [view, shown] : ViewsOf(filter, 0))
  {
    FitWhenDrawn(view);
  }
}

void gridfem::FitCamerasWithout(vtkSMSourceProxy* filter)
{
  WhenDeleted(filter, 0, FitWhenDrawn);
}

void gridfem::CloseWithFilter(vtkSMSourceProxy* filter, int port)
{
  WhenDeleted(filter, port,
    [](vtkSMViewProxy* chart)
    {
      if (ShowsNothing(chart))
      {
        CloseView(chart);
      }
    });
}
