#include "Spaces/PointComponents.h"

#include <algorithm>
#include <cmath>

namespace gridfem
{

std::vector<Index> ComponentsOfRows(const SparseMatrix& rows, const Components& components)
{
  std::vector<Index> component(rows.rows, -1);
  for (Index row = 0; row < rows.rows; ++row)
  {
    if (rows.rowBegin[row] < rows.rowBegin[row + 1])
    {
      component[row] = components.ofFunction[rows.column[rows.rowBegin[row]]];
    }
  }
  return component;
}

std::vector<Index> ComponentsOfPoints(
  const SurfaceSpace& space, const Components& components, const Job& job)
{
  MultiVector numbers(static_cast<Id>(components.ofFunction.size()), 1);
  std::copy(components.ofFunction.begin(), components.ofFunction.end(), numbers.data());
  const MultiVector atPoints = space.ValuesAtPoints(numbers, job);
  const std::vector<char> reached = space.PointsWithFunctions();
  std::vector<Index> component(reached.size(), -1);
  for (std::size_t point = 0; point < reached.size(); ++point)
  {
    if (reached[point])
    {
      component[point] = static_cast<Index>(std::lround(atPoints(static_cast<Id>(point), 0)));
    }
  }
  return component;
}

void SubtractConstants(
  const MultiVector& constant, const std::vector<Index>& componentOfRow, MultiVector& values)
{
  for (Id row = 0; row < values.rows(); ++row)
  {
    if (componentOfRow[row] >= 0)
    {
      values.row(row) -= constant.row(componentOfRow[row]);
    }
    else
    {
      values.row(row).setZero();
    }
  }
}

} // namespace gridfem
