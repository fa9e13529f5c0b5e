// Geodesic Distance as a user of VTK sees it.
#include "FilterSupport.h"
#include "Largest.h"

#include "vtkCellArray.h"
#include "vtkConnectivityAwareBasis.h"
#include "vtkCutter.h"
#include "vtkGeodesicDistance.h"
#include "vtkMath.h"
#include "vtkMultiBlockDataSet.h"
#include "vtkPlane.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

using namespace gridfem;
using namespace gridfem::testing;

namespace
{

vtkSmartPointer<vtkGeodesicDistance> MakeFilter(vtkPolyData* input, int depth = 5)
{
  auto filter = vtkSmartPointer<vtkGeodesicDistance>::New();
  filter->SetDepth(depth);
  filter->SetInputDataObject(0, input);
  return filter;
}

std::vector<double> DistancesOf(vtkGeodesicDistance* filter)
{
  EXPECT_EQ(filter->GetExecutive()->Update(), 1);
  return PointValues(filter->GetOutputDataObject(0), "Distance");
}

/// Adds an array that is 1 at one point.
vtkSmartPointer<vtkPolyData> WithMask(const TriangleMesh& mesh, Id source, double other = 0.0)
{
  auto data = ToPolyData(mesh);
  Id point = 0;
  AddPointArray(data, "mask", 1, [&](const Vec3&, int) { return point++ == source ? 1.0 : other; });
  return data;
}

} // namespace

TEST(GeodesicDistanceFilter, OnHatFunctionsTheGridIsAsFineAsDepthSays)
{
  // Heat flows on the grid. A finer one is more accurate, even if the mesh has fewer points.
  const TriangleMesh mesh = Transform(FlatRectangle(12, 12), { 1, 2, 0 }, 0.5);
  double before = 1.0;
  for (const int depth : { 3, 5, 7 })
  {
    auto filter = MakeFilter(ToPolyData(mesh), depth);
    filter->SetFunctionSpace(vtkGeodesicDistance::HatFunctions);
    filter->AddSourcePointId(0);
    const std::vector<double> distance = DistancesOf(filter);
    double error = 0.0;
    for (std::size_t i = 0; i < distance.size(); ++i)
    {
      error = Larger(error, std::abs(distance[i] - (mesh.points[i] - mesh.points[0]).norm()));
    }
    EXPECT_EQ(FieldValue(filter->GetOutput(), "UsedDepth"), depth);
    EXPECT_LT(error, 0.8 * before) << depth;
    before = error;
  }
}

TEST(GeodesicDistanceFilter, TakesTheSameSourceAsIdAsMaskAndAsPlace)
{
  const TriangleMesh mesh = GeodesicSphere(16);
  constexpr Id Source = 100;
  auto byId = MakeFilter(ToPolyData(mesh));
  byId->AddSourcePointId(Source);
  const std::vector<double> expected = DistancesOf(byId);
  ASSERT_EQ(expected.size(), mesh.points.size());
  for (std::size_t i = 0; i < expected.size(); ++i)
  {
    const double angle = std::acos(std::clamp(mesh.points[i].dot(mesh.points[Source]), -1.0, 1.0));
    ASSERT_NEAR(expected[i], angle, 0.08) << i;
  }
  auto byMask = MakeFilter(WithMask(mesh, Source));
  byMask->SetInputArrayToProcess(0, 0, 0, vtkDataObject::FIELD_ASSOCIATION_POINTS, "mask");
  EXPECT_EQ(DistancesOf(byMask), expected);

  TriangleMesh place;
  place.points = { 1.3 * mesh.points[Source] };
  auto byPlace = MakeFilter(ToPolyData(mesh));
  byPlace->SetInputDataObject(2, ToPolyData(place));
  EXPECT_EQ(DistancesOf(byPlace), expected);
}

TEST(GeodesicDistanceFilter, StartsAtThePointNearestToAPosition)
{
  TriangleMesh mesh = GeodesicSphere(12);
  mesh.points.insert(mesh.points.begin(), Vec3(0.0, 0.0, 1.2)); // of no polygon
  for (auto& corner : mesh.triangles)
  {
    corner = { corner[0] + 1, corner[1] + 1, corner[2] + 1 };
  }
  auto byPosition = MakeFilter(ToPolyData(mesh));
  for (const Vec3& place : { Vec3(0.0, 0.0, 1.25), Vec3(-3.0, 0.2, 0.1), Vec3(0.1, 0.3, -0.2) })
  {
    Id nearest = 1;
    for (Id point = 1; point < static_cast<Id>(mesh.points.size()); ++point)
    {
      const bool isNearer =
        (mesh.points[point] - place).norm() < (mesh.points[nearest] - place).norm();
      nearest = isNearer ? point : nearest;
    }
    auto byId = MakeFilter(ToPolyData(mesh));
    byId->AddSourcePointId(nearest);
    byPosition->SetSourcePosition(place[0], place[1], place[2]);
    EXPECT_EQ(DistancesOf(byPosition)[1], 0.0) << "a position that is not used counts";
    byPosition->UseSourcePositionOn();
    const std::vector<double> found = DistancesOf(byPosition);
    EXPECT_EQ(found[nearest], 0.0);
    const std::vector<double> expected = DistancesOf(byId);
    for (std::size_t i = 1; i < found.size(); ++i)
    {
      ASSERT_EQ(found[i], expected[i]) << i;
    }
    byPosition->UseSourcePositionOff();
  }
}

TEST(GeodesicDistanceFilter, RefusesAPositionThatIsNowhereOrIsNoCurve)
{
  const auto sphere = ToPolyData(GeodesicSphere(8));
  auto nowhere = MakeFilter(sphere, 4);
  nowhere->UseSourcePositionOn();
  nowhere->SetSourcePosition(0.0, std::nan(""), 0.0);
  ExpectRefused(nowhere, "Source Position has a NaN");
  auto noCurve = MakeFilter(sphere, 4);
  noCurve->UseSourcePositionOn();
  noCurve->SignedOn();
  ExpectRefused(noCurve, "Use Source Position is about points");
}

TEST(GeodesicDistanceFilter, StartsAtTheFirstPointWhereNothingIsChosen)
{
  const TriangleMesh mesh = GeodesicSphere(8);
  auto filter = MakeFilter(ToPolyData(mesh), 4);
  const std::vector<double> found = DistancesOf(filter);
  EXPECT_EQ(found[0], 0.0);
  EXPECT_EQ(std::count(found.begin(), found.end(), 0.0), 1);
}

/// A disk whose rim is wavy and has points at uneven distances, and whose inner points are random.
TEST(GeodesicDistanceFilter, IsNoLessThanTheStraightLineToAnUnevenRim)
{
  constexpr int Around = 90;
  constexpr int Rings = 20;
  TriangleMesh mesh;
  for (int ring = 0; ring <= Rings; ++ring)
  {
    for (int k = 0; k < Around; ++k)
    {
      const double angle = 2.0 * vtkMath::Pi() * k / Around;
      const double uneven = angle + 0.9 * std::sin(3.0 * angle) / 3.0;
      const double radius = (1.0 + 0.35 * std::sin(7.0 * uneven)) * (Rings - ring + 0.1) / Rings;
      mesh.points.push_back({ radius * std::cos(uneven), radius * std::sin(uneven), 0.0 });
    }
  }
  for (Id ring = 0; ring < Rings; ++ring)
  {
    for (Id k = 0; k < Around; ++k)
    {
      const Id a = ring * Around + k;
      const Id b = ring * Around + (k + 1) % Around;
      mesh.triangles.push_back({ a, b, b + Around });
      mesh.triangles.push_back({ a, b + Around, a + Around });
    }
  }
  auto data = ToPolyData(mesh);
  Id point = 0;
  AddPointArray(data, "rim", 1, [&](const Vec3&, int) { return point++ < Around ? 1.0 : 0.0; });
  for (const int depth : { 4, 6 })
  {
    auto filter = MakeFilter(data, depth);
    filter->SetInputArrayToProcess(0, 0, 0, vtkDataObject::FIELD_ASSOCIATION_POINTS, "rim");
    const std::vector<double> found = DistancesOf(filter);
    for (std::size_t i = 0; i < found.size(); ++i)
    {
      double least = 1e300;
      for (int k = 0; k < Around; ++k)
      {
        least = std::min(least, (mesh.points[i] - mesh.points[k]).norm());
      }
      ASSERT_GE(found[i], (1.0 - 1e-14) * least) << i << " at depth " << depth;
    }
  }
}

TEST(GeodesicDistanceFilter, WarnsOfSourcesFarFromTheSurface)
{
  const TriangleMesh mesh = GeodesicSphere(16);
  for (const double height : { 1.0, 1.02, 1.3, 500.0 })
  {
    TriangleMesh places;
    places.points = { mesh.points[7], height * mesh.points[100] };
    auto filter = MakeFilter(ToPolyData(mesh), 4);
    filter->SetInputDataObject(2, ToPolyData(places));
    const Messages messages(filter);
    DistancesOf(filter);
    const bool isFar = height > 1.2;
    ASSERT_EQ(messages.warnings.size(), isFar ? 1u : 0u) << height;
    EXPECT_TRUE(!isFar || messages.warnings[0].find(
                            "Sources: 1 of its 2 points is farther than 0.1") != std::string::npos)
      << height;
  }
}

vtkSmartPointer<vtkPolyData> LineBetween(const Vec3& begin, const Vec3& end)
{
  vtkNew<vtkPoints> points;
  points->SetDataTypeToDouble();
  points->InsertNextPoint(begin.data());
  points->InsertNextPoint(end.data());
  vtkNew<vtkCellArray> lines;
  lines->InsertNextCell({ 0, 1 });
  auto data = vtkSmartPointer<vtkPolyData>::New();
  data->SetPoints(points);
  data->SetLines(lines);
  return data;
}

/// Lines count between their points on the surface, to half an edge. Through space they do not.
TEST(GeodesicDistanceFilter, StartsFromAllOfALine)
{
  constexpr double Edge = 1.0 / 40;
  const TriangleMesh square = FlatRectangle(40, 40);
  for (const double slope : { 0.0, 0.3 })
  {
    const Vec3 begin(0.2, 0.5 - 0.5 * slope, 0);
    const Vec3 end(0.8, 0.5 + 0.5 * slope, 0);
    auto filter = MakeFilter(ToPolyData(square));
    filter->SetInputDataObject(2, LineBetween(begin, end));
    const std::vector<double> distance = DistancesOf(filter);
    ASSERT_EQ(distance.size(), square.points.size());
    double largest = 0.0;
    for (std::size_t k = 0; k < distance.size(); ++k)
    {
      const Vec3 along = end - begin;
      const double t = (square.points[k] - begin).dot(along) / along.squaredNorm();
      const double exact = (square.points[k] - begin - std::clamp(t, 0.0, 1.0) * along).norm();
      largest = Larger(largest, std::abs(distance[k] - exact));
    }
    EXPECT_LT(largest, 2.0 * Edge) << slope;
  }
  const TriangleMesh sphere = GeodesicSphere(16);
  auto filter = MakeFilter(ToPolyData(sphere), 4);
  filter->SetInputDataObject(2, LineBetween({ 0, 0, -1 }, { 0, 0, 1 }));
  const std::vector<double> distance = DistancesOf(filter);
  for (std::size_t k = 0; k < distance.size(); ++k)
  {
    EXPECT_TRUE(distance[k] > 0.0 || std::abs(sphere.points[k][2]) > 0.98) << k;
  }
}

/// On a mesh whose edges grow from 1e-5 to 0.07, a line passes through all points of a row.
TEST(GeodesicDistanceFilter, StartsFromAllPointsOfALineOnAGradedMesh)
{
  const TriangleMesh graded = Mapped(
    FlatRectangle(40, 40), [](const Vec3& p) { return Vec3(std::pow(p[0], 3.0), p[1], 0.0); });
  auto filter = MakeFilter(ToPolyData(graded));
  filter->SetInputDataObject(2, LineBetween({ 0, 0.5, 0 }, { 1, 0.5, 0 }));
  const std::vector<double> distance = DistancesOf(filter);
  ASSERT_EQ(distance.size(), graded.points.size());
  for (std::size_t k = 0; k < distance.size(); ++k)
  {
    EXPECT_EQ(distance[k] == 0.0, graded.points[k][1] == 0.5) << graded.points[k].transpose();
  }
}

TEST(GeodesicDistanceFilter, RefusesLinesWithAPointThatDoesNotExist)
{
  for (const vtkIdType wrong : { vtkIdType(-1), vtkIdType(7), vtkIdType(1) << 40 })
  {
    const auto line = LineBetween({ 0, 0, 1 }, { 1, 0, 0 });
    line->GetLines()->InsertNextCell({ 0, wrong });
    auto filter = MakeFilter(ToPolyData(GeodesicSphere(4)), 4);
    filter->SetInputDataObject(2, line);
    ExpectRefused(filter, "uses point " + std::to_string(wrong));
    vtkNew<vtkMultiBlockDataSet> blocks;
    blocks->SetBlock(0, ToPolyData(GeodesicSphere(4)));
    filter->SetInputDataObject(0, blocks);
    filter->BlocksAsOneOn();
    Messages messages(filter);
    filter->Update();
    ExpectOne(messages.errors, "uses point " + std::to_string(wrong));
  }
}

TEST(GeodesicDistanceFilter, WarnsOfACurveFarFromTheSurface)
{
  for (const double height : { 0.0, 0.5 })
  {
    auto filter = MakeFilter(ToPolyData(FlatRectangle(10, 10)), 4);
    filter->SignedOn();
    filter->SetInputDataObject(2, LineBetween({ 0.5, -0.1, height }, { 0.5, 1.1, height }));
    const Messages messages(filter);
    DistancesOf(filter);
    const bool warns = std::any_of(messages.warnings.begin(), messages.warnings.end(),
      [](const std::string& text)
      { return text.find("Sources: 2 of its 2 points are farther than") != std::string::npos; });
    EXPECT_EQ(warns, height > 0.2);
  }
}

TEST(GeodesicDistanceFilter, WarnsWhenMostPointsHaveNoDistance)
{
  TriangleMesh crumb;
  crumb.points = { { 3, 0, 0 }, { 3.01, 0, 0 }, { 3, 0.01, 0 } };
  crumb.triangles = { { 0, 1, 2 } };
  auto filter = MakeFilter(ToPolyData(Join(crumb, GeodesicSphere(8))), 4);
  const Messages messages(filter);
  DistancesOf(filter);
  ExpectOne(messages.warnings, "No source is chosen");
}

TEST(GeodesicDistanceFilter, HasNotConvergedWhereNoHeatArrives)
{
  // The heat reaches about 950 cells with the default Smoothing. The strip is 512 or 1024 long.
  const auto strip = ToPolyData(FlatRectangle(200, 1, 1.0, 0.002));
  for (const bool isTooLong : { false, true })
  {
    auto filter = MakeFilter(strip, isTooLong ? 10 : 9);
    filter->AddSourcePointId(0);
    const Messages messages(filter);
    EXPECT_TRUE(AllFinite(DistancesOf(filter)));
    EXPECT_EQ(FieldValue(filter->GetOutputDataObject(0), "Converged"), isTooLong ? 0.0 : 1.0);
    const auto says = [&](const char* words)
    {
      return std::any_of(messages.warnings.begin(), messages.warnings.end(),
        [words](const std::string& warning) { return warning.find(words) != std::string::npos; });
    };
    EXPECT_EQ(says("wrong far from the sources"), isTooLong);
    EXPECT_EQ(messages.warnings.empty(), !isTooLong);
  }
}

TEST(GeodesicDistanceFilter, RefusesASmoothingThatMakesTheHeatOscillate)
{
  auto filter = MakeFilter(ToPolyData(GeodesicSphere(8)), 4);
  filter->SetSmoothing(0.89);
  ExpectRefused(filter, "Smoothing is 0.89; it must be from 0.9 to 1000");
  filter = MakeFilter(ToPolyData(GeodesicSphere(8)), 4);
  filter->SetSmoothing(1e4);
  ExpectRefused(filter, "Smoothing is 10000; it must be from 0.9 to 1000");
  filter = MakeFilter(ToPolyData(GeodesicSphere(8)), 4);
  filter->SetNormalStabilization(0.01);
  ExpectRefused(filter, "Normal Stabilization is 0.01; it must be from 0.1 to 1");
}

TEST(GeodesicDistanceFilter, NamesTheNearestSource)
{
  const TriangleMesh mesh =
    Join(GeodesicSphere(12), Transform(GeodesicSphere(4), { 1, 0, 0 }, 0.0, 1.0, { 5, 0, 0 }));
  auto filter = MakeFilter(ToPolyData(mesh), 6);
  const std::vector<Id> sources = { 3, 300, 500 };
  for (const Id source : sources)
  {
    filter->AddSourcePointId(source);
  }
  DistancesOf(filter);
  EXPECT_EQ(filter->GetOutput()->GetPointData()->GetArray("NearestSource"), nullptr);
  filter->NearestSourceOn();
  DistancesOf(filter);
  EXPECT_EQ(filter->GetNumberOfRuns("Solve"), 1);
  const std::vector<double> nearest = PointValues(filter->GetOutputDataObject(0), "NearestSource");
  ASSERT_EQ(nearest.size(), mesh.points.size());
  for (std::size_t i = 0; i < nearest.size(); ++i)
  {
    if (mesh.points[i][0] > 3.0)
    {
      ASSERT_EQ(nearest[i], -1) << i;
      continue;
    }
    std::vector<double> length;
    for (const Id source : sources)
    {
      length.push_back((mesh.points[source] - mesh.points[i]).norm());
    }
    const auto expected = std::min_element(length.begin(), length.end());
    std::vector<double> sorted = length;
    std::sort(sorted.begin(), sorted.end());
    if (sorted[1] - sorted[0] > 0.15)
    {
      ASSERT_EQ(nearest[i], double(sources[expected - length.begin()])) << i;
    }
  }
}

TEST(GeodesicDistanceFilter, KeepsHierarchiesForOtherSources)
{
  auto filter = MakeFilter(ToPolyData(GeodesicSphere(12)), 4);
  DistancesOf(filter);
  filter->AddSourcePointId(7);
  EXPECT_EQ(DistancesOf(filter)[7], 0.0);
  EXPECT_EQ(filter->GetNumberOfRuns("Hierarchy"), 1);
  EXPECT_EQ(filter->GetNumberOfRuns("Solve"), 2);
}

TEST(GeodesicDistanceFilter, MarksWhatCannotBeReached)
{
  auto filter = MakeFilter(ToPolyData(TwoSheets(8, 0.5)), 4);
  filter->AddSourcePointId(0);
  const std::vector<double> values = DistancesOf(filter);
  EXPECT_FALSE(std::isnan(values.front()));
  EXPECT_TRUE(std::isnan(values.back()));
}

TEST(GeodesicDistanceFilter, GivesTheSameOnABasisAsAlone)
{
  auto data = ToPolyData(GeodesicSphere(12));
  const std::vector<double> alone = DistancesOf(MakeFilter(data));
  vtkNew<vtkConnectivityAwareBasis> basis;
  basis->SetDepth(5);
  basis->SetInputDataObject(data);
  auto filter = MakeFilter(data, 3);
  filter->SetBasisConnection(basis->GetOutputPort());
  EXPECT_EQ(DistancesOf(filter), alone);
}

TEST(GeodesicDistanceFilter, RefusesSourcesThatAreNone)
{
  const TriangleMesh mesh = GeodesicSphere(6);
  auto filter = MakeFilter(ToPolyData(mesh), 3);
  filter->AddSourcePointId(100000);
  ExpectRefused(filter, "100000");

  filter = MakeFilter(WithMask(mesh, -1), 3);
  filter->SetInputArrayToProcess(0, 0, 0, vtkDataObject::FIELD_ASSOCIATION_POINTS, "mask");
  ExpectRefused(filter, "'mask' is 0");

  filter = MakeFilter(WithMask(mesh, 0, std::nan("")), 3);
  filter->SetInputArrayToProcess(0, 0, 0, vtkDataObject::FIELD_ASSOCIATION_POINTS, "mask");
  ExpectRefused(filter, "mask");

  filter = MakeFilter(ToPolyData(mesh), 3);
  filter->SetInputDataObject(2, vtkNew<vtkPolyData>());
  ExpectRefused(filter, "no points");

  auto vectors = ToPolyData(mesh);
  AddPointArray(vectors, "v", 3, [](const Vec3& p, int c) { return p[c]; });
  filter = MakeFilter(vectors, 3);
  filter->SetInputArrayToProcess(0, 0, 0, vtkDataObject::FIELD_ASSOCIATION_POINTS, "v");
  ExpectRefused(filter, "one component");
}

namespace
{

/// Returns the line at which a surface has this height.
vtkSmartPointer<vtkPolyData> SliceAt(vtkPolyData* surface, double height)
{
  vtkNew<vtkPlane> plane;
  plane->SetOrigin(0, 0, height);
  plane->SetNormal(0, 0, 1);
  vtkNew<vtkCutter> cutter;
  cutter->SetCutFunction(plane);
  cutter->SetInputData(surface);
  cutter->Update();
  auto lines = vtkSmartPointer<vtkPolyData>::New();
  lines->ShallowCopy(cutter->GetOutput());
  return lines;
}

void ExpectLatitudes(
  const std::vector<double>& found, const TriangleMesh& mesh, double height, double tolerance)
{
  ASSERT_EQ(found.size(), mesh.points.size());
  for (std::size_t i = 0; i < found.size(); ++i)
  {
    const double latitude = std::asin(std::clamp(mesh.points[i][2], -1.0, 1.0));
    ASSERT_NEAR(found[i], std::asin(height) - latitude, tolerance) << i; // the cap is inside
  }
}

} // namespace

/// Boxes side by side, whose faces touch: all are cut, each for itself, and from a box as high as a
/// quarter the smaller part is inside.
TEST(GeodesicDistanceFilter, IsSignedOnPartsThatTouch)
{
  constexpr double Height = 0.26;
  const TriangleMesh mesh = Join(Join(Box(7), Box(5, { 1, 0.1, -0.1 }, { 2.1, 1.2, 1.3 })),
    Box(6, { -1, -0.2, 0 }, { 0, 0.7, 1 }));
  auto data = ToPolyData(mesh);
  auto filter = MakeFilter(data);
  filter->SignedOn();
  filter->SetInputDataObject(2, SliceAt(data, Height));
  const std::vector<double> found = DistancesOf(filter);
  ASSERT_EQ(found.size(), mesh.points.size());
  for (std::size_t i = 0; i < found.size(); ++i)
  {
    ASSERT_EQ(found[i] < 0.0, mesh.points[i][2] < Height) << i << ": " << found[i];
  }
}

TEST(GeodesicDistanceFilter, IsSignedOnBothSidesOfASlice)
{
  const TriangleMesh mesh = GeodesicSphere(24);
  auto data = ToPolyData(mesh);
  auto filter = MakeFilter(data, 6);
  filter->SignedOn();
  filter->SetInputDataObject(2, SliceAt(data, 0.3));
  const std::vector<double> found = DistancesOf(filter);
  ExpectLatitudes(found, mesh, 0.3, 0.02);
  // The slice lies between the points of the mesh. Points next to it are not 0.
  EXPECT_EQ(std::count(found.begin(), found.end(), 0.0), 0);

  filter->SetInputDataObject(2, SliceAt(data, 0.5));
  ExpectLatitudes(DistancesOf(filter), mesh, 0.5, 0.02);
  EXPECT_EQ(filter->GetNumberOfRuns("Curve"), 2);
  EXPECT_EQ(filter->GetNumberOfRuns("Hierarchy"), 1);
}

TEST(GeodesicDistanceFilter, IsSignedByLabelsOfPointsAndOfCells)
{
  const TriangleMesh mesh = GeodesicSphere(24);
  auto data = ToPolyData(mesh);
  AddPointArray(
    data, "points", 1, [](const Vec3& p, int) { return p[2] > 0.3 ? 7.0 : p[2] > 0.0; });
  vtkNew<vtkDoubleArray> cells;
  cells->SetName("cells");
  for (const auto& corner : mesh.triangles)
  {
    const double height =
      (mesh.points[corner[0]] + mesh.points[corner[1]] + mesh.points[corner[2]])[2] / 3.0;
    cells->InsertNextValue(height > 0.3 ? 7.0 : -2.0);
  }
  data->GetCellData()->AddArray(cells);
  constexpr double Edge = 0.09;
  auto filter = MakeFilter(data, 6);
  filter->SignedOn();
  filter->SetInsideLabel(7);
  filter->SetInputArrayToProcess(1, 0, 0, vtkDataObject::FIELD_ASSOCIATION_POINTS, "points");
  ExpectLatitudes(DistancesOf(filter), mesh, 0.3, Edge);
  filter->SetInputArrayToProcess(1, 0, 0, vtkDataObject::FIELD_ASSOCIATION_CELLS, "cells");
  ExpectLatitudes(DistancesOf(filter), mesh, 0.3, Edge);
  EXPECT_EQ(filter->GetNumberOfRuns("Hierarchy"), 1);

  filter->SetInsideLabel(3);
  ExpectRefused(filter, "'cells': no point or cell has the Inside Label 3");
  AddPointArray(data, "half", 1, [](const Vec3&, int) { return 0.5; });
  filter = MakeFilter(data, 4);
  filter->SignedOn();
  filter->SetInputArrayToProcess(1, 0, 0, vtkDataObject::FIELD_ASSOCIATION_POINTS, "half");
  ExpectRefused(filter, "integers");
}

TEST(GeodesicDistanceFilter, RefusesSignsWithoutSides)
{
  auto data = ToPolyData(GeodesicSphere(8));
  const auto make = [&]
  {
    auto filter = MakeFilter(data, 4);
    filter->SignedOn();
    return filter;
  };
  ExpectRefused(make(), "Label Array");
  auto filter = make();
  filter->AddSourcePointId(3);
  ExpectRefused(filter, "Source Point Ids");
  filter = make();
  filter->NearestSourceOn();
  ExpectRefused(filter, "Nearest Source");

  auto slice = SliceAt(data, 0.3);
  const vtkIdType last = slice->GetNumberOfCells() - 5; // a gap within a triangle closes itself
  vtkNew<vtkCellArray> open;
  for (vtkIdType cell = 0; cell < last; ++cell)
  {
    vtkNew<vtkIdList> ids;
    slice->GetCellPoints(cell, ids);
    open->InsertNextCell(ids);
  }
  slice->SetLines(open);
  filter = make();
  filter->SetInputDataObject(2, slice);
  ExpectRefused(filter, "A line ends");
  slice->GetPoints()->SetPoint(0, std::nan(""), 0, 0);
  filter = make();
  filter->SetInputDataObject(2, slice);
  ExpectRefused(filter, "NaN");
}
