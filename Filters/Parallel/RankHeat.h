// Heat that has spread from its sources, on a surface that several ranks hold together.
// [Problems/DistantHeat.h]
#ifndef GridFEM_RankHeat_h
#define GridFEM_RankHeat_h

#include "Parallel/RankLevels.h"
#include "Problems/DistantHeat.h"

#include <memory>
#include <vector>

namespace gridfem
{

/// Every rank relaxes the patches of its own cells, in the order in which heat comes to them, while
/// what it sees of other ranks' functions stays as it is; then each function takes the value of the
/// rank that it belongs to, and so on until no patch of any rank changes. Heat comes one rank
/// further in a round, and errors at borders, which overlap by a function, fall as it does from one
/// function to the next. [restricted additive Schwarz; Cai and Sarkis 1999]
class RankHeat
{
public:
  /// Collective. On the finest level.
  /// @param t       in squared units of length; > 0
  /// @param change  as in DistantHeat
  RankHeat(const RankLevels& levels, double t, double change, const Job& job = {});

  /// Collective.
  /// @param load  Σ b_i(source), whole in all rows
  /// @return      rows = functions that touch this rank's cells; numbers are of all ranks. After
  ///              500 rounds it has not converged. Unreached is a function without heat whose
  ///              component has some on any rank.
  HeatField From(const MultiVector& load, const Job& job = {}) const;

private:
  void FindOthers(const SparseMatrix& part);
  void TakeOthers(MultiVector& u) const;
  Id CountUnreached(const MultiVector& heat) const;
  double Sum(double own) const;

  const RankLevels& levels_;
  Communicator ranks_;
  Index functions_; // that touch this rank's cells; those of neighbours' cells follow
  double change_;
  Components components_;
  SparseMatrix whole_;
  std::vector<std::vector<Index>> told_;  // functions here whose values a rank is told
  std::vector<std::vector<Index>> heard_; // places of those that a rank tells
  std::unique_ptr<DistantHeat> heat_;
};

} // namespace gridfem

#endif
