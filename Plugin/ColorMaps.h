// The colors that a color map gets when it is made.
#ifndef GridFEM_ColorMaps_h
#define GridFEM_ColorMaps_h

class vtkSMProxy;

namespace gridfem
{

/// Gives each whole number its color, with the range 0 to 7 or 0 to 15.
/// @param all  pale colors for 0 to 7 and dark ones for 8 to 15; else the pale ones only
void SetCategories(vtkSMProxy* map, bool all);

/// Gives the map twenty stripes from dark to light, every second one shaded, over its range.
void SetStripes(vtkSMProxy* map);

/// Adds the stripes to ParaView's presets, unless there is a preset with their name.
void OfferStripes();

} // namespace gridfem

#endif
