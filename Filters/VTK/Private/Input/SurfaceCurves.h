// Makes curves that divide a surface from lines of VTK.
#ifndef GridFEM_SurfaceCurves_h
#define GridFEM_SurfaceCurves_h

#include "Distance/SurfaceCurve.h"

class vtkDataSet;

namespace gridfem
{

/// Returns the lines of a data set, moved to their nearest places on the surface.
/// @param lines  may be null
/// @return       no segments if there are no lines
/// Throws InvalidInput naming a point that is not finite, and as DivideByLines does.
SurfaceCurve CurveOfLines(vtkDataSet* lines, const TriangleMesh& mesh, bool weldCoincidentPoints);

} // namespace gridfem

#endif
