// The default mesh of the examples: a trefoil-knot tube with strands that nearly touch.
#ifndef GridFEM_Examples_TrefoilKnot_h
#define GridFEM_Examples_TrefoilKnot_h

#include <vtkPolyData.h>
#include <vtkSmartPointer.h>

/// A closed tube around the (2,3) torus knot, 7.4 long and 3.4 times as thick as the narrowest grid
/// cell at depth 6. The gap where strands cross is 0.04, a third of such a cell. The functions of a
/// grid therefore reach from one strand to the other unless they are split.
/// @return 38,400 triangles; the point array `Stripes` (double, 0 or 1) is the active scalar. It
///          changes along the tube, so strands that nearly touch differ
vtkSmartPointer<vtkPolyData> TrefoilKnot();

#endif
