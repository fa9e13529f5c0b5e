// Farthest Points as a user of VTK sees it.
#include "FilterSupport.h"

#include "vtkFarthestPoints.h"
#include "vtkGeodesicDistance.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

using namespace gridfem;
using namespace gridfem::testing;

namespace
{

vtkSmartPointer<vtkFarthestPoints> Spread(vtkPolyData* surface, int points)
{
  auto filter = vtkSmartPointer<vtkFarthestPoints>::New();
  filter->SetInputData(surface);
  filter->SetDepth(4);
  filter->SetNumberOfPoints(points);
  return filter;
}

std::vector<double> Ids(vtkFarthestPoints* filter)
{
  return Values(filter->GetOutput()->GetFieldData()->GetArray("FarthestPoints"));
}

} // namespace

/// Compares with Geodesic Distance: the first point is its source, and the second is at its largest
/// value. Each point is the nearest to itself.
TEST(FarthestPoints, FollowsTheGeodesicDistance)
{
  const auto surface = ToPolyData(Torus(40, 16, 2.0, 0.6));
  vtkNew<vtkGeodesicDistance> distance;
  distance->SetInputData(surface);
  distance->SetDepth(4);
  distance->AddSourcePointId(5);
  distance->Update();
  const std::vector<double> exact = PointValues(distance->GetOutput(), "Distance");
  const auto filter = Spread(surface, 1);
  filter->SetFirstPointId(5);
  filter->Update();
  EXPECT_EQ(PointValues(filter->GetOutput(), "Distance"), exact);
  const auto largest = std::max_element(exact.begin(), exact.end());
  EXPECT_EQ(FieldValue(filter->GetOutput(), "Radius"), *largest);
  filter->SetNumberOfPoints(2);
  filter->Update();
  EXPECT_EQ(filter->GetNumberOfRuns("Solve"), 2);
  EXPECT_EQ(filter->GetNumberOfRuns("Hierarchy"), 1);
  const std::vector<double> points = Ids(filter);
  EXPECT_EQ(points, (std::vector<double>{ 5.0, double(largest - exact.begin()) }));
  const std::vector<double> nearest = PointValues(filter->GetOutput(), "NearestPoint");
  for (const double point : points)
  {
    EXPECT_EQ(nearest.at(static_cast<std::size_t>(point)), point);
  }
  filter->SetFirstPointId(static_cast<int>(surface->GetNumberOfPoints()));
  ExpectRefused(filter);
}

TEST(FarthestPoints, FewerPointsThanComponentsLeaveNaNAndAWarning)
{
  const TriangleMesh sphere = GeodesicSphere(4);
  const auto filter =
    Spread(ToPolyData(Join(sphere, Transform(sphere, { 0, 0, 1 }, 0.0, 1.0, { 4, 0, 0 }))), 1);
  const Messages messages(filter);
  filter->Update();
  ExpectOne(messages.warnings, "50 % of the points");
  const std::vector<double> distance = PointValues(filter->GetOutput(), "Distance");
  const std::vector<double> nearest = PointValues(filter->GetOutput(), "NearestPoint");
  double largest = 0.0;
  for (std::size_t point = 0; point < distance.size(); ++point)
  {
    EXPECT_EQ(std::isnan(distance[point]), nearest[point] == -1.0);
    largest = std::fmax(largest, distance[point]);
  }
  EXPECT_EQ(FieldValue(filter->GetOutput(), "Radius"), largest);
  EXPECT_LT(largest, 4.0);
}
