#include "Spectrum.h"

#include "Parallel.h"
#include "WindowIteration.h"

#include <cmath>
#include <numeric>

namespace gridfem
{
namespace
{

/// A level with this many functions is solved densely, or with this many per pair, if not too many.
constexpr double AlwaysDense = 600.0;
constexpr double DensePerPair = 3.5;
constexpr double LargestDense = 1200.0;

/// Accuracy of the eigenvalues on coarser levels, whose discretisation error is far larger.
constexpr double CoarseTolerance = 1e-3;
constexpr int CoarseIterations = 4;
constexpr int RandomStartIterations = 40;

/// Columns that go through a cycle together.
constexpr Id PanelWidth = 8;

void Validate(const SpectrumOptions& options)
{
  if (options.numberOfModes < 1)
  {
    throw InvalidInput("the number of modes must be at least 1");
  }
  if (!(options.tolerance > 0.0 && options.tolerance < 1.0))
  {
    throw InvalidInput("the tolerance of the spectrum must lie between 0 and 1");
  }
  if (options.maximumIterations < 0)
  {
    throw InvalidInput("the number of iterations must not be negative");
  }
}

bool IsDense(const Level& level, Index blockSize)
{
  return level.numberOfFunctions <= std::clamp(DensePerPair * blockSize, AlwaysDense, LargestDense);
}

/// The finest level if it is solved densely. Else the coarsest level with enough functions, or the
/// one above it when that is too large for a dense solve.
std::size_t StartLevel(const FunctionSpace& space, std::size_t levels, Index blockSize)
{
  const auto size = [&](std::size_t l) { return space.levels[l].numberOfFunctions; };
  std::size_t level = 0;
  while (level + 1 < levels && (!IsDense(space.levels[level], blockSize) ||
                                 (level > 0 && size(level + 1) >= 1.5 * blockSize)))
  {
    ++level;
  }
  return level;
}

std::vector<Index> Components(const FunctionSpace& space, std::size_t level)
{
  return level == 0 ? space.component : FunctionComponents(space.levels[level]);
}

Index CountComponents(const std::vector<Index>& component)
{
  Index count = 0;
  for (const Index c : component)
  {
    count = std::max(count, c + 1);
  }
  return count;
}

SparseMatrix AssembleLevel(const FunctionSpace& space, const System& system, std::size_t level,
  double mass, double stiffness, int threads)
{
  SparseMatrix matrix = system.pattern[level];
  const ElementMatrices& elements = system.elements[level];
  AssembleValues(space.levels[level], system.patches[level], elements.mass, mass,
    elements.stiffness, stiffness, matrix, threads);
  return matrix;
}

Eigen::MatrixXd ToDense(const SparseMatrix& A)
{
  Eigen::MatrixXd dense = Eigen::MatrixXd::Zero(A.rows, A.columns);
  for (Index i = 0; i < A.rows; ++i)
  {
    for (Id k = A.rowBegin[i]; k < A.rowBegin[i + 1]; ++k)
    {
      dense(i, A.column[k]) = A.value[k];
    }
  }
  return dense;
}

/// All of the lowest pairs there are, up to `count`, by the dense solver.
EigenPairs SolveDense(const SpectralProblem& problem, Index count)
{
  Eigen::MatrixXd mass = ToDense(problem.mass);
  problem.constants->Deflate(mass);
  const RitzPairs ritz = SolvePencil(ToDense(problem.stiffness), mass, problem.shift, count);
  EigenPairs pairs{ ritz.values, ritz.coefficients };
  problem.constants->Remove(pairs.vectors);
  return pairs;
}

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

/// Zero modes in front, then the iterated pairs up to the wanted number.
Spectrum Collect(const Constants& constants, const EigenPairs& pairs, const BlockReport& report,
  const SparseMatrix& mass, const SpectrumOptions& options)
{
  const Index wanted = options.numberOfModes;
  const Index zeros = std::min(constants.Count(), wanted);
  const Index others = std::min<Index>(wanted - zeros, static_cast<Index>(pairs.values.size()));
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
  FixSigns(mass, spectrum.vectors, options.multigrid.threads);
  spectrum.residuals.assign(zeros, 0.0);
  spectrum.residuals.insert(
    spectrum.residuals.end(), report.residuals.begin(), report.residuals.end());
  spectrum.numberOfConverged = zeros + report.numberOfConverged;
  spectrum.converged = spectrum.numberOfConverged == zeros + others;
  spectrum.iterations = report.iterations;
  spectrum.truncated = zeros + others < wanted;
  return spectrum;
}

/// Work grows by four per level: each level gets its share.
Progress LevelPart(const Progress& progress, std::size_t level)
{
  const double setUp = 0.1;
  const double begin = std::pow(0.25, static_cast<double>(level) + 1.0);
  const double end = std::pow(0.25, static_cast<double>(level));
  return progress.Part(setUp + (1.0 - setUp) * begin, setUp + (1.0 - setUp) * end);
}

/// One cycle on every column. Panels are as wide as SIMD lanes need and small enough for the cache;
/// they know nothing of each other, so each is the job of one thread.
void CycleOnPanels(
  const Multigrid& multigrid, std::size_t level, const MultiVector& r, MultiVector& z)
{
  z.resize(r.rows(), r.cols());
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

/// The nested iteration: holds what the levels share.
class NestedIteration
{
public:
  NestedIteration(const FunctionSpace& space, const System& system, const SpectrumOptions& options)
    : space_(space), system_(system), options_(options)
  {
  }

  Spectrum Run(const Progress& progress);

private:
  BlockOptions Options(std::size_t level, Index wanted) const;
  SpectralProblem Problem(std::size_t level, const Constants& constants, const Multigrid* multigrid,
    SparseMatrix mass) const;

  const FunctionSpace& space_;
  const System& system_;
  const SpectrumOptions& options_;
  double shift_ = 1.0;
};

SpectralProblem NestedIteration::Problem(std::size_t level, const Constants& constants,
  const Multigrid* multigrid, SparseMatrix mass) const
{
  const int threads = options_.multigrid.threads;
  SpectralProblem problem;
  problem.stiffness = AssembleLevel(space_, system_, level, 0.0, 1.0, threads);
  problem.mass = std::move(mass);
  problem.shift = shift_;
  problem.constants = &constants;
  problem.threads = threads;
  problem.precondition = [multigrid, level](const MultiVector& r, MultiVector& z)
  { CycleOnPanels(*multigrid, level, r, z); };
  return problem;
}

BlockOptions NestedIteration::Options(std::size_t level, Index wanted) const
{
  BlockOptions block;
  block.wanted = wanted;
  block.blockSize = GuardedSize(wanted);
  block.tolerance = level == 0 ? options_.tolerance : CoarseTolerance;
  block.maximumIterations = level == 0 ? options_.maximumIterations
                                       : std::min(CoarseIterations, options_.maximumIterations);
  return block;
}

Spectrum NestedIteration::Run(const Progress& progress)
{
  const int threads = options_.multigrid.threads;
  SparseMatrix mass = AssembleLevel(space_, system_, 0, 1.0, 0.0, threads);
  const Constants zeroModes(mass, space_.component, space_.numberOfComponents, threads);
  if (zeroModes.Count() >= options_.numberOfModes)
  {
    return Collect(zeroModes, {}, {}, mass, options_);
  }
  const Index wanted = options_.numberOfModes - zeroModes.Count();
  const double area = std::accumulate(mass.value.begin(), mass.value.end(), 0.0);
  const double pi = 3.14159265358979323846;
  shift_ = 4.0 * pi * zeroModes.Count() / area;
  const Multigrid multigrid =
    BuildMultigrid(space_, system_, shift_, 1.0, options_.multigrid, progress.Part(0.0, 0.1));

  const Index blockSize = GuardedSize(wanted);
  const std::size_t start = StartLevel(space_, system_.elements.size(), blockSize);
  EigenPairs pairs;
  BlockReport report;
  for (std::size_t level = start + 1; level-- > 0;)
  {
    std::vector<Index> component = Components(space_, level);
    const Index components = CountComponents(component);
    SparseMatrix levelMass =
      level == 0 ? mass : AssembleLevel(space_, system_, level, 1.0, 0.0, threads);
    const Constants constants(levelMass, std::move(component), components, threads);
    const SpectralProblem problem =
      this->Problem(level, constants, &multigrid, std::move(levelMass));
    BlockOptions block = this->Options(level, wanted);
    if (level != start)
    {
      MultiVector fine;
      Multiply(system_.prolongation[level], pairs.vectors, fine, threads);
      pairs.vectors = std::move(fine);
      constants.Remove(pairs.vectors);
      if (pairs.vectors.cols() < wanted)
      {
        block.maximumIterations = std::max(RandomStartIterations, block.maximumIterations);
      }
    }
    else if (IsDense(space_.levels[level], blockSize))
    {
      pairs = SolveDense(problem, blockSize);
      if (level > 0)
      {
        continue;
      }
      block.wanted = std::min<Index>(wanted, static_cast<Index>(pairs.values.size()));
    }
    else // thousands of components: no small level, but B is nearly exact there
    {
      pairs = EigenPairs{ {}, MultiVector(problem.mass.rows, 0) };
      block.maximumIterations = std::max(RandomStartIterations, options_.maximumIterations);
    }
    report = ImproveManyEigenPairs(problem, block, pairs, LevelPart(progress, level));
  }
  return Collect(zeroModes, pairs, report, mass, options_);
}

} // namespace

Spectrum ComputeSpectrum(const FunctionSpace& space, const System& system,
  const SpectrumOptions& options, const Progress& progress)
{
  Validate(options);
  return NestedIteration(space, system, options).Run(progress);
}

} // namespace gridfem
