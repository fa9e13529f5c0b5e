#include "Spectrum/NearestRows.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

namespace gridfem
{
namespace
{

/// Queries whose distances from all centers are computed together.
constexpr Id QueriesPerBlock = 256;

} // namespace

NearestRows::NearestRows(const MultiVector& rows, int threads)
{
  const auto count = static_cast<Id>(std::ceil(std::sqrt(double(rows.rows()))));
  centers_.resize(count, rows.cols());
  for (Id center = 0; center < count; ++center)
  {
    centers_.row(center) = rows.row(center * rows.rows() / count);
  }
  this->Group(rows, threads);
}

/// Sorts the rows by their nearest center.
void NearestRows::Group(const MultiVector& rows, int threads)
{
  Array<Index> group(rows.rows());
  std::vector<double> away(static_cast<std::size_t>(rows.rows()));
  ParallelRanges(
    rows.rows(), threads,
    [&](Id begin, Id end)
    {
      const MultiVector distances = this->ToCenters(rows.middleRows(begin, end - begin));
      for (Id row = begin; row < end; ++row)
      {
        Index nearest = 0;
        away[row] = distances.row(row - begin).minCoeff(&nearest);
        group[row] = nearest;
      }
    },
    QueriesPerBlock);
  groups_ = GroupItems(group, centers_.rows(), threads);
  rows_.resize(rows.rows(), rows.cols());
  away_.resize(away.size());
  radii_.assign(static_cast<std::size_t>(centers_.rows()), 0.0);
  for (Id place = 0; place < rows.rows(); ++place)
  {
    const Index row = groups_.item[place];
    rows_.row(place) = rows.row(row);
    away_[place] = away[row];
    double& radius = radii_[group[row]];
    radius = std::max(radius, away[row]);
  }
}

/// Returns the distances of rows (rows) from all centers (columns).
MultiVector NearestRows::ToCenters(const MultiVector& rows) const
{
  MultiVector squares = -2.0 * rows * centers_.transpose();
  squares.colwise() += rows.rowwise().squaredNorm();
  squares.rowwise() += centers_.rowwise().squaredNorm().transpose();
  return squares.cwiseMax(0.0).cwiseSqrt();
}

/// @param toCenter  the distance of the query from the center of the group
void NearestRows::SearchGroup(
  Index group, double toCenter, const MultiVector& queries, Id query, Nearest& nearest) const
{
  for (Index place = groups_.begin[group]; place < groups_.begin[group + 1]; ++place)
  {
    if (std::abs(toCenter - away_[place]) > nearest.distance)
    {
      continue;
    }
    const double distance = (rows_.row(place) - queries.row(query)).norm();
    const Id row = groups_.item[place];
    if (distance < nearest.distance || (distance == nearest.distance && row < nearest.row))
    {
      nearest = { row, distance };
    }
  }
}

/// Visits the group of the nearest center, and then the others in the order of the least distance
/// that their rows can have.
/// @param order  memory of the caller
NearestRows::Nearest NearestRows::Search(const MultiVector& queries, Id query,
  const double* toCenters, std::vector<std::pair<double, Index>>& order) const
{
  const auto count = static_cast<Index>(radii_.size());
  const auto first = static_cast<Index>(std::min_element(toCenters, toCenters + count) - toCenters);
  Nearest nearest{ -1, std::numeric_limits<double>::infinity() };
  this->SearchGroup(first, toCenters[first], queries, query, nearest);
  order.clear();
  for (Index group = 0; group < count; ++group)
  {
    const double least = toCenters[group] - radii_[group];
    if (group != first && least <= nearest.distance)
    {
      order.emplace_back(least, group);
    }
  }
  std::sort(order.begin(), order.end());
  for (const auto& [least, group] : order)
  {
    if (least > nearest.distance)
    {
      break;
    }
    this->SearchGroup(group, toCenters[group], queries, query, nearest);
  }
  return nearest;
}

std::vector<Id> NearestRows::Find(const MultiVector& queries, const Job& job) const
{
  std::vector<Id> found(static_cast<std::size_t>(queries.rows()));
  ParallelRanges(
    queries.rows(), job.threads,
    [&](Id begin, Id end)
    {
      const MultiVector toCenters = this->ToCenters(queries.middleRows(begin, end - begin));
      std::vector<std::pair<double, Index>> order;
      for (Id query = begin; query < end; ++query)
      {
        found[query] = this->Search(queries, query, toCenters.row(query - begin).data(), order).row;
      }
    },
    QueriesPerBlock, job.progress);
  return found;
}

} // namespace gridfem
