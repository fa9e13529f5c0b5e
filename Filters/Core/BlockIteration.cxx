#include "BlockIteration.h"

#include "BasisProducts.h"
#include "BlockVectors.h"
#include "PairedProduct.h"
#include "Parallel.h"
#include "SoftLocking.h"

#include <algorithm>
#include <cmath>
#include <iterator>

namespace gridfem
{
namespace
{

/// Directions mixed in at the start of a level against eigenvectors the coarser level has missed.
constexpr Index MinimumRandomColumns = 4;

/// After so many iterations the projected matrices are computed anew: rounding adds up.
constexpr int RefreshInterval = 8;

/// Rows of the basis that are combined at a time: they stay in the cache.
constexpr Id CombinedRows = 512;

/// Steps after which the fallback takes over. Most problems need three to six; those with strands
/// of surface that nearly touch fifteen, whatever the preconditioner's precision.
constexpr int StepsBeforeFallback = 20;

/// Calls body(first, count) for panels of columns that a preconditioner takes. Panels know nothing
/// of each other, so each is the job of one thread where there are enough of them.
template<class Body>
void ForEachPanel(Id columns, int threads, Body&& body)
{
  const Id panels = (columns + PreconditionedColumns - 1) / PreconditionedColumns;
  ParallelBlocks(panels, panels >= NumberOfThreads(threads) ? threads : 1,
    [&](Id panel)
    {
      const Id first = panel * PreconditionedColumns;
      body(first, std::min(PreconditionedColumns, columns - first));
    });
}

/// The iteration's state: the basis is [X, P, W].
template<class Real>
class BlockIteration
{
public:
  BlockIteration(const SpectralProblem& problem, const BlockOptions& options,
    const BasisParts<Real>& known, EigenPairs<Real>& pairs, BlockWorkspace<Real>& workspace)
    : problem_(problem), options_(options), known_(known), pairs_(pairs),
      directions_(workspace.directions), corrections_(workspace.corrections),
      locking_(options.wanted, options.tolerance, problem.shift)
  {
  }

  BlockReport Run(const Progress& progress);

private:
  using SmallMatrix = Eigen::Matrix<Real, Eigen::Dynamic, Eigen::Dynamic>;

  void SetStart();
  void PreconditionRandom(const MultiVector& random, Id first);
  void RemoveKnown(Block<Real> X);
  bool Precondition(const Progress& progress);
  EigenResidual<Real> ResidualOf(Id first, Id count) const;
  const Preconditioner& CurrentPreconditioner();
  bool Correct(const Progress& progress);
  Eigen::VectorXd SquaredResiduals() const;
  void RayleighRitz(const Progress& progress);
  void ProjectPart(const BasisParts<Real>& before, const ConstBlock<Real>& part);
  std::vector<Index> ColumnsWithDirections(Index size) const;
  Eigen::MatrixXd Overlap(const RitzPairs& ritz, const Eigen::MatrixXd& step) const;
  void NextVectors(const RitzPairs& ritz);
  void CombineRows(
    const RitzPairs& ritz, const std::vector<Index>& columns, const Eigen::MatrixXd& overlap);
  double Fraction() const;
  Index FoundAndWanted() const;

  const SpectralProblem& problem_;
  const BlockOptions& options_;
  const BasisParts<Real>& known_;
  EigenPairs<Real>& pairs_;        // X
  BlockBuffer<Real>& directions_;  // P
  BlockBuffer<Real>& corrections_; // W = B r of the columns at work that have not converged
  Eigen::MatrixXd stiffness_;      // projected on [X, P], later [X, P, W]
  Eigen::MatrixXd mass_;
  Preconditioner fallback_; // when it is needed
  SoftLocking locking_;
  BlockReport report_;
  double fraction_ = 0.0;
};

/// Random directions; vectors that are no Ritz pairs become directions as well.
template<class Real>
void BlockIteration<Real>::SetStart()
{
  const Id rows = problem_.mass.rows;
  const Id missing = options_.blockSize - pairs_.vectors.Columns();
  const MultiVector random =
    RandomColumns(rows, std::max<Id>(MinimumRandomColumns, missing + MinimumRandomColumns));
  const Id vectors = pairs_.values.size() > 0 ? 0 : pairs_.vectors.Columns();
  directions_.Reserve(rows, std::max<Id>(options_.blockSize, vectors + random.cols()));
  directions_.Show(vectors + random.cols());
  corrections_.Reserve(rows, options_.blockSize);
  corrections_.Show(0);
  this->PreconditionRandom(random, vectors);
  if (vectors > 0)
  {
    CopyBlock(pairs_.vectors.View(), directions_.View().leftCols(vectors), problem_.threads);
    pairs_.vectors.Show(0);
  }
  pairs_.vectors.Grow(rows, options_.blockSize, problem_.threads);
  this->RemoveKnown(directions_.View());
}

/// B M times the random vectors, as directions from number `first` on.
template<class Real>
void BlockIteration<Real>::PreconditionRandom(const MultiVector& random, Id first)
{
  MultiVector load;
  Multiply(problem_.mass, random, load, problem_.threads);
  auto P = directions_.View();
  ForEachPanel(random.cols(), problem_.threads,
    [&](Id panel, Id count)
    {
      const RowSource source{ load.rows(), count,
        [&](Id begin, Id end, MultiVector& part)
        { part.topRows(end - begin) = load.block(begin, panel, end - begin, count); } };
      problem_.precondition(source,
        [&](Id begin, Id end, const MultiVector& part)
        {
          P.block(begin, first + panel, end - begin, count) =
            part.topRows(end - begin).template cast<Real>();
        });
    });
}

/// Makes X orthogonal to all that is known.
template<class Real>
void BlockIteration<Real>::RemoveKnown(Block<Real> X)
{
  problem_.constants->Remove<Real>(X);
  if (!known_.empty() && X.cols() > 0)
  {
    const Eigen::MatrixXd share = Project<Real>(known_, problem_.mass, X, problem_.threads);
    SubtractCombination<Real>(known_, share, X, problem_.threads);
  }
}

/// L X - M X diag(θ) of `count` columns at work, the first of them number `first`.
template<class Real>
EigenResidual<Real> BlockIteration<Real>::ResidualOf(Id first, Id count) const
{
  const auto begin = locking_.AtWork().begin() + first;
  return EigenResidual<Real>(problem_.stiffness, problem_.mass,
    std::as_const(pairs_.vectors).View(), pairs_.values, { begin, begin + count });
}

template<class Real>
const Preconditioner& BlockIteration<Real>::CurrentPreconditioner()
{
  if (report_.iterations < StepsBeforeFallback || !problem_.fallback)
  {
    return problem_.precondition;
  }
  if (!fallback_)
  {
    fallback_ = problem_.fallback();
  }
  return fallback_;
}

/// Residuals and corrections of the columns at work. True when all wanted ones have converged.
template<class Real>
bool BlockIteration<Real>::Correct(const Progress& progress)
{
  const Id columns = static_cast<Id>(locking_.AtWork().size());
  ResidualMeasures all{ Eigen::VectorXd(columns), Eigen::VectorXd(columns) };
  corrections_.Show(columns);
  auto W = corrections_.View();
  const Preconditioner& precondition = this->CurrentPreconditioner();

  ForEachPanel(columns, problem_.threads,
    [&](Id first, Id count)
    {
      const EigenResidual<Real> residual = this->ResidualOf(first, count);
      const RowSource source{ W.rows(), count,
        [&](Id begin, Id end, MultiVector& part) { residual.Rows(begin, end, part); } };
      const ResidualMeasures measures = precondition(source,
        [&](Id begin, Id end, const MultiVector& part) {
          W.block(begin, first, end - begin, count) =
            part.topRows(end - begin).template cast<Real>();
        });
      all.energy.segment(first, count) = measures.energy;
      all.norm.segment(first, count) = measures.norm;
    });
  progress.Check(fraction_);
  const bool done = locking_.Update(all, pairs_.values);
  const std::vector<Index> places = locking_.DropConverged();
  if (static_cast<Id>(places.size()) < columns) // their corrections are not needed
  {
    corrections_.Keep(places, problem_.threads);
  }
  return done;
}

/// rᵀr of the columns at work. A cycle for each would cost far more.
template<class Real>
Eigen::VectorXd BlockIteration<Real>::SquaredResiduals() const
{
  Eigen::VectorXd norm(static_cast<Id>(locking_.AtWork().size()));
  ForEachPanel(norm.size(), problem_.threads,
    [&](Id first, Id count)
    {
      const EigenResidual<Real> residual = this->ResidualOf(first, count);
      const RowSource source{ problem_.mass.rows, count,
        [&](Id begin, Id end, MultiVector& part) { residual.Rows(begin, end, part); } };
      norm.segment(first, count) = SquaredNorms(source, problem_.threads);
    });
  return norm;
}

/// Residuals and corrections. True when all wanted pairs have converged: columns that converged
/// earlier are looked at once more before that is said.
template<class Real>
bool BlockIteration<Real>::Precondition(const Progress& progress)
{
  locking_.Start(pairs_.values);
  if (!this->Correct(progress))
  {
    return false;
  }
  locking_.StartWanted();
  locking_.DropUnmoved(this->SquaredResiduals());
  const bool converged = this->Correct(progress);
  return converged && report_.iterations >= options_.minimumIterations &&
         (this->FoundAndWanted() == options_.wanted || report_.iterations > 0);
}

/// Extends stiffness and mass on the basis `before` by one more part of it.
template<class Real>
void BlockIteration<Real>::ProjectPart(const BasisParts<Real>& before, const ConstBlock<Real>& part)
{
  BasisParts<Real> basis = before;
  basis.push_back(part);
  const Id added = part.cols();
  const Eigen::MatrixXd projected =
    ProjectPair<Real>(basis, problem_.stiffness, problem_.mass, part, problem_.threads);
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

/// The columns of the new vectors that still work.
template<class Real>
std::vector<Index> BlockIteration<Real>::ColumnsWithDirections(Index size) const
{
  std::vector<Index> columns;
  std::copy_if(locking_.AtWork().begin(), locking_.AtWork().end(), std::back_inserter(columns),
    [size](Index column) { return column < size; });
  return columns;
}

/// Coefficients in the new vectors of what makes `step` orthogonal to all of them when subtracted.
template<class Real>
Eigen::MatrixXd BlockIteration<Real>::Overlap(
  const RitzPairs& ritz, const Eigen::MatrixXd& step) const
{
  const Eigen::VectorXd inverse = (ritz.values.array() + problem_.shift).inverse();
  const Eigen::MatrixXd image = stiffness_ * step + problem_.shift * (mass_ * step);
  return inverse.asDiagonal() * (ritz.coefficients.transpose() * image);
}

/// New X and P, and stiffness and mass on them. New directions are the shares of P and W in the new
/// vectors, less their overlap with these, so that [X, P] stays well conditioned.
template<class Real>
void BlockIteration<Real>::NextVectors(const RitzPairs& ritz)
{
  const Id oldX = pairs_.vectors.Columns();
  const Id size = ritz.coefficients.rows();
  const Id newX = ritz.values.size();
  const std::vector<Index> columns = this->ColumnsWithDirections(static_cast<Index>(newX));
  const Id newP = static_cast<Id>(columns.size());
  Eigen::MatrixXd C = Eigen::MatrixXd::Zero(size, newX + newP);
  C.leftCols(newX) = ritz.coefficients;
  C.bottomRightCorner(size - oldX, newP) =
    ritz.coefficients.bottomRows(size - oldX)(Eigen::all, columns);
  const Eigen::MatrixXd overlap = this->Overlap(ritz, C.rightCols(newP));
  C.rightCols(newP) -= ritz.coefficients * overlap;
  stiffness_ = (C.transpose() * (stiffness_ * C)).eval();
  mass_ = (C.transpose() * (mass_ * C)).eval();
  this->CombineRows(ritz, columns, overlap);
  pairs_.values = ritz.values;
}

/// The products of NextVectors: new vectors and directions replace the old ones row by row.
template<class Real>
void BlockIteration<Real>::CombineRows(
  const RitzPairs& ritz, const std::vector<Index>& columns, const Eigen::MatrixXd& overlap)
{
  const SmallMatrix C = ritz.coefficients.cast<Real>();
  const SmallMatrix common = overlap.cast<Real>();
  const auto oldX = pairs_.vectors.View();
  const auto oldP = directions_.View();
  const auto W = corrections_.View();
  pairs_.vectors.Show(C.cols());
  directions_.Show(static_cast<Id>(columns.size()));
  auto newX = pairs_.vectors.View();
  auto newP = directions_.View();
  ParallelRanges(
    problem_.mass.rows, problem_.threads,
    [&](Id begin, Id end)
    {
      const Id count = end - begin;
      Vectors<Real> share = oldP.middleRows(begin, count) * C.middleRows(oldX.cols(), oldP.cols());
      share.noalias() += W.middleRows(begin, count) * C.bottomRows(W.cols());
      Vectors<Real> next = oldX.middleRows(begin, count) * C.topRows(oldX.cols());
      next += share;
      Vectors<Real> step = share(Eigen::all, columns);
      step.noalias() -= next * common;
      newX.middleRows(begin, count) = next;
      newP.middleRows(begin, count) = step;
    },
    CombinedRows);
}

template<class Real>
void BlockIteration<Real>::RayleighRitz(const Progress& progress)
{
  this->RemoveKnown(corrections_.View());
  const ConstBlock<Real> X = pairs_.vectors.View();
  const ConstBlock<Real> P = directions_.View();
  if (report_.iterations % RefreshInterval == 0) // between, they follow from the coefficients
  {
    this->ProjectPart({}, X);
    this->ProjectPart({ X }, P);
  }
  this->ProjectPart({ X, P }, corrections_.View());
  progress.Check(fraction_);
  const RitzPairs ritz =
    SolvePencil(stiffness_, mass_, problem_.shift, options_.blockSize, DependentPivot<Real>);
  progress.Check(fraction_);
  this->NextVectors(ritz);
}

template<class Real>
Index BlockIteration<Real>::FoundAndWanted() const
{
  return std::min<Index>(options_.wanted, static_cast<Index>(pairs_.values.size()));
}

/// How far the slowest wanted pair has come, in orders of magnitude.
template<class Real>
double BlockIteration<Real>::Fraction() const
{
  const Index found = this->FoundAndWanted();
  double worst = found < options_.wanted ? 1.0 : options_.tolerance;
  for (Index j = 0; j < found; ++j)
  {
    worst = std::max(worst, locking_.Measure(j));
  }
  return std::log(1.0 / worst) / std::log(1.0 / options_.tolerance);
}

template<class Real>
BlockReport BlockIteration<Real>::Run(const Progress& progress)
{
  progress.Check(0.0);
  this->SetStart();
  while (true)
  {
    const bool done = this->Precondition(progress);
    fraction_ = std::clamp(this->Fraction(), fraction_, 1.0);
    if (done || report_.iterations == options_.maximumIterations)
    {
      break;
    }
    this->RayleighRitz(progress);
    ++report_.iterations;
  }
  const Index found = this->FoundAndWanted();
  for (Index j = 0; j < found; ++j)
  {
    report_.residuals.push_back(std::sqrt(locking_.Measure(j)));
    report_.numberOfConverged += locking_.IsConverged(j);
  }
  if (found < static_cast<Index>(pairs_.values.size()))
  {
    report_.nextResidual = std::sqrt(locking_.Measure(found));
  }
  progress.Check(1.0);
  return report_;
}

} // namespace

template<class Real>
BlockReport ImproveEigenPairs(const SpectralProblem& problem, const BlockOptions& options,
  const BasisParts<Real>& known, EigenPairs<Real>& pairs, BlockWorkspace<Real>& workspace,
  const Progress& progress)
{
  return BlockIteration<Real>(problem, options, known, pairs, workspace).Run(progress);
}

template BlockReport ImproveEigenPairs(const SpectralProblem&, const BlockOptions&,
  const BasisParts<float>&, EigenPairs<float>&, BlockWorkspace<float>&, const Progress&);
template BlockReport ImproveEigenPairs(const SpectralProblem&, const BlockOptions&,
  const BasisParts<double>&, EigenPairs<double>&, BlockWorkspace<double>&, const Progress&);

} // namespace gridfem
