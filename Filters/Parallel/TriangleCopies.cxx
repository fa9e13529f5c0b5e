#include "Parallel/TriangleCopies.h"

#include <algorithm>
#include <limits>
#include <map>

namespace gridfem
{

TriangleCopies::TriangleCopies(const Communicator& ranks, const TriangleMesh& own,
  const TriangleList& copies, const Grid& grid, const BlockPartition& partition,
  const TriangleMesh& received)
  : ranks_(ranks)
{
  areThere_ = ranks_.ShareOf(static_cast<Id>(copies.size())).total > 0;
  if (!areThere_)
  {
    return;
  }
  std::vector<std::vector<Corners>> asked(ranks_.Size());
  ranks_.Together(
    [&]
    {
      copies_ = copies;
      asked_.resize(ranks_.Size());
      found_.resize(ranks_.Size());
      const std::vector<char> isOwn = UsedPoints(own);
      isCopied_.assign(own.points.size(), 0);
      BlockPartition::RanksNear near;
      for (std::size_t k = 0; k < copies_.size(); ++k)
      {
        std::array<Vec3, 3> inGrid;
        Corners corners;
        for (int corner = 0; corner < 3; ++corner)
        {
          const Id point = copies_[k][corner];
          isCopied_[point] = !isOwn[point];
          inGrid[corner] = grid.ToGrid(own.points[point]);
          for (int axis = 0; axis < 3; ++axis)
          {
            corners[3 * corner + axis] = own.points[point][axis] + 0.0; // as the received points
          }
        }
        partition.FindRanksNear(inGrid[0], inGrid[1], inGrid[2], near);
        if (!near.ranks.empty())
        {
          asked_[near.ranks.front()].push_back(static_cast<Index>(k));
          asked[near.ranks.front()].push_back(corners);
        }
      }
    });
  asked = ranks_.Exchange(asked);
  ranks_.Together([&] { this->Find(asked, received); });
}

void TriangleCopies::Find(
  const std::vector<std::vector<Corners>>& asked, const TriangleMesh& received)
{
  std::map<Corners, Index> originals;
  for (const auto& ofRank : asked)
  {
    for (const Corners& corners : ofRank)
    {
      originals.emplace(corners, -1);
    }
  }
  for (std::size_t t = 0; !originals.empty() && t < received.triangles.size(); ++t)
  {
    Corners corners;
    for (int corner = 0; corner < 3; ++corner)
    {
      const Vec3& point = received.points[received.triangles[t][corner]];
      std::copy_n(point.data(), 3, corners.begin() + 3 * corner);
    }
    const auto original = originals.find(corners);
    if (original != originals.end() && original->second < 0)
    {
      original->second = static_cast<Index>(t);
    }
  }
  corners_ = received.triangles;
  for (int rank = 0; rank < ranks_.Size(); ++rank)
  {
    for (const Corners& corners : asked[rank])
    {
      found_[rank].push_back(originals.at(corners));
    }
  }
}

/// Collective. The answers of all ranks to this rank, copy by copy.
/// @param rows    at received points or triangles
/// @param rowsOf  row k of an original
template<class RowsOf>
std::vector<std::vector<double>> TriangleCopies::Answers(
  const MultiVector& rows, int rowsEach, RowsOf&& rowsOf) const
{
  const Id columns = rows.cols();
  std::vector<std::vector<double>> answers(ranks_.Size());
  std::vector<Id> expected = SizesOf(asked_);
  ranks_.Together(
    [&]
    {
      for (Id& count : expected)
      {
        count *= rowsEach * columns;
      }
      for (int rank = 0; rank < ranks_.Size(); ++rank)
      {
        for (const Index original : found_[rank])
        {
          for (int k = 0; k < rowsEach; ++k)
          {
            const double* const row = original < 0 ? nullptr : rows.row(rowsOf(original, k)).data();
            for (Id c = 0; c < columns; ++c)
            {
              answers[rank].push_back(row ? row[c] : std::numeric_limits<double>::quiet_NaN());
            }
          }
        }
      }
    });
  return ranks_.Exchange(answers, expected);
}

void TriangleCopies::FillPoints(const Redistribution& distribution, MultiVector& atPoints) const
{
  if (!areThere_)
  {
    return;
  }
  const auto answers = this->Answers(distribution.SendPoints(atPoints), 3,
    [&](Index original, int corner) { return corners_[original][corner]; });
  const Id columns = atPoints.cols();
  for (int rank = 0; rank < ranks_.Size(); ++rank)
  {
    const double* row = answers[rank].data();
    for (const Index copy : asked_[rank])
    {
      for (const Id point : copies_[copy])
      {
        if (isCopied_[point])
        {
          std::copy_n(row, columns, atPoints.row(point).data());
        }
        row += columns;
      }
    }
  }
}

MultiVector TriangleCopies::RowsOfOriginals(
  const Redistribution& distribution, const MultiVector& onTriangles) const
{
  const Id columns = onTriangles.cols();
  MultiVector rows;
  ranks_.Together(
    [&]
    {
      rows = MultiVector::Constant(
        static_cast<Id>(copies_.size()), columns, std::numeric_limits<double>::quiet_NaN());
    });
  if (!areThere_)
  {
    return rows;
  }
  const auto answers = this->Answers(
    distribution.SendTriangles(onTriangles), 1, [](Index original, int) { return original; });
  for (int rank = 0; rank < ranks_.Size(); ++rank)
  {
    for (std::size_t k = 0; k < asked_[rank].size(); ++k)
    {
      std::copy_n(answers[rank].data() + k * columns, columns, rows.row(asked_[rank][k]).data());
    }
  }
  return rows;
}

} // namespace gridfem
