#include "Input/NearestPoints.h"

#include "Base/Errors.h"
#include "Pipeline/Allocation.h"

#include "vtkCellType.h"
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

struct EdgeLengths
{
  double mean = 0.0;
  double longest = 0.0;
};

EdgeLengths EdgeLengthsOf(const TriangleMesh& mesh)
{
  EdgeLengths lengths;
  for (const auto& corner : mesh.triangles)
  {
    for (int k = 0; k < 3; ++k)
    {
      const double length = (mesh.points[corner[k]] - mesh.points[corner[(k + 1) % 3]]).norm();
      lengths.mean += length;
      lengths.longest = std::max(lengths.longest, length);
    }
  }
  lengths.mean /= 3.0 * std::max(1.0, double(mesh.triangles.size()));
  return lengths;
}

/// Finds the nearest of the points that triangles use.
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
    vtkNew<vtkPoints> points;
    points->SetDataTypeToDouble();
    SetTuples(points->GetData(), static_cast<vtkIdType>(idOf_.size()));
    for (std::size_t k = 0; k < idOf_.size(); ++k)
    {
      points->SetPoint(static_cast<vtkIdType>(k), mesh.points[idOf_[k]].data());
    }
    candidates_->SetPoints(points);
    locator_->SetDataSet(candidates_);
    locator_->BuildLocator();
    double box[6];
    candidates_->GetBounds(box);
    const double side = std::max({ box[1] - box[0], box[3] - box[2], box[5] - box[4] });
    edges_ = EdgeLengthsOf(mesh);
    far_ = std::max(FarShare * side, edges_.longest);
  }

  Id NearestTo(const Vec3& place) const { return idOf_[locator_->FindClosestPoint(place.data())]; }

  double Between(const Vec3& place, Id point) const { return (mesh_.points[point] - place).norm(); }
  double Far() const { return far_; }
  const EdgeLengths& Edges() const { return edges_; }

private:
  const TriangleMesh& mesh_;
  std::vector<Id> idOf_;
  EdgeLengths edges_;
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
    text << input << ": " << count << " of " << nearest.size() << (count == 1 ? " is" : " are")
         << " farther than " << finder.Far() << " from the points of the surface. Point "
         << farthest << " is the farthest, by " << largest
         << ". They count at the nearest points of the surface. Leave them out, for example with "
            "Clip, if they do not belong to it.";
    warnings.push_back(text.str());
  }
  return nearest;
}

/// Adds the mesh points nearest to places between two ends.
void AddBetween(
  const UsedPointFinder& finder, const Vec3& begin, const Vec3& end, std::vector<Id>& nearest)
{
  constexpr double MostSteps = 1e5;
  const double step = 0.5 * finder.Edges().mean;
  const double length = (end - begin).norm();
  if (!(length > step) || !(step > 0.0))
  {
    return;
  }
  const int steps = static_cast<int>(std::min(MostSteps, std::ceil(length / step)));
  for (int k = 1; k < steps; ++k)
  {
    const Vec3 place = begin + double(k) / steps * (end - begin);
    const Id point = finder.NearestTo(place);
    if (finder.Between(place, point) <= finder.Far())
    {
      nearest.push_back(point);
    }
  }
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
  RequireFinitePoints(places, input);
  const UsedPointFinder finder(mesh);
  std::vector<Id> nearest = NearestOfAll(finder, places, input, warnings);
  vtkNew<vtkIdList> points;
  for (vtkIdType cell = 0; cell < places->GetNumberOfCells(); ++cell)
  {
    const int type = places->GetCellType(cell);
    if (type == VTK_LINE || type == VTK_POLY_LINE)
    {
      places->GetCellPoints(cell, points);
      for (vtkIdType k = 0; k + 1 < points->GetNumberOfIds(); ++k)
      {
        AddBetween(finder, PlaceAt(places, points->GetId(k)), PlaceAt(places, points->GetId(k + 1)),
          nearest);
      }
    }
  }
  return nearest;
}

} // namespace gridfem
