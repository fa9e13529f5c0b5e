#include "CollectSpectrum.h"

#include "BlockVectors.h"
#include "Parallel.h"

namespace gridfem
{
namespace
{

constexpr Id PanelWidth = 8;

/// The entry of largest magnitude of M x becomes positive, ties to the lowest index.
void FixSigns(const SparseMatrix& mass, MultiVector& X, int threads)
{
  MultiVector load;
  Multiply(mass, X, load, threads);
  for (Id j = 0; j < X.cols(); ++j)
  {
    Id largest = 0;
    load.col(j).cwiseAbs().maxCoeff(&largest);
    if (load(largest, j) < 0.0)
    {
      X.col(j) *= -1.0;
    }
  }
}

} // namespace

Spectrum CollectSpectrum(const Constants& constants, Index zeros, const EigenPairs& pairs,
  const BlockReport& report, const SparseMatrix& mass, int threads)
{
  const Index others = static_cast<Index>(report.residuals.size());
  Spectrum spectrum;
  spectrum.eigenvalues.assign(zeros, 0.0);
  spectrum.eigenvalues.insert(
    spectrum.eigenvalues.end(), pairs.values.data(), pairs.values.data() + others);
  spectrum.vectors.resize(mass.rows, zeros + others);
  spectrum.vectors.leftCols(zeros) = constants.Vectors(zeros);
  if (others > 0)
  {
    spectrum.vectors.rightCols(others) = pairs.vectors.leftCols(others);
  }
  FixSigns(mass, spectrum.vectors, threads);
  spectrum.residuals.assign(zeros, 0.0);
  spectrum.residuals.insert(
    spectrum.residuals.end(), report.residuals.begin(), report.residuals.end());
  spectrum.estimatedErrors.assign(zeros, 0.0);
  spectrum.numberOfConverged = zeros + report.numberOfConverged;
  spectrum.converged = spectrum.numberOfConverged == zeros + others;
  spectrum.iterations = report.iterations;
  return spectrum;
}

void CycleOnColumns(
  const Multigrid& multigrid, std::size_t level, const MultiVector& r, MultiVector& z)
{
  Reshape(z, r.rows(), r.cols());
  ParallelRanges(
    r.cols(), multigrid.Options().threads,
    [&](Id begin, Id end)
    {
      const MultiVector residual = r.middleCols(begin, end - begin);
      MultiVector correction;
      multigrid.PreconditionFrom(level, residual, correction);
      z.middleCols(begin, end - begin) = correction;
    },
    PanelWidth);
}

} // namespace gridfem
