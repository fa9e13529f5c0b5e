#include "Krylov/Lobpcg.h"

#include "Krylov/BlockRayleighRitz.h"
#include "Krylov/SoftLocking.h"
#include "Krylov/WithFallback.h"

#include <algorithm>
#include <cmath>

namespace gridfem
{
namespace
{

/// Random directions that are mixed in at the start of a level. They find eigenvectors that the
/// coarser level has missed.
constexpr Index MinimumRandomColumns = 4;

/// Known columns that are removed between two reports of progress.
constexpr Id KnownAtOnce = 1024;

/// Steps after which the fallback takes over. Most problems need three to six steps. Surfaces with
/// strands that nearly touch need fifteen, in either precision of the preconditioner.
constexpr int StepsBeforeFallback = 20;

/// The state of the iteration. Its basis is [X, P, W].
template<class Real>
class BlockIteration
{
public:
  BlockIteration(const SpectralProblem<Real>& problem, const BlockOptions& options,
    const BasisParts<Real>& known, EigenPairs<Real>& pairs, BlockWorkspace<Real>& workspace)
    : problem_(problem), options_(options), known_(known), pairs_(pairs),
      directions_(workspace.directions), corrections_(workspace.corrections),
      rayleighRitz_(problem, pairs, directions_, corrections_),
      locking_(options.wanted, options.tolerance, problem.shift)
  {
  }

  BlockReport Run(const Progress& progress);

private:
  void SetStart();
  void RemoveKnown(Block<Real> X, const Progress& progress);
  const BlockPreconditioner<Real>& CurrentPreconditioner();
  bool Correct(const Progress& progress);
  bool Precondition(const Progress& progress);
  void NextVectors(const Progress& progress);
  double Fraction();
  Index FoundAndWanted() const;
  void Report();

  const SpectralProblem<Real>& problem_;
  const BlockOptions& options_;
  const BasisParts<Real>& known_;
  EigenPairs<Real>& pairs_;        // X
  BlockBuffer<Real>& directions_;  // P
  BlockBuffer<Real>& corrections_; // W = B r of the unconverged columns at work
  MultiVector randomLoad_;         // loads of the last columns of P, which are not computed yet
  BlockRayleighRitz<Real> rayleighRitz_;
  BlockPreconditioner<Real> double_; // made when it is needed
  SoftLocking locking_;
  BlockReport report_;
  double first_ = 0.0; // the largest measure so far
  double fraction_ = 0.0;
};

/// Prepares loads M x of random vectors x. Their images B M x become directions. Start vectors that
/// are no Ritz pairs become directions as well.
template<class Real>
void BlockIteration<Real>::SetStart()
{
  const Id rows = problem_.Rows();
  const Id missing = options_.blockSize - pairs_.vectors.Columns();
  const MultiVector random =
    RandomColumns(rows, std::max<Id>(MinimumRandomColumns, missing + MinimumRandomColumns));
  randomLoad_ = problem_.MassTimes(random);
  const Id vectors = pairs_.values.size() > 0 ? 0 : pairs_.vectors.Columns();
  directions_.Reserve(rows, std::max<Id>(options_.blockSize, vectors + random.cols()));
  directions_.Show(vectors + random.cols());
  corrections_.Reserve(rows, options_.blockSize);
  corrections_.Show(0);
  if (vectors > 0)
  {
    CopyBlock(pairs_.vectors.View(), directions_.View().leftCols(vectors), problem_.threads);
    pairs_.vectors.Show(0);
  }
  pairs_.vectors.Grow(rows, options_.blockSize, problem_.threads);
}

/// Makes X orthogonal to all known vectors, in steps of KnownAtOnce columns. Tens of thousands of
/// known columns take minutes, and the steps allow an abort.
template<class Real>
void BlockIteration<Real>::RemoveKnown(Block<Real> X, const Progress& progress)
{
  problem_.constants->template Remove<Real>(X);
  for (const ConstBlock<Real>& part : known_)
  {
    for (Id first = 0; X.cols() > 0 && first < part.cols(); first += KnownAtOnce)
    {
      progress.Check(fraction_);
      const BasisParts<Real> some = { part.middleCols(
        first, std::min(KnownAtOnce, part.cols() - first)) };
      const Eigen::MatrixXd share = problem_.ProjectMass(some, X);
      SubtractCombination<Real>(some, share, X, problem_.threads);
    }
  }
}

template<class Real>
const BlockPreconditioner<Real>& BlockIteration<Real>::CurrentPreconditioner()
{
  const WithFallback<BlockPreconditioner<Real>>& B = problem_.preconditioner;
  if (report_.iterations < StepsBeforeFallback || !B.makeDouble)
  {
    return B.first;
  }
  if (!double_)
  {
    double_ = B.makeDouble();
  }
  return double_;
}

/// Computes residuals and corrections of the columns at work. The first call also computes the
/// random directions. True when all wanted columns at work have converged.
template<class Real>
bool BlockIteration<Real>::Correct(const Progress& progress)
{
  const Id columns = static_cast<Id>(locking_.AtWork().size());
  const bool isFirst = randomLoad_.cols() > 0;
  corrections_.Show(columns);
  const ResidualMeasures measures = problem_.Correct(this->CurrentPreconditioner(), pairs_,
    locking_, corrections_.View(), randomLoad_, directions_.View().rightCols(randomLoad_.cols()));
  randomLoad_.resize(0, 0);
  if (isFirst)
  {
    this->RemoveKnown(directions_.View(), progress);
  }
  progress.Check(fraction_);
  const bool done = locking_.Update(measures, pairs_.values);
  const std::vector<Index> places = locking_.DropConverged();
  if (static_cast<Id>(places.size()) < columns) // corrections of converged columns are not needed
  {
    corrections_.Keep(places, problem_.threads);
  }
  return done;
}

/// Computes residuals and corrections. True when all wanted pairs have converged. Columns that
/// converged earlier are measured once more before the function returns true.
template<class Real>
bool BlockIteration<Real>::Precondition(const Progress& progress)
{
  locking_.Start(pairs_.values);
  if (!this->Correct(progress))
  {
    return false;
  }
  locking_.StartWanted();
  locking_.DropUnmoved(problem_.SquaredResiduals(pairs_, locking_.AtWork()));
  const bool converged = this->Correct(progress);
  return converged && report_.iterations >= options_.minimumIterations &&
         (this->FoundAndWanted() == options_.wanted || report_.iterations > 0);
}

/// One step of Rayleigh-Ritz. The columns of the new vectors that are still at work get directions.
template<class Real>
void BlockIteration<Real>::NextVectors(const Progress& progress)
{
  this->RemoveKnown(corrections_.View(), progress);
  progress.Check(fraction_);
  rayleighRitz_.Step(options_.blockSize, locking_.AtWork());
  problem_.Agree(pairs_.vectors.View());
  problem_.Agree(directions_.View());
  progress.Check(fraction_);
  ++report_.iterations;
}

template<class Real>
Index BlockIteration<Real>::FoundAndWanted() const
{
  return std::min<Index>(options_.wanted, static_cast<Index>(pairs_.values.size()));
}

/// Progress of the slowest wanted pair since the first measure, in orders of magnitude, as a
/// fraction of the whole way.
template<class Real>
double BlockIteration<Real>::Fraction()
{
  const Index found = this->FoundAndWanted();
  double worst = found < options_.wanted ? 1.0 : options_.tolerance;
  for (Index j = 0; j < found; ++j)
  {
    worst = std::max(worst, locking_.Measure(j));
  }
  if (!std::isfinite(worst))
  {
    return 0.0;
  }
  first_ = std::max(first_, worst);
  return worst > options_.tolerance
           ? std::log(first_ / worst) / std::log(first_ / options_.tolerance)
           : 1.0;
}

template<class Real>
BlockReport BlockIteration<Real>::Run(const Progress& progress)
{
  progress.Check(0.0);
  this->SetStart();
  while (true)
  {
    const bool isLast = report_.iterations == options_.maximumIterations;
    if (isLast && !options_.measureLast && report_.iterations > 0)
    {
      break;
    }
    const bool done = this->Precondition(progress);
    fraction_ = std::clamp(this->Fraction(), fraction_, 1.0);
    if (done || isLast)
    {
      break;
    }
    this->NextVectors(progress);
  }
  if (!options_.measureLast)
  {
    rayleighRitz_.Renew();
  }
  this->Report();
  progress.Check(1.0);
  return report_;
}

template<class Real>
void BlockIteration<Real>::Report()
{
  locking_.Start(pairs_.values); // some pairs may not have been measured yet
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
}

} // namespace

template<class Real>
BlockReport ImproveEigenPairs(const SpectralProblem<Real>& problem, const BlockOptions& options,
  const BasisParts<Real>& known, EigenPairs<Real>& pairs, BlockWorkspace<Real>& workspace,
  const Progress& progress)
{
  return BlockIteration<Real>(problem, options, known, pairs, workspace).Run(progress);
}

template BlockReport ImproveEigenPairs(const SpectralProblem<float>&, const BlockOptions&,
  const BasisParts<float>&, EigenPairs<float>&, BlockWorkspace<float>&, const Progress&);
template BlockReport ImproveEigenPairs(const SpectralProblem<double>&, const BlockOptions&,
  const BasisParts<double>&, EigenPairs<double>&, BlockWorkspace<double>&, const Progress&);

} // namespace gridfem
