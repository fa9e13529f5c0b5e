// How a surface is discretized: the properties that all filters share, with their defaults and
// ranges.
#ifndef GridFEM_SurfaceOptions_h
#define GridFEM_SurfaceOptions_h

#include "Solvers/Requirements.h"
#include "Spaces/SpaceChoice.h"

namespace gridfem
{

/// The unit of length of weights and times that a user gives.
enum class ParameterUnits
{
  World,    // the unit of the points
  UnitArea, // the surface scaled to area 1
  UnitCube  // the surface scaled to a longest side of 1
};

struct SurfaceOptions
{
  SpaceOptions space;                              // depth 0: automatic
  SpaceChoice choice;                              // of the functions
  double functionsPerPoint = EnoughToPrecondition; // of the grid below hat functions, at most
  ParameterUnits parameterUnits = ParameterUnits::UnitArea;
};

/// The defaults of most solvers. They need few iterations to small tolerances on any surface
/// (OperatorOptions).
inline SurfaceOptions StabilizedSurface()
{
  SurfaceOptions options;
  options.choice.normalStabilization = 1e-2;
  return options;
}

} // namespace gridfem

#endif
