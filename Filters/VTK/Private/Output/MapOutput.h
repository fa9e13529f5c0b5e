// Writes the map between two surfaces.
#ifndef GridFEM_MapOutput_h
#define GridFEM_MapOutput_h

#include "Spectrum/FunctionalMap.h"

class vtkPolyData;

namespace gridfem
{

/// Throws InvalidInput naming a point array of wrong length.
void RequireArrays(vtkPolyData* reference);

/// Adds the arrays of the map, and the arrays of the reference without its modes.
void WriteMap(const FunctionalMap& map, vtkPolyData* reference, vtkPolyData* output);

/// Adds the point array MatchingColors to the reference, and makes it active: red, green and blue
/// grow along the sides of the bounding box.
void AddMatchingColors(vtkPolyData* reference, vtkPolyData* output);

} // namespace gridfem

#endif
