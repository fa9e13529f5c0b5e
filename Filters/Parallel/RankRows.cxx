#include "Parallel/RankRows.h"

#include "Base/SortEachOnce.h"

#include <algorithm>
#include <type_traits>

namespace gridfem
{

namespace
{

/// Columns of one message. Wider blocks take several messages.
constexpr Id ColumnsPerMessage = 32;
constexpr int Tag = 1908;

template<class Real>
MPI_Datatype TypeOf()
{
  return std::is_same_v<Real, float> ? MPI_FLOAT : MPI_DOUBLE;
}

/// The next rows in a buffer. Moves `place` behind them.
template<class Real>
Eigen::Map<Vectors<Real>> NextRows(Real*& place, const std::vector<Index>& rows, Id columns)
{
  Eigen::Map<Vectors<Real>> values(place, static_cast<Id>(rows.size()), columns);
  place += values.size();
  return values;
}

/// Calls body(some) for blocks of adjacent columns that fit into a message.
template<class Real, class Body>
void ForColumns(Block<Real> x, Body&& body)
{
  for (Id first = 0; first < x.cols(); first += ColumnsPerMessage)
  {
    body(Block<Real>(x.middleCols(first, std::min(ColumnsPerMessage, x.cols() - first))));
  }
}

} // namespace

RankRows::RankRows(const Communicator& ranks, Index ghosts, std::vector<RankNeighbor> neighbors,
  bool arePartsProlonged)
  : ranks_(ranks), ghosts_(ghosts), arePartsProlonged_(arePartsProlonged),
    neighbors_(std::move(neighbors))
{
  std::vector<char> hasOwner(ghosts_, 0);
  std::size_t rows = 0;
  for (const RankNeighbor& neighbor : neighbors_)
  {
    shared_.push_back(neighbor.functions);
    ownOfShared_.emplace_back();
    ghostsOfShared_.emplace_back();
    lower_ += neighbor.rank < ranks_.Rank() ? 1 : 0;
    rows += neighbor.functions.size();
    RequireIndices(static_cast<double>(neighbor.functions.size()) * ColumnsPerMessage,
      "values in a message between two ranks");
    for (const Index row : neighbor.functions)
    {
      all_.push_back(row);
      if (row >= ghosts_)
      {
        ownOfShared_.back().push_back(row);
      }
      else if (!hasOwner[row]) // the lowest rank that holds it
      {
        ghostsOfShared_.back().push_back(row);
        hasOwner[row] = 1;
      }
    }
  }
  SortEachOnce(all_);
  constexpr std::size_t Bytes = ColumnsPerMessage * sizeof(double);
  sent_.resize(rows * Bytes);
  received_.resize(rows * Bytes);
  own_.resize(all_.size() * Bytes);
  requests_.reserve(2 * neighbors_.size());
}

MultiVector RankRows::Gather(const Eigen::RowVectorXd& numbers) const
{
  const std::vector<double> all =
    ranks_.Gather(std::vector<double>(numbers.data(), numbers.data() + numbers.size()));
  return Eigen::Map<const MultiVector>(all.data(), ranks_.Size(), numbers.size());
}

/// Sends rows `out` of x to each neighbor, and receives as many rows as `in` has. x has few
/// columns.
template<class Real>
void RankRows::Exchange(const Rows& out, const Rows& in, Block<Real> x) const
{
  ranks_.RequireAll();
  requests_.clear();
  Real* place = reinterpret_cast<Real*>(received_.data());
  for (std::size_t k = 0; k < neighbors_.size(); ++k)
  {
    if (in[k].empty())
    {
      continue;
    }
    auto rows = NextRows(place, in[k], x.cols());
    MPI_Irecv(rows.data(), static_cast<int>(rows.size()), TypeOf<Real>(), neighbors_[k].rank, Tag,
      ranks_.Handle(), &requests_.emplace_back());
  }
  place = reinterpret_cast<Real*>(sent_.data());
  for (std::size_t k = 0; k < neighbors_.size(); ++k)
  {
    if (out[k].empty()) // the neighbor expects no message
    {
      continue;
    }
    auto rows = NextRows(place, out[k], x.cols());
    for (Id row = 0; row < rows.rows(); ++row)
    {
      rows.row(row) = x.row(out[k][row]);
    }
    MPI_Isend(rows.data(), static_cast<int>(rows.size()), TypeOf<Real>(), neighbors_[k].rank, Tag,
      ranks_.Handle(), &requests_.emplace_back());
  }
  MPI_Waitall(static_cast<int>(requests_.size()), requests_.data(), MPI_STATUSES_IGNORE);
}

/// Calls body(row, values) for all received rows.
template<class Real, class Body>
void RankRows::ForReceived(const Rows& in, Id columns, Body&& body) const
{
  Real* place = reinterpret_cast<Real*>(received_.data());
  for (const std::vector<Index>& rows : in)
  {
    const auto values = NextRows(place, rows, columns);
    for (Id k = 0; k < values.rows(); ++k)
    {
      body(rows[k], values.row(k));
    }
  }
}

/// Adds parts in the order of the ranks, so that all ranks get the same bits.
template<class Real>
void RankRows::SumParts(Block<Real> x) const
{
  this->Exchange<Real>(shared_, shared_, x);
  Real* place = reinterpret_cast<Real*>(own_.data());
  auto own = NextRows(place, all_, x.cols());
  for (Id k = 0; k < own.rows(); ++k)
  {
    own.row(k) = x.row(all_[k]);
    x.row(all_[k]).setZero();
  }
  const auto add = [&](const std::vector<Index>& rows, const auto& values)
  {
    for (Id k = 0; k < values.rows(); ++k)
    {
      x.row(rows[k]) += values.row(k);
    }
  };
  place = reinterpret_cast<Real*>(received_.data());
  for (std::size_t k = 0; k < neighbors_.size(); ++k)
  {
    if (k == lower_)
    {
      add(all_, own);
    }
    add(shared_[k], NextRows(place, shared_[k], x.cols()));
  }
  if (lower_ == neighbors_.size())
  {
    add(all_, own);
  }
}

template<class Real>
void RankRows::TakeOwners(Block<Real> x) const
{
  this->Exchange<Real>(ownOfShared_, ghostsOfShared_, x);
  this->ForReceived<Real>(
    ghostsOfShared_, x.cols(), [&](Index row, const auto& values) { x.row(row) = values; });
}

void RankRows::Sum(Block<float> x) const
{
  ForColumns<float>(x, [this](const Block<float>& some) { this->SumParts<float>(some); });
}

void RankRows::Sum(Block<double> x) const
{
  ForColumns<double>(x, [this](const Block<double>& some) { this->SumParts<double>(some); });
}

void RankRows::TakeGhosts(Block<float> x) const
{
  ForColumns<float>(x, [this](const Block<float>& some) { this->TakeOwners<float>(some); });
}

void RankRows::TakeGhosts(Block<double> x) const
{
  ForColumns<double>(x, [this](const Block<double>& some) { this->TakeOwners<double>(some); });
}

void RankRows::TakeLeast(Block<double> x) const
{
  ForColumns<double>(x,
    [this](Block<double> some)
    {
      this->Exchange<double>(shared_, shared_, some);
      this->ForReceived<double>(shared_, some.cols(),
        [&](Index row, const auto& values) { some.row(row) = some.row(row).cwiseMin(values); });
    });
}

} // namespace gridfem
