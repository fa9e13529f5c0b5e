// Tests the names of results: no array of the input is lost, and a prefix keeps the results of
// several filters apart.

#include "AllFilters.h"

#include "vtkStringArray.h"

#include <gtest/gtest.h>

#include <set>

using namespace gridfem;
using namespace gridfem::testing;

namespace
{

std::set<std::string> NamesOf(vtkFieldData* data)
{
  std::set<std::string> names;
  for (int k = 0; k < data->GetNumberOfArrays(); ++k)
  {
    names.insert(data->GetArrayName(k));
  }
  return names;
}

vtkPolyData* Update(vtkSurfaceFEMAlgorithm* filter, vtkPolyData* surface)
{
  filter->SetDepth(4);
  filter->SetInputDataObject(surface);
  filter->Update();
  return vtkPolyData::SafeDownCast(filter->GetOutputDataObject(0));
}

bool HasOwnCells(vtkSurfaceFEMAlgorithm* filter)
{
  return vtkClipToOctree::SafeDownCast(filter) || vtkConnectivityAwareBasis::SafeDownCast(filter);
}

class ResultNames : public ::testing::TestWithParam<FilterCase>
{
protected:
  ResultNames() { AddArraysOfAllFilters(surface); }

  vtkSmartPointer<vtkPolyData> surface = ToPolyData(GeodesicSphere(2));
};

TEST_P(ResultNames, ArraysOfTheInputStayWhenAResultHasTheirName)
{
  auto filter = this->GetParam().make();
  if (HasOwnCells(filter))
  {
    return; // its arrays belong to other cells
  }
  const std::set<std::string> given = NamesOf(surface->GetPointData());
  const std::set<std::string> results = NamesOf(Update(filter, surface)->GetPointData());
  // An array of the user's for each result, of another kind so that it cannot be taken for it.
  for (const std::string& name : results)
  {
    if (given.count(name) == 0)
    {
      vtkNew<vtkStringArray> own;
      own->SetName(name.c_str());
      own->SetNumberOfValues(surface->GetNumberOfPoints());
      surface->GetPointData()->AddArray(own);
    }
  }
  surface->Modified();
  auto* points = Update(filter, surface)->GetPointData();
  for (const std::string& name : results)
  {
    if (given.count(name) == 0)
    {
      EXPECT_NE(points->GetArray(name.c_str()), nullptr) << name;
      auto* kept =
        vtkStringArray::SafeDownCast(points->GetAbstractArray((name + "_input").c_str()));
      EXPECT_NE(kept, nullptr) << name;
    }
  }
}

TEST_P(ResultNames, ThePrefixStandsBeforeAllResultsAndChangesNothingElse)
{
  auto filter = this->GetParam().make();
  const std::set<std::string> given = NamesOf(surface->GetPointData());
  vtkNew<vtkPolyData> plain;
  plain->DeepCopy(Update(filter, surface));
  filter->SetResultPrefix("Mine ");
  auto* named = Update(filter, surface);
  if (HasOwnCells(filter)) // other filters need the names of its arrays
  {
    EXPECT_EQ(NamesOf(named->GetCellData()), NamesOf(plain->GetCellData()));
    return;
  }
  EXPECT_EQ(named->GetPointData()->GetNumberOfArrays(), plain->GetPointData()->GetNumberOfArrays());
  for (const std::string& name : NamesOf(plain->GetPointData()))
  {
    const bool isResult = given.count(name) == 0;
    const auto found = PointValues(named, ((isResult ? "Mine " : "") + name).c_str());
    EXPECT_EQ(found.size(), PointValues(plain, name.c_str()).size()) << name;
  }
  auto* scalars = plain->GetPointData()->GetScalars();
  if (scalars && given.count(scalars->GetName()) == 0)
  {
    ASSERT_NE(named->GetPointData()->GetScalars(), nullptr);
    EXPECT_EQ(
      named->GetPointData()->GetScalars()->GetName(), "Mine " + std::string(scalars->GetName()));
  }
  filter->SetResultPrefix("");
  EXPECT_EQ(NamesOf(Update(filter, surface)->GetPointData()), NamesOf(plain->GetPointData()));
}

INSTANTIATE_TEST_SUITE_P(AllFilters, ResultNames, AllFilters(), NameOf);

} // namespace

namespace
{

/// Adds a field array with one number for each name.
void AddFields(vtkPolyData* surface, const std::vector<std::string>& names)
{
  for (const std::string& name : names)
  {
    vtkNew<vtkDoubleArray> array;
    array->SetName(name.c_str());
    array->InsertNextValue(7.0);
    surface->GetFieldData()->AddArray(array);
  }
}

} // namespace

/// All field arrays that report on a run are of this run, or there is none.
TEST_P(ResultNames, ReportsOfEarlierRunsGo)
{
  const std::vector<std::string> reports = { "Device", "Converged", "Iterations",
    "DoublePrecisionSince", "Residual", "ConvergenceFactor", "DiscretizationError",
    "LargestDiscretizationError", "AlgebraicError", "TrustedEstimate", "Misfit", "UsualCurvature",
    "LargestStretchRatio", "HeatSweeps", "LeaveOneOutRatio", "LogLikelihood", "TurnedTriangles",
    "CopiedTriangles", "UsedDepth", "Distributed" };
  const auto fresh = GetParam().make();
  Update(fresh, surface);
  AddFields(surface, reports);
  AddFields(surface, { "Own", "Eigenvalues", "ReferenceTime" });
  const auto filter = GetParam().make();
  vtkPolyData* output = Update(filter, surface);
  for (const std::string& name : reports)
  {
    for (int port = 0; port < filter->GetNumberOfOutputPorts(); ++port)
    {
      EXPECT_EQ(filter->GetOutputDataObject(port)->GetFieldData()->HasArray(name.c_str()),
        fresh->GetOutputDataObject(port)->GetFieldData()->HasArray(name.c_str()))
        << name << port;
    }
    const double value = FieldValue(output, name.c_str());
    EXPECT_TRUE(!(value == 7.0) || FieldValue(fresh->GetOutputDataObject(0), name.c_str()) == 7.0)
      << name;
  }
  if (output->GetNumberOfPolys() > 0) // paths have no arrays of the input
  {
    EXPECT_EQ(FieldValue(output, "Own"), 7.0);
    EXPECT_EQ(FieldValue(output, "ReferenceTime"), 7.0);
  }
  EXPECT_EQ(FieldValue(surface, "Misfit"), 7.0);
}

TEST(ResultNames, DynamicsWithoutAnEnergyHaveNone)
{
  auto surface = ToPolyData(GeodesicSphere(2));
  AddFields(surface, { "Energy" });
  EXPECT_FALSE(Update(MakeDynamics(), surface)->GetFieldData()->HasArray("Energy"));
}

TEST(ResultNames, SmoothingsInARowKeepAllSolutions)
{
  auto surface = ToPolyData(GeodesicSphere(2));
  AddPointArray(surface, "first", 1, Wave);
  AddPointArray(surface, "second", 1, [](const Vec3& p, int) { return p[0] * p[1]; });
  vtkNew<vtkScreenedPoisson> one;
  one->SetInputDataObject(surface);
  vtkNew<vtkScreenedPoisson> two;
  two->SetInputConnection(one->GetOutputPort());
  vtkNew<vtkScreenedPoisson> three;
  three->SetInputConnection(two->GetOutputPort());
  const auto smooth = [](vtkScreenedPoisson* filter, const char* array)
  {
    filter->SetDepth(4);
    filter->SetInputArrayToProcess(0, 0, 0, Points, array);
    filter->Update();
    return PointValues(filter->GetOutput(), "Solution");
  };
  const std::vector<double> first = smooth(one, "first");
  const std::vector<double> second = smooth(two, "second");
  EXPECT_EQ(PointValues(two->GetOutput(), "Solution_input"), first);
  smooth(three, "Solution");
  EXPECT_EQ(PointValues(three->GetOutput(), "Solution_input"), first);
  EXPECT_EQ(PointValues(three->GetOutput(), "Solution_input_2"), second);
}

TEST(ResultNames, OwnArraysNamedAsModesStay)
{
  auto surface = ToPolyData(GeodesicSphere(2));
  AddPointArray(surface, "Mode012", 1, Wave);
  vtkNew<vtkLaplaceSpectrum> spectrum;
  spectrum->SetNumberOfModes(4);
  spectrum->AllModesOn();
  auto* output = Update(spectrum, surface);
  EXPECT_EQ(PointValues(output, "Mode012"), PointValues(surface, "Mode012"));
}

TEST(ResultNames, MovedNormalsReplaceThoseOfTheInput)
{
  auto surface = ToPolyData(GeodesicSphere(2));
  auto* normals = AddPointArray(surface, "Normals", 3, [](const Vec3& p, int c) { return p[c]; });
  surface->GetPointData()->SetNormals(normals);
  vtkNew<vtkSurfaceDetail> detail;
  detail->SetResultPrefix("New ");
  auto* output = Update(detail, surface);
  EXPECT_EQ(output->GetPointData()->GetNormals(), output->GetPointData()->GetArray("Normals"));
  EXPECT_FALSE(output->GetPointData()->HasArray("Normals_input"));
  EXPECT_TRUE(output->GetPointData()->HasArray("New Displacement"));
}
