// The communication that an iteration needs if several processes hold the rows of its vectors
// together. A row held by several processes has the same bits in all of them.
#ifndef GridFEM_DistributedRows_h
#define GridFEM_DistributedRows_h

#include "Algebra/BlockVectors.h"

namespace gridfem
{

/// Every function except Ghosts is collective: all processes call it, in the same order, from one
/// thread each. Every row belongs to one process. A process's contribution to a vector, before the
/// contributions are added up, is called its part.
class DistributedRows
{
public:
  virtual ~DistributedRows() = default;

  /// Number of rows here that belong to other processes. These rows come first.
  virtual Index Ghosts() const = 0;

  /// Whether the prolongations of the processes are parts that add up to the whole prolongation. If
  /// so, their results must be summed, and their transposes need whole vectors. Otherwise each
  /// process has all entries of its rows.
  virtual bool ArePartsProlonged() const { return false; }

  /// Turns the parts of a vector into the whole vector by adding up the rows that several processes
  /// hold.
  virtual void Sum(Block<float> x) const = 0;
  virtual void Sum(Block<double> x) const = 0;

  /// Overwrites each ghost row with the row of the process it belongs to.
  virtual void TakeGhosts(Block<float> x) const = 0;
  virtual void TakeGhosts(Block<double> x) const = 0;

  /// Adds up numbers over all processes, in place. All processes get the same bits.
  virtual void SumNumbers(double* values, Id count) const = 0;

  /// Returns one row per process.
  virtual MultiVector Gather(const Eigen::RowVectorXd& numbers) const = 0;
};

/// Number of ghost rows; 0 if `distributed` is null, because one process then holds all rows.
inline Index GhostRows(const DistributedRows* distributed)
{
  return distributed ? distributed->Ghosts() : 0;
}

/// Sums the result of a prolongation, if the processes prolong parts.
template<class Real>
void SumProlonged(const DistributedRows* distributed, Block<Real> x)
{
  if (distributed && distributed->ArePartsProlonged())
  {
    distributed->Sum(x);
  }
}

template<class Numbers>
void SumOverProcesses(const DistributedRows* distributed, Numbers& numbers)
{
  if (distributed)
  {
    distributed->SumNumbers(numbers.data(), static_cast<Id>(numbers.size()));
  }
}

} // namespace gridfem

#endif
