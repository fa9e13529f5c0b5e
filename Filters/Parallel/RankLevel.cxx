#include "Parallel/RankLevel.h"

#include "Parallel/MatrixEntries.h"
#include "Spaces/PatchOrdering.h"

#include <algorithm>

namespace gridfem
{

namespace
{

/// Patches whose functions this rank has alone, shares with one other, with more.
constexpr Index Kinds = 3;

/// How many ranks touch a function of the patch, at most.
Index RanksAt(const std::array<Index, FunctionsPerPatch>& patch, const LevelNumbering& numbering)
{
  Index most = 1;
  for (const Index function : patch)
  {
    most = std::max(most, numbering.touching[function]);
  }
  return most;
}

/// Functions of all patches but those of this rank alone.
std::vector<Index> BorderOf(const std::vector<PatchLevel>& parts)
{
  std::vector<Index> border;
  for (std::size_t kind = 1; kind < parts.size(); ++kind)
  {
    for (const auto& patch : parts[kind].dof)
    {
      border.insert(border.end(), patch.begin(), patch.end());
    }
  }
  std::sort(border.begin(), border.end());
  border.erase(std::unique(border.begin(), border.end()), border.end());
  return border;
}

/// Replaces functions by their places in an ascending list, which has all of them.
template<class Functions>
void Renumber(const std::vector<Index>& list, Functions& functions)
{
  for (Index& function : functions)
  {
    function =
      static_cast<Index>(std::lower_bound(list.begin(), list.end(), function) - list.begin());
  }
}

/// Calls body(row, column, value) for entries whose row and column are in a list, places in it.
template<class Body>
void ForEntries(const SparseMatrix& A, const std::vector<Index>& list, Body&& body)
{
  std::vector<Index> place(A.rows, -1);
  for (std::size_t k = 0; k < list.size(); ++k)
  {
    place[list[k]] = static_cast<Index>(k);
  }
  for (const Index row : list)
  {
    for (Id k = A.rowBegin[row]; k < A.rowBegin[row + 1]; ++k)
    {
      if (place[A.column[k]] >= 0)
      {
        body(MatrixEntry{ place[row], place[A.column[k]], A.value[k] });
      }
    }
  }
}

/// Collective. The rows and columns of a list of functions, which lack nothing: neighbours tell
/// what their patches add between functions that both hold.
/// @param inList  per neighbour the functions of both, places in the list
SparseMatrix WholeMatrix(const Communicator& ranks, const SparseMatrix& A,
  const std::vector<Index>& list, const LevelNumbering& numbering,
  const std::vector<RankNeighbour>& inList)
{
  std::vector<std::vector<MatrixEntry>> messages(ranks.Size());
  ranks.Together(
    [&]
    {
      for (const RankNeighbour& neighbour : numbering.neighbours)
      {
        ForEntries(A, neighbour.functions,
          [&](const MatrixEntry& entry) { messages[neighbour.rank].push_back(entry); });
      }
    });
  messages = ranks.Exchange(messages);
  SparseMatrix whole;
  ranks.Together(
    [&]
    {
      std::vector<MatrixEntry> entries;
      ForEntries(A, list, [&](const MatrixEntry& entry) { entries.push_back(entry); });
      for (const RankNeighbour& neighbour : inList)
      {
        for (const MatrixEntry& entry : messages[neighbour.rank])
        {
          entries.push_back(
            { neighbour.functions[entry.row], neighbour.functions[entry.column], entry.value });
        }
      }
      whole = SumOf({}, std::move(entries), static_cast<Index>(list.size()));
    });
  return whole;
}

/// @param rows  null: all ranks hold all rows
template<class Real>
void SumRows(const Communicator& ranks, const RankRows* rows, Block<Real> x)
{
  if (rows)
  {
    rows->Sum(x);
    return;
  }
  ranks.Sum(x.data(), x.size());
}

} // namespace

std::vector<PatchLevel> PatchesByRanks(const PatchLevel& level, const LevelNumbering& numbering)
{
  PatchLevel none;
  none.depth = level.depth;
  none.numberOfFunctions = level.numberOfFunctions;
  std::vector<PatchLevel> parts(Kinds, none);
  for (Id patch = 0; patch < level.NumberOfPatches(); ++patch)
  {
    PatchLevel& part = parts[std::min(RanksAt(level.dof[patch], numbering), Kinds) - 1];
    part.cell.push_back(level.cell[patch]);
    part.dof.push_back(level.dof[patch]);
  }
  return parts;
}

RankLevel::RankLevel(const Communicator& ranks, const LevelNumbering& numbering,
  const RankRows& rows, const RankRows* coarse, const std::vector<PatchLevel>& parts,
  const SparseMatrix& A, int threads)
  : ranks_(ranks), rows_(rows), coarse_(coarse), threads_(threads)
{
  std::vector<RankNeighbour> neighbours;
  double most = 1.0;
  ranks.Together(
    [&]
    {
      border_ = BorderOf(parts);
      neighbours = numbering.neighbours;
      for (RankNeighbour& neighbour : neighbours)
      {
        Renumber(border_, neighbour.functions);
      }
      const auto foreign = static_cast<Index>(
        std::lower_bound(border_.begin(), border_.end(), numbering.foreign) - border_.begin());
      borderRows_ = std::make_unique<RankRows>(ranks, foreign, neighbours);
      for (const Index touching : numbering.touching)
      {
        most = std::max(most, double(touching));
      }
    });
  ranks.Maximum(&most, 1);
  matrix_ = WholeMatrix(ranks, A, border_, numbering, neighbours);
  ranks.Together(
    [&]
    {
      for (int kind = 1; kind < std::min(most, double(Kinds)); ++kind)
      {
        PatchLevel part = parts[kind];
        part.numberOfFunctions = matrix_.rows;
        for (auto& patch : part.dof)
        {
          Renumber(border_, patch);
        }
        steps_.push_back(
          { MakePatchSmoother(matrix_, OrderPatches(part), threads_, FactorPrecision::Double),
            1.0 / (kind == 1 ? 2.0 : most) });
      }
    });
}

void RankLevel::SumCoarse(Block<float> x) const
{
  SumRows<float>(ranks_, coarse_, x);
}

void RankLevel::SumCoarse(Block<double> x) const
{
  SumRows<double>(ranks_, coarse_, x);
}

void RankLevel::Relax(Id columns, SweepDirection direction,
  const std::function<void(MultiVector& part)>& residual,
  const std::function<void(const MultiVector& correction)>& correct) const
{
  const auto rows = static_cast<Id>(border_.size());
  MultiVector r(rows, columns);
  MultiVector correction(rows, columns);
  for (std::size_t k = 0; k < steps_.size(); ++k)
  {
    const Step& step = steps_[direction == SweepDirection::Forward ? k : steps_.size() - 1 - k];
    residual(r);
    borderRows_->Sum(r);
    correction.setZero();
    step.smoother->Sweep(matrix_, r, correction, direction, threads_);
    correction *= step.damping;
    borderRows_->Sum(correction);
    correct(correction);
  }
}

} // namespace gridfem
