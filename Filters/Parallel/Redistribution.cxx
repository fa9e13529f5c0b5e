#include "Parallel/Redistribution.h"

#include <algorithm>
#include <numeric>
#include <stdexcept>
#include <string>

namespace gridfem
{

namespace
{

bool IsBefore(const Vec3& a, const Vec3& b)
{
  return std::lexicographical_compare(a.data(), a.data() + 3, b.data(), b.data() + 3);
}

/// Sorts points by their cells along the Morton curve, so that neighbors are close in memory.
/// Points of one cell are sorted by their coordinates; coincident points keep their order.
std::vector<Index> OrderInSpace(const std::vector<Vec3>& points, const Grid& grid)
{
  std::vector<std::pair<MortonKey, Index>> order;
  order.reserve(points.size());
  for (std::size_t k = 0; k < points.size(); ++k)
  {
    order.emplace_back(MortonEncode(grid.CellAt(points[k])), static_cast<Index>(k));
  }
  std::sort(order.begin(), order.end(),
    [&](const auto& a, const auto& b)
    {
      const Vec3& x = points[a.second];
      const Vec3& y = points[b.second];
      return a.first != b.first ? a.first < b.first : IsBefore(x, y) || (x == y && a < b);
    });
  std::vector<Index> indices;
  indices.reserve(points.size());
  for (const auto& [cell, point] : order)
  {
    indices.push_back(point);
  }
  return indices;
}

/// The numbers of values in rows that each rank sends.
std::vector<Id> Values(std::vector<Id> rows, Id columns)
{
  for (Id& count : rows)
  {
    count *= columns;
  }
  return rows;
}

/// Throws if a field has a row too few or too many. It would be read beyond its end, or wrong.
void RequireRows(const MultiVector& field, Id rows)
{
  if (field.rows() != rows)
  {
    throw std::length_error("A field has " + std::to_string(field.rows()) + " rows, but " +
                            std::to_string(rows) + " are expected.");
  }
}

} // namespace

Redistribution::Redistribution(const Communicator& ranks, const TriangleMesh& own, const Grid& grid,
  const BlockPartition& partition, const std::vector<MortonKey>* cells)
  : ranks_(ranks), sentTriangles_(ranks.Size()), sentPoints_(ranks.Size()),
    numberOfOwnPoints_(static_cast<Id>(own.points.size())),
    numberOfOwnTriangles_(static_cast<Id>(own.triangles.size()))
{
  ranks_.Together(
    [&]
    {
      RequireIndices(3.0 * static_cast<double>(own.triangles.size()), "corners of triangles");
      RequireIndices(static_cast<double>(own.points.size()), "points");
      this->Route(own, grid, partition, cells);
    });
  this->Receive(own, grid);
}

void Redistribution::Route(const TriangleMesh& own, const Grid& grid,
  const BlockPartition& partition, const std::vector<MortonKey>* cells)
{
  BlockPartition::RanksNear near;
  for (std::size_t t = 0; t < own.triangles.size(); ++t)
  {
    const auto& corner = own.triangles[t];
    if (cells)
    {
      near.ranks = partition.RanksNearCell((*cells)[t]);
    }
    else
    {
      partition.FindRanksNear(grid.ToGrid(own.points[corner[0]]),
        grid.ToGrid(own.points[corner[1]]), grid.ToGrid(own.points[corner[2]]), near);
    }
    for (const int rank : near.ranks)
    {
      sentTriangles_[rank].push_back(static_cast<Index>(t));
    }
  }
  std::vector<int> sentTo(own.points.size(), -1);
  for (int rank = 0; rank < ranks_.Size(); ++rank)
  {
    for (const Index t : sentTriangles_[rank])
    {
      for (const Id point : own.triangles[t])
      {
        if (sentTo[point] != rank)
        {
          sentTo[point] = rank;
          sentPoints_[rank].push_back(static_cast<Index>(point));
        }
      }
    }
    std::sort(sentPoints_[rank].begin(), sentPoints_[rank].end());
  }
}

void Redistribution::Receive(const TriangleMesh& own, const Grid& grid)
{
  std::vector<std::vector<Point>> points(ranks_.Size());
  std::vector<std::vector<Corners>> corners(ranks_.Size());
  ranks_.Together([&] { this->FillMessages(own, points, corners); });
  points = ranks_.Exchange(points);
  corners = ranks_.Exchange(corners);
  receivedPoints_ = SizesOf(points);
  receivedTriangles_ = SizesOf(corners);
  ranks_.Together([&] { this->BuildMesh(std::move(points), std::move(corners), grid); });
}

/// The points and triangles for every rank.
void Redistribution::FillMessages(const TriangleMesh& own, std::vector<std::vector<Point>>& points,
  std::vector<std::vector<Corners>>& corners) const
{
  std::vector<Index> place(own.points.size());
  for (int rank = 0; rank < ranks_.Size(); ++rank)
  {
    for (const Index point : sentPoints_[rank])
    {
      place[point] = static_cast<Index>(points[rank].size());
      const Vec3& x = own.points[point];
      // Removes the sign of zeros, so that coincident points are equal.
      points[rank].push_back({ x[0] + 0.0, x[1] + 0.0, x[2] + 0.0 });
    }
    for (const Index t : sentTriangles_[rank])
    {
      const auto& corner = own.triangles[t];
      corners[rank].push_back({ place[corner[0]], place[corner[1]], place[corner[2]] });
    }
  }
}

/// Makes the mesh from what all ranks have sent, with its points in the order of space.
void Redistribution::BuildMesh(std::vector<std::vector<Point>> points,
  std::vector<std::vector<Corners>> corners, const Grid& grid)
{
  std::vector<Vec3> received;
  std::vector<std::array<Id, 3>> triangles;
  for (int rank = 0; rank < ranks_.Size(); ++rank)
  {
    const auto first = static_cast<Id>(received.size());
    for (const Point& point : points[rank])
    {
      received.emplace_back(point[0], point[1], point[2]);
    }
    for (const Corners& corner : corners[rank])
    {
      for (const Index point : corner)
      {
        RequirePlace(point, static_cast<Id>(points[rank].size()));
      }
      triangles.push_back({ first + corner[0], first + corner[1], first + corner[2] });
    }
    points[rank] = {};
    corners[rank] = {};
  }
  RequireIndices(static_cast<double>(received.size()), "points");
  const std::vector<Index> order = OrderInSpace(received, grid);
  pointPlace_.resize(received.size());
  mesh_.points.resize(received.size());
  for (std::size_t k = 0; k < order.size(); ++k)
  {
    pointPlace_[order[k]] = static_cast<Index>(k);
    mesh_.points[k] = received[order[k]];
  }
  for (auto& corner : triangles)
  {
    corner = { pointPlace_[corner[0]], pointPlace_[corner[1]], pointPlace_[corner[2]] };
  }
  mesh_.triangles = std::move(triangles);
  trianglePlace_.resize(mesh_.triangles.size());
  std::iota(trianglePlace_.begin(), trianglePlace_.end(), Index{ 0 });
}

MultiVector Redistribution::Send(const MultiVector& own, Id ownRows, const Lists& sent,
  const std::vector<Id>& expected, const std::vector<Index>& place) const
{
  const Id columns = own.cols();
  std::vector<std::vector<double>> rows(ranks_.Size());
  ranks_.Together(
    [&]
    {
      RequireRows(own, ownRows);
      for (int rank = 0; rank < ranks_.Size(); ++rank)
      {
        for (const Index row : sent[rank])
        {
          rows[rank].insert(rows[rank].end(), own.row(row).data(), own.row(row).data() + columns);
        }
      }
    });
  rows = ranks_.Exchange(rows, Values(expected, columns));
  MultiVector received;
  ranks_.Together(
    [&]
    {
      received.resize(static_cast<Id>(place.size()), columns);
      std::size_t k = 0;
      for (int rank = 0; rank < ranks_.Size(); ++rank)
      {
        for (Id row = 0; row < expected[rank]; ++row)
        {
          std::copy_n(rows[rank].data() + row * columns, columns, received.row(place[k++]).data());
        }
      }
    });
  return received;
}

MultiVector Redistribution::SendPoints(const MultiVector& own) const
{
  return this->Send(own, numberOfOwnPoints_, sentPoints_, receivedPoints_, pointPlace_);
}

MultiVector Redistribution::SendTriangles(const MultiVector& own) const
{
  return this->Send(own, numberOfOwnTriangles_, sentTriangles_, receivedTriangles_, trianglePlace_);
}

std::vector<char> Redistribution::ReturnPoints(
  const MultiVector& rows, const std::vector<char>& isKnown, MultiVector& own) const
{
  const Id columns = rows.cols();
  std::vector<std::vector<Index>> which(ranks_.Size()); // points, among those from each rank
  std::vector<std::vector<double>> values(ranks_.Size());
  ranks_.Together(
    [&]
    {
      RequireRows(rows, static_cast<Id>(pointPlace_.size()));
      RequireRows(own, numberOfOwnPoints_);
      std::size_t k = 0;
      for (int rank = 0; rank < ranks_.Size(); ++rank)
      {
        for (Index point = 0; point < receivedPoints_[rank]; ++point, ++k)
        {
          const Index place = pointPlace_[k];
          if (isKnown[place])
          {
            which[rank].push_back(point);
            values[rank].insert(
              values[rank].end(), rows.row(place).data(), rows.row(place).data() + columns);
          }
        }
      }
    });
  which = ranks_.Exchange(which);
  values = ranks_.Exchange(values, Values(SizesOf(which), columns));
  std::vector<char> isReturned;
  ranks_.Together(
    [&]
    {
      isReturned.assign(numberOfOwnPoints_, 0);
      for (int rank = 0; rank < ranks_.Size(); ++rank)
      {
        for (const Index point : which[rank])
        {
          RequirePlace(point, static_cast<Id>(sentPoints_[rank].size()));
        }
      }
    });
  for (int rank = 0; rank < ranks_.Size(); ++rank)
  {
    for (std::size_t k = 0; k < which[rank].size(); ++k)
    {
      const Index point = sentPoints_[rank][which[rank][k]];
      std::copy_n(values[rank].data() + k * columns, columns, own.row(point).data());
      isReturned[point] = 1;
    }
  }
  return isReturned;
}

MultiVector Redistribution::SumTriangles(const MultiVector& rows) const
{
  const Id columns = rows.cols();
  std::vector<std::vector<double>> parts(ranks_.Size());
  ranks_.Together(
    [&]
    {
      RequireRows(rows, static_cast<Id>(trianglePlace_.size()));
      std::size_t k = 0;
      for (int rank = 0; rank < ranks_.Size(); ++rank)
      {
        for (Id t = 0; t < receivedTriangles_[rank]; ++t)
        {
          const double* const row = rows.row(trianglePlace_[k++]).data();
          parts[rank].insert(parts[rank].end(), row, row + columns);
        }
      }
    });
  parts = ranks_.Exchange(parts, Values(SizesOf(sentTriangles_), columns));
  MultiVector sum;
  ranks_.Together([&] { sum = MultiVector::Zero(numberOfOwnTriangles_, columns); });
  for (int rank = 0; rank < ranks_.Size(); ++rank)
  {
    for (std::size_t k = 0; k < sentTriangles_[rank].size(); ++k)
    {
      sum.row(sentTriangles_[rank][k]) +=
        Eigen::Map<const Eigen::RowVectorXd>(parts[rank].data() + k * columns, columns);
    }
  }
  return sum;
}

std::vector<int> Redistribution::GiversOfPoints() const
{
  std::vector<int> giver(pointPlace_.size());
  std::size_t k = 0;
  for (int rank = 0; rank < ranks_.Size(); ++rank)
  {
    for (Id point = 0; point < receivedPoints_[rank]; ++point)
    {
      giver[pointPlace_[k++]] = rank;
    }
  }
  return giver;
}

} // namespace gridfem
