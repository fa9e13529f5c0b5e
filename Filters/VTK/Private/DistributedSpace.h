// What filters have in common that all ranks of VTK's global controller compute together. Only for
// sources that are built with MPI.
#ifndef GridFEM_DistributedSpace_h
#define GridFEM_DistributedSpace_h

#include "Ranks.h"
#include "SurfaceSolverState.h"

#include "Parallel/RankSpace.h"

#include <string>

namespace gridfem
{

Communicator RanksOfVtk();

/// A depth is chosen, functions are those of a grid. Ranks of one machine share its processors.
RankSpaceOptions DistributedOptions(const Communicator& ranks, const SurfaceOptions& options);

/// Returns body(Communicator), which is collective. Throws on all ranks when it throws on one:
/// Aborted on all, or the error on the first rank and FailedElsewhere on the others.
template<class Body>
auto OnRanksOfVtk(Body&& body)
{
  const Communicator ranks = RanksOfVtk();
  try
  {
    decltype(body(ranks)) result;
    ranks.Guard([&] { result = body(ranks); });
    return result;
  }
  catch (const RankFailure& failure)
  {
    if (ranks.Rank() > 0)
    {
      throw FailedElsewhere();
    }
    throw InvalidInput("Rank " + std::to_string(failure.rank) + ": " + failure.what());
  }
  catch (const InvalidInput&) // of what is the same on all ranks
  {
    if (ranks.Rank() > 0)
    {
      throw FailedElsewhere();
    }
    throw;
  }
}

} // namespace gridfem

#endif
