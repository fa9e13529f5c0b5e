#include "Krylov/SpectralProblem.h"

#include "Algebra/BlockProducts.h"
#include "Base/Parallel.h"

#include <algorithm>

namespace gridfem
{
namespace
{

/// Rows whose images are examined together.
constexpr Id RowsOfFacts = 512;

/// Calls body(first, count) for the panels of columns that a preconditioner takes. Panels are
/// independent. With enough panels each is the job of one thread, otherwise the panels share the
/// threads. With several processes one thread does all panels, because it sends messages.
template<class Body>
void ForEachPanel(Id columns, const DistributedRows* distributed, int threads, Body&& body)
{
  const Id panels = (columns + WidestPanel - 1) / WidestPanel;
  const int all = NumberOfThreads(threads);
  const auto ofPanel = [&](Id panel)
  {
    const Id first = panel * WidestPanel;
    body(first, std::min(WidestPanel, columns - first));
  };
  if (!distributed && panels > 1 && panels < all)
  {
    SideBySide(static_cast<int>(panels), all, [&](int panel) { ofPanel(panel); });
  }
  else
  {
    ParallelBlocks(panels, distributed ? 1 : threads, ofPanel);
  }
}

/// L X - M X diag(θ) of `count` of the columns. The first of them has the number `first`.
template<class Real>
EigenResidual<Real> ResidualOf(const SpectralProblem<Real>& problem, const EigenPairs<Real>& pairs,
  const std::vector<Index>& columns, Id first, Id count)
{
  const auto begin = columns.begin() + first;
  return EigenResidual<Real>(
    problem.stiffness, problem.mass, pairs.vectors.View(), pairs.values, { begin, begin + count });
}

/// Squared norms as by SquaredNorms, for a residual whose parts the processes add up.
template<class Real>
Eigen::VectorXd NormsOfParts(
  const DistributedRows& distributed, const RowSource<Real>& part, int threads)
{
  Vectors<Real> whole(part.rows, part.columns);
  ParallelRanges(
    part.rows, threads,
    [&](Id begin, Id end) { part.fill(begin, end, whole.middleRows(begin, end - begin)); },
    SourceRows);
  distributed.Sum(whole);
  const Id ghosts = distributed.Ghosts();
  const RowSource<Real> own{ part.rows - ghosts, part.columns,
    [&](Id begin, Id end, Block<Real> rows)
    { rows = whole.middleRows(ghosts + begin, end - begin); } };
  Eigen::VectorXd norm = SquaredNorms(own, threads);
  distributed.SumNumbers(norm.data(), norm.size());
  return norm;
}

/// Entry of largest magnitude of every column of M X over all processes. Every entry counts once,
/// in the process that owns its row.
/// @param image  this process's part of M X
Eigen::RowVectorXd LargestOfAll(const DistributedRows& distributed, MultiVector image)
{
  distributed.Sum(image);
  ColumnFacts own(image.cols());
  for (Id row = distributed.Ghosts(); row < image.rows(); ++row)
  {
    own.TakeLargest(image.row(row));
  }
  const MultiVector ofProcesses = distributed.Gather(own.largest);
  ColumnFacts all(image.cols());
  for (Id process = 0; process < ofProcesses.rows(); ++process)
  {
    all.TakeLargest(ofProcesses.row(process));
  }
  return all.largest;
}

} // namespace

template<class Real>
MultiVector SpectralProblem<Real>::MassTimes(const MultiVector& X) const
{
  MultiVector image;
  Multiply(mass, X, image, threads);
  return image;
}

template<class Real>
Eigen::MatrixXd SpectralProblem<Real>::ProjectBoth(
  const BasisParts<Real>& parts, const ConstBlock<Real>& Y) const
{
  Eigen::MatrixXd projected = ProjectPair<Real>(parts, stiffness, mass, Y, threads);
  SumOverProcesses(distributed, projected);
  return projected;
}

template<class Real>
Eigen::MatrixXd SpectralProblem<Real>::ProjectMass(
  const BasisParts<Real>& parts, const ConstBlock<Real>& Y) const
{
  Eigen::MatrixXd projected = Project<Real>(parts, mass, Y, threads);
  SumOverProcesses(distributed, projected);
  return projected;
}

template<class Real>
ResidualMeasures SpectralProblem<Real>::Correct(const BlockPreconditioner<Real>& B,
  const EigenPairs<Real>& pairs, const SoftLocking& locking, Block<Real> W, const MultiVector& load,
  Block<Real> P) const
{
  const std::vector<Index>& columns = locking.AtWork();
  const Id residuals = static_cast<Id>(columns.size());
  ResidualMeasures all{ Eigen::VectorXd(residuals), Eigen::VectorXd(residuals) };
  ForEachPanel(residuals + load.cols(), distributed, threads,
    [&](Id first, Id count)
    {
      const Id firstW = std::min(first, residuals);
      const Id firstP = std::max<Id>(first - residuals, 0);
      const Id ofW = std::min(count, residuals - firstW);
      const Id ofP = count - ofW;
      const EigenResidual<Real> residual = ResidualOf(*this, pairs, columns, firstW, ofW);
      const RowSource<Real> source{ mass.rows, count,
        [&](Id begin, Id end, Block<Real> part)
        {
          residual.Rows(begin, end, part.leftCols(ofW));
          if (ofP > 0) // without a load, `load` may have no rows
          {
            part.rightCols(ofP) = load.block(begin, firstP, end - begin, ofP).template cast<Real>();
          }
        } };
      const auto isWanted = [&](const ResidualMeasures& measures)
      {
        bool isSmall = true;
        for (Id j = 0; j < ofW; ++j)
        {
          isSmall =
            isSmall && locking.IsSmall(measures.energy[j], pairs.values[columns[firstW + j]]);
        }
        return !isSmall || ofP > 0;
      };
      const ResidualMeasures measures = B(source, isWanted,
        [&](Id begin, Id end, const ConstBlock<Real>& part)
        {
          W.block(begin, firstW, end - begin, ofW) = part.leftCols(ofW);
          P.block(begin, firstP, end - begin, ofP) = part.rightCols(ofP);
        });
      all.energy.segment(firstW, ofW) = measures.energy.head(ofW);
      all.norm.segment(firstW, ofW) = measures.norm.head(ofW);
    });
  return all;
}

template<class Real>
Eigen::VectorXd SpectralProblem<Real>::SquaredResiduals(
  const EigenPairs<Real>& pairs, const std::vector<Index>& columns) const
{
  Eigen::VectorXd norm(static_cast<Id>(columns.size()));
  ForEachPanel(norm.size(), distributed, threads,
    [&](Id first, Id count)
    {
      const EigenResidual<Real> residual = ResidualOf(*this, pairs, columns, first, count);
      const RowSource<Real> source{ mass.rows, count,
        [&](Id begin, Id end, Block<Real> part) { residual.Rows(begin, end, part); } };
      norm.segment(first, count) =
        distributed ? NormsOfParts(*distributed, source, threads) : SquaredNorms(source, threads);
    });
  return norm;
}

template<class Real>
ColumnFacts SpectralProblem<Real>::FactsOf(const MultiVector& X) const
{
  const Id columns = X.cols();
  const Id ranges = (X.rows() + RowsOfFacts - 1) / RowsOfFacts;
  std::vector<ColumnFacts> parts(ranges, ColumnFacts(columns));
  const BlockProducts<double> product(stiffness, mass, X);
  ParallelBlocks(ranges, threads,
    [&](Id range)
    {
      const Id begin = range * RowsOfFacts;
      const Id end = std::min(X.rows(), begin + RowsOfFacts);
      MultiVector image(RowsOfFacts, 2 * columns);
      product.Rows(begin, end, image);
      for (Id row = begin; row < end; ++row)
      {
        const auto images = image.row(row - begin);
        parts[range].energy += X.row(row).cwiseProduct(images.head(columns));
        parts[range].mass += X.row(row).cwiseProduct(images.tail(columns));
        parts[range].TakeLargest(images.tail(columns));
      }
    });
  ColumnFacts facts(columns);
  for (const ColumnFacts& part : parts)
  {
    facts.energy += part.energy;
    facts.mass += part.mass;
    facts.TakeLargest(part.largest);
  }
  if (distributed)
  {
    SumOverProcesses(distributed, facts.energy);
    SumOverProcesses(distributed, facts.mass);
    facts.largest = LargestOfAll(*distributed, this->MassTimes(X));
  }
  return facts;
}

template<class Real>
void SpectralProblem<Real>::Agree(Block<Real> X) const
{
  if (distributed)
  {
    distributed->TakeGhosts(X);
  }
}

template struct SpectralProblem<float>;
template struct SpectralProblem<double>;

} // namespace gridfem
