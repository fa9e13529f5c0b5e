#include "Grid/PolygonTriangles.h"

#include "Base/Errors.h"

#include <algorithm>
#include <cmath>
#include <set>
#include <string>
#include <utility>

namespace gridfem
{
namespace
{

Vec3 NormalOf(const Vec3& a, const Vec3& b, const Vec3& c)
{
  return (b - a).cross(c - a);
}

/// Cuts ears off a polygon. It keeps the remaining corners in a ring; corners are numbered from 0.
class EarCutter
{
public:
  EarCutter(const std::vector<Vec3>& points, Id cell, const std::vector<Id>& corners)
    : points_(points), cell_(cell), corners_(corners), before_(corners.size()),
      after_(corners.size()), ear_(corners.size(), 0.0), blocker_(corners.size(), None)
  {
    const Id count = static_cast<Id>(corners.size());
    for (Id k = 0; k < count; ++k)
    {
      before_[k] = (k + count - 1) % count;
      after_[k] = (k + 1) % count;
      normal_ += NormalOf(this->Place(0), this->Place(k), this->Place(after_[k]));
    }
    for (Id k = 0; k < count; ++k)
    {
      this->Judge(k);
    }
  }

  /// Cuts until one triangle is left. Returns false when no corner can be cut off anymore. Throws
  /// InvalidInput when it takes too long.
  bool Cut(std::vector<Triangle>& triangles)
  {
    for (std::size_t left = corners_.size(); left > 3; --left)
    {
      const auto ear = std::find_if(ears_.begin(), ears_.end(),
        [this](const std::pair<double, Id>& candidate) { return this->IsFree(candidate.second); });
      this->RequireTime();
      if (ear == ears_.end())
      {
        return false;
      }
      const Id corner = ear->second;
      triangles.push_back(this->TriangleAt(corner));
      this->Remove(corner);
    }
    triangles.push_back(this->TriangleAt(first_));
    return true;
  }

private:
  static constexpr Id None = -1;

  const Vec3& Place(Id corner) const { return points_[corners_[corner]]; }

  Triangle TriangleAt(Id corner) const
  {
    return { corners_[before_[corner]], corners_[corner], corners_[after_[corner]] };
  }

  double AreaOf(Id a, Id b, Id c) const
  {
    return NormalOf(this->Place(a), this->Place(b), this->Place(c)).dot(normal_);
  }

  /// Classifies a corner as an ear or as an inward corner. Ears are sorted by how far they are from
  /// equilateral.
  void Judge(Id corner)
  {
    this->Forget(corner);
    blocker_[corner] = None;
    const Id a = before_[corner];
    const Id c = after_[corner];
    const double area = this->AreaOf(a, corner, c);
    if (!(area > 0.0))
    {
      inward_.insert(corner);
      return;
    }
    const double perimeter = (this->Place(corner) - this->Place(a)).norm() +
                             (this->Place(c) - this->Place(corner)).norm() +
                             (this->Place(a) - this->Place(c)).norm();
    ear_[corner] = perimeter * perimeter / area;
    ears_.insert({ ear_[corner], corner });
  }

  void Forget(Id corner)
  {
    inward_.erase(corner);
    ears_.erase({ ear_[corner], corner });
  }

  /// Whether no inward corner lies in the triangle that would be cut off. An inward corner once
  /// found there keeps blocking until it is cut off or no longer points inward.
  bool IsFree(Id corner)
  {
    if (blocker_[corner] != None && inward_.count(blocker_[corner]) > 0)
    {
      return false;
    }
    const auto blocker = std::find_if(
      inward_.begin(), inward_.end(), [&](Id other) { return this->Blocks(other, corner); });
    blocker_[corner] = blocker == inward_.end() ? None : *blocker;
    return blocker_[corner] == None;
  }

  bool Blocks(Id other, Id corner)
  {
    ++looks_;
    const Id a = before_[corner];
    const Id c = after_[corner];
    if (other == a || other == c || this->Place(other) == this->Place(a) ||
        this->Place(other) == this->Place(c))
    {
      return false;
    }
    return this->AreaOf(a, corner, other) >= 0.0 && this->AreaOf(corner, c, other) >= 0.0 &&
           this->AreaOf(c, a, other) >= 0.0;
  }

  /// Stops the search after too many looks of ears at inward corners. Nothing else could stop it.
  void RequireTime() const
  {
    constexpr double Most = 2e8; // a few seconds
    if (looks_ > Most)
    {
      throw InvalidInput("Cell " + std::to_string(cell_) + " is a polygon with " +
                         std::to_string(corners_.size()) +
                         " corners. So many of them point inward that cutting it into triangles "
                         "would take too long. Split it into smaller polygons first.");
    }
  }

  void Remove(Id corner)
  {
    const Id a = before_[corner];
    const Id c = after_[corner];
    this->Forget(corner);
    after_[a] = c;
    before_[c] = a;
    first_ = a;
    this->Judge(a);
    this->Judge(c);
  }

  const std::vector<Vec3>& points_;
  Id cell_;
  const std::vector<Id>& corners_;
  std::vector<Id> before_;
  std::vector<Id> after_;
  std::vector<double> ear_; // the key of each corner in ears_
  std::vector<Id> blocker_; // the inward corner that blocks each ear
  double looks_ = 0.0;
  Vec3 normal_ = Vec3::Zero();
  std::set<std::pair<double, Id>> ears_;
  std::set<Id> inward_;
  Id first_ = 0; // a remaining corner
};

std::vector<Triangle> TrianglesOfQuad(const std::vector<Vec3>& points, const std::vector<Id>& q)
{
  const auto normal = [&](int a, int b, int c)
  { return NormalOf(points[q[a]], points[q[b]], points[q[c]]); };
  const bool firstInside = normal(0, 1, 2).dot(normal(0, 2, 3)) >= 0.0;
  const bool secondInside = normal(1, 2, 3).dot(normal(1, 3, 0)) >= 0.0;
  const bool firstShorter =
    (points[q[0]] - points[q[2]]).squaredNorm() <= (points[q[1]] - points[q[3]]).squaredNorm();
  const bool useFirst = firstInside == secondInside ? firstShorter : firstInside;
  if (useFirst)
  {
    return { { q[0], q[1], q[2] }, { q[0], q[2], q[3] } };
  }
  return { { q[0], q[1], q[3] }, { q[1], q[2], q[3] } };
}

} // namespace

std::vector<Triangle> TrianglesOfPolygon(
  const std::vector<Vec3>& points, Id cell, const std::vector<Id>& corners)
{
  if (corners.size() == 4)
  {
    return TrianglesOfQuad(points, corners);
  }
  std::vector<Triangle> triangles;
  const bool isFinite = std::all_of(
    corners.begin(), corners.end(), [&](Id corner) { return points[corner].allFinite(); });
  if (isFinite)
  {
    if (EarCutter(points, cell, corners).Cut(triangles))
    {
      return triangles;
    }
  }
  triangles.clear();
  for (std::size_t k = 1; k + 1 < corners.size(); ++k)
  {
    triangles.push_back({ corners[0], corners[k], corners[k + 1] });
  }
  return triangles;
}

} // namespace gridfem
