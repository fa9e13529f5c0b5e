#include "Parallel/RankLevel.h"

#include "Base/SortEachOnce.h"
#include "Multigrid/MatrixOrdering.h"
#include "Multigrid/SmootherSequence.h"
#include "Parallel/MatrixEntries.h"
#include "Spaces/PatchOrdering.h"

#include <algorithm>
#include <array>

namespace gridfem
{

namespace
{

/// Kinds of patches: this rank alone has its functions, one other rank shares them, or more ranks
/// do.
constexpr Index Kinds = 3;

/// The largest number of ranks that touch a function of the patch.
Index RanksAt(const std::array<Index, FunctionsPerPatch>& patch, const LevelNumbering& numbering)
{
  Index most = 1;
  for (const Index function : patch)
  {
    most = std::max(most, numbering.touching[function]);
  }
  return most;
}

/// Replaces functions by their places in an ascending list that contains all of them.
template<class Functions>
void Renumber(const std::vector<Index>& list, Functions& functions)
{
  for (Index& function : functions)
  {
    function =
      static_cast<Index>(std::lower_bound(list.begin(), list.end(), function) - list.begin());
  }
}

/// Collective. The complete rows and columns of a list of functions. Neighbors send the entries of
/// their patches between shared functions.
/// @param inList  shared functions with each neighbor, as places in the list
SparseMatrix WholeMatrix(const Communicator& ranks, const SparseMatrix& A,
  const std::vector<Index>& list, const LevelNumbering& numbering,
  const std::vector<RankNeighbor>& inList)
{
  std::vector<std::vector<MatrixEntry>> messages(ranks.Size());
  ranks.Together(
    [&]
    {
      for (const RankNeighbor& neighbor : numbering.neighbors)
      {
        ForEntries(A, neighbor.functions,
          [&](const MatrixEntry& entry) { messages[neighbor.rank].push_back(entry); });
      }
    });
  messages = ranks.Exchange(messages);
  SparseMatrix whole;
  ranks.Together(
    [&]
    {
      std::vector<MatrixEntry> entries;
      ForEntries(A, list, [&](const MatrixEntry& entry) { entries.push_back(entry); });
      for (const RankNeighbor& neighbor : inList)
      {
        for (const MatrixEntry& entry : messages[neighbor.rank])
        {
          RequirePlace(entry.row, static_cast<Id>(neighbor.functions.size()));
          RequirePlace(entry.column, static_cast<Id>(neighbor.functions.size()));
          entries.push_back(
            { neighbor.functions[entry.row], neighbor.functions[entry.column], entry.value });
        }
      }
      whole = SumOf({}, std::move(entries), static_cast<Index>(list.size()));
    });
  return whole;
}

/// The owner of each function.
std::vector<int> OwnersOf(const LevelNumbering& numbering, int rank)
{
  std::vector<int> owner(numbering.Functions(), rank);
  for (auto neighbor = numbering.neighbors.rbegin(); neighbor != numbering.neighbors.rend();
       ++neighbor) // the lowest rank comes last
  {
    for (const Index function : neighbor->functions)
    {
      owner[function] = std::min(owner[function], neighbor->rank);
    }
  }
  return owner;
}

using RankPair = std::array<int, 2>;

/// Collective. The color of each rank: the lowest number that no lower rank with coupled functions
/// has. The same on all ranks.
std::vector<int> ColorRanks(
  const Communicator& ranks, const SparseMatrix& A, const std::vector<int>& owner)
{
  std::vector<RankPair> coupled;
  ranks.Together(
    [&]
    {
      for (Index row = 0; row < A.rows; ++row)
      {
        for (Id k = A.rowBegin[row]; k < A.rowBegin[row + 1]; ++k)
        {
          const RankPair pair{ owner[A.column[k]], owner[row] };
          if (pair[0] < pair[1] && (coupled.empty() || coupled.back() != pair))
          {
            coupled.push_back(pair);
          }
        }
      }
      SortEachOnce(coupled);
    });
  coupled = ranks.Gather(coupled);
  std::vector<int> color(ranks.Size(), 0);
  ranks.Together(
    [&]
    {
      for (int rank = 0; rank < ranks.Size(); ++rank)
      {
        std::vector<char> isTaken(ranks.Size() + 1, 0);
        for (const RankPair& pair : coupled)
        {
          if (pair[1] == rank)
          {
            isTaken[color[pair[0]]] = 1;
          }
        }
        color[rank] =
          static_cast<int>(std::find(isTaken.begin(), isTaken.end(), 0) - isTaken.begin());
      }
    });
  return color;
}

std::unique_ptr<Smoother> MakeStep(const SparseMatrix& matrix, const BorderStep& step, int threads)
{
  std::vector<std::unique_ptr<Smoother>> sequence;
  if (!step.single.dof.IsEmpty())
  {
    sequence.push_back(MakeGaussSeidel(matrix, step.single));
  }
  if (!step.patches.dof.IsEmpty())
  {
    sequence.push_back(MakePatchSmoother(matrix, step.patches, threads, FactorPrecision::Double));
  }
  return sequence.empty() ? nullptr : MakeSmootherSequence(std::move(sequence));
}

/// Adds up rows over the ranks.
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

LevelBorder BorderOfPatches(
  const Communicator& ranks, const LevelNumbering& numbering, const std::vector<PatchLevel>& parts)
{
  LevelBorder border;
  double most = 1.0;
  ranks.Together(
    [&]
    {
      for (std::size_t kind = 1; kind < parts.size(); ++kind)
      {
        for (const auto& patch : parts[kind].dof)
        {
          border.functions.insert(border.functions.end(), patch.begin(), patch.end());
        }
      }
      SortEachOnce(border.functions);
      for (const Index touching : numbering.touching)
      {
        most = std::max(most, double(touching));
      }
    });
  ranks.Maximum(&most, 1);
  border.steps = [&parts, functions = border.functions, most](const SparseMatrix& matrix)
  {
    std::vector<BorderStep> steps;
    for (int kind = 1; kind < std::min(most, double(Kinds)); ++kind)
    {
      PatchLevel part = parts[kind];
      part.numberOfFunctions = matrix.rows;
      for (auto& patch : part.dof)
      {
        Renumber(functions, patch);
      }
      steps.push_back({ {}, OrderPatches(part), 1.0 / (kind == 1 ? 2.0 : most) });
    }
    return steps;
  };
  return border;
}

LevelBorder BorderOfGroups(
  const Communicator& ranks, const LevelNumbering& numbering, const SparseMatrix& A, int threads)
{
  LevelBorder border;
  std::vector<int> owner;
  std::vector<Index> own; // places of this rank's functions
  ranks.Together(
    [&]
    {
      owner = OwnersOf(numbering, ranks.Rank());
      for (Index row = 0; row < A.rows; ++row)
      {
        if (numbering.touching[row] > 1)
        {
          border.functions.push_back(row);
          border.functions.insert(border.functions.end(), A.column.begin() + A.rowBegin[row],
            A.column.begin() + A.rowBegin[row + 1]);
        }
      }
      SortEachOnce(border.functions);
      for (std::size_t place = 0; place < border.functions.size(); ++place)
      {
        if (border.functions[place] >= numbering.ghosts)
        {
          own.push_back(static_cast<Index>(place));
        }
      }
    });
  const std::vector<int> color = ColorRanks(ranks, A, owner);
  border.steps = [own, color, rank = ranks.Rank(), threads](const SparseMatrix& matrix)
  {
    std::vector<BorderStep> steps(1 + *std::max_element(color.begin(), color.end()));
    BorderStep& step = steps[color[rank]];
    const SparseMatrix rows = PartOf(matrix, own);
    step.single = InWhole(OrderInBlocks(rows), own);
    step.patches = InWhole(GroupByCoupling(rows, threads), own);
    return steps;
  };
  return border;
}

RankLevel::RankLevel(const Communicator& ranks, const LevelNumbering& numbering,
  const RankRows& rows, const RankRows* coarse, LevelBorder border, const SparseMatrix& A,
  int threads)
  : ranks_(ranks), rows_(rows), coarse_(coarse), threads_(threads),
    border_(std::move(border.functions))
{
  std::vector<RankNeighbor> neighbors;
  ranks.Together(
    [&]
    {
      neighbors = numbering.neighbors;
      for (RankNeighbor& neighbor : neighbors)
      {
        Renumber(border_, neighbor.functions);
      }
      const auto ghosts = static_cast<Index>(
        std::lower_bound(border_.begin(), border_.end(), numbering.ghosts) - border_.begin());
      borderRows_ = std::make_unique<RankRows>(ranks, ghosts, neighbors);
    });
  matrix_ = WholeMatrix(ranks, A, border_, numbering, neighbors);
  ranks.Together(
    [&]
    {
      for (const BorderStep& step : border.steps(matrix_))
      {
        steps_.push_back({ MakeStep(matrix_, step, threads_), step.damping });
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
    if (step.smoother)
    {
      step.smoother->Sweep(matrix_, r, correction, direction, threads_);
      correction *= step.damping;
    }
    borderRows_->Sum(correction);
    correct(correction);
  }
}

} // namespace gridfem
