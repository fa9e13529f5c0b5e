// The hat functions of a mesh on several ranks, above the grid's functions, as one rank sees them.
#ifndef GridFEM_RankHats_h
#define GridFEM_RankHats_h

#include "Parallel/RankSpace.h"
#include "Spaces/HatSpace.h"

#include <memory>
#include <vector>

namespace gridfem
{

/// Each triangle is integrated by the lowest of the ranks whose cells contain its corners: a rank
/// holds the hats of these triangles, and those whose points are in its cells or on their borders.
/// Points with the same coordinates have one hat. A copy shares all that does not change.
class RankHats
{
public:
  /// Collective. Throws RankFailure on all ranks when one fails, and Aborted.
  /// @param space  whose functions join coincident points
  explicit RankHats(const RankSpace& space, const Job& job = {});

  /// The hats that this rank holds as a space of their own, above RankSpace::Own. Matrices,
  /// integrals and the prolongation are what the rank adds to the whole; its order and groups have
  /// the hats that no other rank holds.
  const HatSpace& Own() const { return *own_; }
  const LevelNumbering& Numbering() const { return *numbering_; }

  /// 1 for triangles of the received mesh that this rank integrates, else 0.
  const std::vector<double>& IsIntegrated() const { return *isIntegrated_; }

  /// Per hat whether this rank is the one that evaluates it: the lowest whose prolongation has a
  /// part of its row, and the owner where no rank has one.
  const std::vector<char>& IsEvaluated() const { return *isEvaluated_; }

  /// The same hats with other integrals.
  /// @param own  a copy of Own() with these
  RankHats WithOwn(HatSpace own) const;

private:
  std::shared_ptr<const LevelNumbering> numbering_;
  std::shared_ptr<const HatLevel> level_;
  std::shared_ptr<const std::vector<double>> isIntegrated_;
  std::shared_ptr<const std::vector<char>> isEvaluated_;
  std::shared_ptr<const HatSpace> own_;
};

} // namespace gridfem

#endif
