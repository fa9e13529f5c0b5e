// Calls functions at events in ParaView, and finds the views of a filter.
#ifndef GridFEM_Watch_h
#define GridFEM_Watch_h

#include "vtkWeakPointer.h"

#include <functional>
#include <utility>
#include <vector>

class vtkObject;
class vtkSMProxy;
class vtkSMSourceProxy;
class vtkSMViewProxy;

namespace gridfem
{

/// Calls a function at each event of a kind, until it returns true.
void Watch(vtkObject* object, unsigned long event, std::function<bool(void*)> isDone);

/// Whether ParaView's window is in use. Only there changes can be undone.
bool HasWindow();

/// The views that show a port of a source or filter, with their representations.
std::vector<std::pair<vtkSMViewProxy*, vtkSMProxy*>> ViewsOf(vtkSMSourceProxy* filter, int port);

bool ShowsPort(vtkSMProxy* representation, vtkSMSourceProxy* filter, int port);

/// Calls a function with the first representation of a port of a filter, before it is drawn.
void WhenShown(const vtkWeakPointer<vtkSMSourceProxy>& filter, int port,
  const std::function<void(vtkSMProxy*)>& act);

/// Does the same after the first data of the filter.
void WhenFirstShown(vtkSMProxy* proxy, int port,
  std::function<void(vtkSMProxy* shown, vtkSMSourceProxy* filter)> act);

} // namespace gridfem

#endif
