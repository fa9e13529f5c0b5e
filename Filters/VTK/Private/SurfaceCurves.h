// Curves that divide a surface, from arrays and lines of VTK.
#ifndef GridFEM_SurfaceCurves_h
#define GridFEM_SurfaceCurves_h

#include "InputArray.h"
#include "Problems/SurfaceCurve.h"

class vtkDataSet;

namespace gridfem
{

/// The border of the points or cells with this label. Throws InvalidInput naming the array when its
/// values are not integers, or when all of the surface has the label, or nothing.
SurfaceCurve BorderOfLabel(
  const InputArray& labels, int inside, const InputMesh& mesh, bool weldCoincidentPoints);

/// The lines of a data set, moved to their nearest places on the surface.
/// @param lines  may be null
/// Throws InvalidInput when there are none, naming a point that is not finite, and as
/// DivideByLines.
SurfaceCurve CurveOfLines(vtkDataSet* lines, const TriangleMesh& mesh, bool weldCoincidentPoints);

} // namespace gridfem

#endif
