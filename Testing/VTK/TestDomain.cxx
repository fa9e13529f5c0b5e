// Tests the DomainArray of every filter. The results equal the results on the surface with the rest
// cut away, and the output keeps all points, cells and arrays of the input.

#include "AllFilters.h"
#include "Selections.h"

#include "vtkExtractSelection.h"
#include "vtkUnsignedCharArray.h"

#include <gtest/gtest.h>

#include <limits>
#include <map>

using namespace gridfem;
using namespace gridfem::testing;

namespace
{

constexpr int DomainIndex = 9;
constexpr int PointsThenCells = vtkDataObject::FIELD_ASSOCIATION_POINTS_THEN_CELLS;

bool IsInside(const TriangleMesh& mesh, std::size_t triangle)
{
  double height = 0.0;
  for (const Id corner : mesh.triangles[triangle])
  {
    height += mesh.points[corner][2];
  }
  return height > -0.6;
}

vtkSmartPointer<vtkPolyData> WithArrays(const TriangleMesh& mesh)
{
  auto surface = ToPolyData(mesh);
  AddArraysOfAllFilters(surface);
  return surface;
}

/// Returns the point arrays that a filter has added, the number of points, and the lengths of
/// paths. NaN is the largest number here, so that equal arrays compare equal.
std::map<std::string, std::vector<double>> Results(vtkPolyData* input, vtkAlgorithm* filter)
{
  auto* output = vtkPolyData::SafeDownCast(filter->GetOutputDataObject(0));
  auto* points = output->GetPointData();
  std::map<std::string, std::vector<double>> results;
  results["number of points"] = { double(output->GetNumberOfPoints()) };
  for (int k = 0; k < points->GetNumberOfArrays(); ++k)
  {
    const std::string name = points->GetArrayName(k);
    if (!input->GetPointData()->HasArray(name.c_str()))
    {
      std::vector<double> values = Values(points->GetArray(k));
      std::replace_if(
        values.begin(), values.end(), [](double value) { return std::isnan(value); },
        std::numeric_limits<double>::max());
      results[name] = std::move(values);
    }
  }
  if (vtkGeodesicPaths::SafeDownCast(filter))
  {
    auto* lines = vtkPolyData::SafeDownCast(filter->GetOutputDataObject(1));
    results["lengths"] = Values(lines->GetCellData()->GetArray("Length"));
  }
  return results;
}

class Domain : public ::testing::TestWithParam<FilterCase>
{
protected:
  Domain()
  {
    vtkNew<vtkDoubleArray> cells;
    cells->SetName("region");
    TriangleMesh part = sphere;
    part.triangles.clear();
    std::vector<char> isInside(sphere.points.size(), 0);
    for (std::size_t t = 0; t < sphere.triangles.size(); ++t)
    {
      const bool isKept = IsInside(sphere, t);
      // NaN is outside, and so is 0.
      cells->InsertNextValue(isKept ? 1.0 + double(t) : t % 2 ? 0.0 : std::nan(""));
      if (isKept)
      {
        part.triangles.push_back(sphere.triangles[t]);
      }
    }
    whole = WithArrays(sphere);
    whole->GetCellData()->AddArray(cells);
    cut = WithArrays(part);
  }

  vtkSmartPointer<vtkSurfaceFEMAlgorithm> Run(vtkPolyData* surface, bool within)
  {
    auto filter = this->GetParam().make();
    filter->SetDepth(4);
    if (auto* farthest = vtkFarthestPoints::SafeDownCast(filter))
    {
      farthest->SetFirstPointId(top);
    }
    if (auto* distance = vtkGeodesicDistance::SafeDownCast(filter))
    {
      distance->AddSourcePointId(top);
    }
    if (auto* path = vtkGeodesicPaths::SafeDownCast(filter))
    {
      path->AddSourcePointId(top);
    }
    if (within)
    {
      filter->SetInputArrayToProcess(DomainIndex, 0, 0, Cells, "region");
    }
    filter->SetInputDataObject(surface);
    filter->Update();
    return filter;
  }

  const TriangleMesh sphere = GeodesicSphere(3);
  const Id top = std::max_element(sphere.points.begin(), sphere.points.end(),
                   [](const Vec3& a, const Vec3& b) { return a[2] < b[2]; }) -
                 sphere.points.begin();
  vtkSmartPointer<vtkPolyData> whole;
  vtkSmartPointer<vtkPolyData> cut;
};

TEST_P(Domain, GivesTheResultsOfTheCutSurface)
{
  const auto within = this->Run(whole, true);
  const auto alone = this->Run(cut, false);
  const auto expected = Results(cut, alone);
  EXPECT_EQ(Results(whole, within), expected);
  auto* output = vtkPolyData::SafeDownCast(within->GetOutputDataObject(0));
  auto* outputOfCut = vtkPolyData::SafeDownCast(alone->GetOutputDataObject(0));
  ASSERT_GT(output->GetNumberOfPoints(), 0);
  EXPECT_EQ(Values(output->GetPoints()->GetData()), Values(outputOfCut->GetPoints()->GetData()));
  EXPECT_FALSE(output->GetCellData()->HasArray(vtkDataSetAttributes::GhostArrayName()));
  // The filters below have cells of their own.
  if (!vtkClipToOctree::SafeDownCast(within) && !vtkConnectivityAwareBasis::SafeDownCast(within))
  {
    EXPECT_EQ(output->GetNumberOfCells(), whole->GetNumberOfCells());
    EXPECT_TRUE(output->GetCellData()->HasArray("region"));
  }
}

TEST_P(Domain, HasNoResultsOnCellsOutside)
{
  auto filter = this->Run(whole, true);
  auto* output = vtkPolyData::SafeDownCast(filter->GetOutputDataObject(0));
  const bool hasOwnCells = output->GetPolys() != whole->GetPolys();
  vtkCellData* cells = output->GetCellData();
  for (int k = 0; k < cells->GetNumberOfArrays() && !hasOwnCells; ++k)
  {
    vtkDataArray* array = cells->GetArray(k);
    if (whole->GetCellData()->HasArray(array->GetName()))
    {
      continue;
    }
    const bool isReal = array->GetDataType() == VTK_DOUBLE;
    vtkDataArray* region = whole->GetCellData()->GetArray("region");
    for (vtkIdType cell = 0; cell < array->GetNumberOfTuples(); ++cell)
    {
      const bool isInside = region->GetComponent(cell, 0) >= 1.0;
      const double value = array->GetComponent(cell, 0);
      EXPECT_TRUE(isInside || (isReal ? std::isnan(value) : value == -1.0)) << array->GetName();
      EXPECT_TRUE(!isInside || !isReal || std::isfinite(value)) << array->GetName();
    }
  }
}

TEST_P(Domain, KeepsTheGhostFlagsOfTheInput)
{
  vtkNew<vtkUnsignedCharArray> ghosts;
  ghosts->SetName(vtkDataSetAttributes::GhostArrayName());
  ghosts->SetNumberOfTuples(whole->GetNumberOfCells());
  ghosts->FillValue(0);
  ghosts->SetValue(0, vtkDataSetAttributes::HIDDENCELL);
  whole->GetCellData()->AddArray(ghosts);
  const auto filter = this->Run(whole, true);
  auto* output = vtkPolyData::SafeDownCast(filter->GetOutputDataObject(0));
  vtkDataArray* kept = output->GetCellData()->GetArray(vtkDataSetAttributes::GhostArrayName());
  ASSERT_NE(kept, nullptr);
  if (output->GetNumberOfCells() == whole->GetNumberOfCells())
  {
    EXPECT_EQ(Values(kept), Values(ghosts));
  }
}

TEST_P(Domain, OfPointsTakesTheCellsWithAllPointsInside)
{
  std::vector<char> isInside(sphere.points.size(), 1);
  for (std::size_t t = 0; t < sphere.triangles.size(); ++t)
  {
    for (const Id corner : sphere.triangles[t])
    {
      isInside[corner] = isInside[corner] && IsInside(sphere, t);
    }
  }
  vtkNew<vtkDoubleArray> ofPoints;
  ofPoints->SetName("region");
  for (const char inside : isInside)
  {
    ofPoints->InsertNextValue(inside);
  }
  auto* ofCells = vtkDoubleArray::SafeDownCast(whole->GetCellData()->GetArray("region"));
  for (std::size_t t = 0; t < sphere.triangles.size(); ++t)
  {
    const auto& corners = sphere.triangles[t];
    ofCells->SetValue(static_cast<vtkIdType>(t),
      isInside[corners[0]] && isInside[corners[1]] && isInside[corners[2]] ? 1.0 : 0.0);
  }
  const auto onCells = Results(whole, this->Run(whole, true));
  whole->GetPointData()->AddArray(ofPoints);
  auto filter = this->GetParam().make();
  const auto named = this->Run(whole, false);
  named->SetInputArrayToProcess(DomainIndex, 0, 0, Points, "region");
  named->Update();
  EXPECT_EQ(Results(whole, named), onCells);
}

/// Extract Selection with PreserveTopology keeps the surface and adds the array vtkInsidedness.
TEST_P(Domain, TakesASelectionThatKeepsTheSurface)
{
  const auto isHigh = [&](Id point) { return sphere.points[point][2] > -0.3; };
  for (const int fieldType : { vtkSelectionNode::CELL, vtkSelectionNode::POINT })
  {
    auto* region = whole->GetCellData()->GetArray("region");
    std::vector<vtkIdType> ids;
    for (std::size_t t = 0; t < sphere.triangles.size(); ++t)
    {
      const auto& corners = sphere.triangles[t];
      const bool isInside = std::all_of(corners.begin(), corners.end(), isHigh);
      region->SetComponent(static_cast<vtkIdType>(t), 0, isInside ? 1.0 : 0.0);
      if (isInside && fieldType == vtkSelectionNode::CELL)
      {
        ids.push_back(static_cast<vtkIdType>(t));
      }
    }
    for (Id point = 0; point < static_cast<Id>(sphere.points.size()); ++point)
    {
      if (isHigh(point) && fieldType == vtkSelectionNode::POINT)
      {
        ids.push_back(point);
      }
    }
    vtkNew<vtkExtractSelection> extract;
    extract->PreserveTopologyOn();
    extract->SetInputData(0, whole);
    extract->SetInputData(1, SelectIds(fieldType, ids));
    extract->Update();
    auto* marked = vtkPolyData::SafeDownCast(extract->GetOutputDataObject(0));
    ASSERT_NE(marked, nullptr);
    const auto expected = Results(whole, this->Run(whole, true));
    const auto filter = this->Run(marked, false);
    filter->SetInputArrayToProcess(DomainIndex, 0, 0, PointsThenCells, "vtkInsidedness");
    filter->Update();
    EXPECT_EQ(Results(marked, filter), expected) << fieldType;
  }
}

TEST_P(Domain, AChangeOfTheRegionIsSeen)
{
  const auto filter = this->Run(whole, true);
  auto* region = whole->GetCellData()->GetArray("region");
  const auto before = Results(whole, filter);
  std::vector<double> old = Values(region);
  region->Fill(1.0);
  region->Modified();
  whole->Modified();
  filter->Update();
  EXPECT_NE(Results(whole, filter), before);
  for (vtkIdType cell = 0; cell < region->GetNumberOfTuples(); ++cell)
  {
    region->SetComponent(cell, 0, old[cell]);
  }
  region->Modified();
  whole->Modified();
  filter->Update();
  EXPECT_EQ(Results(whole, filter), before);
}

TEST_P(Domain, OfNothingAndOfSeveralComponentsIsRefused)
{
  const auto filter = this->Run(whole, false);
  whole->GetCellData()->GetArray("region")->Fill(0.0);
  filter->SetInputArrayToProcess(DomainIndex, 0, 0, Cells, "region");
  ExpectRefused(filter, "Domain Array");
  AddPointArray(whole, "three", 3, Wave);
  whole->Modified();
  filter->SetInputArrayToProcess(DomainIndex, 0, 0, Points, "three");
  ExpectRefused(filter, "one component");
}

INSTANTIATE_TEST_SUITE_P(AllFilters, Domain, AllFilters(), NameOf);

} // namespace
