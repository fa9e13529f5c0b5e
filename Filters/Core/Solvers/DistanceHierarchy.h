// The method by which solvers find distances on a surface, kept while it can be used.
#ifndef GridFEM_DistanceHierarchy_h
#define GridFEM_DistanceHierarchy_h

#include "Distance/GeodesicDistance.h"
#include "Solvers/Surface.h"

namespace gridfem
{

/// Makes the method again if the surface, or an option of the method, has changed (HierarchyStage).
/// Collective. Throws InvalidInput and Aborted.
/// @param options  the number of threads has no effect: the surface's threads are used
void UpdateDistanceMethod(const Surface& surface, DistanceOptions options,
  std::unique_ptr<DistanceMethod>& method, const Progress& progress);

} // namespace gridfem

#endif
