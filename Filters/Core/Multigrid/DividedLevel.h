// A level whose unknowns several processes hold together, as the cycle of each of them sees it.
#ifndef GridFEM_DividedLevel_h
#define GridFEM_DividedLevel_h

#include "Algebra/DividedRows.h"
#include "Multigrid/Smoother.h"

#include <functional>
#include <memory>
#include <vector>

namespace gridfem
{

/// The matrix of such a level is the part that this process adds, and its order has the patches all
/// of whose unknowns are of this process alone. Others are relaxed by Relax, in double precision.
/// As DividedRows, all functions are called by all processes.
class DividedLevel
{
public:
  virtual ~DividedLevel() = default;

  virtual const DividedRows& Rows() const = 0;

  /// As Rows().Sum for vectors, without a gap, of the next coarser level, which all may hold whole.
  virtual void SumCoarse(Block<float> x) const = 0;
  virtual void SumCoarse(Block<double> x) const = 0;

  /// Unknowns of the patches that Relax relaxes, ascending.
  virtual const std::vector<Index>& Border() const = 0;

  /// One sweep over these patches.
  /// @param residual  fills the part of b - A x in the rows of Border()
  /// @param correct   adds a correction in these rows to x
  virtual void Relax(Id columns, SweepDirection direction,
    const std::function<void(MultiVector& part)>& residual,
    const std::function<void(const MultiVector& correction)>& correct) const = 0;
};

/// Relax as a smoother.
template<class Real>
std::unique_ptr<BasicSmoother<Real>> MakeBorderSmoother(
  std::shared_ptr<const DividedLevel> divided);

} // namespace gridfem

#endif
