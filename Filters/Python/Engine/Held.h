// Values that problems hold at points: those with `held`, and where the surface ends.
#ifndef GridFEM_Held_h
#define GridFEM_Held_h

#include "Problem.h"

#include "Problems/EdgeConditions.h"

namespace gridfem
{

/// Throws InvalidInput when the values are on cells.
void RequirePointValues(const std::string& who, const GivenArray* values);

/// Throws InvalidInput for a mask that does not fit, and for values on cells where some are held.
void CheckHeld(const Given& given, bool holdsBoundary);

/// @param value  the array `values` at points; edges with a NaN are left out
HeldValues FindHeld(const Given& given, const EngineSurface& surface, const EngineOptions& options,
  const Field& value, bool holdsBoundary, Results& results);

} // namespace gridfem

#endif
