// One rank's part of the grid space of a surface: the functions that touch its cells, and the
// patches in them. No rank has the whole space, except for the coarse levels.
#ifndef GridFEM_RankSpace_h
#define GridFEM_RankSpace_h

#include "Parallel/LevelNumbering.h"
#include "Parallel/RankClip.h"
#include "Spaces/GridSpace.h"

#include <memory>
#include <vector>

namespace gridfem
{

/// The grid space on several ranks. A copy shares all data that do not change.
class RankSpace
{
public:
  /// Collective. Clips and integrates the surface in the cells of this rank.
  /// @param own       this rank's triangles, world units
  /// @param progress  of this rank alone; it reports as often as its work requires
  /// @param copies    triangles of its points that are copies of another rank's triangles
  /// Throws RankFailure on all ranks if one rank fails, with its reason, and Aborted.
  RankSpace(const Communicator& ranks, const TriangleMesh& own, const RankSpaceOptions& options,
    const Progress& progress = {}, const TriangleList& copies = {});

  const Communicator& Ranks() const { return ranks_; }
  const Redistribution& Distribution() const { return *distribution_; }
  const TriangleCopies& Copies() const { return *copies_; }

  /// The rank whose cells contain a point of the surface, world units.
  int OwnerOfPoint(const Vec3& point) const;

  /// The patches of this rank's cells as a space of their own. Its levels are the distributed
  /// levels and the first shared level. Distributed levels have the functions of Numberings().
  /// Matrices and integrals are therefore this rank's parts of the sums over all ranks. Its mesh is
  /// the mesh that the rank has received.
  const GridSpace& Own() const { return *own_; }

  /// The numberings of the distributed levels, finest first.
  const std::vector<LevelNumbering>& Numberings() const { return *numberings_; }

  /// The level of the blocks and all coarser levels, which every rank holds whole, as a space
  /// without a mesh.
  const GridSpace& Shared() const { return *shared_; }

  /// The patch of each received point in this rank's cells; -1 if another rank evaluates the point.
  /// Points at the same place of one sheet have the same values, bit for bit.
  const Array<Index>& PointPatches() const { return own_->Functions().pointPatch; }

  /// Collective. The same functions with other integrals.
  /// @param own  a copy of Own() with these integrals
  RankSpace WithOwn(GridSpace own, int threads = 0) const;

  /// Collective. Sends numbers on this rank's own triangles to the ranks that have received the
  /// triangles.
  /// @return  the numbers on the triangles that this rank has received
  std::vector<double> SendToTriangles(const std::vector<double>& own) const;

  /// Collective. Replaces rows of this rank's own points by the sums over the points of all ranks
  /// at the same place of one sheet. If a rank has several points at a place, they are separate on
  /// purpose, and all stay as they are.
  void SumAtPoints(MultiVector& own) const;

private:
  std::vector<PatchLevel> Divide(
    GridFunctions& all, const Array<Link>& links, const BlockPartition& partition, int threads);
  std::vector<PatchLevel> Share(const PatchLevel& level, const Array<Link>& links,
    const BlockPartition& partition, FunctionSupport support, int threads) const;
  void AddElements(int threads);

  Communicator ranks_;
  Index coarsestSize_;
  std::shared_ptr<const BlockPartition> partition_;
  std::shared_ptr<Redistribution> distribution_;
  std::shared_ptr<const TriangleCopies> copies_;
  std::shared_ptr<const GridSpace> own_;
  std::shared_ptr<std::vector<LevelNumbering>> numberings_;
  std::shared_ptr<const GridFunctions> sharedFunctions_;
  std::shared_ptr<const GridSpace> shared_;
};

} // namespace gridfem

#endif
