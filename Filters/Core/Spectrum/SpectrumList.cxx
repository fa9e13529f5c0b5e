#include "Spectrum/SpectrumList.h"

#include "Krylov/LobpcgWindows.h"
#include "Spectrum/SpectrumAccuracy.h"

#include <algorithm>
#include <cmath>

namespace gridfem
{
namespace
{

/// Whether the pair behind the first `count` belongs to the multiplet of the last of them. Its
/// value may be too large by the relative error.
bool EndsInside(const Eigen::VectorXd& values, Id count, double error, Index zeros)
{
  return count < values.size() &&
         IsMultiplet(values[count - 1], (1.0 - error) * values[count], zeros + count);
}

/// Keeps only the first `count` pairs in the report.
void Shorten(BlockReport& report, Id count, double tolerance)
{
  report.residuals.resize(std::min<std::size_t>(count, report.residuals.size()));
  report.numberOfConverged = static_cast<Index>(std::count_if(report.residuals.begin(),
    report.residuals.end(), [&](double residual) { return residual * residual <= tolerance; }));
}

/// Measures pairs without an iteration, which would only find rounding.
template<class Real>
ListReport MeasureAll(const SpectralProblem<Real>& problem, BlockOptions block, const ListEnd& end,
  EigenPairs<Real>& pairs, const Progress& progress)
{
  ListReport report;
  block.maximumIterations = 0;
  block.blockSize = static_cast<Index>(pairs.values.size());
  block.wanted = std::min(block.wanted, block.blockSize);
  while (end.completeMultiplets && EndsInside(pairs.values, block.wanted, 0.0, end.zeros))
  {
    ++block.wanted;
  }
  report.cutsMultiplet = EndsInside(pairs.values, block.wanted, 0.0, end.zeros);
  BlockWorkspace<Real> workspace;
  report.block = ImproveEigenPairs<Real>(problem, block, {}, pairs, workspace, progress);
  return report;
}

} // namespace

/// The pair behind the list shows whether a multiplet is cut. Its value can only fall, at most by
/// its measure. It therefore has to converge only if the answer is in doubt.
template<class Real>
ListReport FinishList(const SpectralProblem<Real>& problem, BlockOptions block, const ListEnd& end,
  EigenPairs<Real>& pairs, const Progress& progress)
{
  if (end.isAll)
  {
    return MeasureAll(problem, block, end, pairs, progress);
  }
  ListReport report;
  Id count = block.wanted;
  double done = 0.0;
  const auto endsInside = [&](double error)
  { return EndsInside(pairs.values, count, error, end.zeros); };
  while (true)
  {
    block.blockSize = std::max(block.blockSize, GuardedSize(block.wanted));
    const int before = report.block.iterations;
    const double next = AfterRound(done);
    report.block = ImproveManyEigenPairs(problem, block, pairs, progress.Part(done, next));
    report.block.iterations += before;
    done = next;
    const bool converged = report.block.numberOfConverged == block.wanted;
    report.cutsMultiplet = endsInside(0.0);
    if (!converged)
    {
      break;
    }
    const bool isSure = block.wanted > count || report.cutsMultiplet ||
                        !endsInside(std::pow(report.block.nextResidual, 2));
    if (isSure && (!report.cutsMultiplet || !end.completeMultiplets))
    {
      break;
    }
    while (isSure && endsInside(0.0))
    {
      ++count;
    }
    block.wanted = static_cast<Index>(isSure ? count : count + 1);
  }
  Shorten(report.block, count, block.tolerance);
  return report;
}

template ListReport FinishList(
  const SpectralProblem<float>&, BlockOptions, const ListEnd&, EigenPairs<float>&, const Progress&);
template ListReport FinishList(const SpectralProblem<double>&, BlockOptions, const ListEnd&,
  EigenPairs<double>&, const Progress&);

} // namespace gridfem
