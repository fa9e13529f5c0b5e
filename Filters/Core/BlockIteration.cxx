#include "BlockIteration.h"

#include "BasisProducts.h"
#include "BlockVectors.h"
#include "PairedProduct.h"
#include "Parallel.h"

#include <algorithm>
#include <cmath>
#include <iterator>

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

/// After so many iterations the projected matrices are computed anew: rounding adds up.
constexpr int RefreshInterval = 8;

/// Rows of the basis that are combined at a time: they stay in the cache.
constexpr Id CombinedRows = 512;

/// The iteration's state: the basis is [X, P, W].
class BlockIteration
{
public:
  BlockIteration(const SpectralProblem& problem, const BlockOptions& options, EigenPairs& pairs,
    BlockWorkspace& workspace)
    : problem_(problem), options_(options), pairs_(pairs), directions_(workspace.directions),
      corrections_(workspace.corrections), residual_(workspace.residual), spare_(workspace.vectors)
  {
  }

  BlockReport Run(const Progress& progress);

private:
  void SetStart();
  void RemoveKnown(Block X);
  bool Precondition(const Progress& progress);
  void ComputeResiduals();
  bool MeasureResiduals();
  void DropConverged();
  bool Correct(const Progress& progress);
  void RayleighRitz(const Progress& progress);
  void ProjectPart(const BasisParts& before, const ConstBlock& part);
  std::vector<Index> ColumnsAtWork() const;
  std::vector<Index> ColumnsThatMoved();
  std::vector<Index> ColumnsWithDirections(Index size) const;
  Eigen::MatrixXd Overlap(const RitzPairs& ritz, const Eigen::MatrixXd& step) const;
  void NextVectors(const RitzPairs& ritz);
  void CombineRows(const RitzPairs& ritz, const std::vector<Index>& columns,
    const Eigen::MatrixXd& overlap, MultiVector& vectors, Eigen::Map<MultiVector>& directions);
  double Fraction() const;

  const SpectralProblem& problem_;
  const BlockOptions& options_;
  EigenPairs& pairs_;        // X
  BlockBuffer& directions_;  // P
  BlockBuffer& corrections_; // W = B r of the columns at work that have not converged
  BlockBuffer& residual_;
  MultiVector& spare_;        // where new vectors go when their number changes
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
  const Id vectors = pairs_.values.size() > 0 ? 0 : pairs_.vectors.cols();
  directions_.Reshape(rows, vectors + random.cols());
  Eigen::Map<MultiVector>& P = directions_.View();
  problem_.precondition(load, P.rightCols(random.cols()));
  if (vectors > 0)
  {
    ParallelRanges(rows, problem_.threads,
      [&](Id begin, Id end)
      {
        P.middleRows(begin, end - begin).leftCols(vectors) =
          pairs_.vectors.middleRows(begin, end - begin);
      });
    pairs_.vectors.swap(spare_);
    pairs_.vectors.resize(rows, 0);
  }
  this->RemoveKnown(P);
}

/// Makes X orthogonal to all that is known.
void BlockIteration::RemoveKnown(Block X)
{
  problem_.constants->Remove(X);
  if (!problem_.known.empty() && X.cols() > 0)
  {
    const Eigen::MatrixXd share = Project(problem_.known, problem_.mass, X, problem_.threads);
    SubtractCombination(problem_.known, share, X, problem_.threads);
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
  const int threads = problem_.threads;
  const Id count = static_cast<Id>(atWork_.size());
  const Eigen::VectorXd values = pairs_.values(atWork_);
  const bool all = count == pairs_.values.size();
  if (!all) // corrections are not needed any more
  {
    SelectColumns(pairs_.vectors, atWork_, corrections_, threads);
  }
  const ConstBlock X = all ? ConstBlock(pairs_.vectors) : ConstBlock(corrections_.View());
  residual_.Reshape(problem_.mass.rows, count);
  EigenResidual(problem_.stiffness, problem_.mass, X, values, residual_.View(), threads);
}

/// True when all wanted columns at work have converged.
bool BlockIteration::MeasureResiduals()
{
  const ConstBlock r = residual_.View();
  const Eigen::VectorXd energy = ColumnDots(r, corrections_.View(), problem_.threads);
  const Eigen::VectorXd norm = ColumnDots(r, r, problem_.threads);
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

/// What has converged leaves the work; its correction is not needed.
void BlockIteration::DropConverged()
{
  std::vector<Index> kept;
  std::vector<Index> places;
  for (std::size_t j = 0; j < atWork_.size(); ++j)
  {
    if (measure_[atWork_[j]] > options_.tolerance)
    {
      kept.push_back(atWork_[j]);
      places.push_back(static_cast<Index>(j));
    }
  }
  if (kept.size() < atWork_.size())
  {
    SelectColumns(corrections_.View(), places, residual_, problem_.threads);
    corrections_.Swap(residual_);
    atWork_ = std::move(kept);
  }
}

/// Residuals and corrections of the columns at work. True when all wanted ones have converged.
bool BlockIteration::Correct(const Progress& progress)
{
  if (atWork_.empty())
  {
    corrections_.Reshape(problem_.mass.rows, 0);
    return true;
  }
  this->ComputeResiduals();
  progress.Check(fraction_);
  corrections_.Reshape(problem_.mass.rows, residual_.Columns());
  problem_.precondition(residual_.View(), corrections_.View());
  progress.Check(fraction_);
  const bool done = this->MeasureResiduals();
  this->DropConverged();
  return done;
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
  const Eigen::VectorXd norm = ColumnDots(residual_.View(), residual_.View(), problem_.threads);
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
  return converged && report_.iterations >= options_.minimumIterations &&
         (static_cast<Index>(size) >= options_.wanted || report_.iterations > 0);
}

/// Extends stiffness and mass on the basis `before` by one more part of it.
void BlockIteration::ProjectPart(const BasisParts& before, const ConstBlock& part)
{
  BasisParts basis = before;
  basis.push_back(part);
  const Id added = part.cols();
  const Eigen::MatrixXd projected =
    ProjectPair(basis, problem_.stiffness, problem_.mass, part, problem_.threads);
  const Id old = projected.rows() - added;
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
  std::copy_if(atWork_.begin(), atWork_.end(), std::back_inserter(columns),
    [size](Index column) { return column < size; });
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

  // The residual is not needed any more. New vectors replace the old ones row by row.
  residual_.Reshape(problem_.mass.rows, newP);
  if (newX != oldX)
  {
    Reshape(spare_, problem_.mass.rows, newX);
  }
  MultiVector& vectors = newX != oldX ? spare_ : pairs_.vectors;
  this->CombineRows(ritz, columns, overlap, vectors, residual_.View());
  pairs_.values = ritz.values;
  pairs_.vectors.swap(vectors);
  directions_.Swap(residual_);
}

/// The products of NextVectors. `vectors` may be the old ones.
void BlockIteration::CombineRows(const RitzPairs& ritz, const std::vector<Index>& columns,
  const Eigen::MatrixXd& overlap, MultiVector& vectors, Eigen::Map<MultiVector>& directions)
{
  const Id oldX = pairs_.vectors.cols();
  const Id oldP = directions_.Columns();
  const Id oldW = corrections_.Columns();
  const Eigen::MatrixXd& C = ritz.coefficients;
  ParallelRanges(
    problem_.mass.rows, problem_.threads,
    [&](Id begin, Id end)
    {
      const auto rows = [&](auto& A) { return A.middleRows(begin, end - begin); };
      MultiVector share = rows(directions_.View()) * C.middleRows(oldX, oldP);
      share.noalias() += rows(corrections_.View()) * C.bottomRows(oldW);
      MultiVector next = rows(pairs_.vectors) * C.topRows(oldX);
      next += share;
      MultiVector step = share(Eigen::all, columns);
      step.noalias() -= next * overlap;
      rows(vectors) = next;
      rows(directions) = step;
    },
    CombinedRows);
}

void BlockIteration::RayleighRitz(const Progress& progress)
{
  this->RemoveKnown(corrections_.View());
  const ConstBlock X = pairs_.vectors;
  const ConstBlock P = directions_.View();
  if (report_.iterations % RefreshInterval == 0) // between, they follow from the coefficients
  {
    this->ProjectPart({}, X);
    this->ProjectPart({ X }, P);
  }
  this->ProjectPart({ X, P }, corrections_.View());
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
  EigenPairs& pairs, BlockWorkspace& workspace, const Progress& progress)
{
  return BlockIteration(problem, options, pairs, workspace).Run(progress);
}

} // namespace gridfem
