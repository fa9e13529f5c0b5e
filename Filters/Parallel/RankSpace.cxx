#include "Parallel/RankSpace.h"

#include "Base/Parallel.h"
#include "Parallel/OwnPieces.h"

#include <algorithm>
#include <numeric>

namespace gridfem
{

namespace
{

/// Replaces the links of the finer level's patches by the links of the coarser level's patches.
void CoarsenLinks(const PatchLevel& fine, int threads, Array<Link>& links)
{
  links = LinksOfGroups(links, fine.parent, threads);
}

/// Whether two patches have the same functions at all corners that their cells share. They then
/// give the same value at any point that both contain.
bool AgreeOnSharedCorners(const PatchLevel& level, Index a, Index b)
{
  const CellIndex cellA = MortonDecode(level.cell[a]);
  const CellIndex cellB = MortonDecode(level.cell[b]);
  for (int corner = 0; corner < FunctionsPerPatch; ++corner)
  {
    int other = 0;
    bool isShared = true;
    for (int axis = 0; axis < 3; ++axis)
    {
      const int offset = cellA[axis] + (corner >> axis & 1) - cellB[axis];
      isShared &= offset == 0 || offset == 1;
      other |= (offset & 1) << axis;
    }
    if (isShared && level.dof[a][corner] != level.dof[b][other])
    {
      return false;
    }
  }
  return true;
}

/// Assigns points at the same place of one sheet to one patch, so that their values are equal bit
/// for bit. Coincident points have to be consecutive.
void UnitePointPatches(
  const std::vector<Vec3>& points, const PatchLevel& level, Array<Index>& pointPatch)
{
  std::vector<Index> chosen; // chosen patches of the points at one place
  for (std::size_t k = 0; k < points.size(); ++k)
  {
    if (k > 0 && points[k] != points[k - 1])
    {
      chosen.clear();
    }
    if (pointPatch[k] < 0)
    {
      continue;
    }
    const auto same = std::find_if(chosen.begin(), chosen.end(),
      [&](Index patch) { return AgreeOnSharedCorners(level, patch, pointPatch[k]); });
    if (same == chosen.end())
    {
      chosen.push_back(pointPatch[k]);
    }
    else
    {
      pointPatch[k] = *same;
    }
  }
}

/// Largest number of points that are compared at one place. No mesh has more.
constexpr std::size_t MostCompared = 64;

/// Adds up the rows of points first .. last, which are at one place, over those with the same
/// patch. Points of one rank are not added to each other.
void SumOfPlace(std::size_t first, std::size_t last, const Array<Index>& pointPatch,
  const std::vector<int>& giver, const MultiVector& rows, MultiVector& sums)
{
  for (std::size_t k = first; k < last && last - first <= MostCompared; ++k)
  {
    Eigen::RowVectorXd sum = Eigen::RowVectorXd::Zero(rows.cols());
    int before = -1;
    bool areApart = false;
    for (std::size_t other = first; other < last; ++other)
    {
      if (pointPatch[other] == pointPatch[k]) // givers ascend
      {
        sum += rows.row(static_cast<Id>(other));
        areApart |= giver[other] == before;
        before = giver[other];
      }
    }
    if (!areApart)
    {
      sums.row(static_cast<Id>(k)) = sum;
    }
  }
}

/// The patches in a range as a level of their own, without functions and parents.
PatchLevel CellsOfRange(const PatchLevel& level, const PatchRange& range)
{
  PatchLevel own;
  own.depth = level.depth;
  own.cell.assign(level.cell.begin() + range.first, level.cell.begin() + range.last);
  own.dof.resize(own.cell.size());
  return own;
}

void SetParents(
  const PatchLevel& level, const PatchRange& range, Index firstParent, PatchLevel& own)
{
  own.parent.resize(own.cell.size());
  for (Index patch = range.first; patch < range.last; ++patch)
  {
    own.parent[patch - range.first] = level.parent[patch] - firstParent;
  }
}

/// A link from a patch of this rank to a patch that may belong to another rank.
struct LinkToCell
{
  Id patch; // numbered over all ranks
  MortonKey cell;
  Index placeInCell;
};

} // namespace

RankSpace::RankSpace(const Communicator& ranks, const TriangleMesh& own,
  const RankSpaceOptions& options, const Progress& progress, const TriangleList& copies)
  : ranks_(ranks), coarsestSize_(options.space.coarsestSize),
    numberings_(std::make_shared<std::vector<LevelNumbering>>())
{
  RankClip clip(ranks_, own, options, progress.Part(0.0, 0.4), copies);
  partition_ = clip.partition;
  distribution_ = clip.distribution;
  copies_ = clip.copies;
  const SpaceOptions& functions = options.space.functions;
  const int depth = clip.clipped.grid.depth;
  const FunctionSupport support =
    functions.connectivityAware ? FunctionSupport::ConnectivityAware : FunctionSupport::Plain;

  GridFunctions all; // in and around the cells of this rank
  Array<Link> links;
  ranks_.Together(
    [&]
    {
      all.support = support;
      all.clipped = std::move(clip.clipped);
      PatchPartition patches = BuildPatches(all.clipped, support, functions.threads);
      Release(all.clipped.links);
      all.piecePatch = std::move(patches.piecePatch);
      all.pointPatch = FindPointPatches(all.clipped, all.piecePatch,
        static_cast<Id>(patches.cell.size()), all.clipped.numberOfInputPoints, functions.threads);
      progress.Check(0.45);
      PatchLevel finest = BuildFinestLevel(depth, patches, support, functions.threads);
      links = patches.links;
      all.levels = BuildLevels(std::move(finest), std::move(patches.links), support,
        { functions.threads, progress.Part(0.45, 0.6) });
      for (int level = depth; level > partition_->Depth(); --level)
      {
        CoarsenLinks(all.levels[depth - level], functions.threads, links);
      }
      UnitePointPatches(clip.mesh->points, all.Finest(), all.pointPatch);
    });
  std::vector<PatchLevel> shared = this->Divide(all, links, *partition_, functions.threads);
  ranks_.Together(
    [&]
    {
      FindComponents(all, functions.threads);
      auto distributed = std::make_shared<const GridFunctions>(std::move(all));
      // All levels of this rank. None of them is the coarsest level of the whole.
      auto operators = std::make_shared<const LevelOperators>(
        BuildLevelOperators(*distributed, TriangleRule(options.space.quadratureDegree),
          { functions.threads, progress.Part(0.6, 1.0) }, -1, options.space.normalStabilization));
      own_ =
        std::make_shared<const GridSpace>(clip.mesh, std::move(distributed), std::move(operators));
      auto whole = std::make_shared<GridFunctions>();
      whole->support = support;
      whole->clipped.grid = own_->Functions().GetGrid();
      whole->levels = std::move(shared);
      FindComponents(*whole, functions.threads);
      sharedFunctions_ = std::move(whole);
    });
  this->AddElements(functions.threads);
}

int RankSpace::OwnerOfPoint(const Vec3& point) const
{
  const Grid& grid = own_->Functions().GetGrid();
  return partition_->OwnerOf(MortonEncode(grid.CellAt(point)), grid.depth);
}

/// Collective. Makes the shared levels with the element matrices of all ranks.
void RankSpace::AddElements(int threads)
{
  const ElementMatrices& own = own_->Operators().elements.back();
  std::vector<ElementMatrix> mass;
  std::vector<ElementMatrix> stiffness;
  ranks_.Together(
    [&]
    {
      mass.assign(own.mass.begin(), own.mass.end());
      stiffness.assign(own.stiffness.begin(), own.stiffness.end());
    });
  mass = ranks_.Gather(mass);
  stiffness = ranks_.Gather(stiffness);
  ranks_.Together(
    [&]
    {
      ElementMatrices elements;
      elements.mass = Array<ElementMatrix>(mass.begin(), mass.end());
      elements.stiffness = Array<ElementMatrix>(stiffness.begin(), stiffness.end());
      auto operators = std::make_shared<const LevelOperators>(
        OperatorsOfElements(*sharedFunctions_, std::move(elements), threads, coarsestSize_));
      shared_ = std::make_shared<const GridSpace>(
        std::make_shared<const TriangleMesh>(), sharedFunctions_, std::move(operators));
    });
}

std::vector<double> RankSpace::SendToTriangles(const std::vector<double>& own) const
{
  MultiVector column;
  ranks_.Together(
    [&] {
      column = Eigen::Map<const Eigen::VectorXd>(own.data(), static_cast<Eigen::Index>(own.size()));
    });
  column = distribution_->SendTriangles(column);
  std::vector<double> received;
  ranks_.Together([&] { received.assign(column.data(), column.data() + column.size()); });
  return received;
}

RankSpace RankSpace::WithOwn(GridSpace own, int threads) const
{
  RankSpace other = *this;
  ranks_.Together([&] { other.own_ = std::make_shared<const GridSpace>(std::move(own)); });
  other.AddElements(threads);
  return other;
}

/// Keeps in `all` only this rank's part, with the functions numbered by their places in
/// numberings_.
/// @return the shared levels
std::vector<PatchLevel> RankSpace::Divide(
  GridFunctions& all, const Array<Link>& links, const BlockPartition& partition, int threads)
{
  const std::size_t distributed = all.GetGrid().depth - partition.Depth();
  std::vector<PatchLevel> levels;
  std::vector<PatchRange> ranges;
  ranks_.Together(
    [&]
    {
      for (std::size_t l = 0; l <= distributed; ++l)
      {
        ranges.push_back(OwnPatches(all.levels[l], partition, ranks_.Rank()));
        levels.push_back(CellsOfRange(all.levels[l], ranges[l]));
      }
    });
  for (std::size_t l = 0; l < distributed; ++l)
  {
    std::vector<Index> place;
    numberings_->push_back(NumberLevel(ranks_, partition, all.levels[l], place));
    levels[l].numberOfFunctions = (*numberings_)[l].Functions();
    for (Index patch = ranges[l].first; patch < ranges[l].last; ++patch)
    {
      for (int corner = 0; corner < FunctionsPerPatch; ++corner)
      {
        levels[l].dof[patch - ranges[l].first][corner] = place[all.levels[l].dof[patch][corner]];
      }
    }
    ranks_.Together([&] { SetParents(all.levels[l], ranges[l], ranges[l + 1].first, levels[l]); });
  }
  std::vector<PatchLevel> shared =
    this->Share(all.levels[distributed], links, partition, all.support, threads);
  const Communicator::Share patches = ranks_.ShareOf(levels.back().NumberOfPatches());
  const auto first = shared.front().dof.begin() + patches.before;
  std::copy_n(first, levels.back().dof.size(), levels.back().dof.begin());
  levels.back().numberOfFunctions = shared.front().numberOfFunctions;
  all.levels = std::move(levels);
  ranks_.Together([&] { KeepPieces(ranges.front().first, ranges.front().last, all); });
  return shared;
}

/// Collective. The level of the blocks with the patches of all ranks, and all coarser levels.
std::vector<PatchLevel> RankSpace::Share(const PatchLevel& level, const Array<Link>& links,
  const BlockPartition& partition, FunctionSupport support, int threads) const
{
  const PatchRange own = OwnPatches(level, partition, ranks_.Rank());
  const Communicator::Share share = ranks_.ShareOf(own.last - own.first);
  std::vector<LinkToCell> told;
  const auto tell = [&](Index from, Index to)
  {
    if (from >= own.first && from < own.last)
    {
      told.push_back({ share.before + from - own.first, level.cell[to], PlaceInCell(level, to) });
    }
  };
  PatchLevel whole;
  whole.depth = level.depth;
  ranks_.Together(
    [&]
    {
      for (const Link& link : links)
      {
        tell(link.first, link.second);
        tell(link.second, link.first);
      }
      whole.cell.assign(level.cell.begin() + own.first, level.cell.begin() + own.last);
    });
  whole.cell = ranks_.Gather(whole.cell);
  told = ranks_.Gather(told);
  std::vector<PatchLevel> levels;
  ranks_.Together(
    [&]
    {
      PatchPartition patches;
      Array<Link> all;
      for (const LinkToCell& link : told)
      {
        const auto other = FirstInCell(whole, link.cell) + link.placeInCell;
        all.emplace_back(static_cast<Index>(link.patch), other);
      }
      Array<Index> itself(whole.cell.size());
      std::iota(itself.begin(), itself.end(), Index{ 0 });
      patches.links = LinksOfGroups(all, itself, threads); // sorted, each once
      patches.cell = std::move(whole.cell);
      PatchLevel finest = BuildFinestLevel(level.depth, patches, support, threads);
      levels = BuildLevels(std::move(finest), std::move(patches.links), support, threads);
    });
  return levels;
}

void RankSpace::SumAtPoints(MultiVector& own) const
{
  const MultiVector rows = distribution_->SendPoints(own);
  MultiVector sums;
  std::vector<char> isHere;
  ranks_.Together(
    [&]
    {
      sums = rows;
      isHere = own_->PointsWithFunctions();
      const std::vector<int> giver = distribution_->GiversOfPoints();
      const std::vector<Vec3>& points = own_->Mesh().points;
      std::size_t last = 0;
      for (std::size_t first = 0; first < points.size(); first = last)
      {
        for (last = first + 1; last < points.size() && points[last] == points[first];)
        {
          ++last;
        }
        SumOfPlace(first, last, this->PointPatches(), giver, rows, sums);
      }
    });
  distribution_->ReturnPoints(sums, isHere, own);
}

} // namespace gridfem
