// The mesh the examples use when none is given: a trefoil-knot tube whose strands nearly touch.
#ifndef GridFEM_Examples_TrefoilKnot_h
#define GridFEM_Examples_TrefoilKnot_h

#include <vtkPolyData.h>
#include <vtkSmartPointer.h>

/// A closed tube around the (2,3) torus knot, 7.4 long and 3.4 times as thick as the narrowest grid
/// cell at depth 6. Where strands cross, 0.04 lies between them: a third of such a cell, so that
/// the functions of a grid reach from one strand to the other unless they are split.
/// @return  38,400 triangles; the point array `Stripes` (double, 0 or 1) is the active scalar and
///          changes along the tube, so that touching strands differ
vtkSmartPointer<vtkPolyData> TrefoilKnot();

#endif
