// Makes choices for a new filter that a user sees and can change before the first Apply. The XML of
// the filter needs these hints:
//
//   <Hints>
//     <InitializationHelper class="vtkSMChoosesArray" property="ValueArray"
//       otherwise="ScreeningWeight" value="10000" />
//     <InitializationHelper class="vtkSMChoosesNumber" property="Depth" value="5" />
//     <InitializationHelper class="vtkSMChoosesPoints" property="KnownValues" />
//   </Hints>
//
//   vtkSMChoosesArray   the property takes the array that colors the input in its view, or else the
//                       only array that the property offers. Normals, texture coordinates and ids
//                       are no candidates. If there is none, the property `otherwise` gets the
//                       value, which suits the shape
//   vtkSMChoosesNumber  the property gets the value
//   vtkSMChoosesPoints  a table of points and values gets an example: four points spread over the
//                       numbers of the points, with the values 0 to 3. Only for polygonal data
//
// Without ParaView's window nothing is chosen, because scripts make their own choices. Values that
// the user has saved as defaults also stay.
#ifndef GridFEM_FirstChoices_h
#define GridFEM_FirstChoices_h

namespace gridfem
{

/// Registers the classes under the names that hints use. The plugin calls it when it is loaded.
void RegisterFirstChoices();

} // namespace gridfem

#endif
