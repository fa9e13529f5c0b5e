#include "Multigrid/CoarseSolver.h"

#include "Algebra/PivotedCholesky.h"
#include "Algebra/RowBuilder.h"
#include "Base/UnionFind.h"
#include "Multigrid/BlockSweep.h"

#include <cmath>

namespace gridfem
{
namespace
{

/// Components per parallel task. Most components have a handful of unknowns.
constexpr Id ComponentsPerRange = 8;

/// The part of A that couples the given unknowns (ascending), scaled.
Eigen::MatrixXd ScaledBlock(
  const SparseMatrix& A, const std::vector<Index>& unknown, const Eigen::VectorXd& scale)
{
  const Id size = static_cast<Id>(unknown.size());
  Eigen::MatrixXd S = Eigen::MatrixXd::Zero(size, size);
  for (Id i = 0; i < size; ++i)
  {
    for (Id k = A.rowBegin[unknown[i]]; k < A.rowBegin[unknown[i] + 1]; ++k)
    {
      const auto found = std::lower_bound(unknown.begin(), unknown.end(), A.column[k]);
      if (found != unknown.end() && *found == A.column[k])
      {
        const Id j = found - unknown.begin();
        S(i, j) = scale[i] * A.value[k] * scale[j];
      }
    }
  }
  return S;
}

} // namespace

Groups ComponentsOf(const SparseMatrix& A)
{
  UnionFind sets(A.rows);
  for (Index row = 0; row < A.rows; ++row)
  {
    for (Id k = A.rowBegin[row]; k < A.rowBegin[row + 1]; ++k)
    {
      sets.Unite(row, A.column[k]);
    }
  }
  Index count = 0;
  const Array<Index> component = NumberSets(sets, count);
  return GroupItems(component, count);
}

CoarseSolver::CoarseSolver(const SparseMatrix& A, int threads, double smallestPivot) : rows_(A.rows)
{
  if (A.rows != A.columns)
  {
    throw InvalidInput("The coarsest matrix is not square.");
  }
  const Groups members = ComponentsOf(A);
  components_.resize(members.begin.size() - 1);
  ParallelRanges(
    static_cast<Id>(components_.size()), threads,
    [&](Id begin, Id end)
    {
      for (Id c = begin; c < end; ++c)
      {
        const Index* const unknowns = members.item.data();
        components_[c] =
          Factor(A, unknowns + members.begin[c], unknowns + members.begin[c + 1], smallestPivot);
      }
    },
    ComponentsPerRange);
}

CoarseSolver::Component CoarseSolver::Factor(
  const SparseMatrix& A, const Index* begin, const Index* end, double smallestPivot)
{
  std::vector<Index> usable;
  std::vector<double> scales;
  for (; begin != end; ++begin)
  {
    const double diagonal = A.Coefficient(*begin, *begin);
    if (IsUsableDiagonal(diagonal))
    {
      usable.push_back(*begin);
      scales.push_back(1.0 / std::sqrt(diagonal));
    }
  }
  const Eigen::VectorXd scale =
    Eigen::Map<const Eigen::VectorXd>(scales.data(), static_cast<Id>(scales.size()));
  Eigen::MatrixXd S = ScaledBlock(A, usable, scale);
  const std::vector<Index> pivots = PivotedCholesky(S, smallestPivot);

  Component component;
  const Id rank = static_cast<Id>(pivots.size());
  component.scale.resize(rank);
  for (Id i = 0; i < rank; ++i)
  {
    component.unknown.push_back(usable[pivots[i]]);
    component.scale[i] = scale[pivots[i]];
  }
  component.L = S.topLeftCorner(rank, rank);
  return component;
}

void CoarseSolver::SolveComponent(const Component& component, const MultiVector& b, MultiVector& x)
{
  const Id rank = component.scale.size();
  Eigen::MatrixXd y(rank, b.cols());
  for (Id i = 0; i < rank; ++i)
  {
    y.row(i) = component.scale[i] * b.row(component.unknown[i]);
  }
  const auto lower = component.L.triangularView<Eigen::Lower>();
  for (Id column = 0; column < b.cols(); ++column)
  {
    lower.solveInPlace(y.col(column));
    lower.transpose().solveInPlace(y.col(column));
  }
  for (Id i = 0; i < rank; ++i)
  {
    x.row(component.unknown[i]) = component.scale[i] * y.row(i);
  }
}

void CoarseSolver::Solve(const MultiVector& b, MultiVector& x, int threads) const
{
  if (b.rows() != rows_)
  {
    throw InvalidInput("The coarsest system has " + std::to_string(rows_) +
                       " unknowns, the right-hand side " + std::to_string(b.rows()));
  }
  x.setZero(b.rows(), b.cols());
  ParallelRanges(
    static_cast<Id>(components_.size()), threads,
    [&](Id begin, Id end)
    {
      for (Id c = begin; c < end; ++c)
      {
        SolveComponent(components_[c], b, x);
      }
    },
    ComponentsPerRange);
}

SparseMatrix CoarseSolver::Inverse() const
{
  std::vector<RowBuilder::Entries> rows(rows_);
  for (const Component& component : components_)
  {
    const Id rank = component.scale.size();
    Eigen::MatrixXd B = component.scale.asDiagonal();
    const auto lower = component.L.triangularView<Eigen::Lower>();
    lower.solveInPlace(B);
    lower.transpose().solveInPlace(B);
    for (Id i = 0; i < rank; ++i)
    {
      for (Id j = 0; j < rank; ++j)
      {
        const double entry = i >= j ? component.scale[i] * B(i, j) : component.scale[j] * B(j, i);
        rows[component.unknown[i]].emplace_back(component.unknown[j], entry);
      }
    }
  }
  RowBuilder builder;
  for (RowBuilder::Entries& row : rows)
  {
    builder.Append(row);
  }
  return builder.Finish(static_cast<Index>(rows_));
}

std::size_t CoarseSolver::Memory() const
{
  std::size_t bytes = 0;
  for (const Component& component : components_)
  {
    bytes += component.unknown.size() * sizeof(Index) +
             (component.scale.size() + component.L.size()) * sizeof(double) + sizeof(Component);
  }
  return bytes;
}

} // namespace gridfem
