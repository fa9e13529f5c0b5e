// Rows of vectors that several processes hold together: what an iteration in each of them asks of
// the others. Rows that several processes hold have the same bits in all of them.
#ifndef GridFEM_DividedRows_h
#define GridFEM_DividedRows_h

#include "Algebra/BlockVectors.h"

namespace gridfem
{

/// All functions but Foreign are called by all processes, in the same order and by one thread each.
/// A row belongs to one process; what a process adds to a vector before it is summed up is called
/// its part.
class DividedRows
{
public:
  virtual ~DividedRows() = default;

  /// Rows here that belong to other processes. They come first.
  virtual Index Foreign() const = 0;

  /// Whether the prolongations of the processes are parts as well, which add up to the whole: what
  /// they give is to be summed, and what their transposes take has to be whole. Else each process
  /// has all entries of its rows.
  virtual bool ArePartsProlonged() const { return false; }

  /// Parts of a vector become the vector: adds up rows that several processes hold.
  virtual void Sum(Block<float> x) const = 0;
  virtual void Sum(Block<double> x) const = 0;

  /// Foreign rows become those of the processes that they belong to.
  virtual void TakeForeign(Block<float> x) const = 0;
  virtual void TakeForeign(Block<double> x) const = 0;

  /// Adds up numbers of all processes, in place; the same bits in all of them.
  virtual void SumNumbers(double* values, Id count) const = 0;

  /// One row per process.
  virtual MultiVector Gather(const Eigen::RowVectorXd& numbers) const = 0;
};

/// The same where there may be one process alone, which holds all.
inline Index ForeignRows(const DividedRows* divided)
{
  return divided ? divided->Foreign() : 0;
}

/// Of what a process has prolonged to such rows.
template<class Real>
void SumProlonged(const DividedRows* divided, Block<Real> x)
{
  if (divided && divided->ArePartsProlonged())
  {
    divided->Sum(x);
  }
}

template<class Numbers>
void SumOverProcesses(const DividedRows* divided, Numbers& numbers)
{
  if (divided)
  {
    divided->SumNumbers(numbers.data(), static_cast<Id>(numbers.size()));
  }
}

} // namespace gridfem

#endif
