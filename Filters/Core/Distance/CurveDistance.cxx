#include "Distance/CurveDistance.h"

#include "Base/Grouping.h"
#include "Integrals/EdgeSamples.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <queue>

namespace gridfem
{
namespace
{

constexpr double Far = std::numeric_limits<double>::infinity();

/// Spreads distances: points take over the segments of their neighbors, the nearest first.
class Spread
{
public:
  Spread(const SurfaceCurve& curve, const TriangleMesh& mesh, double limit, int threads)
    : curve_(curve), mesh_(mesh), limit_(limit), ends_(PiecesOf(curve, mesh)),
      distance_(mesh.points.size(), Far)
  {
    std::vector<Index> cornerPlace;
    for (const auto& corner : mesh.triangles)
    {
      this->AppendPlaces(corner, cornerPlace);
    }
    corners_ = this->GroupByPlace(cornerPlace, threads);
    std::vector<Index> segmentPlace;
    for (const TriangleSegment& segment : curve.segments)
    {
      this->AppendPlaces(mesh.triangles[segment.triangle], segmentPlace);
    }
    segments_ = this->GroupByPlace(segmentPlace, threads);
  }

  void Run()
  {
    for (std::size_t s = 0; s < curve_.segments.size(); ++s)
    {
      for (const Id point : mesh_.triangles[curve_.segments[s].triangle])
      {
        this->Offer(curve_.place[point], static_cast<Index>(s), 0.0, Far);
      }
    }
    while (!next_.empty())
    {
      const Entry entry = next_.top();
      next_.pop();
      if (entry.distance <= distance_[entry.place])
      {
        this->HandOn(entry);
      }
    }
  }

  double At(Id point) const
  {
    const Index place = curve_.place[point];
    const double size = distance_[place];
    return size == Far               ? std::numeric_limits<double>::quiet_NaN()
           : curve_.side[point] == 0 ? 0.0
                                     : curve_.side[point] * size;
  }

private:
  struct Entry
  {
    double distance;
    Index place;
    Index segment;

    /// Reversed, so that the top of a priority queue is the nearest entry.
    bool operator<(const Entry& other) const
    {
      return distance != other.distance ? distance > other.distance
             : place != other.place     ? place > other.place
                                        : segment > other.segment;
    }
  };

  void AppendPlaces(const std::array<Id, 3>& corner, std::vector<Index>& places) const
  {
    for (const Id point : corner)
    {
      places.push_back(curve_.place[point]);
    }
  }

  Groups GroupByPlace(const std::vector<Index>& places, int threads) const
  {
    return GroupItems(
      places.data(), static_cast<Id>(places.size()), static_cast<Id>(mesh_.points.size()), threads);
  }

  double DistanceFrom(Index segment, Index place) const
  {
    return DistanceFromSegment(ends_[segment], mesh_.points[place]);
  }

  /// Follows the curve to a nearer segment, over triangles that touch, as long as the distance
  /// falls.
  Index NearestFrom(Index segment, Index place) const
  {
    double least = this->DistanceFrom(segment, place);
    for (Index last = -1; last != segment;)
    {
      last = segment;
      for (const Id point : mesh_.triangles[curve_.segments[last].triangle])
      {
        const Index corner = curve_.place[point];
        for (Index k = segments_.begin[corner]; k < segments_.begin[corner + 1]; ++k)
        {
          const Index other = segments_.item[k] / 3;
          const double distance = this->DistanceFrom(other, place);
          if (distance < least)
          {
            least = distance;
            segment = other;
          }
        }
      }
    }
    return segment;
  }

  /// Offers a point the best segment near `start`.
  /// @param least  a segment that is nearer than this is on the other side of a fold
  void Offer(Index place, Index start, double least, double most)
  {
    const Index segment = this->NearestFrom(start, place);
    const double distance = this->DistanceFrom(segment, place);
    if (distance >= least && distance <= most && distance < distance_[place])
    {
      distance_[place] = distance;
      next_.push({ distance, place, segment });
    }
  }

  void HandOn(const Entry& entry)
  {
    for (Index k = corners_.begin[entry.place]; k < corners_.begin[entry.place + 1]; ++k)
    {
      for (const Id point : mesh_.triangles[corners_.item[k] / 3])
      {
        this->Offer(curve_.place[point], entry.segment, entry.distance, limit_);
      }
    }
  }

  const SurfaceCurve& curve_;
  const TriangleMesh& mesh_;
  double limit_;
  std::vector<Segment> ends_;
  Groups corners_;               // per place: 3 triangle + corner
  Groups segments_;              // per place: 3 segment + corner of its triangle
  std::vector<double> distance_; // per place
  std::priority_queue<Entry> next_;
};

} // namespace

std::vector<Segment> PiecesOf(const SurfaceCurve& curve, const TriangleMesh& mesh)
{
  std::vector<Segment> pieces;
  for (const TriangleSegment& segment : curve.segments)
  {
    const auto& corner = mesh.triangles[segment.triangle];
    const auto pointAt = [&](double t)
    {
      return PointOfSegment(
        segment, t, mesh.points[corner[0]], mesh.points[corner[1]], mesh.points[corner[2]]);
    };
    pieces.push_back({ pointAt(0.0), pointAt(1.0) });
  }
  return pieces;
}

std::vector<double> DistancesNear(
  const SurfaceCurve& curve, const TriangleMesh& mesh, double limit, int threads)
{
  Spread spread(curve, mesh, limit, threads);
  spread.Run();
  std::vector<double> distance(mesh.points.size());
  for (Id point = 0; point < static_cast<Id>(distance.size()); ++point)
  {
    distance[point] = spread.At(point);
  }
  return distance;
}

} // namespace gridfem
