#include "Spectrum/ModeMatch.h"

#include "Algebra/BlockProducts.h"
#include "Algebra/BlockVectors.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace gridfem
{
namespace
{

/// Coarser modes that are compared together. All of them would need as much memory as the modes.
constexpr Id ModesAtOnce = 128;

/// Share of a mode that coarser modes have to contain.
constexpr double LeastShare = 0.5;

} // namespace

template<class Real>
Eigen::MatrixXd MatchNumbers(const SpectralProblem<Real>& problem, const ConstBlock<Real>& modes,
  const SparseMatrix& prolongation, const ConstBlock<Real>& coarser, const Eigen::MatrixXd& numbers)
{
  Eigen::MatrixXd sum = Eigen::MatrixXd::Zero(modes.cols(), numbers.cols());
  Eigen::MatrixXd weights = sum;
  Eigen::MatrixXd share = sum;
  Vectors<Real> prolonged;
  for (Id first = 0; first < coarser.cols(); first += ModesAtOnce)
  {
    const Id count = std::min(ModesAtOnce, coarser.cols() - first);
    prolonged.resize(prolongation.rows, count);
    MultiplyBlock<Real>(prolongation, coarser.middleCols(first, count), prolonged, problem.threads);
    SumProlonged<Real>(problem.distributed, prolonged);
    const Eigen::MatrixXd square = problem.ProjectMass({ modes }, prolonged).cwiseAbs2();
    for (Id column = 0; column < numbers.cols(); ++column)
    {
      for (Id j = 0; j < count; ++j)
      {
        const double number = numbers(first + j, column);
        if (!std::isnan(number))
        {
          sum.col(column) += number * square.col(j).cwiseAbs2();
          weights.col(column) += square.col(j).cwiseAbs2();
          share.col(column) += square.col(j);
        }
      }
    }
  }
  return (share.array() >= LeastShare)
    .select(sum.array() / weights.array(), std::numeric_limits<double>::quiet_NaN());
}

template Eigen::MatrixXd MatchNumbers(const SpectralProblem<float>&, const ConstBlock<float>&,
  const SparseMatrix&, const ConstBlock<float>&, const Eigen::MatrixXd&);
template Eigen::MatrixXd MatchNumbers(const SpectralProblem<double>&, const ConstBlock<double>&,
  const SparseMatrix&, const ConstBlock<double>&, const Eigen::MatrixXd&);

} // namespace gridfem
