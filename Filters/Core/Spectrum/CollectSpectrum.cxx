#include "Spectrum/CollectSpectrum.h"

#include "Algebra/BasisProducts.h"
#include "Algebra/BlockVectors.h"
#include "Base/Job.h"
#include "Base/LargeMemory.h"
#include "Base/Parallel.h"
#include "Base/PrecisionTraits.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>

namespace gridfem
{
namespace
{

/// Rows that are combined at a time.
constexpr Id RowsAtOnce = 512;

/// Orthonormal columns have a mass of 1 up to this error. The mass of any other column is rounding.
/// Such columns are functions that almost vanish, as on a sliver.
constexpr double LargestMassError = 1e-3;
constexpr double NotANumber = std::numeric_limits<double>::quiet_NaN();

/// Columns that are projected together. The partial sums of a thousand columns would take 200 MB.
constexpr Id ColumnsAtOnce = 128;

/// Puts the constants and the first `others` pairs side by side, in double precision.
template<class Real>
MultiVector SideBySide(
  const MultiVector& constants, const BlockBuffer<Real>& vectors, Id others, int threads)
{
  const Id columns = constants.cols() + others;
  ReturnLargeMemory(sizeof(double) * constants.rows() * columns);
  MultiVector all(constants.rows(), columns);
  PreferLargePages(all.data(), all.size() * sizeof(double));
  CopyBlock(constants, all.leftCols(constants.cols()), threads);
  if (others > 0)
  {
    CopyBlock(vectors.View().leftCols(others), all.rightCols(others), threads);
  }
  return all;
}

/// One step of Newton's method for columns that are orthonormal up to rounding to single precision.
/// It squares the error. [X (3 - XᵀMX) / 2]
void Orthonormalize(
  const SparseMatrix& mass, const DistributedRows* distributed, Block<double> X, const Job& job)
{
  Eigen::MatrixXd step(X.cols(), X.cols());
  for (Id first = 0; first < X.cols(); first += ColumnsAtOnce)
  {
    job.Check(1.0); // a thousand columns take a second, ten thousand minutes
    const Id count = std::min(ColumnsAtOnce, X.cols() - first);
    step.middleCols(first, count) =
      -0.5 * Project<double>({ X }, mass, X.middleCols(first, count), job.threads);
  }
  SumOverProcesses(distributed, step);
  step.diagonal().array() += 1.5;
  ParallelRanges(
    X.rows(), job.threads,
    [&](Id begin, Id end)
    {
      const MultiVector rows = X.middleRows(begin, end - begin) * step;
      X.middleRows(begin, end - begin) = rows;
    },
    RowsAtOnce);
}

/// Multiplies every column by its factor and puts the columns in the given order, which may leave
/// some out.
void ScaleAndOrder(
  const Eigen::RowVectorXd& factor, const std::vector<Index>& order, MultiVector& X, int threads)
{
  const auto columns = static_cast<Id>(order.size());
  ParallelRanges(X.rows(), threads,
    [&](Id begin, Id end)
    {
      for (Id row = begin; row < end; ++row)
      {
        const Eigen::RowVectorXd scaled = X.row(row).cwiseProduct(factor);
        X.row(row).head(columns) = scaled(order);
      }
    });
  if (columns < X.cols())
  {
    X.conservativeResize(Eigen::NoChange, columns);
  }
}

template<class List>
std::vector<double> Ordered(const List& list, const std::vector<Index>& order)
{
  std::vector<double> result;
  std::transform(order.begin(), order.end(), std::back_inserter(result),
    [&](Index place) { return list[place]; });
  return result;
}

} // namespace

template<class Real>
Spectrum CollectSpectrum(const Constants& constants, Index zeros, EigenPairs<Real>& pairs,
  const BlockReport& report, double tolerance, const SpectralProblem<Real>& problem,
  Eigen::MatrixXd& ofPairs, const Progress& progress)
{
  const Index others = static_cast<Index>(report.residuals.size());
  Spectrum spectrum;
  spectrum.numberOfConstants = constants.Count();
  spectrum.vectors = SideBySide(constants.Vectors(zeros), pairs.vectors, others, problem.threads);
  pairs.vectors = {};
  if (others > 0) // the rest of a constant that has come back, as on a sliver, has no mass
  {
    constants.Remove<double>(spectrum.vectors.rightCols(others));
  }
  if (PrecisionTraits<Real>::IsSingle && others > 0)
  {
    Orthonormalize(problem.mass, problem.distributed, spectrum.vectors.rightCols(others),
      { problem.threads, progress });
  }

  const ColumnFacts facts = problem.FactsOf(spectrum.vectors);
  Eigen::RowVectorXd values = Eigen::RowVectorXd::Zero(zeros + others);
  Eigen::RowVectorXd factor(zeros + others);
  const auto isNormal = [&](Index j) { return std::abs(facts.mass[j] - 1.0) < LargestMassError; };
  for (Index j = 0; j < values.size(); ++j)
  {
    const double mass = isNormal(j) ? facts.mass[j] : 1.0;
    factor[j] = (facts.largest[j] < 0.0 ? -1.0 : 1.0) / std::sqrt(mass);
    if (j >= zeros)
    {
      // Values below 0 are rounding, from functions on slivers that almost vanish.
      values[j] = isNormal(j) ? std::max(facts.energy[j] / mass, 0.0) : NotANumber;
    }
  }
  std::vector<Index> order;
  for (Index j = 0; j < zeros + others; ++j)
  {
    if (j < zeros || PrecisionTraits<Real>::IsSingle || isNormal(j))
    {
      order.push_back(j);
    }
  }
  std::stable_sort(order.begin() + zeros, order.end(),
    [&](Index a, Index b)
    { return values[a] < values[b] || (std::isnan(values[b]) && !std::isnan(values[a])); });
  ScaleAndOrder(factor, order, spectrum.vectors, problem.threads);
  if (problem.distributed)
  {
    problem.distributed->TakeGhosts(spectrum.vectors);
  }
  spectrum.eigenvalues = Ordered(values, order);
  std::vector<double> residuals(zeros, 0.0);
  residuals.insert(residuals.end(), report.residuals.begin(), report.residuals.end());
  spectrum.residuals = Ordered(residuals, order);
  std::vector<Index> ofOthers(order.begin() + zeros, order.end());
  std::for_each(ofOthers.begin(), ofOthers.end(), [&](Index& place) { place -= zeros; });
  ofPairs = Eigen::MatrixXd(ofPairs(ofOthers, Eigen::seqN(0, ofPairs.cols())));
  spectrum.estimatedErrors.assign(zeros, 0.0);
  spectrum.isErrorTrusted.assign(zeros, 1);
  spectrum.numberOfConverged = static_cast<Index>(std::count_if(spectrum.residuals.begin(),
    spectrum.residuals.end(), [&](double residual) { return residual * residual <= tolerance; }));
  spectrum.converged = spectrum.numberOfConverged == static_cast<Index>(order.size());
  spectrum.iterations = report.iterations;
  return spectrum;
}

template Spectrum CollectSpectrum(const Constants&, Index, EigenPairs<float>&, const BlockReport&,
  double, const SpectralProblem<float>&, Eigen::MatrixXd&, const Progress&);
template Spectrum CollectSpectrum(const Constants&, Index, EigenPairs<double>&, const BlockReport&,
  double, const SpectralProblem<double>&, Eigen::MatrixXd&, const Progress&);

} // namespace gridfem
