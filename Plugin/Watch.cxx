#include "Watch.h"

#include "vtkCommand.h"
#include "vtkNew.h"
#include "vtkSMPropertyHelper.h"
#include "vtkSMProxyIterator.h"
#include "vtkSMProxyManager.h"
#include "vtkSMRepresentationProxy.h"
#include "vtkSMSessionProxyManager.h"
#include "vtkSMSourceProxy.h"
#include "vtkSMViewProxy.h"

#include <string>

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

} // namespace

namespace gridfem
{

void Watch(vtkObject* object, unsigned long event, std::function<bool(void*)> isDone)
{
  vtkNew<Watcher> watcher;
  watcher->IsDone = std::move(isDone);
  object->AddObserver(event, watcher);
}

bool HasWindow()
{
  return vtkSMProxyManager::GetProxyManager()->GetUndoStackBuilder() != nullptr;
}

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

bool ShowsPort(vtkSMProxy* representation, vtkSMSourceProxy* filter, int port)
{
  const vtkSMPropertyHelper input(representation, "Input", true);
  return input.GetNumberOfElements() == 1 && input.GetAsProxy() == filter &&
         static_cast<int>(input.GetOutputPort()) == port;
}

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

void WhenFirstShown(
  vtkSMProxy* proxy, int port, std::function<void(vtkSMProxy* shown, vtkSMSourceProxy* filter)> act)
{
  const vtkWeakPointer<vtkSMSourceProxy> filter = vtkSMSourceProxy::SafeDownCast(proxy);
  Watch(proxy, vtkCommand::UpdateDataEvent,
    [filter, port, act = std::move(act)](void*)
    {
      WhenShown(filter, port, [filter, act](vtkSMProxy* shown) { act(shown, filter); });
      return true;
    });
}

} // namespace gridfem
