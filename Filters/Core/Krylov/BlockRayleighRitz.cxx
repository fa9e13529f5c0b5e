#include "Krylov/BlockRayleighRitz.h"

#include "Base/Parallel.h"
#include "Base/PrecisionTraits.h"

#include <algorithm>
#include <iterator>

namespace gridfem
{
namespace
{

/// The projected matrices are computed again after this many steps, because rounding errors add up.
constexpr int RefreshInterval = 8;

/// Rows of the basis that are combined at a time. They stay in the cache.
constexpr Id CombinedRows = 512;

} // namespace

template<class Real>
BlockRayleighRitz<Real>::BlockRayleighRitz(const SpectralProblem<Real>& problem,
  EigenPairs<Real>& pairs, BlockBuffer<Real>& directions, BlockBuffer<Real>& corrections)
  : problem_(problem), pairs_(pairs), directions_(directions), corrections_(corrections)
{
}

template<class Real>
void BlockRayleighRitz<Real>::Step(Index wanted, const std::vector<Index>& withDirections)
{
  const ConstBlock<Real> X = pairs_.vectors.View();
  const ConstBlock<Real> P = directions_.View();
  if (pairs_.isRenewed) // renewed on this level, or on a coarser one with the same products
  {
    stiffness_ = pairs_.values.asDiagonal();
    mass_ = Eigen::MatrixXd::Identity(X.cols(), X.cols());
    this->ProjectPart({ X }, P);
  }
  else if (steps_ % RefreshInterval == 0)
  {
    this->ProjectPart({}, X);
    this->ProjectPart({ X }, P);
  }
  this->ProjectPart({ X, P }, corrections_.View());
  const RitzPairs ritz =
    SolvePencil(stiffness_, mass_, problem_.shift, wanted, PrecisionTraits<Real>::DependentPivot);
  this->NextVectors(ritz, withDirections);
  pairs_.isRenewed = false;
  ++steps_;
}

template<class Real>
void BlockRayleighRitz<Real>::Renew()
{
  directions_.Show(0);
  corrections_.Show(0);
  this->ProjectPart({}, pairs_.vectors.View());
  const Index count = static_cast<Index>(pairs_.values.size());
  this->NextVectors(
    SolvePencil(stiffness_, mass_, problem_.shift, count, PrecisionTraits<Real>::DependentPivot),
    {});
  pairs_.isRenewed = true;
}

/// Extends the projected matrices, known on the basis `before`, by one more part of the basis.
template<class Real>
void BlockRayleighRitz<Real>::ProjectPart(
  const BasisParts<Real>& before, const ConstBlock<Real>& part)
{
  BasisParts<Real> basis = before;
  basis.push_back(part);
  const Id added = part.cols();
  const Eigen::MatrixXd projected = problem_.ProjectBoth(basis, part);
  const Id old = projected.rows() - added;
  const auto extend = [&](Eigen::MatrixXd& A, auto columns)
  {
    A.conservativeResize(old + added, old + added);
    A.rightCols(added) = columns;
    A.bottomLeftCorner(added, old) = A.topRightCorner(old, added).transpose();
    A.template triangularView<Eigen::StrictlyLower>() = A.transpose();
  };
  extend(stiffness_, projected.leftCols(added));
  extend(mass_, projected.rightCols(added));
}

/// The part of `step` in the span of the new vectors, as coefficients in them. Subtracting it makes
/// `step` orthogonal to all new vectors.
template<class Real>
Eigen::MatrixXd BlockRayleighRitz<Real>::Overlap(
  const RitzPairs& ritz, const Eigen::MatrixXd& step) const
{
  const Eigen::VectorXd inverse = (ritz.values.array() + problem_.shift).inverse();
  const Eigen::MatrixXd image = stiffness_ * step + problem_.shift * (mass_ * step);
  return inverse.asDiagonal() * (ritz.coefficients.transpose() * image);
}

/// Computes the new X and P, and stiffness and mass on them. New directions are the shares of P and
/// W in the new vectors. Their overlap with the new vectors is subtracted, so that [X, P] stays
/// well conditioned.
template<class Real>
void BlockRayleighRitz<Real>::NextVectors(
  const RitzPairs& ritz, const std::vector<Index>& withDirections)
{
  const Id oldX = pairs_.vectors.Columns();
  const Id size = ritz.coefficients.rows();
  const Id newX = ritz.values.size();
  std::vector<Index> columns;
  std::copy_if(withDirections.begin(), withDirections.end(), std::back_inserter(columns),
    [newX](Index column) { return column < newX; });
  const Id newP = static_cast<Id>(columns.size());
  Eigen::MatrixXd C = Eigen::MatrixXd::Zero(size, newX + newP);
  C.leftCols(newX) = ritz.coefficients;
  C.bottomRightCorner(size - oldX, newP) =
    ritz.coefficients.bottomRows(size - oldX)(Eigen::indexing::all, columns);
  const Eigen::MatrixXd overlap = this->Overlap(ritz, C.rightCols(newP));
  C.rightCols(newP) -= ritz.coefficients * overlap;
  stiffness_ = (C.transpose() * (stiffness_ * C)).eval();
  mass_ = (C.transpose() * (mass_ * C)).eval();
  this->CombineRows(ritz, columns, overlap);
  pairs_.values = ritz.values;
}

/// Carries out the products of NextVectors. New vectors and directions replace the old ones row by
/// row.
template<class Real>
void BlockRayleighRitz<Real>::CombineRows(
  const RitzPairs& ritz, const std::vector<Index>& columns, const Eigen::MatrixXd& overlap)
{
  const SmallMatrix C = ritz.coefficients.cast<Real>();
  const SmallMatrix& common = overlap.cast<Real>();
  const auto oldX = pairs_.vectors.View();
  const auto oldP = directions_.View();
  const auto W = corrections_.View();
  pairs_.vectors.Show(C.cols());
  directions_.Show(static_cast<Id>(columns.size()));
  auto newX = pairs_.vectors.View();
  auto newP = directions_.View();
  ParallelRanges(
    problem_.Rows(), problem_.threads,
    [&](Id begin, Id end)
    {
      const Id count = end - begin;
      Vectors<Real> share = oldP.middleRows(begin, count) * C.middleRows(oldX.cols(), oldP.cols());
      share.noalias() += W.middleRows(begin, count) * C.bottomRows(W.cols());
      Vectors<Real> next = oldX.middleRows(begin, count) * C.topRows(oldX.cols());
      next += share;
      Vectors<Real> step = share(Eigen::indexing::all, columns);
      step.noalias() -= next * common;
      newX.middleRows(begin, count) = next;
      newP.middleRows(begin, count) = step;
    },
    CombinedRows);
}

template class BlockRayleighRitz<float>;
template class BlockRayleighRitz<double>;

} // namespace gridfem
