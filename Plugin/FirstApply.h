// What a filter shows by itself, beyond its colours (ArrayColors.h). In the XML of the filter:
//
//   <Hints>
//     <InitializationHelper class="vtkSMOpensBeside" port="1" />
//     <InitializationHelper class="vtkSMShowsLastStep" />
//     <InitializationHelper class="vtkSMColorsLater" array="StitchedColors" direct="fractions" />
//     <InitializationHelper class="vtkSMShowsEdges" most="20000" />
//   </Hints>
//
//   vtkSMOpensBeside    the view that opens for this port at the first Apply stands beside that of
//                       port 0, which stays the active one: what the next filter makes comes there
//   vtkSMShowsLastStep  the first Apply goes to the last of the filter's time steps, where no other
//                       source has time steps that would move with it
//   vtkSMColorsLater    port 0 is coloured by the array as soon as it has it. ParaView looks once,
//                       when it shows a filter, which may be before its arrays were chosen. Colours
//                       of the user are left alone. direct="bytes" shows three or four bytes as the
//                       colors they are, without a bar; "fractions" does the same for numbers from
//                       0 to 1, too
//   vtkSMShowsEdges     port 0 is a surface with edges when it is first shown, where it has no more
//                       cells than this: more edges hide the colours
//
// and in that of a chart:
//
//     <InitializationHelper class="vtkSMAxisTitles" bottom="Mode" left="Eigenvalue" />
//
//   vtkSMAxisTitles     the axes that have no title when the chart is first drawn get these
//
// Only the last also acts without ParaView's window: scripts say themselves what they show.
#ifndef GridFEM_FirstApply_h
#define GridFEM_FirstApply_h

namespace gridfem
{

/// Makes the classes known by which hints call them; for the plugin, when it is loaded.
void RegisterFirstApply();

} // namespace gridfem

#endif
