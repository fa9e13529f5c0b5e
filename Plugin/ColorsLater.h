// Colors a port of a filter by an array that it gets later than the first picture, as the hint
// ColorsLater of its XML asks for (FirstApply.h).
#ifndef GridFEM_ColorsLater_h
#define GridFEM_ColorsLater_h

class vtkPVXMLElement;
class vtkSMSourceProxy;

namespace gridfem
{

/// Colors pictures without colors as soon as the array is there. For a filter that the user has
/// just made.
void ColorFirst(vtkSMSourceProxy* filter, vtkPVXMLElement* hint);

/// Colors pictures by the array when the filter has lost the array that colored them, and shows the
/// array directly as soon as its values are colors. Only in ParaView's window.
void ReplaceLostColors(vtkSMSourceProxy* filter, vtkPVXMLElement* hint);

} // namespace gridfem

#endif
