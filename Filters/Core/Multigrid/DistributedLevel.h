// A level whose unknowns are distributed over several processes, from the view of each process's
// cycle.
#ifndef GridFEM_DistributedLevel_h
#define GridFEM_DistributedLevel_h

#include "Algebra/DistributedRows.h"
#include "Multigrid/Smoother.h"

#include <functional>
#include <memory>
#include <vector>

namespace gridfem
{

/// The matrix of a distributed level is this process's part of the sum over all processes. Its
/// order has only the patches whose unknowns all belong to this process alone. Relax relaxes the
/// other patches, in double precision. Every function is collective, as in DistributedRows.
class DistributedLevel
{
public:
  virtual ~DistributedLevel() = default;

  virtual const DistributedRows& Rows() const = 0;

  /// The sum of Rows().Sum without a gap, for vectors of the next coarser level, which every
  /// process may hold whole.
  virtual void SumCoarse(Block<float> x) const = 0;
  virtual void SumCoarse(Block<double> x) const = 0;

  /// Unknowns of the patches that Relax relaxes, in ascending order.
  virtual const std::vector<Index>& Border() const = 0;

  /// One sweep over these patches.
  /// @param residual  fills this process's part of b - A x in the rows of Border()
  /// @param correct   adds a correction in these rows to x
  virtual void Relax(Id columns, SweepDirection direction,
    const std::function<void(MultiVector& part)>& residual,
    const std::function<void(const MultiVector& correction)>& correct) const = 0;
};

/// DistributedLevel::Relax as a smoother.
template<class Real>
std::unique_ptr<BasicSmoother<Real>> MakeBorderSmoother(
  std::shared_ptr<const DistributedLevel> distributed);

} // namespace gridfem

#endif
