#include "Input/NearestPoints.h"

#include "Base/Errors.h"
#include "Input/DataLines.h"
#include "Pipeline/Allocation.h"

#include "vtkDataSet.h"
#include "vtkIdList.h"
#include "vtkNew.h"
#include "vtkPoints.h"
#include "vtkPolyData.h"
#include "vtkStaticPointLocator.h"

#include <algorithm>
#include <cmath>
#include <sstream>

namespace gridfem
{
namespace
{

/// Refuses points that are not finite, because a locator finds nothing near them.
void RequireFinitePoints(vtkDataSet* places, const std::string& input)
{
  for (vtkIdType k = 0; k < places->GetNumberOfPoints(); ++k)
  {
    const double* point = places->GetPoint(k);
    if (!std::isfinite(point[0]) || !std::isfinite(point[1]) || !std::isfinite(point[2]))
    {
      throw InvalidInput(
        input + ": point " + std::to_string(k) +
        " has a NaN or infinite coordinate, so no point of the mesh is nearest to it.");
    }
  }
}

double LongestEdge(const TriangleMesh& mesh)
{
  double square = 0.0;
  for (const auto& corner : mesh.triangles)
  {
    for (int k = 0; k < 3; ++k)
    {
      square =
        std::max(square, (mesh.points[corner[k]] - mesh.points[corner[(k + 1) % 3]]).squaredNorm());
    }
  }
  return std::sqrt(square);
}

/// Finds the nearest of the points that triangles use. The locator finds nothing at places of huge
/// coordinates. So it works in units of the surface, with far places moved nearer.
class UsedPointFinder
{
public:
  explicit UsedPointFinder(const TriangleMesh& mesh) : mesh_(mesh)
  {
    constexpr double FarShare = 0.05; // of the longest side
    const std::vector<char> used = UsedPoints(mesh);
    for (Id point = 0; point < static_cast<Id>(used.size()); ++point)
    {
      if (used[point])
      {
        idOf_.push_back(point);
      }
    }
    const Bounds bounds = BoundsOf(mesh.points, used);
    const double side = (bounds.high - bounds.low).maxCoeff();
    center_ = 0.5 * bounds.low + 0.5 * bounds.high;
    unit_ = side > 0.0 ? side : 1.0;
    far_ = std::max(FarShare * side, LongestEdge(mesh));
    vtkNew<vtkPoints> points;
    points->SetDataTypeToDouble();
    SetTuples(points->GetData(), static_cast<vtkIdType>(idOf_.size()));
    for (std::size_t k = 0; k < idOf_.size(); ++k)
    {
      points->SetPoint(static_cast<vtkIdType>(k), this->InUnits(mesh.points[idOf_[k]]).data());
    }
    candidates_->SetPoints(points);
    locator_->SetDataSet(candidates_);
    locator_->BuildLocator();
  }

  Id NearestTo(const Vec3& place) const
  {
    return idOf_[locator_->FindClosestPoint(this->InUnits(place).data())];
  }

  double Between(const Vec3& place, Id point) const
  {
    return (mesh_.points[point] - place).stableNorm();
  }
  double Between(Id point, Id other) const { return this->Between(mesh_.points[point], other); }
  double Far() const { return far_; }

private:
  /// Beyond the farthest distance, only the direction decides about the nearest point.
  Vec3 InUnits(const Vec3& place) const
  {
    constexpr double Farthest = 1e6;
    const Vec3 half = 0.5 * place - 0.5 * center_; // the whole may overflow
    const double length = half.stableNorm();
    return length > 0.0 ? Vec3(half / length * std::min(2.0 * (length / unit_), Farthest))
                        : Vec3(Vec3::Zero());
  }

  const TriangleMesh& mesh_;
  std::vector<Id> idOf_;
  Vec3 center_ = Vec3::Zero();
  double unit_ = 1.0; // the longest side of the surface
  double far_ = 0.0;
  vtkNew<vtkPolyData> candidates_;
  vtkNew<vtkStaticPointLocator> locator_;
};

Vec3 PlaceAt(vtkDataSet* places, vtkIdType point)
{
  const double* place = places->GetPoint(point);
  return { place[0], place[1], place[2] };
}

std::vector<Id> NearestOfAll(const UsedPointFinder& finder, vtkDataSet* places,
  const std::string& input, std::vector<std::string>& warnings)
{
  std::vector<Id> nearest;
  vtkIdType count = 0;
  vtkIdType farthest = 0;
  double largest = 0.0;
  for (vtkIdType k = 0; k < places->GetNumberOfPoints(); ++k)
  {
    const Vec3 place = PlaceAt(places, k);
    nearest.push_back(finder.NearestTo(place));
    const double distance = finder.Between(place, nearest.back());
    count += distance > finder.Far() ? 1 : 0;
    if (distance > largest)
    {
      largest = distance;
      farthest = k;
    }
  }
  warnings.clear();
  if (count > 0)
  {
    std::ostringstream text;
    text << input << ": " << count << " of its " << nearest.size() << " points "
         << (count == 1 ? "is" : "are") << " farther than " << finder.Far()
         << " from all points of the surface. The farthest is point " << farthest << ", at "
         << largest
         << ". Each counts at the nearest point of the surface. Remove them, for "
            "example with Clip, if they do not belong to it.";
    warnings.push_back(text.str());
  }
  return nearest;
}

/// A place on a line, and the mesh point nearest to it.
struct PlaceOnLine
{
  Vec3 place;
  Id nearest;
};

/// Adds the mesh points nearest to places between two ends. Divides the line until its parts have
/// one nearest point, or are at most half as long as the nearest points are apart: half an edge.
/// @param divisions  how often the line may be divided
void AddBetween(const UsedPointFinder& finder, const PlaceOnLine& begin, const PlaceOnLine& end,
  int divisions, std::vector<Id>& nearest)
{
  // All places between two places with the same nearest point have this nearest point, too.
  if (begin.nearest == end.nearest || divisions == 0 ||
      (end.place - begin.place).norm() <= 0.5 * finder.Between(begin.nearest, end.nearest))
  {
    return;
  }
  const Vec3 place = 0.5 * (begin.place + end.place);
  const PlaceOnLine middle{ place, finder.NearestTo(place) };
  AddBetween(finder, begin, middle, divisions - 1, nearest);
  if (finder.Between(place, middle.nearest) <= finder.Far())
  {
    nearest.push_back(middle.nearest);
  }
  AddBetween(finder, middle, end, divisions - 1, nearest);
}

} // namespace

std::vector<Id> NearestPoints(const TriangleMesh& mesh, vtkDataSet* places,
  const std::string& input, std::vector<std::string>& warnings)
{
  RequireFinitePoints(places, input);
  return NearestOfAll(UsedPointFinder(mesh), places, input, warnings);
}

std::vector<Id> NearestPointsAlongLines(const TriangleMesh& mesh, vtkDataSet* places,
  const std::string& input, std::vector<std::string>& warnings)
{
  constexpr int MostDivisions = 40;
  RequireFinitePoints(places, input);
  const UsedPointFinder finder(mesh);
  std::vector<Id> nearest = NearestOfAll(finder, places, input, warnings);
  const auto at = [&](vtkIdType point) {
    return PlaceOnLine{ PlaceAt(places, point), nearest[static_cast<std::size_t>(point)] };
  };
  ForEachLine(places,
    [&](vtkIdList* points)
    {
      for (vtkIdType k = 0; k + 1 < points->GetNumberOfIds(); ++k)
      {
        AddBetween(finder, at(points->GetId(k)), at(points->GetId(k + 1)), MostDivisions, nearest);
      }
    });
  return nearest;
}

} // namespace gridfem
