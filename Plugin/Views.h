// Keeps ParaView's views in order when a filter opens a chart or moves the surface.
#ifndef GridFEM_Views_h
#define GridFEM_Views_h

class vtkSMProxy;
class vtkSMSourceProxy;
class vtkSMViewProxy;

namespace gridfem
{

/// Fits the camera of the views that show port 0 of a filter, when they are next drawn. The view
/// that a chart has made smaller is fitted at its new size.
void FitCameras(vtkSMSourceProxy* filter);

/// Fits the camera of these views again when the filter is deleted.
void FitCamerasWithout(vtkSMSourceProxy* filter);

/// Closes the view that shows a representation of a port when the filter is deleted, if nothing
/// else is in the view.
void CloseWithFilter(vtkSMSourceProxy* filter, int port);

} // namespace gridfem

#endif
