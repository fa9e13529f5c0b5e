// Geodesic Distance as a user of VTK sees it.
#include "FilterSupport.h"

#include "vtkConnectivityAwareBasis.h"
#include "vtkGeodesicDistance.h"

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

/// 1 at one point.
vtkSmartPointer<vtkPolyData> WithMask(const TriangleMesh& mesh, Id source, double other = 0.0)
{
  auto data = ToPolyData(mesh);
  Id point = 0;
  AddPointArray(data, "mask", 1, [&](const Vec3&, int) { return point++ == source ? 1.0 : other; });
  return data;
}

void ExpectRefused(vtkGeodesicDistance* filter, const std::string& reason)
{
  const Messages messages(filter);
  EXPECT_EQ(filter->GetExecutive()->Update(), 0);
  ASSERT_EQ(messages.errors.size(), 1u);
  EXPECT_NE(messages.errors[0].find(reason), std::string::npos) << messages.errors[0];
  EXPECT_TRUE(IsEmptyData(filter->GetOutputDataObject(0)));
}

} // namespace

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

TEST(GeodesicDistanceFilter, StartsAtTheFirstPointWhereNothingIsChosen)
{
  const TriangleMesh mesh = GeodesicSphere(8);
  auto filter = MakeFilter(ToPolyData(mesh), 4);
  EXPECT_EQ(DistancesOf(filter)[mesh.triangles[0][0]], 0.0);
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
  filter->SetUnreachable(vtkGeodesicDistance::Infinity);
  DistancesOf(filter);
  EXPECT_EQ(filter->GetNumberOfRuns("Solve"), 2);
}

TEST(GeodesicDistanceFilter, MarksWhatCannotBeReached)
{
  auto filter = MakeFilter(ToPolyData(TwoSheets(8, 0.5)), 4);
  filter->AddSourcePointId(0);
  std::vector<double> values = DistancesOf(filter);
  EXPECT_FALSE(std::isnan(values.front()));
  EXPECT_TRUE(std::isnan(values.back()));
  filter->SetUnreachable(vtkGeodesicDistance::Infinity);
  values = DistancesOf(filter);
  EXPECT_TRUE(std::isinf(values.back()));
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
