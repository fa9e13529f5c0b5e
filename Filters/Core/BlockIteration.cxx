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
class BlockIteration
{
public:
  BlockIteration(const SpectralProblem& problem, const BlockOptions& options, EigenPairs& pairs,
    BlockWorkspace& workspace)
    : problem_(problem), options_(options), pairs_(pairs), directions_(workspace.directions),
      corrections_(workspace.corrections), spare_(workspace.vectors)
  {
  }

  BlockReport Run(const Progress& progress);

private:
  void SetStart();
  void RemoveKnown(Block X);
  bool Precondition(const Progress& progress);
  EigenResidual ResidualOf(Id first, Id count) const;
  const Preconditioner& CurrentPreconditioner();
  bool TakeMeasures(const Eigen::VectorXd& energy, const Eigen::VectorXd& norm);
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
    const Eigen::MatrixXd& overlap, MultiVector& vectors);
  double Fraction() const;

  const SpectralProblem& problem_;
  const BlockOptions& options_;
  EigenPairs& pairs_;         // X
  BlockBuffer& directions_;   // P
  BlockBuffer& corrections_;  // W = B r of the columns at work that have not converged
  MultiVector& spare_;        // where new vectors go when their number changes
  Eigen::MatrixXd stiffness_; // projected on [X, P], later [X, P, W]
  Eigen::MatrixXd mass_;
  Preconditioner fallback_; // when it is needed
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
  directions_.Reserve(rows, std::max<Id>(options_.blockSize, vectors + random.cols()));
  directions_.Show(vectors + random.cols());
  corrections_.Reserve(rows, options_.blockSize);
  corrections_.Show(0);
  BlockBuffer::Map& P = directions_.View();
  ForEachPanel(random.cols(), problem_.threads,
    [&](Id first, Id count)
    {
      problem_.precondition([&](Id begin, Id end, MultiVector& part)
        { part.topRows(end - begin) = load.block(begin, first, end - begin, count); },
        P.middleCols(vectors + first, count));
    });
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

/// L X - M X diag(θ) of `count` columns at work, the first of them number `first`.
EigenResidual BlockIteration::ResidualOf(Id first, Id count) const
{
  return EigenResidual(problem_.stiffness, problem_.mass, pairs_.vectors, pairs_.values,
    { atWork_.begin() + first, atWork_.begin() + first + count });
}

const Preconditioner& BlockIteration::CurrentPreconditioner()
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

/// Per column at work rᵀBr and rᵀr. True when all wanted ones have converged.
bool BlockIteration::TakeMeasures(const Eigen::VectorXd& energy, const Eigen::VectorXd& norm)
{
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
    SelectColumns(corrections_.View(), places, corrections_.View(), problem_.threads);
    corrections_.Show(static_cast<Id>(kept.size()));
    atWork_ = std::move(kept);
  }
}

/// Residuals and corrections of the columns at work. True when all wanted ones have converged.
bool BlockIteration::Correct(const Progress& progress)
{
  const Id columns = static_cast<Id>(atWork_.size());
  Eigen::VectorXd energy(columns);
  Eigen::VectorXd norm(columns);
  corrections_.Show(columns);
  const Preconditioner& precondition = this->CurrentPreconditioner();

  ForEachPanel(columns, problem_.threads,
    [&](Id first, Id count)
    {
      const EigenResidual residual = this->ResidualOf(first, count);
      const ResidualMeasures measures =
        precondition([&](Id begin, Id end, MultiVector& rows) { residual.Rows(begin, end, rows); },
          corrections_.View().middleCols(first, count));
      energy.segment(first, count) = measures.energy;
      norm.segment(first, count) = measures.norm;
    });
  progress.Check(fraction_);
  const bool done = this->TakeMeasures(energy, norm);
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
  Eigen::VectorXd norm(static_cast<Id>(atWork_.size()));
  ForEachPanel(norm.size(), problem_.threads,
    [&](Id first, Id count)
    {
      const EigenResidual residual = this->ResidualOf(first, count);
      norm.segment(first, count) =
        SquaredNorms([&](Id begin, Id end, MultiVector& rows) { residual.Rows(begin, end, rows); },
          problem_.mass.rows, count, problem_.threads);
    });
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

  // New vectors replace the old ones row by row.
  if (newX != oldX)
  {
    Reshape(spare_, problem_.mass.rows, newX);
  }
  MultiVector& vectors = newX != oldX ? spare_ : pairs_.vectors;
  this->CombineRows(ritz, columns, overlap, vectors);
  pairs_.values = ritz.values;
  pairs_.vectors.swap(vectors);
}

/// The products of NextVectors. `vectors` may be the old ones; new directions take the place of the
/// old ones.
void BlockIteration::CombineRows(const RitzPairs& ritz, const std::vector<Index>& columns,
  const Eigen::MatrixXd& overlap, MultiVector& vectors)
{
  const Id oldX = pairs_.vectors.cols();
  const Id oldP = directions_.Columns();
  const Id oldW = corrections_.Columns();
  const BlockBuffer::Map oldDirections = directions_.View();
  directions_.Show(static_cast<Id>(columns.size()));
  const Eigen::MatrixXd& C = ritz.coefficients;
  ParallelRanges(
    problem_.mass.rows, problem_.threads,
    [&](Id begin, Id end)
    {
      const auto rows = [&](auto& A) { return A.middleRows(begin, end - begin); };
      MultiVector share = rows(oldDirections) * C.middleRows(oldX, oldP);
      share.noalias() += rows(corrections_.View()) * C.bottomRows(oldW);
      MultiVector next = rows(pairs_.vectors) * C.topRows(oldX);
      next += share;
      MultiVector step = share(Eigen::all, columns);
      step.noalias() -= next * overlap;
      rows(vectors) = next;
      rows(directions_.View()) = step;
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
