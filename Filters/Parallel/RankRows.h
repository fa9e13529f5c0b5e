// Rows of a level's vectors on several ranks, and the messages that they need.
#ifndef GridFEM_RankRows_h
#define GridFEM_RankRows_h

#include "Algebra/DividedRows.h"
#include "Parallel/LevelNumbering.h"

#include <vector>

namespace gridfem
{

/// Rows are those of the functions of a numbering, or of some of them. Ranks that hold rows
/// together send them to each other, in one message for up to 32 columns, which has its room from
/// the start. All functions but Foreign are collective.
class RankRows : public DividedRows
{
public:
  /// @param foreign     rows of other ranks, which come first
  /// @param neighbours  per rank, which ascend: the rows that both hold, in the same order there
  /// @param arePartsProlonged  see DividedRows
  RankRows(const Communicator& ranks, Index foreign, std::vector<RankNeighbour> neighbours,
    bool arePartsProlonged = false);

  Index Foreign() const override { return foreign_; }
  bool ArePartsProlonged() const override { return arePartsProlonged_; }
  void Sum(Block<float> x) const override;
  void Sum(Block<double> x) const override;
  void TakeForeign(Block<float> x) const override;
  void TakeForeign(Block<double> x) const override;
  void SumNumbers(double* values, Id count) const override { ranks_.Sum(values, count); }
  MultiVector Gather(const Eigen::RowVectorXd& numbers) const override;

  /// Rows become the least of what the ranks have in them.
  void TakeLeast(Block<double> x) const;

private:
  using Rows = std::vector<std::vector<Index>>; // per neighbour

  template<class Real>
  void Exchange(const Rows& out, const Rows& in, Block<Real> x) const;
  template<class Real, class Body>
  void ForReceived(const Rows& in, Id columns, Body&& body) const;
  template<class Real>
  void SumParts(Block<Real> x) const;
  template<class Real>
  void TakeOwners(Block<Real> x) const;

  Communicator ranks_;
  Index foreign_;
  bool arePartsProlonged_;
  std::vector<RankNeighbour> neighbours_;
  std::size_t lower_ = 0;  // neighbours of lower rank
  Rows shared_;            // with each neighbour
  Rows ownOfShared_;       // those of them that belong to this rank
  Rows foreignOfShared_;   // to the neighbour
  std::vector<Index> all_; // rows that any neighbour holds, ascending
  // Room for the rows of a message, and for what this rank has in them. One call is at work.
  mutable std::vector<unsigned char> sent_;
  mutable std::vector<unsigned char> received_;
  mutable std::vector<unsigned char> own_;
  mutable std::vector<MPI_Request> requests_;
};

} // namespace gridfem

#endif
