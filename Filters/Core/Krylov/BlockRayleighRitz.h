// Rayleigh-Ritz on the blocks of a LOBPCG step: vectors X, directions P and corrections W are
// combined to new vectors and directions. Sums over all rows are taken of what is new alone; the
// projected matrices of the rest follow from the coefficients. [NUMERICS §3]
#ifndef GridFEM_BlockRayleighRitz_h
#define GridFEM_BlockRayleighRitz_h

#include "Algebra/BasisProducts.h"
#include "Algebra/RayleighRitz.h"
#include "Krylov/SpectralProblem.h"

#include <vector>

namespace gridfem
{

template<class Real>
class BlockRayleighRitz
{
public:
  /// @param pairs  X; Ritz pairs, or none
  BlockRayleighRitz(const SpectralProblem<Real>& problem, EigenPairs<Real>& pairs,
    BlockBuffer<Real>& directions, BlockBuffer<Real>& corrections);

  /// The lowest `wanted` pairs of the span become X, their shares of P and W become P; W is used
  /// up.
  /// @param withDirections  columns of X that get a direction, ascending
  void Step(Index wanted, const std::vector<Index>& withDirections);

  /// Rayleigh-Ritz on X alone, of which it computes all products; P and W are lost.
  void Renew();

private:
  using SmallMatrix = Eigen::Matrix<Real, Eigen::Dynamic, Eigen::Dynamic>;

  void ProjectPart(const BasisParts<Real>& before, const ConstBlock<Real>& part);
  Eigen::MatrixXd Overlap(const RitzPairs& ritz, const Eigen::MatrixXd& step) const;
  void NextVectors(const RitzPairs& ritz, const std::vector<Index>& withDirections);
  void CombineRows(
    const RitzPairs& ritz, const std::vector<Index>& columns, const Eigen::MatrixXd& overlap);

  const SpectralProblem<Real>& problem_;
  EigenPairs<Real>& pairs_;
  BlockBuffer<Real>& directions_;
  BlockBuffer<Real>& corrections_;
  Eigen::MatrixXd stiffness_; // projected on [X, P], later [X, P, W]
  Eigen::MatrixXd mass_;
  int steps_ = 0;
};

} // namespace gridfem

#endif
