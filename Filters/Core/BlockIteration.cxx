#include "BlockIteration.h"

#include "PairedProduct.h"
#include "Parallel.h"
#include "RayleighRitz.h"

#include <cmath>
#include <random>

namespace gridfem
{
namespace
{

/// Directions mixed in at the start of a level against eigenvectors the coarser level has missed.
constexpr Index MinimumRandomColumns = 4;

/// A converged column whose value moves by more than this many tolerances has to work again.
constexpr double WakeFactor = 10.0;

/// Columns are handled in groups of this size where a loop over rows has to be serial.
constexpr Id ColumnGroup = 16;

/// Uniform in [-1, 1), the same on every platform.
MultiVector RandomColumns(Id rows, Id columns)
{
  std::mt19937_64 generator(20180901);
  MultiVector X(rows, columns);
  for (Id i = 0; i < rows; ++i)
  {
    for (Id j = 0; j < columns; ++j)
    {
      X(i, j) = static_cast<double>(generator() >> 11) * 0x1p-52 - 1.0;
    }
  }
  return X;
}

MultiVector SelectColumns(const MultiVector& X, const std::vector<Index>& columns, int threads)
{
  MultiVector result(X.rows(), static_cast<Id>(columns.size()));
  ParallelRanges(X.rows(), threads,
    [&](Id begin, Id end)
    {
      for (Id i = begin; i < end; ++i)
      {
        for (std::size_t j = 0; j < columns.size(); ++j)
        {
          result(i, static_cast<Id>(j)) = X(i, columns[j]);
        }
      }
    });
  return result;
}

/// Column-wise xᵀ y.
Eigen::VectorXd ColumnDots(const MultiVector& X, const MultiVector& Y, int threads)
{
  return ParallelSum(X.rows(), threads, Eigen::VectorXd(Eigen::VectorXd::Zero(X.cols())),
    [&](Id begin, Id end)
    {
      Eigen::VectorXd sum = Eigen::VectorXd::Zero(X.cols());
      for (Id i = begin; i < end; ++i)
      {
        sum += X.row(i).cwiseProduct(Y.row(i)).transpose();
      }
      return sum;
    });
}

/// The iteration's state: the basis is [X, W, P].
class BlockIteration
{
public:
  BlockIteration(const SpectralProblem& problem, const BlockOptions& options, EigenPairs& pairs)
    : problem_(problem), options_(options), pairs_(pairs)
  {
  }

  BlockReport Run(const Progress& progress);

private:
  void AddRandomDirections();
  bool Precondition(const Progress& progress);
  void RayleighRitz(const Progress& progress);
  std::vector<Index> ColumnsAtWork(bool all) const;
  Eigen::MatrixXd NextDirections(
    const RitzPairs& ritz, const Eigen::MatrixXd& shifted, Id oldSize) const;
  double Fraction() const;

  const SpectralProblem& problem_;
  const BlockOptions& options_;
  EigenPairs& pairs_;
  MultiVector corrections_; // W = B r of the columns at work
  MultiVector directions_;  // P
  std::vector<Index> atWork_;
  std::vector<double> measure_;   // per column: rᵀBr / θ when it was last looked at
  std::vector<double> settledAt_; // value at which a column has converged, else -1
  BlockReport report_;
  double firstWorst_ = 0.0;
  double fraction_ = 0.0;
};

void BlockIteration::AddRandomDirections()
{
  const Id rows = problem_.mass.rows;
  const Id missing = options_.blockSize - pairs_.vectors.cols();
  const MultiVector random =
    RandomColumns(rows, std::max<Id>(MinimumRandomColumns, missing + MinimumRandomColumns));
  MultiVector load;
  Multiply(problem_.mass, random, load, problem_.threads);
  problem_.precondition(load, directions_);
  problem_.constants->Remove(directions_);
}

std::vector<Index> BlockIteration::ColumnsAtWork(bool all) const
{
  std::vector<Index> columns;
  for (Index j = 0; j < static_cast<Index>(pairs_.values.size()); ++j)
  {
    const bool settled =
      settledAt_[j] >= 0.0 && std::abs(pairs_.values[j] - settledAt_[j]) <=
                                WakeFactor * options_.tolerance * pairs_.values[j];
    if (all ? j < options_.wanted : !settled)
    {
      columns.push_back(j);
    }
  }
  return columns;
}

/// Residuals and corrections of the columns at work. True when all wanted pairs have converged:
/// columns that converged earlier are looked at once more before that is said.
bool BlockIteration::Precondition(const Progress& progress)
{
  const int threads = problem_.threads;
  const Index size = static_cast<Index>(pairs_.values.size());
  measure_.resize(size, 1.0);
  settledAt_.resize(size, -1.0);
  for (const bool all : { false, true })
  {
    atWork_ = this->ColumnsAtWork(all);
    if (atWork_.empty())
    {
      corrections_.resize(problem_.mass.rows, 0);
      continue;
    }
    const MultiVector X = SelectColumns(pairs_.vectors, atWork_, threads);
    MultiVector residual;
    MultiVector massX;
    MultiplyPair(problem_.stiffness, problem_.mass, X, residual, massX, threads);
    Eigen::RowVectorXd values(X.cols());
    for (Id j = 0; j < X.cols(); ++j)
    {
      values[j] = pairs_.values[atWork_[j]];
    }
    ParallelRanges(X.rows(), threads,
      [&](Id begin, Id end)
      {
        residual.middleRows(begin, end - begin) -=
          massX.middleRows(begin, end - begin) * values.asDiagonal();
      });
    progress.Check(fraction_);
    problem_.precondition(residual, corrections_);
    progress.Check(fraction_);
    const Eigen::VectorXd energy = ColumnDots(residual, corrections_, threads);
    bool done = true;
    for (Id j = 0; j < X.cols(); ++j)
    {
      const Index column = atWork_[j];
      measure_[column] = std::max(0.0, energy[j]) / std::max(values[j], problem_.shift);
      const bool converged = measure_[column] <= options_.tolerance;
      settledAt_[column] = converged && column < options_.wanted ? values[j] : -1.0;
      done = done && (converged || column >= options_.wanted);
    }
    if (!done)
    {
      return false;
    }
  }
  return size >= options_.wanted || report_.iterations > 0;
}

/// Coefficients of the new directions: the share of W and P in the new vectors that still work,
/// made orthogonal to all new vectors, so that [X, P] stays well conditioned.
Eigen::MatrixXd BlockIteration::NextDirections(
  const RitzPairs& ritz, const Eigen::MatrixXd& shifted, Id oldSize) const
{
  const Id size = ritz.coefficients.rows();
  std::vector<Index> columns;
  for (const Index column : atWork_)
  {
    if (column < ritz.values.size() && measure_[column] > options_.tolerance)
    {
      columns.push_back(column);
    }
  }
  Eigen::MatrixXd C = Eigen::MatrixXd::Zero(size, static_cast<Id>(columns.size()));
  for (Id j = 0; j < C.cols(); ++j)
  {
    C.col(j).tail(size - oldSize) = ritz.coefficients.col(columns[j]).tail(size - oldSize);
  }
  const Eigen::VectorXd inverse = (ritz.values.array() + problem_.shift).inverse();
  const Eigen::MatrixXd overlap = ritz.coefficients.transpose() * (shifted * C);
  C.noalias() -= ritz.coefficients * (inverse.asDiagonal() * overlap);
  return C;
}

void BlockIteration::RayleighRitz(const Progress& progress)
{
  const int threads = problem_.threads;
  problem_.constants->Remove(corrections_);
  const Id oldSize = pairs_.vectors.cols();
  MultiVector basis(problem_.mass.rows, oldSize + corrections_.cols() + directions_.cols());
  ParallelRanges(basis.rows(), threads,
    [&](Id begin, Id end)
    {
      const Id count = end - begin;
      auto rows = basis.middleRows(begin, count);
      rows.leftCols(oldSize) = pairs_.vectors.middleRows(begin, count);
      rows.middleCols(oldSize, corrections_.cols()) = corrections_.middleRows(begin, count);
      rows.rightCols(directions_.cols()) = directions_.middleRows(begin, count);
    });
  MultiVector stiffnessBasis;
  MultiVector massBasis;
  MultiplyPair(problem_.stiffness, problem_.mass, basis, stiffnessBasis, massBasis, threads);
  progress.Check(fraction_);
  Eigen::MatrixXd stiffness;
  Eigen::MatrixXd mass;
  ProjectPair(basis, stiffnessBasis, massBasis, stiffness, mass, threads);
  progress.Check(fraction_);

  const RitzPairs ritz = SolvePencil(stiffness, mass, problem_.shift, options_.blockSize);
  const Id newSize = ritz.values.size();
  const Eigen::MatrixXd next =
    this->NextDirections(ritz, stiffness + problem_.shift * mass, oldSize);
  Eigen::MatrixXd C(basis.cols(), newSize + next.cols());
  C << ritz.coefficients, next;
  const MultiVector combined = Combine(basis, C, threads);
  pairs_.values = ritz.values;
  pairs_.vectors = combined.leftCols(newSize);
  directions_ = combined.rightCols(next.cols());
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
  this->AddRandomDirections();
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
  progress.Check(1.0);
  return report_;
}

} // namespace

Constants::Constants(
  const SparseMatrix& mass, std::vector<Index> component, Index numberOfComponents, int threads)
  : component_(std::move(component)), threads_(threads)
{
  weight_.assign(mass.rows, 0.0);
  mass_.assign(numberOfComponents, 0.0);
  double total = 0.0;
  for (Index i = 0; i < mass.rows; ++i)
  {
    for (Id k = mass.rowBegin[i]; k < mass.rowBegin[i + 1]; ++k)
    {
      weight_[i] += mass.value[k];
    }
    mass_[component_[i]] += weight_[i];
    total += weight_[i];
  }
  for (Index c = 0; c < numberOfComponents; ++c)
  {
    if (mass_[c] > 1e-14 * total)
    {
      massive_.push_back(c);
    }
    else
    {
      mass_[c] = 0.0;
    }
  }
}

void Constants::Remove(MultiVector& X) const
{
  const Id rows = X.rows();
  ParallelRanges(
    X.cols(), threads_,
    [&](Id begin, Id end)
    {
      MultiVector mean = MultiVector::Zero(static_cast<Id>(mass_.size()), end - begin);
      for (Id i = 0; i < rows; ++i)
      {
        mean.row(component_[i]) += weight_[i] * X.row(i).segment(begin, end - begin);
      }
      for (std::size_t c = 0; c < mass_.size(); ++c)
      {
        mean.row(static_cast<Id>(c)) *= mass_[c] > 0.0 ? 1.0 / mass_[c] : 0.0;
      }
      for (Id i = 0; i < rows; ++i)
      {
        X.row(i).segment(begin, end - begin) -= mean.row(component_[i]);
      }
    },
    ColumnGroup);
}

void Constants::Deflate(Eigen::MatrixXd& mass) const
{
  for (Id j = 0; j < mass.cols(); ++j)
  {
    const double total = mass_[component_[j]];
    for (Id i = 0; i < mass.rows(); ++i)
    {
      if (total > 0.0 && component_[i] == component_[j])
      {
        mass(i, j) -= weight_[i] * weight_[j] / total;
      }
    }
  }
}

MultiVector Constants::Vectors(Index count) const
{
  MultiVector result = MultiVector::Zero(static_cast<Id>(component_.size()), count);
  std::vector<Index> column(mass_.size(), -1);
  for (Index j = 0; j < count; ++j)
  {
    column[massive_[j]] = j;
  }
  for (std::size_t i = 0; i < component_.size(); ++i)
  {
    const Index j = column[component_[i]];
    if (j >= 0)
    {
      result(static_cast<Id>(i), j) = 1.0 / std::sqrt(mass_[component_[i]]);
    }
  }
  return result;
}

BlockReport ImproveEigenPairs(const SpectralProblem& problem, const BlockOptions& options,
  EigenPairs& pairs, const Progress& progress)
{
  return BlockIteration(problem, options, pairs).Run(progress);
}

} // namespace gridfem
