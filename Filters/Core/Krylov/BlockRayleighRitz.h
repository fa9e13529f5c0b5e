// Rayleigh-Ritz step of LOBPCG: combines the vectors X, the directions P and the corrections W to
// new vectors and directions. Only the new blocks cost sums over all rows. The projected matrices
// of the other blocks follow from the coefficients. [NUMERICS §3]
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
  /// @param pairs  X with its values: Ritz pairs, or no pairs yet
  BlockRayleighRitz(const SpectralProblem<Real>& problem, EigenPairs<Real>& pairs,
    BlockBuffer<Real>& directions, BlockBuffer<Real>& corrections);

  /// Replaces X by the lowest `wanted` pairs of the span of [X, P, W], and P by the shares of P and
  /// W in them. Uses up W.
  /// @param withDirections  columns of X that get a direction, ascending
  void Step(Index wanted, const std::vector<Index>& withDirections);

  /// Rayleigh-Ritz on X alone, with all products computed again. P and W are lost.
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
