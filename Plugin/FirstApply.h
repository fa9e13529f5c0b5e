// Effects of the first Apply of a filter, other than colors (ArrayColors.h). The XML of the filter
// needs these hints:
//
//   <Hints>
//     <OpensBeside port="1" />
//     <ShowsLastStep />
//     <DrawsTubes port="1" />
//     <FitsCameras port="1" />
//     <ColorsLater array="StitchedColors" direct="fractions" />
//   </Hints>
//
//   OpensBeside: the first Apply opens a view for this port beside the view of port 0. The view of
//   port 0 stays active, so it also shows the next filter. Its camera is fitted. A view that shows
//   only this port is closed with the filter.
//
//   ShowsLastStep: the first Apply goes to the last of the filter's time steps, unless another
//   source has time steps that would change with it.
//
//   DrawsTubes: the first Apply shows the lines of this port as tubes, and port 0 half transparent,
//   so that lines on its far side are seen as well.
//
//   FitsCameras: the first Apply fits the camera to port 0 and to this port, which lies beside it.
//   The camera is fitted again when the filter is deleted.
//
//   ColorsLater: the array colors port 0, or the port in the attribute `port`, as soon as the port
//   has it, or has lost the array that colored it. ParaView looks only once, when it first shows a
//   filter, and the user may choose arrays later. The user's own coloring stays. With
//   direct="bytes", three or four bytes are shown directly as colors, without a bar. With
//   direct="fractions", so are numbers from 0 to 1.
//
// The XML of a chart has the hint:
//
//     <AxisTitles bottom="Mode" left="Eigenvalue" />
//
//   AxisTitles     axes without a title get these titles when the chart is first drawn
//
// Only filters that the user makes in ParaView's window have a first Apply. Views are closed, and
// lost arrays replaced, whether the window, a script, a state or undo has brought the filter.
// Titles are also set without a window, but not in states.
#ifndef GridFEM_FirstApply_h
#define GridFEM_FirstApply_h

class vtkSMSourceProxy;

namespace gridfem
{

/// Waits for the first Apply of a filter that the user has just made.
void AwaitFirstApply(vtkSMSourceProxy* filter);

/// Begins to follow filters and charts with the hints. The plugin calls it when it is loaded.
void RegisterFirstApply();

} // namespace gridfem

#endif
