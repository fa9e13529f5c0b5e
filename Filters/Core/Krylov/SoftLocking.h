// The columns of a block iteration that are still at work. Converged columns drop out, stay in the
// Rayleigh-Ritz basis, and work again when they move.
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

  /// Activates the columns that have not converged, and the columns with values that have moved
  /// since.
  void Start(const Eigen::VectorXd& values);

  /// Puts the wanted columns to work.
  void StartWanted();

  /// Numbers of the columns at work, ascending.
  const std::vector<Index>& AtWork() const { return atWork_; }

  /// Whether a column with this value and rᵀBr has converged.
  bool IsSmall(double energy, double value) const { return Relative(energy, value) <= tolerance_; }

  /// Takes the measures of the columns at work, all of which have a value. True when all wanted
  /// columns among them have converged.
  bool Update(const ResidualMeasures& measures, const Eigen::VectorXd& values);

  /// Drops converged columns from the work. Returns the places in AtWork of the columns that stay.
  std::vector<Index> DropConverged();

  /// Drops from the work the columns that have not changed since they converged.
  /// @param norm  rᵀr of the columns at work
  void DropUnmoved(const Eigen::VectorXd& norm);

  bool IsConverged(Index column) const { return measure_[column] <= tolerance_; }
  /// rᵀBr / max(θ, shift) of a column when it was last measured; 1 before its first measurement.
  double Measure(Index column) const { return measure_[column]; }

private:
  /// Rounding may make rᵀBr negative. The magnitude then still tells how far it is from zero. NaN
  /// stays NaN and therefore has not converged.
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
  std::vector<double> settledAt_;   // value at which the column has converged, else -1
  std::vector<double> settledNorm_; // rᵀr at that time
};

} // namespace gridfem

#endif
