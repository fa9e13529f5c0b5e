#include "Input/SurfaceCurves.h"

#include "Base/Errors.h"
#include "Input/DataLines.h"
#include "Pipeline/Allocation.h"

#include "vtkCellArray.h"
#include "vtkDataSet.h"
#include "vtkGenericCell.h"
#include "vtkIdList.h"
#include "vtkNew.h"
#include "vtkPoints.h"
#include "vtkPolyData.h"
#include "vtkStaticCellLocator.h"

#include <algorithm>
#include <cmath>

namespace gridfem
{
namespace
{

std::vector<Vec3> ReadLine(vtkDataSet* data, vtkIdList* ids)
{
  std::vector<Vec3> line;
  for (vtkIdType k = 0; k < ids->GetNumberOfIds(); ++k)
  {
    if (ids->GetId(k) < 0 || ids->GetId(k) >= data->GetNumberOfPoints())
    {
      throw InvalidInput("Sources: a line uses point " + std::to_string(ids->GetId(k)) +
                         ", but there are " + std::to_string(data->GetNumberOfPoints()) +
                         " points.");
    }
    line.emplace_back();
    data->GetPoint(ids->GetId(k), line.back().data());
    if (!line.back().allFinite())
    {
      throw InvalidInput("Sources: point " + std::to_string(ids->GetId(k)) +
                         " of a line has a NaN or infinite coordinate.");
    }
  }
  return line;
}

/// Finds the triangle nearest to a point.
class TriangleLocator
{
public:
  explicit TriangleLocator(const TriangleMesh& mesh)
  {
    vtkNew<vtkPoints> points;
    points->SetDataTypeToDouble();
    SetTuples(points->GetData(), static_cast<vtkIdType>(mesh.points.size()));
    for (std::size_t k = 0; k < mesh.points.size(); ++k)
    {
      // Points that no triangle uses need not be finite.
      const Vec3 position = mesh.points[k].allFinite() ? mesh.points[k] : Vec3::Zero();
      points->SetPoint(static_cast<vtkIdType>(k), position.data());
    }
    vtkNew<vtkCellArray> triangles;
    for (Id t = 0; t < static_cast<Id>(mesh.triangles.size()); ++t)
    {
      const auto& corner = mesh.triangles[t];
      const auto at = [&](int k) -> const Vec3& { return mesh.points[corner[k]]; };
      if (at(0) != at(1) && at(1) != at(2) && at(2) != at(0))
      {
        const vtkIdType ids[3] = { corner[0], corner[1], corner[2] };
        triangles->InsertNextCell(3, ids);
        number_.push_back(t);
      }
    }
    surface_->SetPoints(points);
    surface_->SetPolys(triangles);
    locator_->SetDataSet(surface_);
    locator_->BuildLocator();
  }

  std::vector<SurfacePlace> Nearest(const Vec3& wanted, double tolerance) const
  {
    Vec3 closest;
    vtkIdType cell = -1;
    int part = 0;
    double square = 0.0;
    locator_->FindClosestPoint(wanted.data(), closest.data(), cell_, cell, part, square);
    if (cell < 0)
    {
      throw InvalidInput("No triangle with an area is near the lines of Sources.");
    }
    std::vector<SurfacePlace> places = { { number_[cell], closest } };
    this->AppendOthers(cell, closest, tolerance, places);
    return places;
  }

private:
  void AppendOthers(
    vtkIdType found, const Vec3& closest, double tolerance, std::vector<SurfacePlace>& places) const
  {
    double box[6];
    for (int axis = 0; axis < 3; ++axis)
    {
      box[2 * axis] = closest[axis] - tolerance;
      box[2 * axis + 1] = closest[axis] + tolerance;
    }
    locator_->FindCellsWithinBounds(box, near_);
    std::sort(near_->GetPointer(0), near_->GetPointer(0) + near_->GetNumberOfIds());
    for (vtkIdType k = 0; k < near_->GetNumberOfIds(); ++k)
    {
      surface_->GetCell(near_->GetId(k), cell_);
      Vec3 place;
      double weights[3];
      double square = 0.0;
      double parameters[3];
      int part = 0;
      const int isFound =
        cell_->EvaluatePosition(closest.data(), place.data(), part, parameters, square, weights);
      if (near_->GetId(k) != found && isFound != -1 && square <= tolerance * tolerance)
      {
        places.push_back({ number_[near_->GetId(k)], place });
      }
    }
  }

  vtkNew<vtkPolyData> surface_;
  vtkNew<vtkStaticCellLocator> locator_;
  vtkNew<vtkGenericCell> cell_;
  vtkNew<vtkIdList> near_;
  std::vector<Id> number_; // of the mesh's triangles
};

} // namespace

SurfaceCurve CurveOfLines(vtkDataSet* lines, const TriangleMesh& mesh, bool weldCoincidentPoints)
{
  std::vector<std::vector<Vec3>> polylines;
  if (lines)
  {
    ForEachLine(lines, [&](vtkIdList* ids) { polylines.push_back(ReadLine(lines, ids)); });
  }
  if (polylines.empty())
  {
    return {};
  }
  const TriangleLocator locator(mesh);
  return DivideByLines(
    mesh, polylines,
    [&](const Vec3& wanted, double tolerance) { return locator.Nearest(wanted, tolerance); },
    weldCoincidentPoints);
}

} // namespace gridfem
