#include "Parallel/RankHats.h"

#include "Base/UnionFind.h"
#include "Multigrid/MatrixOrdering.h"
#include "Parallel/HatNumbering.h"
#include "Parallel/MatrixEntries.h"
#include "Parallel/RankRows.h"

#include <algorithm>
#include <limits>

namespace gridfem
{

namespace
{

/// The hats of the received mesh, and this rank's part of them.
class ReceivedHats
{
public:
  ReceivedHats(const RankSpace& space, int threads)
    : mesh_(space.Own().Mesh()), own_(space.Own().Functions()), rank_(space.Ranks().Rank())
  {
    HatOptions options;
    options.unitLength = space.Own().UnitLength();
    options.threads = threads;
    all_ = NumberHatFunctions(mesh_, options);
    for (const Vec3& point : mesh_.points)
    {
      home_.push_back(space.OwnerOfPoint(point));
    }
    for (const auto& corners : mesh_.triangles)
    {
      const int lowest = std::min({ home_[corners[0]], home_[corners[1]], home_[corners[2]] });
      isOwn_.push_back(lowest == rank_);
    }
    this->ListHeld();
  }

  /// The held hats. Received points are in an order that all ranks share, and so is the list.
  HatList Held() const
  {
    HatList list;
    for (const Id point : point_)
    {
      list.position.push_back(mesh_.points[point]);
      list.home.push_back(home_[point]);
    }
    return list;
  }

  /// The held hats, at their places in a numbering.
  /// @param ofOwn  with the triangles that are integrated here; else with all received triangles
  HatFunctions Part(const std::vector<Index>& place, bool ofOwn) const
  {
    std::vector<Index> placeOf(all_.Count(), -1);
    std::vector<Index> hatAt(place.size());
    for (std::size_t k = 0; k < place.size(); ++k)
    {
      placeOf[all_.ofPoint[point_[k]]] = place[k];
      hatAt[place[k]] = all_.ofPoint[point_[k]];
    }
    HatFunctions part;
    part.unitLength = all_.unitLength;
    for (const Index hat : all_.ofPoint)
    {
      part.ofPoint.push_back(hat < 0 ? -1 : placeOf[hat]);
    }
    UnionFind sets(static_cast<Index>(hatAt.size()));
    part.begin.push_back(0);
    for (const Index hat : hatAt)
    {
      for (Index k = all_.begin[hat]; k < all_.begin[hat + 1]; ++k)
      {
        const TriangleCorner corner = all_.corners[k];
        if (!ofOwn || isOwn_[corner.Triangle()])
        {
          part.corners.push_back(corner);
        }
        for (int side = 0; side < 3 && isOwn_[corner.Triangle()]; ++side)
        {
          sets.Unite(placeOf[hat], part.ofPoint[mesh_.triangles[corner.Triangle()][side]]);
        }
      }
      part.begin.push_back(static_cast<Index>(part.corners.size()));
    }
    const Array<Index> component = NumberSets(sets, part.numberOfComponents);
    part.component.assign(component.begin(), component.end());
    return part;
  }

  std::vector<double> IsIntegrated() const { return { isOwn_.begin(), isOwn_.end() }; }

private:
  /// Lists the held hats by their first points: hats of own triangles, hats with a piece of this
  /// rank at their point, and hats whose points are in its cells.
  void ListHeld()
  {
    std::vector<char> isHeld(all_.Count(), 0);
    const auto hold = [&](Id point)
    {
      if (all_.ofPoint[point] >= 0)
      {
        isHeld[all_.ofPoint[point]] = 1;
      }
    };
    for (std::size_t t = 0; t < mesh_.triangles.size(); ++t)
    {
      // The edges of flat triangles may be needed.
      for (int corner = 0; corner < 3 && isOwn_[t]; ++corner)
      {
        hold(mesh_.triangles[t][corner]);
      }
    }
    for (const Index corner : own_.clipped.corners)
    {
      if (corner < own_.clipped.numberOfInputPoints)
      {
        hold(corner);
      }
    }
    for (std::size_t point = 0; point < home_.size(); ++point)
    {
      if (home_[point] == rank_)
      {
        hold(static_cast<Id>(point));
      }
    }
    for (std::size_t point = 0; point < all_.ofPoint.size(); ++point)
    {
      const Index hat = all_.ofPoint[point];
      if (hat >= 0 && isHeld[hat])
      {
        isHeld[hat] = 0;
        point_.push_back(static_cast<Id>(point));
      }
    }
  }

  const TriangleMesh& mesh_;
  const GridFunctions& own_;
  int rank_;
  HatFunctions all_;
  std::vector<int> home_;   // owner of each point
  std::vector<char> isOwn_; // whether this rank integrates each triangle
  std::vector<Id> point_;   // first point of each held hat
};

/// Orders sweeps over the hats that no other rank holds. Their rows are complete here.
void OrderAlone(const LevelNumbering& numbering, int threads, HatLevel& level)
{
  std::vector<Index> alone;
  for (Index hat = numbering.ghosts; hat < numbering.Functions(); ++hat)
  {
    if (numbering.touching[hat] == 1)
    {
      alone.push_back(hat);
    }
  }
  const SparseMatrix rows = PartOf(level.matrices.stiffness, alone);
  level.order = InWhole(OrderInBlocks(rows), alone);
  level.groups = InWhole(GroupByCoupling(rows, threads), alone);
}

/// Collective. Builds the rank's part of the prolongation. The weights of all ranks sum to 1 in
/// each row.
SparseMatrix BuildProlongation(
  const RankSpace& space, const HatFunctions& hats, const RankRows& rows, int threads)
{
  SparseMatrix weights;
  MultiVector sum;
  const auto build = [&](const std::vector<char>& isBare)
  {
    space.Ranks().Together(
      [&]
      {
        weights = BuildHatWeights(hats, space.Own().Functions(), space.Own().Mesh(),
          HatTransfer::Evaluation, isBare, threads);
        sum = RowSums(weights, threads);
      });
    rows.Sum(sum);
  };
  build({});
  std::vector<char> isBare;
  double anyBare = 0.0;
  space.Ranks().Together(
    [&]
    {
      isBare = BareRows(sum);
      anyBare = std::count(isBare.begin(), isBare.end(), 1) > 0 ? 1.0 : 0.0;
    });
  space.Ranks().Maximum(&anyBare, 1);
  if (anyBare > 0.0)
  {
    build(isBare);
  }
  DivideRows(sum, weights, threads);
  return weights;
}

/// Collective. Whether this rank is the first that has a row of the prolongation, for each hat.
std::vector<char> FindEvaluated(const Communicator& ranks, const LevelNumbering& numbering,
  const RankRows& rows, const SparseMatrix& prolongation)
{
  constexpr double NoRank = std::numeric_limits<double>::infinity();
  MultiVector first;
  ranks.Together(
    [&]
    {
      first.resize(numbering.Functions(), 1);
      for (Index hat = 0; hat < numbering.Functions(); ++hat)
      {
        const bool hasRow = prolongation.rowBegin[hat] < prolongation.rowBegin[hat + 1];
        first(hat, 0) = hasRow ? ranks.Rank() : NoRank;
      }
    });
  rows.TakeLeast(first);
  std::vector<char> isEvaluated;
  ranks.Together(
    [&]
    {
      for (Index hat = 0; hat < numbering.Functions(); ++hat)
      {
        isEvaluated.push_back(
          first(hat, 0) == NoRank ? hat >= numbering.ghosts : first(hat, 0) == ranks.Rank());
      }
    });
  return isEvaluated;
}

} // namespace

RankHats::RankHats(const RankSpace& space, const Job& job)
{
  const Communicator& ranks = space.Ranks();
  std::unique_ptr<const ReceivedHats> received;
  HatList held;
  ranks.Together(
    [&]
    {
      received = std::make_unique<const ReceivedHats>(space, job.threads);
      held = received->Held();
      isIntegrated_ = std::make_shared<const std::vector<double>>(received->IsIntegrated());
      job.Check(0.2);
    });
  std::vector<Index> place;
  numbering_ = std::make_shared<const LevelNumbering>(NumberHats(ranks, held, place));
  auto level = std::make_shared<HatLevel>();
  HatFunctions atPoints; // with all triangles around each point
  std::unique_ptr<const RankRows> rows;
  ranks.Together(
    [&]
    {
      level->functions = received->Part(place, true);
      atPoints = received->Part(place, false);
      level->matrices = AssembleHatMatrices(space.Own().Mesh(), level->functions, {}, job.threads);
      job.Check(0.5);
      OrderAlone(*numbering_, job.threads, *level);
      rows = std::make_unique<const RankRows>(ranks, numbering_->ghosts, numbering_->neighbors);
      job.Check(0.7);
    });
  level->prolongation = BuildProlongation(space, atPoints, *rows, job.threads);
  isEvaluated_ = std::make_shared<const std::vector<char>>(
    FindEvaluated(ranks, *numbering_, *rows, level->prolongation));
  ranks.Together(
    [&]
    {
      level->restriction = Transpose(level->prolongation, job.threads);
      level_ = std::move(level);
      own_ = std::make_shared<const HatSpace>(level_, space.Own());
      job.Check(1.0);
    });
}

RankHats RankHats::WithOwn(HatSpace own) const
{
  RankHats other = *this;
  other.own_ = std::make_shared<const HatSpace>(std::move(own));
  return other;
}

} // namespace gridfem
