#include "Algebra/PivotedCholesky.h"

#include <algorithm>
#include <cmath>
#include <numeric>

namespace gridfem
{
namespace
{

constexpr Index PanelWidth = 48;

/// Returns the position of the largest entry from `begin` on that is above `smallest`, or -1 if
/// there is none.
Index FindPivot(const Eigen::VectorXd& diagonal, Index begin, double smallest)
{
  Index pivot = -1;
  for (Index i = begin; i < diagonal.size(); ++i)
  {
    if (diagonal[i] > smallest)
    {
      smallest = diagonal[i];
      pivot = i;
    }
  }
  return pivot;
}

/// Exchanges rows and columns `pivot` and `target`.
void Exchange(Eigen::MatrixXd& S, Eigen::VectorXd& diagonal, std::vector<Index>& order,
  Index target, Index pivot)
{
  if (target != pivot)
  {
    S.row(target).swap(S.row(pivot));
    S.col(target).swap(S.col(pivot));
    std::swap(diagonal[target], diagonal[pivot]);
    std::swap(order[target], order[pivot]);
  }
}

} // namespace

std::vector<Index> PivotedCholesky(Eigen::MatrixXd& S, double smallestPivot)
{
  const Index size = static_cast<Index>(S.rows());
  std::vector<Index> order(size);
  std::iota(order.begin(), order.end(), 0);
  Eigen::VectorXd diagonal = S.diagonal(); // diagonal of the remaining matrix
  for (Index panel = 0; panel < size; panel += PanelWidth)
  {
    const Index panelEnd = std::min(size, panel + PanelWidth);
    for (Index j = panel; j < panelEnd; ++j)
    {
      const Index pivot = FindPivot(diagonal, j, smallestPivot);
      if (pivot < 0)
      {
        order.resize(j);
        return order;
      }
      Exchange(S, diagonal, order, j, pivot);
      const Index below = size - j - 1;
      const double root = std::sqrt(diagonal[j]);
      S(j, j) = root;
      auto column = S.col(j).tail(below);
      column.noalias() -=
        S.block(j + 1, panel, below, j - panel) * S.row(j).segment(panel, j - panel).transpose();
      column /= root;
      diagonal.tail(below) -= column.cwiseAbs2();
    }
    const Index rest = size - panelEnd;
    const auto done = S.block(panelEnd, panel, rest, panelEnd - panel);
    S.bottomRightCorner(rest, rest).noalias() -= done * done.transpose();
  }
  return order;
}

} // namespace gridfem
