// Geodesic Paths as a user of VTK sees it.
#include "FilterSupport.h"
#include "Selections.h"

#include "vtkGeodesicPaths.h"

#include "vtkCell.h"
#include "vtkUnsignedCharArray.h"

#include <gtest/gtest.h>

#include <cmath>
#include <set>

using namespace gridfem;
using namespace gridfem::testing;

namespace
{

vtkPolyData* PathsOf(vtkGeodesicPaths* filter)
{
  filter->Update();
  return vtkPolyData::SafeDownCast(filter->GetOutputDataObject(1));
}

std::vector<double> CellValues(vtkPolyData* data, const char* name)
{
  return Values(data->GetCellData()->GetArray(name));
}

vtkSmartPointer<vtkGeodesicPaths> PathOn(vtkPolyData* surface)
{
  auto filter = vtkSmartPointer<vtkGeodesicPaths>::New();
  filter->SetInputData(surface);
  return filter;
}

} // namespace

/// Points lie where their corners and weights say, and arrays of the input are linear along the
/// path. Numbers at other corners, even NaN, do not count.
TEST(GeodesicPaths, DescribesItsPoints)
{
  const TriangleMesh mesh = Torus(24, 12, 2.0, 0.7);
  const auto surface = ToPolyData(mesh);
  auto* x = AddPointArray(surface, "x", 1, [](const Vec3& p, int) { return p[0]; });
  AddPointArray(surface, "place", 3, [](const Vec3& p, int k) { return p[k]; });
  vtkNew<vtkUnsignedCharArray> ghosts;
  ghosts->SetName(vtkDataSetAttributes::GhostArrayName());
  ghosts->SetNumberOfTuples(surface->GetNumberOfPoints());
  ghosts->FillValue(0);
  surface->GetPointData()->AddArray(ghosts);
  const auto filter = PathOn(surface);
  filter->AddSourcePointId(3);
  filter->AddTargetPointId(170);
  filter->AddTargetPointId(45);
  vtkPolyData* paths = PathsOf(filter);
  ASSERT_EQ(paths->GetNumberOfLines(), 2);
  EXPECT_EQ(CellValues(paths, "SourceId"), (std::vector<double>{ 3, 3 }));
  EXPECT_EQ(CellValues(paths, "TargetId"), (std::vector<double>{ 170, 45 }));
  EXPECT_EQ(CellValues(paths, "Shortest"), (std::vector<double>{ 1, 1 }));
  EXPECT_FALSE(paths->GetPointData()->HasArray(vtkDataSetAttributes::GhostArrayName()));
  vtkPointData* data = paths->GetPointData();
  for (vtkIdType point = 0; point < paths->GetNumberOfPoints(); ++point)
  {
    Vec3 place = Vec3::Zero();
    for (int k = 0; k < 3; ++k)
    {
      const auto corner =
        static_cast<vtkIdType>(data->GetArray("CornerIds")->GetComponent(point, k));
      place += data->GetArray("CornerWeights")->GetComponent(point, k) * mesh.points[corner];
      EXPECT_GE(surface->GetCell(static_cast<vtkIdType>(data->GetArray("CellId")->GetTuple1(point)))
                  ->GetPointIds()
                  ->IsId(corner),
        0);
    }
    for (int k = 0; k < 3; ++k)
    {
      EXPECT_NEAR(paths->GetPoint(point)[k], place[k], 1e-14);
      EXPECT_NEAR(data->GetArray("place")->GetComponent(point, k), place[k], 1e-14);
    }
  }
  x->SetValue(0, std::nan("")); // no path comes near point 0 of the mesh
  x->Modified();
  EXPECT_FALSE(std::isnan(PointValues(PathsOf(filter), "x").front()));
}

/// The last arc length is the length, and the cells of the path are marked.
TEST(GeodesicPaths, MeasuresAndMarks)
{
  const auto surface = ToPolyData(Box(5));
  const auto filter = PathOn(surface);
  filter->SetPathType(vtkGeodesicPaths::Closed);
  for (const vtkIdType point : { 2, 40, 100 })
  {
    filter->AddTargetPointId(point);
  }
  vtkPolyData* paths = PathsOf(filter);
  ASSERT_EQ(paths->GetNumberOfLines(), 3);
  const std::vector<double> lengths = CellValues(paths, "Length");
  const std::vector<double> pathOfCell = CellValues(filter->GetOutput(), "PathId");
  std::set<double> cells;
  for (vtkIdType line = 0; line < 3; ++line)
  {
    vtkIdList* points = paths->GetCell(line)->GetPointIds();
    EXPECT_NEAR(paths->GetPointData()
                  ->GetArray("ArcLength")
                  ->GetTuple1(points->GetId(points->GetNumberOfIds() - 1)),
      lengths[static_cast<std::size_t>(line)], 1e-13);
  }
  for (const double cell : PointValues(paths, "CellId"))
  {
    cells.insert(cell);
  }
  for (std::size_t cell = 0; cell < pathOfCell.size(); ++cell)
  {
    EXPECT_EQ(pathOfCell[cell] >= 0.0, cells.count(static_cast<double>(cell)) > 0) << cell;
  }
}

/// Two selected points have the path between them, without another choice.
TEST(GeodesicPaths, JoinsTwoSelectedPoints)
{
  const auto surface = ToPolyData(GeodesicSphere(6));
  const auto filter = PathOn(surface);
  filter->SetInputDataObject(1, SelectPoints({ 11, 90 }));
  vtkPolyData* paths = PathsOf(filter);
  EXPECT_EQ(CellValues(paths, "SourceId"), (std::vector<double>{ 11 }));
  EXPECT_EQ(CellValues(paths, "TargetId"), (std::vector<double>{ 90 }));
}

TEST(GeodesicPaths, ArraysNameSourcesAndTargets)
{
  const auto surface = ToPolyData(Box(3));
  AddPointArray(surface, "from", 1, [](const Vec3& p, int) { return p.norm() == 0.0 ? 1.0 : 0.0; });
  AddPointArray(surface, "to", 1, [](const Vec3& p, int) { return p.sum() == 3.0 ? 1.0 : 0.0; });
  const auto filter = PathOn(surface);
  filter->SetInputArrayToProcess(0, 0, 0, Points, "from");
  filter->SetInputArrayToProcess(1, 0, 0, Points, "to");
  const std::vector<double> lengths = CellValues(PathsOf(filter), "Length");
  ASSERT_EQ(lengths.size(), 1u);
  EXPECT_NEAR(lengths.front(), std::sqrt(5.0), 1e-6); // points of vtkPolyData may be float
}

TEST(GeodesicPaths, TellsWhereNoPathLeads)
{
  const auto surface = ToPolyData(CubeArray(2, 1, 0.5));
  const auto last = static_cast<double>(surface->GetNumberOfPoints() - 1);
  const auto filter = PathOn(surface);
  filter->AddSourcePointId(0);
  filter->AddTargetPointId(static_cast<vtkIdType>(last));
  const Messages messages(filter);
  EXPECT_EQ(PathsOf(filter)->GetNumberOfLines(), 0);
  EXPECT_EQ(messages.warnings.size(), 1u);
  EXPECT_EQ(Values(filter->GetOutput()->GetFieldData()->GetArray("UnreachedTargets")),
    std::vector<double>{ last });
  filter->AddTargetPointId(static_cast<vtkIdType>(last) + 1);
  ExpectRefused(filter);
}
