// Hidden functions that are as fine as the grid along one axis. The distance to the surface times a
// function φ has the energy h²(|∂φ/∂t|² + n_z²|∂φ/∂z|²) where the normal n is nearly orthogonal to
// z and t is the other tangent: where n_z = 0, φ may vary along z from layer to layer and costs
// nothing, so that no coarser grid has it. The remedy is semi-coarsening: levels of boxes that grow
// across the axis and keep one layer of finest cells along it. Every smooth surface needs them
// along three curves, extruded ones everywhere.
#ifndef GridFEM_LayeredFunctions_h
#define GridFEM_LayeredFunctions_h

#include "Spaces/LevelOperators.h"

namespace gridfem
{

/// Adds the hierarchy of layered functions to the hidden functions of a space, whose heights it
/// multiplies. Every finest function belongs to one axis: that of the smallest normal component in
/// its support. Boxes begin 4 x 4 x 1 cells large; from 16 x 16 x 1 on they grow along all axes.
/// Inside a box, what is one patch of the grid of its width counts as connected. None where the
/// space has fewer than three levels. Cost O(patches), partly serial; same bits for any number of
/// threads.
void AddLayeredFunctions(
  const GridFunctions& space, const LevelOperators& system, HiddenLevels& hidden, int threads = 0);

/// Bytes that the hierarchies of hidden and layered functions hold, from above: on surfaces 450 to
/// 590 were measured per finest function of the grid.
inline double EstimateLayeredMemory(Id functions)
{
  return 600.0 * static_cast<double>(functions);
}

} // namespace gridfem

#endif
