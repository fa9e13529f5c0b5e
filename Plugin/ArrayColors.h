// Chooses suitable colors for an array of a filter. The XML of the filter has the hint:
//
//   <Hints>
//     <InitializationHelper class="vtkSMArrayColors" array="Mode" colors="diverging" />
//   </Hints>
//
// `array` is a point or cell array of port 0 with one component. `colors` is one of
//   diverging    ParaView's default colors, with 0 always in the middle
//   sequential   from dark to light; diverging if some values are below 0
//   categorical  one color for each whole number: pale for 0 to 7, dark for 8 to 15
//
// ParaView has one color map for all arrays of a name. This class makes the map when the filter
// first has the array, unless a map exists or the user has saved a map for this name. Later the
// range grows with the data and stays symmetric about 0. Any other range is the user's and stays
// unchanged.
#ifndef GridFEM_ArrayColors_h
#define GridFEM_ArrayColors_h

namespace gridfem
{

/// Registers the class under the name that hints use. The plugin calls it when it is loaded.
void RegisterArrayColors();

} // namespace gridfem

#endif
