// One rank's part of the hat functions of a mesh, above the grid's functions.
#ifndef GridFEM_RankHats_h
#define GridFEM_RankHats_h

#include "Parallel/RankSpace.h"
#include "Spaces/HatSpace.h"

#include <memory>
#include <vector>

namespace gridfem
{

/// Each triangle is integrated by the lowest rank whose cells contain one of its corners. A rank
/// holds the hats of the triangles it integrates, and those whose points are in its cells or on
/// their borders. Points with the same coordinates have one hat. A copy shares all data that do not
/// change.
class RankHats
{
public:
  /// Collective. Throws RankFailure on all ranks when one fails, and Aborted.
  /// @param space  its functions have to join coincident points
  explicit RankHats(const RankSpace& space, const Job& job = {});

  /// The hats of this rank as a space of their own, above RankSpace::Own. Matrices, integrals and
  /// the prolongation are this rank's parts of the sums over all ranks. Its order and groups have
  /// only the hats that no other rank holds.
  const HatSpace& Own() const { return *own_; }
  const LevelNumbering& Numbering() const { return *numbering_; }

  /// 1 for triangles of the received mesh that this rank integrates, else 0.
  const std::vector<double>& IsIntegrated() const { return *isIntegrated_; }

  /// Whether this rank evaluates each hat. The evaluating rank is the lowest rank whose
  /// prolongation has a part of its row, or the owner if no rank has a part.
  const std::vector<char>& IsEvaluated() const { return *isEvaluated_; }

  /// The same hats with other integrals.
  /// @param own  a copy of Own() with these integrals
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
