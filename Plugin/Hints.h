// Finds the hints that the XML of filters and charts has for this plugin.
#ifndef GridFEM_Hints_h
#define GridFEM_Hints_h

#include <functional>
#include <string>
#include <vector>

class vtkPVXMLElement;
class vtkSMProxy;

namespace gridfem
{

/// The hints with a name, in the order of the XML.
std::vector<vtkPVXMLElement*> HintsOf(vtkSMProxy* proxy, const char* name);

/// Calls a function with each proxy that is registered in a group, in any session. It does not
/// matter who makes the proxy: the window, a script, a state, or undo.
void WhenRegistered(const char* group, const std::function<void(vtkSMProxy*)>& act);

/// The name that a result has in port 0 of a filter: its prefix comes first.
std::string ResultName(vtkSMProxy* filter, const std::string& array);

} // namespace gridfem

#endif
