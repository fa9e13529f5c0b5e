// Which columns of a block iteration still work. What has converged drops out, stays in the
// Rayleigh-Ritz basis, and works again when it moves.
#ifndef GridFEM_SoftLocking_h
#define GridFEM_SoftLocking_h

#include "Multigrid/BlockPreconditioner.h"

#include <algorithm>
#include <cmath>
#include <vector>

namespace gridfem
{

class SoftLocking
{
public:
  /// @param tolerance  on rᵀBr / max(θ, shift)
  SoftLocking(Index wanted, double tolerance, double shift)
    : wanted_(wanted), tolerance_(tolerance), shift_(shift)
  {
  }

  /// To work: columns that have not converged, or whose values have moved since.
  void Start(const Eigen::VectorXd& values);

  /// To work: the wanted columns.
  void StartWanted();

  /// Numbers of the columns that work, ascending.
  const std::vector<Index>& AtWork() const { return atWork_; }

  /// Whether a column with this value and rᵀBr has converged.
  bool IsSmall(double energy, double value) const { return Relative(energy, value) <= tolerance_; }

  /// Takes the measures of the columns at work, all of which have a value. True when all wanted
  /// ones of them have converged.
  bool Update(const ResidualMeasures& measures, const Eigen::VectorXd& values);

  /// What has converged leaves the work. Returns the places in AtWork of those that stay.
  std::vector<Index> DropConverged();

  /// What has not changed since it converged leaves the work. @param norm  rᵀr of those at work
  void DropUnmoved(const Eigen::VectorXd& norm);

  bool IsConverged(Index column) const { return measure_[column] <= tolerance_; }
  /// rᵀBr / max(θ, shift) of a column when it was last looked at; 1 before.
  double Measure(Index column) const { return measure_[column]; }

private:
  /// Rounding may make rᵀBr negative: it is as far from zero then. NaN stays, and has not
  /// converged.
  double Relative(double energy, double value) const
  {
    return std::abs(energy) / std::max(value, shift_);
  }
  template<class Condition>
  std::vector<Index> KeepWhere(Condition&& condition);

  Index wanted_;
  double tolerance_;
  double shift_;
  std::vector<Index> atWork_;
  std::vector<double> measure_;
  std::vector<double> settledAt_;   // value at which a column has converged, else -1
  std::vector<double> settledNorm_; // rᵀr then
};

} // namespace gridfem

#endif
