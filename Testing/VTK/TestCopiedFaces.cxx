// Tests that repeated faces count once, and that the output has their number.

#include "AllFilters.h"

#include <gtest/gtest.h>

using namespace gridfem;
using namespace gridfem::testing;

namespace
{

class CopiedFaces : public ::testing::TestWithParam<FilterCase>
{
protected:
  vtkSmartPointer<vtkPolyData> Run(const TriangleMesh& mesh)
  {
    auto input = ToPolyData(mesh);
    AddArraysOfAllFilters(input);
    auto filter = this->GetParam().make();
    filter->SetDepth(4);
    filter->SetInputDataObject(input);
    filter->Update();
    return vtkPolyData::SafeDownCast(filter->GetOutputDataObject(0));
  }
};

TEST_P(CopiedFaces, AreCountedInTheFieldData)
{
  const TriangleMesh sphere = GeodesicSphere(3);
  EXPECT_FALSE(this->Run(sphere)->GetFieldData()->HasArray("CopiedTriangles"));
  TriangleMesh doubled = sphere;
  for (const std::size_t face : { 0, 7, 7, 30, 71 })
  {
    const auto& [a, b, c] = sphere.triangles[face];
    doubled.triangles.push_back({ b, a, c });
  }
  EXPECT_EQ(FieldValue(this->Run(doubled), "CopiedTriangles"), 5.0);
}

/// Points at the places of others get no result from copies elsewhere.
TEST(CopiedFacesOfCurvatures, GiveNoCurvatureToPointsWithoutFaces)
{
  TriangleMesh mesh = GeodesicSphere(3);
  const std::size_t without = mesh.points.size();
  mesh.points.push_back(mesh.points[40]);
  const auto& [a, b, c] = mesh.triangles[7];
  mesh.points.push_back(mesh.points[a]);
  mesh.triangles.push_back(
    { static_cast<Id>(without + 1), b, c }); // a copy with a point of its own
  vtkNew<vtkPrincipalCurvatures> filter;
  filter->SetInputDataObject(ToPolyData(mesh));
  filter->Update();
  const std::vector<double> mean = PointValues(filter->GetOutput(), "MeanCurvature");
  ASSERT_EQ(mean.size(), without + 2);
  EXPECT_TRUE(std::isnan(mean[without]));
  EXPECT_EQ(mean[without + 1], mean[a]);
}

INSTANTIATE_TEST_SUITE_P(AllFilters, CopiedFaces, AllFilters(), NameOf);

} // namespace
