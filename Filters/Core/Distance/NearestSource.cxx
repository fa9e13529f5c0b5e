#include "Distance/NearestSource.h"

#include "Base/Errors.h"
#include "Base/Grouping.h"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <string>
#include <utility>

namespace gridfem
{
namespace
{

constexpr Index None = -1;

/// The origin of a point's distance is a place between two other points, at `share` of the way to
/// the second point.
struct Origin
{
  Index first = None;
  Index second = None;
  double share = 0.0;
  double slope = 0.0;
};

/// Passes the numbers of sources from point to point, in the order of the distance.
class Descent
{
public:
  Descent(const TriangleMesh& mesh, const std::vector<double>& distance,
    const std::vector<Id>& sources, bool weld, int threads)
    : mesh_(mesh), place_(PlacesOf(mesh, weld)), distance_(DistancesOf(place_, distance)),
      number_(mesh.points.size(), None)
  {
    std::vector<Index> cornerPlace;
    for (const auto& corner : mesh.triangles)
    {
      for (const Id point : corner)
      {
        cornerPlace.push_back(place_[point]);
      }
    }
    corners_ = GroupItems(cornerPlace.data(), static_cast<Id>(cornerPlace.size()),
      static_cast<Id>(mesh.points.size()), threads);
    for (const Id source : sources)
    {
      if (number_[place_[source]] == None)
      {
        number_[place_[source]] = static_cast<Index>(sources_.size());
        sources_.push_back(source);
      }
    }
    while ((std::size_t(1) << digits_) < sources_.size())
    {
      ++digits_;
    }
    share_ = MultiVector::Zero(static_cast<Id>(mesh.points.size()), digits_);
    for (const Id source : sources_)
    {
      this->SetDigits(place_[source]);
    }
  }

  /// Visits all points from the nearest to the farthest. A point that is no source may be nearer
  /// than all points around it, for example in the place of a source. Such a point waits for a
  /// neighbor that knows its source.
  void Run(const Job& job)
  {
    const std::vector<Index> order = this->PlacesByDistance();
    rank_.assign(place_.size(), static_cast<Index>(order.size()));
    for (std::size_t k = 0; k < order.size(); ++k)
    {
      rank_[order[k]] = static_cast<Index>(k);
    }
    for (std::size_t k = 0; k < order.size(); ++k)
    {
      if (k % 65536 == 0)
      {
        job.Check(static_cast<double>(k) / static_cast<double>(order.size()));
      }
      if (number_[order[k]] == None)
      {
        this->Take(order[k], this->OriginOf(order[k]));
      }
      if (number_[order[k]] != None)
      {
        this->HandBack(order[k]);
      }
    }
  }

  Id SourceOf(Id point) const
  {
    const Index number = number_[place_[point]];
    return number == None ? -1 : sources_[number];
  }

private:
  static std::vector<Index> PlacesOf(const TriangleMesh& mesh, bool weld)
  {
    std::vector<Index> place(mesh.points.size());
    std::iota(place.begin(), place.end(), 0);
    if (weld)
    {
      const Array<Index> welded = WeldCoincidentPoints(mesh.points, UsedPoints(mesh));
      std::copy(welded.begin(), welded.end(), place.begin());
    }
    return place;
  }

  /// The distance of a place is the least distance of its points. Sheets that touch only in a point
  /// have separate distances there.
  static std::vector<double> DistancesOf(
    const std::vector<Index>& place, const std::vector<double>& atPoints)
  {
    std::vector<double> distance = atPoints;
    for (std::size_t point = 0; point < place.size(); ++point)
    {
      distance[place[point]] = std::fmin(distance[place[point]], atPoints[point]);
    }
    return distance;
  }

  /// All places with a distance, sources first.
  std::vector<Index> PlacesByDistance() const
  {
    std::vector<Index> order;
    for (Index point = 0; point < static_cast<Index>(place_.size()); ++point)
    {
      if (place_[point] == point && !std::isnan(distance_[point]))
      {
        order.push_back(point);
      }
    }
    const auto before = [this](Index a, Index b)
    {
      const bool aIsSource = number_[a] != None;
      const bool bIsSource = number_[b] != None;
      return aIsSource != bIsSource         ? aIsSource
             : distance_[a] != distance_[b] ? distance_[a] < distance_[b]
                                            : a < b;
    };
    std::sort(order.begin(), order.end(), before);
    return order;
  }

  bool IsNearer(Index a, Index than) const { return number_[a] != None && rank_[a] < rank_[than]; }

  Origin OriginOf(Index place) const
  {
    Origin best;
    for (Index k = corners_.begin[place]; k < corners_.begin[place + 1]; ++k)
    {
      const Index corner = corners_.item[k];
      const auto& triangle = mesh_.triangles[corner / 3];
      const Index a = place_[triangle[(corner % 3 + 1) % 3]];
      const Index b = place_[triangle[(corner % 3 + 2) % 3]];
      this->AlongEdge(place, a, best);
      this->AlongEdge(place, b, best);
      this->AcrossTriangle(place, a, b, best);
    }
    return best;
  }

  void AlongEdge(Index place, Index other, Origin& best) const
  {
    if (this->IsNearer(other, place))
    {
      const double length = (mesh_.points[other] - mesh_.points[place]).norm();
      const double fall = distance_[place] - distance_[other];
      this->Improve({ other, other, 0.0, length > 0.0 ? fall / length : 0.0 }, best);
    }
  }

  /// -∇ of the linear function is α (a - place) + β (b - place). It leads between a and b if both
  /// factors are positive.
  void AcrossTriangle(Index place, Index a, Index b, Origin& best) const
  {
    if (!this->IsNearer(a, place) || !this->IsNearer(b, place))
    {
      return;
    }
    const Vec3 toA = mesh_.points[a] - mesh_.points[place];
    const Vec3 toB = mesh_.points[b] - mesh_.points[place];
    const double fallA = distance_[place] - distance_[a];
    const double fallB = distance_[place] - distance_[b];
    const double aa = toA.squaredNorm();
    const double ab = toA.dot(toB);
    const double bb = toB.squaredNorm();
    const double determinant = aa * bb - ab * ab;
    const double alpha = bb * fallA - ab * fallB;
    const double beta = aa * fallB - ab * fallA;
    if (alpha > 0.0 && beta > 0.0 && determinant > 1e-12 * aa * bb)
    {
      const double slope = std::sqrt((alpha * fallA + beta * fallB) / determinant);
      this->Improve({ a, b, beta / (alpha + beta), slope }, best);
    }
  }

  static void Improve(const Origin& origin, Origin& best)
  {
    if (best.first == None || origin.slope > best.slope)
    {
      best = origin;
    }
  }

  void Take(Index place, const Origin& origin)
  {
    if (origin.first == None)
    {
      return;
    }
    share_.row(place) =
      (1.0 - origin.share) * share_.row(origin.first) + origin.share * share_.row(origin.second);
    Index number = 0;
    for (int digit = 0; digit < digits_; ++digit)
    {
      number |= share_(place, digit) > 0.5 ? Index(1) << digit : 0;
    }
    // At places where three regions meet, the digits may belong to another source.
    const bool isKnown = number == number_[origin.first] || number == number_[origin.second];
    number_[place] = isKnown               ? number
                     : origin.share <= 0.5 ? number_[origin.first]
                                           : number_[origin.second];
  }

  /// Passes the number of a place back to waiting neighbors, and on to theirs.
  void HandBack(Index from)
  {
    std::vector<Index> reached = { from };
    while (!reached.empty())
    {
      const Index place = reached.back();
      reached.pop_back();
      for (Index k = corners_.begin[place]; k < corners_.begin[place + 1]; ++k)
      {
        for (const Id point : mesh_.triangles[corners_.item[k] / 3])
        {
          const Index other = place_[point];
          if (number_[other] == None && rank_[other] < rank_[from])
          {
            number_[other] = number_[place];
            share_.row(other) = share_.row(place);
            reached.push_back(other);
          }
        }
      }
    }
  }

  void SetDigits(Index place)
  {
    for (int digit = 0; digit < digits_; ++digit)
    {
      share_(place, digit) = (number_[place] >> digit) & 1;
    }
  }

  const TriangleMesh& mesh_;
  std::vector<Index> place_;     // per point, the first one in its place
  std::vector<double> distance_; // per place
  Groups corners_;               // per place: 3 triangle + corner
  std::vector<Index> rank_;      // rank in the order of the distance
  std::vector<Id> sources_;      // without repeats
  std::vector<Index> number_;    // per place, the number of its source
  MultiVector share_;            // per place, shares of the digits of numbers
  int digits_ = 0;
};

} // namespace

void RequireSources(const std::vector<Id>& sources, std::size_t points)
{
  for (const Id source : sources)
  {
    if (source < 0 || source >= static_cast<Id>(points))
    {
      throw InvalidInput("The source " + std::to_string(source) + " is not a point of the mesh.");
    }
  }
}

void RequireUsed(const std::string& property, const std::vector<Id>& ids, const TriangleMesh& mesh)
{
  const std::vector<char> used = ids.empty() ? std::vector<char>() : UsedPoints(mesh);
  const auto points = static_cast<Id>(used.size());
  for (const Id id : ids)
  {
    if (id < 0 || id >= points)
    {
      throw InvalidInput(property + ": there is no point " + std::to_string(id) +
                         ". Choose an id from 0 to " + std::to_string(points - 1) + ".");
    }
    if (!used[id])
    {
      throw InvalidInput(property + ": no polygon uses point " + std::to_string(id) +
                         ", so that it is not on the surface. Choose a corner of a polygon.");
    }
  }
}

Id FirstUsedPoint(const TriangleMesh& mesh)
{
  Id first = mesh.triangles.front()[0];
  for (const auto& corner : mesh.triangles)
  {
    first = std::min({ first, corner[0], corner[1], corner[2] });
  }
  return first;
}

Id NearestUsedPoint(const std::string& property, const Vec3& place, const TriangleMesh& mesh)
{
  if (!place.allFinite())
  {
    throw InvalidInput(
      property + " has a NaN or infinite coordinate, so no point of the mesh is nearest to it.");
  }
  const auto farness = [&](Id point)
  { return std::make_pair((mesh.points[point] - place).squaredNorm(), point); };
  auto nearest = farness(mesh.triangles.front()[0]);
  for (const auto& corner : mesh.triangles)
  {
    for (const Id point : corner)
    {
      nearest = std::min(nearest, farness(point));
    }
  }
  return nearest.second;
}

std::vector<Id> NearestSources(const TriangleMesh& mesh, const std::vector<double>& distance,
  const std::vector<Id>& sources, bool weldCoincidentPoints, const Job& job)
{
  if (distance.size() != mesh.points.size())
  {
    throw InvalidInput("There are " + std::to_string(distance.size()) + " distances for " +
                       std::to_string(mesh.points.size()) + " points.");
  }
  RequireSources(sources, mesh.points.size());
  Descent descent(mesh, distance, sources, weldCoincidentPoints, job.threads);
  descent.Run(job);
  std::vector<Id> nearest(mesh.points.size());
  for (Id point = 0; point < static_cast<Id>(nearest.size()); ++point)
  {
    nearest[point] = std::isnan(distance[point]) ? -1 : descent.SourceOf(point);
  }
  return nearest;
}

} // namespace gridfem
