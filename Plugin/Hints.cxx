#include "Hints.h"

#include "Watch.h"

#include "vtkCommand.h"
#include "vtkPVXMLElement.h"
#include "vtkSMPropertyHelper.h"
#include "vtkSMProxy.h"
#include "vtkSMProxyManager.h"
#include "vtkSMSessionProxyManager.h"
#include "vtkWeakPointer.h"

#include <algorithm>
#include <memory>

namespace
{

/// Calls a function with the proxies of the active session, and of each that becomes active later.
void ForEachSession(const std::function<void(vtkSMSessionProxyManager*)>& act)
{
  using Known = std::vector<vtkWeakPointer<vtkSMSessionProxyManager>>;
  vtkSMProxyManager* sessions = vtkSMProxyManager::GetProxyManager();
  const auto meet = [sessions, act, known = std::make_shared<Known>()]
  {
    vtkSMSessionProxyManager* proxies = sessions->GetActiveSessionProxyManager();
    if (proxies && std::find(known->begin(), known->end(), proxies) == known->end())
    {
      known->emplace_back(proxies);
      act(proxies);
    }
  };
  meet();
  gridfem::Watch(sessions, vtkSMProxyManager::ActiveSessionChanged,
    [meet](void*)
    {
      meet();
      return false;
    });
}

} // namespace

std::vector<vtkPVXMLElement*> gridfem::HintsOf(vtkSMProxy* proxy, const char* name)
{
  std::vector<vtkPVXMLElement*> found;
  vtkPVXMLElement* hints = proxy->GetHints();
  for (unsigned int k = 0; hints && k < hints->GetNumberOfNestedElements(); ++k)
  {
    if (hints->GetNestedElement(k)->GetName() == std::string(name))
    {
      found.push_back(hints->GetNestedElement(k));
    }
  }
  return found;
}

void gridfem::WhenRegistered(const char* group, const std::function<void(vtkSMProxy*)>& act)
{
  const auto meet = [group = std::string(group), act](void* data)
  {
    const auto* made = static_cast<vtkSMProxyManager::RegisteredProxyInformation*>(data);
    if (made->Proxy && made->GroupName && made->GroupName == group) // links have no group
    {
      act(made->Proxy);
    }
    return false;
  };
  ForEachSession(
    [meet](vtkSMSessionProxyManager* proxies) { Watch(proxies, vtkCommand::RegisterEvent, meet); });
}

std::string gridfem::ResultName(vtkSMProxy* filter, const std::string& array)
{
  const vtkSMPropertyHelper prefix(filter, "ResultPrefix", true);
  const char* text = prefix.GetNumberOfElements() == 1 ? prefix.GetAsString() : nullptr;
  return text ? text + array : array;
}
