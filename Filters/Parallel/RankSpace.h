// The grid space of a surface that lies on several ranks, as one of them sees it: the functions
// that touch its cells, and the patches in them. Nobody has the whole but for the coarse levels.
#ifndef GridFEM_RankSpace_h
#define GridFEM_RankSpace_h

#include "Parallel/LevelNumbering.h"
#include "Parallel/RankClip.h"
#include "Spaces/GridSpace.h"

#include <memory>
#include <vector>

namespace gridfem
{

/// A copy shares all that does not change.
class RankSpace
{
public:
  /// Collective. Clips and integrates what the cells of this rank hold.
  /// @param own     this rank's triangles, world units
  /// @param progress  of this rank alone, which reports as often as its work is long
  /// @param copies  triangles of its points that it has as copies of another rank's
  /// Throws RankFailure, on all ranks, with what went wrong on one, and Aborted.
  RankSpace(const Communicator& ranks, const TriangleMesh& own, const RankSpaceOptions& options,
    const Progress& progress = {}, const TriangleList& copies = {});

  const Communicator& Ranks() const { return ranks_; }
  const Redistribution& Distribution() const { return *distribution_; }
  const TriangleCopies& Copies() const { return *copies_; }

  /// The rank whose cells contain a point of the surface, world units.
  int OwnerOfPoint(const Vec3& point) const;

  /// The patches of this rank's cells as a space of their own. Its levels are the divided ones and
  /// the first of the shared ones. Functions of divided levels are those of Numberings(), so that
  /// matrices and integrals are what the rank's patches add to the whole. Its mesh is the one that
  /// the rank has received.
  const GridSpace& Own() const { return *own_; }

  /// Of the divided levels, finest first.
  const std::vector<LevelNumbering>& Numberings() const { return *numberings_; }

  /// The level of the blocks and those below it, which every rank holds whole, as a space without a
  /// mesh.
  const GridSpace& Shared() const { return *shared_; }

  /// Places of the received points' patches in this rank's cells; -1 where another rank evaluates.
  /// Points at the same place of one sheet have values that are equal bit for bit.
  const Array<Index>& PointPatches() const { return own_->Functions().pointPatch; }

  /// Collective. The same functions with other integrals.
  /// @param own  a copy of Own() with these
  RankSpace WithOwn(GridSpace own, int threads = 0) const;

  /// Collective. Numbers of this rank's own triangles, at those that this rank has received.
  std::vector<double> SendToTriangles(const std::vector<double>& own) const;

  /// Collective. Rows of this rank's own points become the sums over the points of all ranks at the
  /// same place of one sheet. Where a rank has several there, it keeps them apart: all stay as they
  /// are.
  void SumAtPoints(MultiVector& own) const;

private:
  std::vector<PatchLevel> Divide(
    GridFunctions& all, const Array<Link>& links, const BlockPartition& partition);
  std::vector<PatchLevel> Share(const PatchLevel& level, const Array<Link>& links,
    const BlockPartition& partition, FunctionSupport support) const;
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
