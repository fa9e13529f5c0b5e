// Effects of the first Apply of a filter, other than colors (ArrayColors.h). The XML of the filter
// needs these hints:
//
//   <Hints>
//     <InitializationHelper class="vtkSMOpensBeside" port="1" />
//     <InitializationHelper class="vtkSMShowsLastStep" />
//     <InitializationHelper class="vtkSMDrawsTubes" port="1" />
//     <InitializationHelper class="vtkSMFitsCameras" port="1" />
//     <InitializationHelper class="vtkSMColorsLater" array="StitchedColors" direct="fractions" />
//   </Hints>
//
//   vtkSMOpensBeside    the first Apply opens a view for this port beside the view of port 0. The
//                       view of port 0 stays active, so it also shows the next filter. Its camera
//                       is fitted. The new view is closed with the filter
//   vtkSMShowsLastStep  the first Apply goes to the last of the filter's time steps, unless another
//                       source has time steps that would change with it
//   vtkSMDrawsTubes     the first Apply shows the lines of this port as tubes, and port 0 half
//                       transparent, so that lines on its far side are seen as well
//   vtkSMFitsCameras    the first Apply fits the camera to port 0 and to this port, which lies
//                       beside it. The camera is fitted again when the filter is deleted
//   vtkSMColorsLater    the array colors port 0 as soon as port 0 has it, or has lost the array
//                       that colored it. ParaView looks only once, when it first shows a filter,
//                       and the user may choose arrays later. The user's own coloring stays. With
//                       direct="bytes", three or four bytes are shown directly as colors, without a
//                       bar. With direct="fractions", numbers from 0 to 1 are shown like this
//
// The XML of a chart has the hint:
//
//     <InitializationHelper class="vtkSMAxisTitles" bottom="Mode" left="Eigenvalue" />
//
//   vtkSMAxisTitles     axes without a title get these titles when the chart is first drawn
//
// Only the last hint also acts without ParaView's window, because scripts choose their views.
#ifndef GridFEM_FirstApply_h
#define GridFEM_FirstApply_h

namespace gridfem
{

/// Registers the classes under the names that hints use. The plugin calls it when it is loaded.
void RegisterFirstApply();

} // namespace gridfem

#endif
