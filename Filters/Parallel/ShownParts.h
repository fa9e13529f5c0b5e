// The parts of a clip, and of the functions on it, that each rank outputs.
#ifndef GridFEM_ShownParts_h
#define GridFEM_ShownParts_h

#include "Parallel/RankSpace.h"

#include <vector>

namespace gridfem
{

/// Returns the input's points that pieces use, ascending, then all cut points.
std::vector<Id> PointsOfPieces(const ClippedMesh& clipped);

/// Returns the mesh with only these points.
ClippedMesh WithPoints(const ClippedMesh& clipped, const std::vector<Id>& points);

/// Returns the levels of all ranks' functions on this rank. The distributed levels come first, with
/// the rank's own patches and its own numbers of functions. The shared levels follow as a whole.
/// Collective.
std::vector<PatchLevel> LevelsOfRank(const RankSpace& space);

/// Returns the finest level of all ranks. Collective.
PatchLevel GatherFinest(const RankSpace& space);

} // namespace gridfem

#endif
