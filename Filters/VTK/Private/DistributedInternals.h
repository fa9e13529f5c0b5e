// The data of DistributedSurface, for the parts of the filters that are built with MPI.
#ifndef GridFEM_DistributedInternals_h
#define GridFEM_DistributedInternals_h

#include "DistributedSurface.h"

#include "Parallel/RankSurface.h"

namespace gridfem
{

struct SurfaceOptions;

/// The ranks of VTK's global controller.
Communicator RanksOfVtk();

RankSpaceOptions RankOptionsOf(const SurfaceOptions& options);

struct DistributedSurface::Internals
{
  Communicator ranks = RanksOfVtk();
  RankRows numbers{ ranks, 0, {} };
  std::shared_ptr<const RankSurface> whole;
};

} // namespace gridfem

#endif
