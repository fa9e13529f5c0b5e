// Rows of a level's vectors on several ranks, and the messages between the ranks.
#ifndef GridFEM_RankRows_h
#define GridFEM_RankRows_h

#include "Algebra/DistributedRows.h"
#include "Parallel/LevelNumbering.h"

#include <vector>

namespace gridfem
{

/// The rows belong to the functions of a numbering, or to some of them. Ranks exchange their shared
/// rows, in one message for up to 32 columns. Buffers are allocated at the start. All functions but
/// Ghosts are collective.
class RankRows : public DistributedRows
{
public:
  /// @param ghosts     number of rows that belong to other ranks, which come first
  /// @param neighbors  for each other rank, in ascending order: the shared rows, in the same order
  ///   on both ranks
  /// @param arePartsProlonged  see DistributedRows
  RankRows(const Communicator& ranks, Index ghosts, std::vector<RankNeighbor> neighbors,
    bool arePartsProlonged = false);

  Index Ghosts() const override { return ghosts_; }
  bool ArePartsProlonged() const override { return arePartsProlonged_; }
  void Sum(Block<float> x) const override;
  void Sum(Block<double> x) const override;
  void TakeGhosts(Block<float> x) const override;
  void TakeGhosts(Block<double> x) const override;
  void SumNumbers(double* values, Id count) const override { ranks_.Sum(values, count); }
  MultiVector Gather(const Eigen::RowVectorXd& numbers) const override;

  /// Sets shared rows to the least of the ranks' values.
  void TakeLeast(Block<double> x) const;

private:
  using Rows = std::vector<std::vector<Index>>; // per neighbor

  template<class Real>
  void Exchange(const Rows& out, const Rows& in, Block<Real> x) const;
  template<class Real, class Body>
  void ForReceived(const Rows& in, Id columns, Body&& body) const;
  template<class Real>
  void SumParts(Block<Real> x) const;
  template<class Real>
  void TakeOwners(Block<Real> x) const;

  Communicator ranks_;
  Index ghosts_;
  bool arePartsProlonged_;
  std::vector<RankNeighbor> neighbors_;
  std::size_t lower_ = 0;  // number of neighbors with lower rank
  Rows shared_;            // shared with each neighbor
  Rows ownOfShared_;       // shared rows that belong to this rank
  Rows ghostsOfShared_;    // shared rows that belong to the neighbor
  std::vector<Index> all_; // rows that any neighbor holds, ascending
  // Buffers for the rows of a message, and for this rank's own values in these rows. Only one call
  // may be active.
  mutable std::vector<unsigned char> sent_;
  mutable std::vector<unsigned char> received_;
  mutable std::vector<unsigned char> own_;
  mutable std::vector<MPI_Request> requests_;
};

} // namespace gridfem

#endif
