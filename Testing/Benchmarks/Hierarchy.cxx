#include "Hierarchy.h"

#include <memory>
#include <numeric>

namespace gridfem::benchmarks
{

namespace
{

/// One block with all unknowns in their order.
PatchOrder RowOrder(Index rows)
{
  PatchOrder order;
  order.dof.size = 1;
  order.dof.unknown.resize(rows);
  std::iota(order.dof.unknown.begin(), order.dof.unknown.end(), 0);
  order.blockBegin = { 0, rows };
  order.colorBegin = { 0, 1 };
  return order;
}

} // namespace

MultigridOptions ThesisCycle()
{
  MultigridOptions options;
  options.smoother = SmootherType::GaussSeidel;
  options.preSweeps = 10;
  options.postSweeps = 10;
  options.threads = 1;
  return options;
}

testing::HybridCycle ThesisHybrid()
{
  testing::HybridCycle options;
  options.grid = ThesisCycle();
  options.hats = LevelSmoothing{ SmootherType::GaussSeidel, 10, 10, CycleType::W };
  options.relaxGroups = false;
  return options;
}

SparseMatrix FromEigen(const Eigen::SparseMatrix<double>& matrix)
{
  const Eigen::SparseMatrix<double, Eigen::RowMajor> rows = matrix;
  SparseMatrix result;
  result.rows = static_cast<Index>(rows.rows());
  result.columns = static_cast<Index>(rows.cols());
  result.rowBegin = Array<Id>(rows.outerIndexPtr(), rows.outerIndexPtr() + rows.rows() + 1);
  result.column = Array<Index>(rows.innerIndexPtr(), rows.innerIndexPtr() + rows.nonZeros());
  result.value.assign(rows.valuePtr(), rows.valuePtr() + rows.nonZeros());
  return result;
}

SymmetricMatrix ToEigen(const SparseMatrix& matrix)
{
  std::vector<Eigen::Triplet<double>> entries;
  for (Index row = 0; row < matrix.rows; ++row)
  {
    for (Id k = matrix.rowBegin[row]; k < matrix.rowBegin[row + 1]; ++k)
    {
      entries.emplace_back(row, matrix.column[k], matrix.value[k]);
    }
  }
  SymmetricMatrix result(matrix.rows, matrix.columns);
  result.setFromTriplets(entries.begin(), entries.end());
  return result;
}

Multigrid BuildHierarchy(const SymmetricMatrix& A,
  const std::vector<Eigen::SparseMatrix<double>>& prolongations, const MultigridOptions& options)
{
  std::vector<MultigridLevel> levels;
  SymmetricMatrix matrix = A;
  for (const Eigen::SparseMatrix<double>& prolongation : prolongations)
  {
    MultigridLevel& level = levels.emplace_back();
    level.A = FromEigen(matrix);
    level.prolongation = FromEigen(prolongation);
    level.order = RowOrder(level.A.rows);
    matrix = SymmetricMatrix(prolongation.transpose() * SymmetricMatrix(matrix * prolongation));
  }
  levels.emplace_back().A = FromEigen(matrix);
  return Multigrid(std::move(levels), options);
}

double RelativeResidual(
  const SymmetricMatrix& A, const Eigen::MatrixXd& b, const Eigen::MatrixXd& x)
{
  return (b - A * x).norm() / b.norm();
}

Iterate Cycles(const Multigrid& multigrid, const Eigen::MatrixXd& b, const Eigen::MatrixXd& start)
{
  // The last iterate is kept: asking for one after the other costs one cycle each.
  struct State
  {
    int count = 0;
    MultiVector x;
  };
  const auto state = std::make_shared<State>();
  const MultiVector first =
    start.rows() > 0 ? MultiVector(start) : MultiVector::Zero(b.rows(), b.cols());
  return [state, first, source = MultiVector(b), &multigrid](int count)
  {
    if (count < state->count || state->x.rows() == 0)
    {
      *state = { 0, first };
    }
    for (; state->count < count; ++state->count)
    {
      multigrid.Cycle(source, state->x);
    }
    return Eigen::MatrixXd(state->x);
  };
}

std::vector<double> Residuals(
  const SymmetricMatrix& A, const Eigen::MatrixXd& b, const Iterate& iterate, int count)
{
  std::vector<double> residuals;
  for (int k = 0; k <= count; ++k)
  {
    residuals.push_back(RelativeResidual(A, b, iterate(k)));
  }
  return residuals;
}

} // namespace gridfem::benchmarks
