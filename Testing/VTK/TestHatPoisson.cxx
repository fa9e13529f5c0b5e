// Tests Screened Poisson on hat functions: it has a direct solver's solution, from every kind of
// array and basis.

#include "FilterSupport.h"
#include "Largest.h"
#include "Support/HatSystem.h"

#include "vtkConnectivityAwareBasis.h"
#include "vtkScreenedPoisson.h"

#include "vtkDoubleArray.h"

#include <gtest/gtest.h>

using namespace gridfem;
using namespace gridfem::testing;

namespace
{

using Poisson = vtkScreenedPoisson;

class HatPoisson : public ::testing::Test
{
protected:
  HatPoisson() : mesh(Transform(GeodesicSphere(8), { 1, 2, 0 }, 0.5, 3.0)), input(ToPolyData(mesh))
  {
    AddPointArray(input, "f", 1, Wave);
    filter->SetFunctionSpace(Poisson::HatFunctions);
    filter->SetDepth(4);
    filter->SetTolerance(1e-11);
    filter->SetParameterUnits(Poisson::World);
    filter->SetScreeningWeight(0.7);
    filter->SetInputData(input);
    filter->SetInputArrayToProcess(0, 0, 0, Points, "f");
  }

  std::vector<double> Solution()
  {
    filter->Update();
    EXPECT_EQ(FieldValue(filter->GetOutput(), "Converged"), 1);
    return PointValues(filter->GetOutput(), "Solution");
  }

  /// The solution of a direct solver for point values.
  std::vector<double> Direct(const TriangleMesh& surface, const std::vector<double>& f) const
  {
    const Eigen::MatrixXd u = SolveHatPoisson(surface, BuildHatSystem(surface), 0.7,
      Eigen::Map<const Eigen::VectorXd>(f.data(), static_cast<Eigen::Index>(f.size())));
    return { u.data(), u.data() + u.size() };
  }

  void AddCellArray(
    const char* name, int components, const std::function<double(vtkIdType, int)>& f)
  {
    vtkNew<vtkDoubleArray> array;
    array->SetName(name);
    array->SetNumberOfComponents(components);
    array->SetNumberOfTuples(input->GetNumberOfCells());
    for (vtkIdType cell = 0; cell < input->GetNumberOfCells(); ++cell)
    {
      for (int c = 0; c < components; ++c)
      {
        array->SetComponent(cell, c, f(cell, c));
      }
    }
    input->GetCellData()->AddArray(array);
  }

  TriangleMesh mesh;
  vtkSmartPointer<vtkPolyData> input;
  vtkNew<Poisson> filter;
};

TEST_F(HatPoisson, IsTheSolutionOfADirectSolverAtEveryDepth)
{
  const std::vector<double> expected = this->Direct(mesh, PointValues(input, "f"));
  for (const int depth : { 2, 4, 6 })
  {
    filter->SetDepth(depth);
    EXPECT_LT(Difference(this->Solution(), expected), 1e-8) << depth;
  }
}

TEST_F(HatPoisson, TheGridIsNoFinerThanTheMesh)
{
  const std::vector<double> expected = this->Direct(mesh, PointValues(input, "f"));
  filter->SetDepth(7);
  EXPECT_LT(Difference(this->Solution(), expected), 1e-8);
  const double enough = FieldValue(filter->GetOutput(), "UsedDepth");
  EXPECT_LT(enough, 4); // 258 points
  EXPECT_EQ(filter->GetNumberOfRuns("Space"), 1);
  filter->SetFunctionSpace(Poisson::Grid); // it has the wanted depth
  this->Solution();
  EXPECT_EQ(FieldValue(filter->GetOutput(), "UsedDepth"), 7);
  EXPECT_EQ(filter->GetNumberOfRuns("Space"), 2);
  filter->SetFunctionSpace(Poisson::HatFunctions);
  // The same depth replaces a given basis, whether or not the basis welds points.
  vtkNew<vtkConnectivityAwareBasis> basis;
  basis->SetInputData(input);
  basis->SetDepth(5);
  filter->SetBasisConnection(basis->GetOutputPort());
  EXPECT_LT(Difference(this->Solution(), expected), 1e-8);
  EXPECT_EQ(FieldValue(filter->GetOutput(), "UsedDepth"), enough);
  input->ShallowCopy(ToPolyData(Unweld(mesh)));
  AddPointArray(input, "f", 1, Wave);
  filter->SetBasisConnection(nullptr);
  filter->WeldCoincidentPointsOff();
  const std::vector<double> apart = this->Solution();
  basis->WeldCoincidentPointsOff();
  filter->SetBasisConnection(basis->GetOutputPort());
  EXPECT_LT(Difference(this->Solution(), apart), 1e-8);
  EXPECT_EQ(FieldValue(filter->GetOutput(), "UsedDepth"), enough);
  // The functions of the grid are as fine as the basis.
  filter->SetFunctionSpace(Poisson::Grid);
  this->Solution();
  EXPECT_EQ(FieldValue(filter->GetOutput(), "UsedDepth"), 5);
}

TEST_F(HatPoisson, SoupIsWeldedUnlessToldOtherwise)
{
  const TriangleMesh soup = Unweld(mesh);
  input->ShallowCopy(ToPolyData(soup));
  AddPointArray(input, "f", 1, Wave);
  EXPECT_LT(Difference(this->Solution(), this->Direct(soup, PointValues(input, "f"))), 1e-8);
  // Without welding and without gradients to keep, every triangle fits only its own values. The
  // solution then jumps between triangles.
  filter->WeldCoincidentPointsOff();
  const std::vector<double> apart = this->Solution();
  double jump = 0.0;
  const Array<Index> welded = WeldCoincidentPoints(soup.points);
  for (std::size_t point = 0; point < welded.size(); ++point)
  {
    jump = Larger(jump, std::abs(apart[point] - apart[welded[point]]));
  }
  EXPECT_GT(jump, 1e-2);
}

TEST_F(HatPoisson, ValuesOfAFunctionAndItsOwnGradientGiveItBack)
{
  const std::vector<double> f = PointValues(input, "f");
  filter->UseValueGradientOn();
  for (const double weight : { 0.0, 1e-6, 1.0, 1e4 })
  {
    filter->SetScreeningWeight(weight);
    EXPECT_LT(Difference(this->Solution(), f), 1e-8) << weight;
  }
}

TEST_F(HatPoisson, GradientsMayBeGivenAtPointsOrCells)
{
  AddPointArray(input, "xy", 2, [](const Vec3& p, int c) { return p[c]; });
  AddPointArray(input, "at points", 6, [](const Vec3&, int c) { return c % 4 == 0 ? 0.5 : 0.0; });
  this->AddCellArray("at cells", 6, [](vtkIdType, int c) { return c % 4 == 0 ? 0.5 : 0.0; });
  this->AddCellArray("two", 1, [](vtkIdType, int) { return 2.0; });
  filter->SetInputArrayToProcess(0, 0, 0, Points, "xy");
  filter->SetInputArrayToProcess(2, 0, 0, Cells, "two");
  for (const int association : { Points, Cells })
  {
    filter->SetInputArrayToProcess(
      1, 0, 0, association, association == Points ? "at points" : "at cells");
    EXPECT_LT(Difference(this->Solution(), PointValues(input, "xy")), 1e-8);
  }
}

TEST_F(HatPoisson, CellValuesCountAsConstantOnTheirTriangles)
{
  // A soup whose points carry the values of their triangle gives the same integrals.
  this->AddCellArray("cells", 1, [](vtkIdType cell, int) { return double(cell % 7); });
  filter->SetInputArrayToProcess(0, 0, 0, Cells, "cells");
  const std::vector<double> fromCells = this->Solution();
  auto soup = ToPolyData(Unweld(mesh));
  vtkNew<vtkDoubleArray> f;
  f->SetName("f");
  for (vtkIdType point = 0; point < soup->GetNumberOfPoints(); ++point)
  {
    f->InsertNextValue(double(point / 3 % 7));
  }
  soup->GetPointData()->AddArray(f);
  filter->SetInputData(soup);
  filter->SetInputArrayToProcess(0, 0, 0, Points, "f");
  const std::vector<double> fromSoup = this->Solution();
  for (std::size_t t = 0; t < mesh.triangles.size(); ++t)
  {
    for (int k = 0; k < 3; ++k)
    {
      ASSERT_NEAR(fromSoup[3 * t + k], fromCells[mesh.triangles[t][k]], 1e-8);
    }
  }
}

TEST_F(HatPoisson, TakesABasisOrTheClippedMesh)
{
  const std::vector<double> expected = this->Direct(mesh, PointValues(input, "f"));
  vtkNew<vtkConnectivityAwareBasis> basis;
  basis->SetDepth(4);
  basis->SetInputData(input);
  filter->SetBasisConnection(basis->GetOutputPort());
  EXPECT_LT(Difference(this->Solution(), expected), 1e-8);
  // On the output of the basis filter, the mesh and its hats are clipped.
  filter->SetInputConnection(1, nullptr);
  filter->SetInputConnection(0, basis->GetOutputPort());
  const std::vector<double> clipped = this->Solution();
  TriangleMesh clippedMesh;
  auto* output = vtkPolyData::SafeDownCast(basis->GetOutputDataObject(0));
  for (vtkIdType point = 0; point < output->GetNumberOfPoints(); ++point)
  {
    clippedMesh.points.emplace_back(output->GetPoint(point));
  }
  for (vtkIdType cell = 0; cell < output->GetNumberOfCells(); ++cell)
  {
    vtkIdType count;
    const vtkIdType* ids;
    output->GetCellPoints(cell, count, ids);
    clippedMesh.triangles.push_back({ ids[0], ids[1], ids[2] });
  }
  const std::vector<double> direct = this->Direct(clippedMesh, PointValues(output, "f"));
  EXPECT_LT(Difference(clipped, direct), 1e-7);
}

TEST_F(HatPoisson, PointsWithoutAFunctionHaveNoValue)
{
  mesh.points.push_back({ 9, 9, 9 });
  mesh.points.push_back({ 1, 0, 0 });
  const Id last = static_cast<Id>(mesh.points.size()) - 1;
  mesh.triangles.push_back({ last, last, 0 }); // has no area
  auto data = ToPolyData(mesh);
  AddPointArray(data, "f", 1, Wave);
  filter->SetInputData(data);
  const std::vector<double> solution = this->Solution();
  EXPECT_TRUE(std::isnan(solution[last - 1]));
  EXPECT_TRUE(std::isnan(solution[last]));
}

TEST_F(HatPoisson, AChangeRunsOnlyItsOwnStagesAndGivesTheSameAsAFreshFilter)
{
  const auto runs = [&]
  {
    std::vector<vtkIdType> counts;
    for (const char* stage : Stages)
    {
      counts.push_back(filter->GetNumberOfRuns(stage));
    }
    return counts;
  };
  using Counts = std::vector<vtkIdType>;
  filter->SetDepth(2); // the mesh has points for no finer grid
  const auto hats = this->Solution();
  EXPECT_EQ(runs(), (Counts{ 1, 1, 1, 1, 1 }));
  filter->SetScreeningWeight(5.0);
  this->Solution();
  EXPECT_EQ(runs(), (Counts{ 1, 1, 2, 1, 2 }));
  filter->SetScreeningWeight(0.7);
  filter->SetFunctionSpace(Poisson::Grid);
  const auto grid = this->Solution();
  EXPECT_EQ(runs(), (Counts{ 1, 1, 3, 2, 3 })); // the grid's system is there already
  EXPECT_GT(Difference(grid, hats), 1e-4);      // another discretization
  filter->SetFunctionSpace(Poisson::HatFunctions);
  EXPECT_EQ(this->Solution(), hats);
}

TEST_F(HatPoisson, ThreadsDoNotChangeABit)
{
  filter->ReleaseDataFlagOn(); // each run starts anew
  filter->SetNumberOfThreads(1);
  const auto one = this->Solution();
  filter->SetNumberOfThreads(2);
  EXPECT_EQ(this->Solution(), one);
}

TEST_F(HatPoisson, AMeshWithoutAreaIsRefused)
{
  TriangleMesh line;
  line.points = { { 0, 0, 0 }, { 1, 0, 0 }, { 2, 0, 0 } };
  line.triangles = { { 0, 1, 2 } };
  input->ShallowCopy(ToPolyData(line));
  AddPointArray(input, "f", 1, Wave);
  ExpectRefused(filter, "area");
}

} // namespace
