// The method by which solvers find distances on a surface, kept while it can be used.
#ifndef GridFEM_DistanceHierarchy_h
#define GridFEM_DistanceHierarchy_h

#include "Problems/GeodesicDistance.h"
#include "Solvers/Surface.h"

namespace gridfem
{

/// Makes the method again when the surface has changed or what the method depends on
/// (HierarchyStage). Collective. Throws InvalidInput and Aborted.
/// @param options  with any number of threads; those of the surface are used
void UpdateDistanceMethod(const Surface& surface, DistanceOptions options,
  std::unique_ptr<DistanceMethod>& method, const Progress& progress);

} // namespace gridfem

#endif
