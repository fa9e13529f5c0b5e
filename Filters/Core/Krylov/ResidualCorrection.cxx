#include "Krylov/ResidualCorrection.h"

#include "Algebra/BlockProducts.h"
#include "Base/Parallel.h"

#include <algorithm>

namespace gridfem
{
namespace
{

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

/// L X - M X diag(θ) of `count` of the columns, the first of them number `first`.
template<class Real>
EigenResidual<Real> ResidualOf(const SpectralProblem<Real>& problem, const EigenPairs<Real>& pairs,
  const std::vector<Index>& columns, Id first, Id count)
{
  const auto begin = columns.begin() + first;
  return EigenResidual<Real>(
    problem.stiffness, problem.mass, pairs.vectors.View(), pairs.values, { begin, begin + count });
}

} // namespace

template<class Real>
ResidualMeasures CorrectResiduals(const SpectralProblem<Real>& problem,
  const BlockPreconditioner<Real>& precondition, const EigenPairs<Real>& pairs,
  const SoftLocking& locking, Block<Real> W, const MultiVector& load, Block<Real> P)
{
  const std::vector<Index>& columns = locking.AtWork();
  const Id residuals = static_cast<Id>(columns.size());
  ResidualMeasures all{ Eigen::VectorXd(residuals), Eigen::VectorXd(residuals) };
  ForEachPanel(residuals + load.cols(), problem.threads,
    [&](Id first, Id count)
    {
      const Id firstW = std::min(first, residuals);
      const Id firstP = std::max<Id>(first - residuals, 0);
      const Id ofW = std::min(count, residuals - firstW);
      const Id ofP = count - ofW;
      const EigenResidual<Real> residual = ResidualOf(problem, pairs, columns, firstW, ofW);
      const RowSource<Real> source{ problem.mass.rows, count,
        [&](Id begin, Id end, Block<Real> part)
        {
          residual.Rows(begin, end, part.leftCols(ofW));
          if (ofP > 0) // the load may have no rows else
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
      const ResidualMeasures measures = precondition(source, isWanted,
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
Eigen::VectorXd SquaredResiduals(const SpectralProblem<Real>& problem,
  const EigenPairs<Real>& pairs, const std::vector<Index>& columns)
{
  Eigen::VectorXd norm(static_cast<Id>(columns.size()));
  ForEachPanel(norm.size(), problem.threads,
    [&](Id first, Id count)
    {
      const EigenResidual<Real> residual = ResidualOf(problem, pairs, columns, first, count);
      const RowSource<Real> source{ problem.mass.rows, count,
        [&](Id begin, Id end, Block<Real> part) { residual.Rows(begin, end, part); } };
      norm.segment(first, count) = SquaredNorms(source, problem.threads);
    });
  return norm;
}

template ResidualMeasures CorrectResiduals(const SpectralProblem<float>&,
  const BlockPreconditioner<float>&, const EigenPairs<float>&, const SoftLocking&, Block<float>,
  const MultiVector&, Block<float>);
template ResidualMeasures CorrectResiduals(const SpectralProblem<double>&,
  const BlockPreconditioner<double>&, const EigenPairs<double>&, const SoftLocking&, Block<double>,
  const MultiVector&, Block<double>);
template Eigen::VectorXd SquaredResiduals(
  const SpectralProblem<float>&, const EigenPairs<float>&, const std::vector<Index>&);
template Eigen::VectorXd SquaredResiduals(
  const SpectralProblem<double>&, const EigenPairs<double>&, const std::vector<Index>&);

} // namespace gridfem
