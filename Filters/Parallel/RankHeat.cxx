#include "Parallel/RankHeat.h"

#include "Base/SortEachOnce.h"
#include "Parallel/MatrixEntries.h"

#include <algorithm>
#include <iterator>
#include <limits>
#include <utility>

namespace gridfem
{

namespace
{

/// Largest number of rounds. Heat needs one round per rank on its way, and errors at borders need
/// further rounds to fall.
constexpr int MostRounds = 500;

/// Rounds end when the changes at borders are this fraction of the changes allowed in layers that
/// are left. Errors at borders fall more slowly than those within a rank.
constexpr double AtBorders = 0.1;

/// Largest number of rounds after everything has nearly settled.
constexpr int MostLastRounds = 30;

/// The place of a number in an ascending list; -1 if it is missing.
Index PlaceOf(Id number, const std::vector<Id>& list)
{
  const auto found = std::lower_bound(list.begin(), list.end(), number);
  return found != list.end() && *found == number ? static_cast<Index>(found - list.begin()) : -1;
}

} // namespace

RankHeat::RankHeat(const RankLevels& levels, double t, double change, const Job& job)
  : levels_(levels), ranks_(levels.Space().Ranks()),
    functions_(levels.Space().Numberings().front().Functions()), change_(change)
{
  components_ = levels.ComponentsOf(0, job.threads);
  SparseMatrix part;
  ranks_.Together([&] { part = levels.Space().Own().Matrix(0, 1.0 / t, 1.0, job.threads); });
  this->FindOthers(part);
  ranks_.Together(
    [&]
    {
      heat_ = std::make_unique<DistantHeat>(
        std::move(whole_), levels.Space().Own().Functions().Finest().dof, t, change, job.threads);
    });
  job.Check(1.0);
}

/// Collective. Completes the rows of all functions here with the entries that neighbors send for
/// shared functions.
void RankHeat::FindOthers(const SparseMatrix& part)
{
  EntriesOfRanks messages(ranks_.Size());
  told_.resize(ranks_.Size());
  heard_.resize(ranks_.Size());
  ranks_.Together(
    [&]
    {
      for (const RankNeighbor& neighbor : this->Numbering().neighbors)
      {
        messages[neighbor.rank] = this->EntriesFor(neighbor, part);
      }
    });
  messages = ranks_.Exchange(messages);
  ranks_.Together([&] { this->AddOthers(part, messages); });
}

/// The entries of rows that a neighbor shares. Notes the columns that the neighbor does not share.
std::vector<RankHeat::ToldEntry> RankHeat::EntriesFor(
  const RankNeighbor& neighbor, const SparseMatrix& part)
{
  std::vector<char> isShared(functions_, 0);
  for (const Index function : neighbor.functions)
  {
    isShared[function] = 1;
  }
  std::vector<ToldEntry> entries;
  std::vector<Index>& told = told_[neighbor.rank];
  for (std::size_t k = 0; k < neighbor.functions.size(); ++k)
  {
    const Index row = neighbor.functions[k];
    for (Id e = part.rowBegin[row]; e < part.rowBegin[row + 1]; ++e)
    {
      const Index column = part.column[e];
      entries.push_back({ static_cast<Index>(k), this->Numbering().number[column], part.value[e] });
      if (!isShared[column])
      {
        isShared[column] = 1;
        told.push_back(column);
      }
    }
  }
  std::sort(told.begin(), told.end()); // numbers ascend with places
  return entries;
}

/// Gives functions that only other ranks hold a place behind the functions here, and adds the
/// entries of all ranks to this rank's part of the matrix.
void RankHeat::AddOthers(const SparseMatrix& part, const EntriesOfRanks& messages)
{
  const LevelNumbering& numbering = this->Numbering();
  std::vector<std::vector<Id>> unknown(ranks_.Size()); // from each rank, unknown here
  std::vector<Id> numbers;
  for (int rank = 0; rank < ranks_.Size(); ++rank)
  {
    for (const ToldEntry& entry : messages[rank])
    {
      if (PlaceOf(entry.column, numbering.number) < 0)
      {
        unknown[rank].push_back(entry.column);
      }
    }
    SortEachOnce(unknown[rank]);
    numbers.insert(numbers.end(), unknown[rank].begin(), unknown[rank].end());
  }
  SortEachOnce(numbers);
  const auto placeOf = [&](Id number)
  {
    const Index here = PlaceOf(number, numbering.number);
    return here >= 0 ? here : functions_ + PlaceOf(number, numbers);
  };
  for (int rank = 0; rank < ranks_.Size(); ++rank)
  {
    std::transform(
      unknown[rank].begin(), unknown[rank].end(), std::back_inserter(heard_[rank]), placeOf);
  }
  std::vector<MatrixEntry> others;
  for (const RankNeighbor& neighbor : numbering.neighbors)
  {
    for (const ToldEntry& entry : messages[neighbor.rank])
    {
      RequirePlace(entry.row, static_cast<Id>(neighbor.functions.size()));
      const Index row = neighbor.functions[entry.row];
      const Index column = placeOf(entry.column);
      others.push_back({ row, column, entry.value });
      if (column >= functions_) // so that heat can come from there
      {
        others.push_back({ column, row, entry.value });
      }
    }
  }
  whole_ = SumOf(part, std::move(others), functions_ + static_cast<Index>(numbers.size()));
}

/// Collective. Replaces values that belong to other ranks by the owners' values.
void RankHeat::TakeOthers(MultiVector& u) const
{
  MultiVector here;
  ranks_.Together([&] { here = u.topRows(functions_); });
  levels_.Distributed(0)->TakeGhosts(here);
  std::vector<std::vector<double>> values(ranks_.Size());
  ranks_.Together(
    [&]
    {
      u.topRows(functions_) = here;
      for (int rank = 0; rank < ranks_.Size(); ++rank)
      {
        for (const Index function : told_[rank])
        {
          values[rank].push_back(here(function, 0));
        }
      }
    });
  values = ranks_.Exchange(values, SizesOf(heard_));
  for (int rank = 0; rank < ranks_.Size(); ++rank)
  {
    for (std::size_t k = 0; k < values[rank].size(); ++k)
    {
      u(heard_[rank][k], 0) = values[rank][k];
    }
  }
}

/// Collective. Counts over all ranks. A rank's own count would miss ranks that no heat has entered
/// at all.
Id RankHeat::CountUnreached(const MultiVector& heat) const
{
  // Heat that is too small to be represented is 0.
  const auto hasHeat = [&](Index function) { return heat(function, 0) != 0.0; };
  std::vector<double> isReached;
  ranks_.Together([&] { isReached.assign(components_.count, 0.0); });
  for (Index function = 0; function < functions_; ++function)
  {
    if (hasHeat(function))
    {
      isReached[components_.ofFunction[function]] = 1.0;
    }
  }
  ranks_.Maximum(isReached.data(), components_.count);
  double unreached = 0.0;
  for (Index function = levels_.Distributed(0)->Ghosts(); function < functions_; ++function)
  {
    unreached +=
      !hasHeat(function) && isReached[components_.ofFunction[function]] > 0.0 ? 1.0 : 0.0;
  }
  return static_cast<Id>(this->Sum(unreached));
}

double RankHeat::Sum(double own) const
{
  ranks_.Sum(&own, 1);
  return own;
}

HeatField RankHeat::From(const MultiVector& load, const Job& job) const
{
  MultiVector b;
  HeatField heat;
  double sweeps = 0.0;
  ranks_.Together(
    [&]
    {
      const Index all = heat_->Matrix().rows;
      b = MultiVector::Zero(all, 1);
      b.topRows(functions_) = load;
      heat.coefficients = MultiVector::Zero(all, 1);
    });
  double change = std::numeric_limits<double>::infinity();
  int last = 0;
  for (int round = 0; round < MostRounds && last < MostLastRounds && change > AtBorders * change_;
       ++round)
  {
    job.Check(1.0 - 10.0 / (10.0 + round));
    ranks_.Together([&] { heat = heat_->Continue(b, std::move(heat.coefficients), job.threads); });
    sweeps += heat.sweeps;
    this->TakeOthers(heat.coefficients);
    ranks_.Together([&] { change = heat_->ChangeOf(b, heat.coefficients); });
    ranks_.Maximum(&change, 1);
    last += change <= DistantHeat::LastChange * change_ ? 1 : 0;
  }
  const double patches =
    static_cast<double>(levels_.Space().Own().Functions().Finest().NumberOfPatches());
  heat.sweeps = this->Sum(sweeps * patches) / std::max(1.0, this->Sum(patches));
  heat.converged =
    change <= DistantHeat::LastChange * change_ && this->Sum(heat.converged ? 0.0 : 1.0) == 0.0;
  heat.unreached = this->CountUnreached(heat.coefficients);
  ranks_.Together([&] { heat.coefficients = MultiVector(heat.coefficients.topRows(functions_)); });
  return heat;
}

} // namespace gridfem
