// Chooses suitable colors for an array of a filter. The XML of the filter needs this hint:
//
//   <Hints>
//     <ArrayColors array="Mode" colors="diverging" steps="apart" />
//   </Hints>
//
// `array` is a point or cell array of port 0, without the prefix of results, or of the port in the
// attribute `port`. A name that ends in * stands for all arrays that begin with it. The `colors`:
//   diverging    ParaView's default colors, with 0 always in the middle
//   sequential   from dark to light; diverging if some values are below 0
//   stripes      the same in stripes, for distances
//   categorical  one color for each whole number: pale for 0 to 7, dark for 8 to 15
// With limit="4", the range never exceeds -4 to 4, so that a few extremes do not pale the rest.
// An array with several components is only given its colors, for its magnitude.
//
// ParaView has one color map for all arrays of a name. This class gives the map its colors when the
// map is made, unless the user has saved colors for this name. After every Apply the range is the
// range of the filter's data, symmetric about 0 if 0 is in the middle. It only grows while another
// visible representation uses the map, and from one time step to the next; with steps="apart",
// every time step has its own range. A range that comes from elsewhere is the user's and stays.
//
// It makes no difference whether the window, a script, a state or undo brings the filter.
#ifndef GridFEM_ArrayColors_h
#define GridFEM_ArrayColors_h

class vtkSMProxy;

namespace gridfem
{

/// Whether the range of a color map has been given by a filter's hint.
bool HasRangeOfHint(vtkSMProxy* map);

/// Begins to follow filters with the hint. The plugin calls it when it is loaded.
void RegisterArrayColors();

} // namespace gridfem

#endif
