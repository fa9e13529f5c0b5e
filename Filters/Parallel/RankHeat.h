// Heat that has spread from its sources, on a surface on several ranks. [Distance/DistantHeat.h]
#ifndef GridFEM_RankHeat_h
#define GridFEM_RankHeat_h

#include "Distance/DistantHeat.h"
#include "Parallel/RankLevels.h"

#include <memory>
#include <vector>

namespace gridfem
{

/// Every rank relaxes the patches of its own cells, in the order in which heat reaches them.
/// Functions of other ranks keep their values meanwhile. Each function then takes the value of the
/// rank that owns it. These rounds repeat until no patch of any rank changes.
/// Heat advances by one rank per round. Errors at borders, which overlap by a function, fall as the
/// heat does from one function to the next. [restricted additive Schwarz; Cai and Sarkis 1999]
class RankHeat
{
public:
  /// Collective. Prepares the equation on the finest level.
  /// @param t       in squared units of length; > 0
  /// @param change  as in DistantHeat
  RankHeat(const RankLevels& levels, double t, double change, const Job& job = {});

  /// Collective.
  /// @param load  Σ b_i(source), complete in all rows
  /// @return      rows = functions that touch this rank's cells; counts are over all ranks. It has
  ///   not converged if 500 rounds are not enough. A function is unreached if it has no heat but
  ///   its component has heat on some rank.
  HeatField From(const MultiVector& load, const Job& job = {}) const;

private:
  /// An entry that a rank's patches add to the row of a shared function.
  struct ToldEntry
  {
    Index row; // place among the shared functions
    Id column; // number over all ranks
    double value;
  };
  using EntriesOfRanks = std::vector<std::vector<ToldEntry>>;

  const LevelNumbering& Numbering() const { return levels_.Space().Numberings().front(); }
  void FindOthers(const SparseMatrix& part);
  std::vector<ToldEntry> EntriesFor(const RankNeighbor& neighbor, const SparseMatrix& part);
  void AddOthers(const SparseMatrix& part, const EntriesOfRanks& messages);
  void TakeOthers(MultiVector& u) const;
  Id CountUnreached(const MultiVector& heat) const;
  double Sum(double own) const;

  const RankLevels& levels_;
  Communicator ranks_;
  // Number of functions that touch this rank's cells. Functions of neighbors' cells follow.
  Index functions_;
  double change_;
  Components components_;
  SparseMatrix whole_;
  std::vector<std::vector<Index>> told_;  // functions here whose values go to each rank
  std::vector<std::vector<Index>> heard_; // places of functions that come from each rank
  std::unique_ptr<DistantHeat> heat_;
};

} // namespace gridfem

#endif
