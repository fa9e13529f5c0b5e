// Makes choices for a new filter that a user sees and can change before the first Apply. The XML of
// the filter needs these hints:
//
//   <Hints>
//     <ChoosesArray property="ValueArray" otherwise="ScreeningWeight" value="10000" />
//     <ChoosesNumber property="Depth" value="5" />
//     <ChoosesPoints property="KnownValues" />
//   </Hints>
//
//   ChoosesArray   the property takes the array that colors the input in its view, or else the only
//                  array that the property offers. Normals, texture coordinates and ids are no
//                  candidates. If there is none, the property `otherwise` gets the value, which
//                  suits the shape
//   ChoosesNumber  the property gets the value
//   ChoosesPoints  a table of points and values gets an example: four points spread over the ids,
//                  with the values 0 to 3. Only for polygonal data
//
// Only filters that the user makes in ParaView's window get these choices. Scripts, macros and
// states make their own choices, in the window as well. Values that the user has saved as defaults
// stay.
#ifndef GridFEM_FirstChoices_h
#define GridFEM_FirstChoices_h

class vtkSMProxy;

namespace gridfem
{

/// Makes the choices for a filter that the user has just made. A recorded trace gets them as well.
void MakeFirstChoices(vtkSMProxy* filter);

} // namespace gridfem

#endif
