#include "BlockIteration.h"

#include "BlockVectors.h"
#include "PairedProduct.h"
#include "Parallel.h"
#include "RayleighRitz.h"

#include <cmath>

namespace gridfem
{
namespace
{

/// Directions mixed in at the start of a level against eigenvectors the coarser level has missed.
constexpr Index MinimumRandomColumns = 4;

/// A converged column whose value moves by more than this many tolerances has to work again.
constexpr double WakeFactor = 10.0;

/// A converged column whose squared residual grows by more than this is measured again.
constexpr double GrowthFactor = 1.5;

/// After so many iterations the projected matrices are computed anew.
constexpr int RefreshInterval = 8;

/// Rows of the basis that are combined at a time: they stay in the cache.
constexpr Id CombinedRows = 512;

/// The iteration's state: the basis is [X, P, W].
class BlockIteration
{
public:
  BlockIteration(const SpectralProblem& problem, const BlockOptions& options, EigenPairs& pairs)
    : problem_(problem), options_(options), pairs_(pairs)
  {
  }

  BlockReport Run(const Progress& progress);

private:
  void SetStart();
  void RemoveKnown(MultiVector& X);
  bool Precondition(const Progress& progress);
  void ComputeResiduals();
  bool MeasureResiduals();
  bool Correct(const Progress& progress);
  void RayleighRitz(const Progress& progress);
  void ProjectOldPart();
  void ProjectCorrections();
  std::vector<Index> ColumnsAtWork() const;
  std::vector<Index> ColumnsThatMoved();
  std::vector<Index> ColumnsWithDirections(Index size) const;
  Eigen::MatrixXd Overlap(const RitzPairs& ritz, const Eigen::MatrixXd& step) const;
  void NextVectors(const RitzPairs& ritz);
  double Fraction() const;

  const SpectralProblem& problem_;
  const BlockOptions& options_;
  EigenPairs& pairs_;       // X
  MultiVector directions_;  // P
  MultiVector corrections_; // W = B r of the columns at work
  MultiVector residual_;
  MultiVector pair_;        // stiffness and mass times a part of the basis
  MultiVector nextVectors_; // room that is kept: fresh pages cost as much as the numbers in them
  MultiVector nextDirections_;
  Eigen::MatrixXd stiffness_; // projected on [X, P], later [X, P, W]
  Eigen::MatrixXd mass_;
  std::vector<Index> atWork_;
  std::vector<double> measure_;     // per column: rᵀBr / θ when it was last looked at
  std::vector<double> settledAt_;   // value at which a column has converged, else -1
  std::vector<double> settledNorm_; // squared norm of its residual then
  BlockReport report_;
  double fraction_ = 0.0;
};

/// Random directions; vectors that are no Ritz pairs become directions as well.
void BlockIteration::SetStart()
{
  const Id rows = problem_.mass.rows;
  const Id missing = options_.blockSize - pairs_.vectors.cols();
  const MultiVector random =
    RandomColumns(rows, std::max<Id>(MinimumRandomColumns, missing + MinimumRandomColumns));
  MultiVector load;
  Multiply(problem_.mass, random, load, problem_.threads);
  problem_.precondition(load, directions_);
  if (pairs_.values.size() == 0 && pairs_.vectors.cols() > 0)
  {
    MultiVector start(rows, pairs_.vectors.cols() + directions_.cols());
    start << pairs_.vectors, directions_;
    directions_.swap(start);
    pairs_.vectors.resize(rows, 0);
  }
  this->RemoveKnown(directions_);
}

/// Makes X orthogonal to all that is known.
void BlockIteration::RemoveKnown(MultiVector& X)
{
  problem_.constants->Remove(X);
  if (!problem_.known.empty())
  {
    Multiply(problem_.mass, X, residual_, problem_.threads);
    const Eigen::MatrixXd share = Project(problem_.known, residual_, problem_.threads);
    Combine(problem_.known, share, residual_, problem_.threads);
    X -= residual_;
  }
}

/// Columns that have not converged, or have moved since.
std::vector<Index> BlockIteration::ColumnsAtWork() const
{
  std::vector<Index> columns;
  for (Index j = 0; j < static_cast<Index>(pairs_.values.size()); ++j)
  {
    const bool settled =
      settledAt_[j] >= 0.0 && std::abs(pairs_.values[j] - settledAt_[j]) <=
                                WakeFactor * options_.tolerance * pairs_.values[j];
    if (!settled)
    {
      columns.push_back(j);
    }
  }
  return columns;
}

/// residual = L X - M X diag(θ) of the columns at work.
void BlockIteration::ComputeResiduals()
{
  const bool all = static_cast<Id>(atWork_.size()) == pairs_.values.size();
  const MultiVector selected =
    all ? MultiVector() : SelectColumns(pairs_.vectors, atWork_, problem_.threads);
  const MultiVector& X = all ? pairs_.vectors : selected;
  Eigen::VectorXd values(X.cols());
  for (Id j = 0; j < X.cols(); ++j)
  {
    values[j] = pairs_.values[atWork_[j]];
  }
  EigenResidual(problem_.stiffness, problem_.mass, X, values, residual_, problem_.threads);
}

/// True when all wanted columns at work have converged.
bool BlockIteration::MeasureResiduals()
{
  const Eigen::VectorXd energy = ColumnDots(residual_, corrections_, problem_.threads);
  const Eigen::VectorXd norm = ColumnDots(residual_, residual_, problem_.threads);
  bool done = true;
  for (Id j = 0; j < energy.size(); ++j)
  {
    const Index column = atWork_[j];
    const double value = pairs_.values[column];
    measure_[column] = std::max(0.0, energy[j]) / std::max(value, problem_.shift);
    const bool converged = measure_[column] <= options_.tolerance;
    settledAt_[column] = converged ? value : -1.0;
    settledNorm_[column] = norm[j];
    done = done && (converged || column >= options_.wanted);
  }
  return done;
}

/// Residuals and corrections of the columns at work. True when all wanted ones have converged.
bool BlockIteration::Correct(const Progress& progress)
{
  if (atWork_.empty())
  {
    corrections_.resize(problem_.mass.rows, 0);
    return true;
  }
  this->ComputeResiduals();
  progress.Check(fraction_);
  problem_.precondition(residual_, corrections_);
  progress.Check(fraction_);
  return this->MeasureResiduals();
}

/// Wanted columns that converged earlier and whose residual has grown since. A cycle for each would
/// measure it anew; its norm costs far less.
std::vector<Index> BlockIteration::ColumnsThatMoved()
{
  atWork_.clear();
  for (Index j = 0; j < std::min<Id>(options_.wanted, pairs_.values.size()); ++j)
  {
    atWork_.push_back(j);
  }
  this->ComputeResiduals();
  const Eigen::VectorXd norm = ColumnDots(residual_, residual_, problem_.threads);
  std::vector<Index> moved;
  for (const Index column : atWork_)
  {
    if (norm[column] > GrowthFactor * settledNorm_[column])
    {
      moved.push_back(column);
    }
  }
  return moved;
}

/// Residuals and corrections. True when all wanted pairs have converged: columns that converged
/// earlier are looked at once more before that is said.
bool BlockIteration::Precondition(const Progress& progress)
{
  const std::size_t size = static_cast<std::size_t>(pairs_.values.size());
  measure_.resize(size, 1.0);
  settledAt_.resize(size, -1.0);
  settledNorm_.resize(size, 0.0);
  atWork_ = this->ColumnsAtWork();
  if (!this->Correct(progress))
  {
    return false;
  }
  atWork_ = this->ColumnsThatMoved();
  const bool converged = this->Correct(progress);
  return converged && (static_cast<Index>(size) >= options_.wanted || report_.iterations > 0);
}

/// Stiffness and mass on [X, P] from the vectors. Between, they follow from the coefficients, and
/// rounding adds up.
void BlockIteration::ProjectOldPart()
{
  const Id size = pairs_.vectors.cols();
  const Id added = directions_.cols();
  const int threads = problem_.threads;
  stiffness_.resize(size + added, size + added);
  mass_.resize(size + added, size + added);
  if (size > 0)
  {
    MultiplyPair(problem_.stiffness, problem_.mass, pairs_.vectors, pair_, threads);
    const Eigen::MatrixXd X = Project({ &pairs_.vectors, &directions_ }, pair_, threads);
    stiffness_.leftCols(size) = X.leftCols(size);
    mass_.leftCols(size) = X.rightCols(size);
  }
  MultiplyPair(problem_.stiffness, problem_.mass, directions_, pair_, threads);
  const Eigen::MatrixXd P = Project({ &pairs_.vectors, &directions_ }, pair_, threads);
  stiffness_.rightCols(added) = P.leftCols(added);
  mass_.rightCols(added) = P.rightCols(added);
}

/// Extends stiffness and mass by the corrections.
void BlockIteration::ProjectCorrections()
{
  const Id old = stiffness_.rows();
  const Id added = corrections_.cols();
  const int threads = problem_.threads;
  MultiplyPair(problem_.stiffness, problem_.mass, corrections_, pair_, threads);
  const Eigen::MatrixXd projected =
    Project({ &pairs_.vectors, &directions_, &corrections_ }, pair_, threads);
  const auto extend = [&](Eigen::MatrixXd& A, auto columns)
  {
    A.conservativeResize(old + added, old + added);
    A.rightCols(added) = columns;
    A.bottomLeftCorner(added, old) = A.topRightCorner(old, added).transpose();
    A.triangularView<Eigen::StrictlyLower>() = A.transpose();
  };
  extend(stiffness_, projected.leftCols(added));
  extend(mass_, projected.rightCols(added));
}

/// The columns of the new vectors that still work.
std::vector<Index> BlockIteration::ColumnsWithDirections(Index size) const
{
  std::vector<Index> columns;
  for (const Index column : atWork_)
  {
    if (column < size && measure_[column] > options_.tolerance)
    {
      columns.push_back(column);
    }
  }
  return columns;
}

/// Coefficients in the new vectors of what makes `step` orthogonal to all of them when subtracted.
Eigen::MatrixXd BlockIteration::Overlap(const RitzPairs& ritz, const Eigen::MatrixXd& step) const
{
  const Eigen::VectorXd inverse = (ritz.values.array() + problem_.shift).inverse();
  const Eigen::MatrixXd image = stiffness_ * step + problem_.shift * (mass_ * step);
  return inverse.asDiagonal() * (ritz.coefficients.transpose() * image);
}

/// New X and P, and stiffness and mass on them. New directions are the shares of P and W in the new
/// vectors, less their overlap with these, so that [X, P] stays well conditioned.
void BlockIteration::NextVectors(const RitzPairs& ritz)
{
  const Id oldX = pairs_.vectors.cols();
  const Id oldP = directions_.cols();
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

  nextVectors_.resize(problem_.mass.rows, newX);
  nextDirections_.resize(problem_.mass.rows, newP);
  ParallelRanges(
    problem_.mass.rows, problem_.threads,
    [&](Id begin, Id end)
    {
      const Id count = end - begin;
      const auto rows = [&](MultiVector& A) { return A.middleRows(begin, count); };
      MultiVector share = rows(directions_) * ritz.coefficients.middleRows(oldX, oldP);
      share.noalias() += rows(corrections_) * ritz.coefficients.bottomRows(size - oldX - oldP);
      auto vectors = rows(nextVectors_);
      auto directions = rows(nextDirections_);
      vectors = share;
      vectors.noalias() += rows(pairs_.vectors) * ritz.coefficients.topRows(oldX);
      directions = share(Eigen::all, columns);
      directions.noalias() -= vectors * overlap;
    },
    CombinedRows);
  pairs_.values = ritz.values;
  pairs_.vectors.swap(nextVectors_);
  directions_.swap(nextDirections_);
}

void BlockIteration::RayleighRitz(const Progress& progress)
{
  this->RemoveKnown(corrections_);
  if (report_.iterations % RefreshInterval == 0)
  {
    this->ProjectOldPart();
  }
  this->ProjectCorrections();
  progress.Check(fraction_);
  const RitzPairs ritz = SolvePencil(stiffness_, mass_, problem_.shift, options_.blockSize);
  progress.Check(fraction_);
  this->NextVectors(ritz);
}

/// How far the slowest wanted pair has come, in orders of magnitude.
double BlockIteration::Fraction() const
{
  const Index wanted = std::min<Index>(options_.wanted, static_cast<Index>(pairs_.values.size()));
  double worst = wanted < options_.wanted ? 1.0 : options_.tolerance;
  for (Index j = 0; j < wanted; ++j)
  {
    worst = std::max(worst, measure_[j]);
  }
  return std::log(1.0 / worst) / std::log(1.0 / options_.tolerance);
}

BlockReport BlockIteration::Run(const Progress& progress)
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
  const Index wanted = std::min<Index>(options_.wanted, static_cast<Index>(pairs_.values.size()));
  for (Index j = 0; j < wanted; ++j)
  {
    report_.residuals.push_back(std::sqrt(measure_[j]));
    report_.numberOfConverged += measure_[j] <= options_.tolerance;
  }
  if (wanted < static_cast<Index>(pairs_.values.size()))
  {
    report_.nextResidual = std::sqrt(measure_[wanted]);
  }
  progress.Check(1.0);
  return report_;
}

} // namespace

BlockReport ImproveEigenPairs(const SpectralProblem& problem, const BlockOptions& options,
  EigenPairs& pairs, const Progress& progress)
{
  return BlockIteration(problem, options, pairs).Run(progress);
}

} // namespace gridfem
