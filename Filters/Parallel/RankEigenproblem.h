// The eigenproblem of one level whose functions several ranks hold together. Vectors here have the
// rows of this rank's own functions.
#ifndef GridFEM_RankEigenproblem_h
#define GridFEM_RankEigenproblem_h

#include "Krylov/SpectralProblem.h"
#include "Parallel/RankComponents.h"
#include "Parallel/RankCycle.h"

#include <memory>
#include <vector>

namespace gridfem
{

/// All functions are collective, and return the same bits on all ranks where they return sums.
class RankEigenproblem : public SpectralProblem<double>
{
public:
  /// Keeps a reference to the space.
  /// @param level  a divided one
  RankEigenproblem(const RankSpace& space, std::size_t level, const MultigridOptions& options);

  /// Sets the shift and builds the cycle of L + shift M.
  void SetShift(double value);

  Id Rows() const override { return numbering_.OwnFunctions(); }
  MultiVector MassTimes(const MultiVector& X) const override;
  Eigen::MatrixXd ProjectBoth(
    const BasisParts<double>& parts, const ConstBlock<double>& Y) const override;
  Eigen::MatrixXd ProjectMass(
    const BasisParts<double>& parts, const ConstBlock<double>& Y) const override;
  ResidualMeasures Correct(const BlockPreconditioner<double>& B, const EigenPairs<double>& pairs,
    const SoftLocking& locking, Block<double> W, const MultiVector& load,
    Block<double> P) const override;
  ColumnFacts FactsOf(const MultiVector& X) const override;
  Eigen::VectorXd SquaredResiduals(
    const EigenPairs<double>& pairs, const std::vector<Index>& columns) const override;

  /// ∫ 1
  double Area() const { return area_; }

  /// Rows of all functions that touch this rank's cells.
  MultiVector Spread(const ConstBlock<double>& X) const;

private:
  Eigen::MatrixXd ProjectOnto(const BasisParts<double>& parts, const ConstBlock<double>& Y,
    const std::vector<Mat>& matrices) const;
  MultiVector Times(Mat matrix, const ConstBlock<double>& X) const;
  MultiVector Residuals(const EigenPairs<double>& pairs, const std::vector<Index>& columns) const;
  void Precondition(Block<double> R) const;

  const RankSpace& space_;
  const std::size_t level_;
  const LevelNumbering& numbering_;
  MultigridOptions options_;
  PetscMatrix L_;
  PetscMatrix M_;
  LevelVectors vectors_;
  PetscVector from_; // what a matrix or a cycle is applied to, and the result
  PetscVector to_;
  std::unique_ptr<RankComponents> components_;
  std::unique_ptr<Constants> ofComponents_;
  double area_ = 0.0;
  std::unique_ptr<RankCycle> cycle_;
};

} // namespace gridfem

#endif
