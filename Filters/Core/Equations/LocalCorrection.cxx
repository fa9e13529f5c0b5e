#include "Equations/LocalCorrection.h"

#include "Algebra/RowBuilder.h"
#include "Algebra/SparseCholesky.h"
#include "Spaces/HatMatrices.h"

#include <algorithm>
#include <cmath>
#include <functional>
#include <limits>
#include <queue>
#include <utility>

namespace gridfem
{
namespace
{

/// Deviations up to this share of the range are not worth new values around them.
constexpr double VisibleDeviation = 1e-3;

/// By how much rounding may move a value beyond its range.
double RoundingOf(double low, double high)
{
  return 1e-12 * std::max(std::abs(low), std::abs(high));
}

/// The weight of a neighbor in the mean of a hat. It is positive and symmetric.
/// @param k  the entry of the neighbor in the row of the hat
double WeightOf(const SparseMatrix& stiffness, Index hat, Id k)
{
  constexpr double Least = 1e-3; // of the diagonal; obtuse triangles have negative weights
  const Index other = stiffness.column[k];
  const double diagonal =
    std::min(stiffness.Coefficient(hat, hat), stiffness.Coefficient(other, other));
  return std::max(-stiffness.value[k], Least * diagonal);
}

} // namespace

LocalCorrection::LocalCorrection(const TriangleMesh& mesh, bool weldCoincidentPoints,
  const std::vector<Id>& points, const MultiVector& values, int threads)
  : mesh_(mesh), hats_(NumberHatFunctions(mesh, { weldCoincidentPoints, 1.0, threads })),
    place_(hats_.Count(), -1), isGiven_(hats_.Count(), 0)
{
  for (Id point = static_cast<Id>(mesh.points.size()); point-- > 0;)
  {
    if (hats_.ofPoint[point] >= 0)
    {
      place_[hats_.ofPoint[point]] = point;
    }
  }
  this->TakeGiven(points, values);
  this->FindRanges();
}

void LocalCorrection::TakeGiven(const std::vector<Id>& points, const MultiVector& values)
{
  given_ = MultiVector::Zero(hats_.Count(), values.cols());
  std::vector<double> count(hats_.Count(), 0.0);
  for (std::size_t k = 0; k < points.size(); ++k)
  {
    const Index hat = hats_.ofPoint[points[k]];
    if (hat >= 0)
    {
      given_.row(hat) += values.row(static_cast<Id>(k));
      count[hat] += 1.0;
      isGiven_[hat] = 1;
    }
  }
  for (Index hat = 0; hat < hats_.Count(); ++hat)
  {
    given_.row(hat) /= std::max(1.0, count[hat]);
  }
}

/// The functions may connect a component without a given value to another one. Such a component has
/// the range of all given values, or no range if no hat has one.
void LocalCorrection::FindRanges()
{
  const double infinity = std::numeric_limits<double>::infinity();
  low_ = MultiVector::Constant(hats_.numberOfComponents, given_.cols(), infinity);
  high_ = -low_;
  for (Index hat = 0; hat < hats_.Count(); ++hat)
  {
    if (isGiven_[hat])
    {
      const Index component = hats_.component[hat];
      low_.row(component) = low_.row(component).cwiseMin(given_.row(hat));
      high_.row(component) = high_.row(component).cwiseMax(given_.row(hat));
    }
  }
  const bool hasGiven = std::count(isGiven_.begin(), isGiven_.end(), 1) > 0;
  const Eigen::RowVectorXd least = (hasGiven ? low_ : high_).colwise().minCoeff();
  const Eigen::RowVectorXd largest = (hasGiven ? high_ : low_).colwise().maxCoeff();
  for (Index component = 0; component < hats_.numberOfComponents; ++component)
  {
    if (low_(component, 0) == infinity)
    {
      low_.row(component) = least;
      high_.row(component) = largest;
    }
  }
}

MultiVector LocalCorrection::OfHats(const MultiVector& atPoints) const
{
  return atPoints(place_, Eigen::indexing::all);
}

std::vector<Id> LocalCorrection::PointsBeyond(const MultiVector& atPoints, double share) const
{
  std::vector<Id> beyond;
  for (Index hat = 0; hat < hats_.Count(); ++hat)
  {
    const auto low = low_.row(hats_.component[hat]).array();
    const auto high = high_.row(hats_.component[hat]).array();
    const auto value = atPoints.row(place_[hat]).array();
    const auto most = share * (high - low) + RoundingOf(low.minCoeff(), high.maxCoeff());
    if (!isGiven_[hat] && (low - value > most || value - high > most).any())
    {
      beyond.push_back(place_[hat]);
    }
  }
  return beyond;
}

/// Replaces given values, and values beyond the range. Returns the hats that were off visibly.
std::vector<Index> LocalCorrection::Clamp(MultiVector& values) const
{
  std::vector<Index> off;
  for (Index hat = 0; hat < hats_.Count(); ++hat)
  {
    const Index component = hats_.component[hat];
    bool isOff = false;
    for (Id c = 0; c < values.cols(); ++c)
    {
      const double low = low_(component, c);
      const double high = high_(component, c);
      double& value = values(hat, c);
      const double right = isGiven_[hat] ? given_(hat, c) : std::clamp(value, low, high);
      const double most = VisibleDeviation * (high - low) + RoundingOf(low, high);
      isOff = isOff || std::abs(right - value) > most;
      value = right;
    }
    if (isOff)
    {
      off.push_back(hat);
    }
  }
  return off;
}

/// The hats without a given value within reach of some, ascending.
std::vector<Index> LocalCorrection::Around(const std::vector<Index>& some, double reach) const
{
  using Visit = std::pair<double, Index>;
  std::priority_queue<Visit, std::vector<Visit>, std::greater<>> open;
  std::vector<double> distance(hats_.Count(), std::numeric_limits<double>::infinity());
  const auto visit = [&](double at, Index hat)
  {
    if (at < distance[hat] && at <= reach)
    {
      distance[hat] = at;
      open.emplace(at, hat);
    }
  };
  for (const Index hat : some)
  {
    visit(0.0, hat);
  }
  std::vector<Index> found;
  while (!open.empty())
  {
    const auto [at, hat] = open.top();
    open.pop();
    if (at > distance[hat])
    {
      continue;
    }
    if (!isGiven_[hat])
    {
      found.push_back(hat);
    }
    for (Index k = hats_.begin[hat]; k < hats_.begin[hat + 1]; ++k)
    {
      for (const Id point : mesh_.triangles[hats_.corners[k].Triangle()])
      {
        const double length = (mesh_.points[point] - mesh_.points[place_[hat]]).norm();
        visit(at + length, hats_.ofPoint[point]);
      }
    }
  }
  std::sort(found.begin(), found.end());
  return found;
}

/// Makes each of some values the mean of its neighbors. The means lie between the other values. A
/// weight that rounding would lose keeps values without any other value around them.
void LocalCorrection::MakeHarmonic(
  const std::vector<Index>& some, MultiVector& values, const Job& job) const
{
  constexpr double Kept = 1e-12; // weight of the value itself
  const SparseMatrix stiffness = AssembleHatMatrices(mesh_, hats_, {}, job.threads).stiffness;
  std::vector<Index> number(hats_.Count(), -1);
  for (std::size_t row = 0; row < some.size(); ++row)
  {
    number[some[row]] = static_cast<Index>(row);
  }
  RowBuilder rows;
  RowBuilder::Entries entries;
  MultiVector right(static_cast<Id>(some.size()), values.cols());
  for (const Index hat : some)
  {
    entries.clear();
    double total = 0.0;
    auto sum = right.row(number[hat]);
    sum.setZero();
    for (Id k = stiffness.rowBegin[hat]; k < stiffness.rowBegin[hat + 1]; ++k)
    {
      const Index other = stiffness.column[k];
      if (other == hat || values.row(other).hasNaN())
      {
        continue; // neighbors without a value do not count
      }
      const double weight = WeightOf(stiffness, hat, k);
      total += weight;
      if (number[other] >= 0)
      {
        entries.emplace_back(number[other], -weight);
      }
      else
      {
        sum += weight * values.row(other);
      }
    }
    const double own = total > 0.0 ? Kept * total : 1.0;
    entries.emplace_back(number[hat], total + own);
    sum += own * values.row(hat);
    rows.Append(entries);
  }
  job.Check(0.2);
  const SparseCholesky factor(rows.Finish(static_cast<Index>(some.size())));
  job.Check(0.8);
  factor.Solve(right, right, job.threads);
  for (const Index hat : some)
  {
    const Index component = hats_.component[hat];
    values.row(hat) =
      right.row(number[hat]).cwiseMax(low_.row(component)).cwiseMin(high_.row(component));
  }
}

void LocalCorrection::Apply(double reach, MultiVector& atPoints, const Job& job) const
{
  MultiVector values = this->OfHats(atPoints);
  const std::vector<Index> off = this->Clamp(values);
  std::vector<Index> around = this->Around(off, reach);
  const auto hasNoValue = [&](Index hat) { return values.row(hat).hasNaN(); };
  around.erase(std::remove_if(around.begin(), around.end(), hasNoValue), around.end());
  if (!around.empty())
  {
    this->MakeHarmonic(around, values, job);
  }
  for (Id point = 0; point < atPoints.rows(); ++point)
  {
    const Index hat = hats_.ofPoint[point];
    if (hat >= 0 && !values.row(hat).hasNaN())
    {
      atPoints.row(point) = values.row(hat);
    }
  }
}

} // namespace gridfem
