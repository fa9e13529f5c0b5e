// Gives an array of a filter the colours that suit it. In the XML of the filter:
//
//   <Hints>
//     <InitializationHelper class="vtkSMArrayColors" array="Mode" colors="diverging" />
//   </Hints>
//
// `array` is a point or cell array of port 0 with one component. `colors` is one of
//   diverging    the colours that ParaView has by default, with 0 always in their middle
//   sequential   from dark to light; diverging where there are values below 0
//   categorical  one colour each for the whole numbers 0 to 7, pale, and 8 to 15, dark
//
// ParaView has one colour map for all arrays of a name. It is made here when the filter first has
// the array, unless there is one already or the user has saved one for this name. After that a
// range that lies evenly about 0 stays so when it grows with the data; any other is the user's, and
// left alone.
#ifndef GridFEM_ArrayColors_h
#define GridFEM_ArrayColors_h

namespace gridfem
{

/// Makes the class known by which hints call it; for the plugin, when it is loaded.
void RegisterArrayColors();

} // namespace gridfem

#endif
