// Arranges flat charts side by side.
#ifndef GridFEM_ChartLayout_h
#define GridFEM_ChartLayout_h

#include "Base/Types.h"

#include <vector>

namespace gridfem
{

/// Turns every chart so that it is longest along x. Moves all charts into rows, the highest chart
/// first, so that they fill about a square without touching. The lowest coordinates are 0.
/// @param charts  a row of two coordinates for each vertex
void ArrangeCharts(std::vector<MultiVector>& charts);

} // namespace gridfem

#endif
