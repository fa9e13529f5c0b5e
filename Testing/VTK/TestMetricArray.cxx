// Tests MetricArray of Screened Poisson and Laplace Spectrum against surfaces that have been moved
// to a shape with that metric.

#include "Spectra.h"

#include "Grid/TriangleMesh.h"
#include "Pieces/CanDistribute.h"

#include "vtkLaplaceSpectrum.h"
#include "vtkScreenedPoisson.h"

#include "vtkFloatArray.h"

#include <gtest/gtest.h>

using namespace gridfem;
using namespace gridfem::testing;

namespace
{

constexpr int MetricIndex = 5;

Eigen::Matrix3d FrameOf(const TriangleMesh& mesh, std::size_t t)
{
  const auto& corner = mesh.triangles[t];
  const Vec3 a = mesh.points[corner[1]] - mesh.points[corner[0]];
  const Vec3 b = mesh.points[corner[2]] - mesh.points[corner[0]];
  Eigen::Matrix3d columns;
  columns << a, b, a.cross(b).normalized();
  return columns;
}

/// Adds a tensor array of 6 or 9 components.
vtkDoubleArray* AddTensors(
  vtkPolyData* data, int components, int where, const std::vector<Eigen::Matrix3d>& tensors)
{
  constexpr int Row[6] = { 0, 1, 2, 0, 1, 0 };
  constexpr int Column[6] = { 0, 1, 2, 1, 2, 2 };
  vtkNew<vtkDoubleArray> array;
  array->SetName("metric");
  array->SetNumberOfComponents(components);
  array->SetNumberOfTuples(static_cast<vtkIdType>(tensors.size()));
  for (std::size_t k = 0; k < tensors.size(); ++k)
  {
    for (int c = 0; c < components; ++c)
    {
      array->SetComponent(static_cast<vtkIdType>(k), c,
        components == 6 ? tensors[k](Row[c], Column[c]) : tensors[k](c / 3, c % 3));
    }
  }
  data->GetAttributes(where)->AddArray(array);
  return array;
}

/// Returns J^T J of the move on every triangle.
std::vector<Eigen::Matrix3d> MetricOfMove(const TriangleMesh& mesh, const TriangleMesh& moved)
{
  std::vector<Eigen::Matrix3d> tensors;
  for (std::size_t t = 0; t < mesh.triangles.size(); ++t)
  {
    const Eigen::Matrix3d map = FrameOf(moved, t) * FrameOf(mesh, t).inverse();
    tensors.emplace_back(map.transpose() * map);
  }
  return tensors;
}

std::vector<double> Solve(vtkPolyData* input, const std::function<void(vtkScreenedPoisson*)>& set,
  bool hasMetric, int where = Cells)
{
  vtkNew<vtkScreenedPoisson> filter;
  filter->SetInputData(input);
  filter->SetDepth(4);
  filter->SetTolerance(1e-13);
  filter->SetMaximumIterations(500);
  if (hasMetric)
  {
    filter->SetInputArrayToProcess(MetricIndex, 0, 0, where, "metric");
  }
  set(filter);
  filter->Update();
  EXPECT_EQ(FieldValue(filter->GetOutput(), "Converged"), 1);
  return PointValues(filter->GetOutput(), "Solution");
}

std::vector<double> Eigenvalues(
  vtkPolyData* input, bool onHats, bool hasMetric, int modes, int depth = 4)
{
  vtkNew<vtkLaplaceSpectrum> filter;
  filter->SetInputData(input);
  filter->SetDepth(depth);
  filter->SetFunctionSpace(onHats);
  filter->SetNumberOfModes(modes);
  filter->SetTolerance(1e-13);
  filter->SetMaximumIterations(500);
  if (hasMetric)
  {
    filter->SetInputArrayToProcess(MetricIndex, 0, 0, Cells, "metric");
  }
  const std::vector<double> values = gridfem::testing::Eigenvalues(filter);
  EXPECT_EQ(FieldValue(filter->GetOutput(), "Converged"), 1);
  return values;
}

/// A mesh with the metric of its move on cells, and the moved mesh, with the same values.
struct Pair
{
  explicit Pair(const TriangleMesh& mesh) : moved(Mapped(mesh, Bend))
  {
    for (vtkPolyData* data : { given.Get(), there.Get() })
    {
      const bool isGiven = data == given;
      data->DeepCopy(ToPolyData(isGiven ? mesh : moved));
      vtkNew<vtkDoubleArray> f;
      f->SetName("f");
      vtkNew<vtkDoubleArray> weight;
      weight->SetName("w");
      vtkNew<vtkDoubleArray> held;
      held->SetName("held");
      for (const Vec3& p : mesh.points)
      {
        f->InsertNextValue(Wave(p, 0));
        weight->InsertNextValue(0.5 + std::abs(p[0]));
        held->InsertNextValue(p[2] > 0.9);
      }
      for (vtkDoubleArray* array : { f.Get(), weight.Get(), held.Get() })
      {
        data->GetPointData()->AddArray(array);
      }
    }
    AddTensors(given, 6, Cells, MetricOfMove(mesh, moved));
  }

  TriangleMesh moved;
  vtkNew<vtkPolyData> given;
  vtkNew<vtkPolyData> there;
};

TEST(MetricArray, OnHatsGivesTheSolutionOfTheMovedSurface)
{
  for (const TriangleMesh& mesh : { GeodesicSphere(8), Torus(24, 12, 1.0, 0.3),
         Join(Box(3), Transform(GeodesicSphere(3), { 1, 0, 0 }, 0.2, 0.3, { 2, 0, 0 })) })
  {
    const Pair pair(mesh);
    const auto compare = [&](const char* what, const std::function<void(vtkScreenedPoisson*)>& set)
    {
      const auto all = [&](vtkScreenedPoisson* filter)
      {
        filter->SetFunctionSpace(vtkSurfaceFEMAlgorithm::HatFunctions);
        filter->SetInputArrayToProcess(0, 0, 0, Points, "f");
        set(filter);
      };
      EXPECT_LT(Difference(Solve(pair.given, all, true), Solve(pair.there, all, false)), 1e-10)
        << what;
    };
    compare("values", [](vtkScreenedPoisson*) {});
    compare("gradients", [](vtkScreenedPoisson* filter) { filter->UseValueGradientOn(); });
    compare("world units", [](vtkScreenedPoisson* filter) { filter->SetParameterUnits(0); });
    const auto setWeights = [](vtkScreenedPoisson* filter)
    { filter->SetInputArrayToProcess(3, 0, 0, Points, "w"); };
    compare("weights", setWeights);
  }
}

/// Held values are met to a tolerance of their own.
TEST(MetricArray, HoldsValuesOnTheMovedSurface)
{
  const Pair pair(GeodesicSphere(8));
  const auto set = [](vtkScreenedPoisson* filter)
  {
    filter->SetFunctionSpace(vtkSurfaceFEMAlgorithm::HatFunctions);
    filter->SetInputArrayToProcess(0, 0, 0, Points, "f");
    filter->SetInputArrayToProcess(4, 0, 0, Points, "held");
    filter->SetScreeningWeight(0.0);
  };
  EXPECT_LT(Difference(Solve(pair.given, set, true), Solve(pair.there, set, false)), 1e-6);
}

TEST(MetricArray, OnHatsGivesTheSpectrumOfTheMovedSurface)
{
  for (const TriangleMesh& mesh : { GeodesicSphere(8), Torus(24, 12, 1.0, 0.3) })
  {
    const Pair pair(mesh);
    const std::vector<double> given = Eigenvalues(pair.given, true, true, 12);
    const std::vector<double> there = Eigenvalues(pair.there, true, false, 12);
    EXPECT_LT(Difference(given, there), 1e-9 * there.back());
  }
}

/// Compares the grid of the sphere, with the metric of an ellipsoid, with hats on the ellipsoid
/// itself.
TEST(MetricArray, GivesTheSpectrumOfAnEllipsoidOnASphere)
{
  const Vec3 axes(1.0, 1.3, 0.7);
  const auto map = [&](const Vec3& p) { return Vec3(axes.cwiseProduct(p)); };
  const auto sphere = ToPolyData(GeodesicSphere(24));
  const Eigen::Matrix3d metric = axes.cwiseAbs2().asDiagonal();
  AddTensors(sphere, 9, Cells,
    std::vector<Eigen::Matrix3d>(static_cast<std::size_t>(sphere->GetNumberOfCells()), metric));
  const auto ellipsoid = ToPolyData(Mapped(GeodesicSphere(48), map));
  const std::vector<double> onSphere = Eigenvalues(sphere, false, true, 10, 5);
  const std::vector<double> expected = Eigenvalues(ellipsoid, true, false, 10, 5);
  for (std::size_t k = 1; k < expected.size(); ++k)
  {
    EXPECT_NEAR(onSphere[k], expected[k], 0.01 * expected[k]) << k;
  }
  EXPECT_GT(std::abs(expected[1] - 2.0), 0.2); // not the sphere's
}

TEST(MetricArray, OfTheIdentityChangesNothing)
{
  const TriangleMesh mesh = GeodesicSphere(8);
  for (const bool onHats : { false, true })
  {
    for (const int components : { 6, 9 })
    {
      for (const int where : { Points, Cells })
      {
        const auto input = ToPolyData(mesh);
        AddPointArray(input, "f", 2, Wave);
        AddPointArray(input, "g", 6, Wave);
        const std::size_t tuples = where == Points ? mesh.points.size() : mesh.triangles.size();
        AddTensors(input, components, where,
          std::vector<Eigen::Matrix3d>(tuples, Eigen::Matrix3d::Identity()));
        const auto set = [&](vtkScreenedPoisson* filter)
        {
          filter->SetFunctionSpace(onHats);
          filter->SetInputArrayToProcess(0, 0, 0, Points, "f");
          filter->SetInputArrayToProcess(1, 0, 0, Points, "g");
        };
        EXPECT_LT(Difference(Solve(input, set, true, where), Solve(input, set, false)), 1e-11);
      }
    }
  }
}

class RefusedMetric : public ::testing::Test
{
protected:
  RefusedMetric() : input(ToPolyData(GeodesicSphere(4)))
  {
    AddPointArray(input, "f", 1, Wave);
    poisson->SetInputArrayToProcess(0, 0, 0, Points, "f");
  }

  void ExpectRefused(int where, const std::string& reason)
  {
    poisson->SetInputArrayToProcess(MetricIndex, 0, 0, where, "metric");
    spectrum->SetInputArrayToProcess(MetricIndex, 0, 0, where, "metric");
    spectrum->SetNumberOfModes(3);
    for (vtkSurfaceFEMAlgorithm* filter : { static_cast<vtkSurfaceFEMAlgorithm*>(poisson), //
           static_cast<vtkSurfaceFEMAlgorithm*>(spectrum) })
    {
      filter->SetDepth(3);
      filter->SetInputDataObject(0, input);
      gridfem::testing::ExpectRefused(filter, reason);
    }
  }

  vtkDoubleArray* Add(int components, int where)
  {
    const vtkIdType tuples =
      where == Points ? input->GetNumberOfPoints() : input->GetNumberOfCells();
    return AddTensors(input, components, where,
      std::vector<Eigen::Matrix3d>(
        static_cast<std::size_t>(tuples), Eigen::Matrix3d(Eigen::Matrix3d::Identity())));
  }

  vtkSmartPointer<vtkPolyData> input;
  vtkNew<vtkScreenedPoisson> poisson;
  vtkNew<vtkLaplaceSpectrum> spectrum;
};

TEST_F(RefusedMetric, WithAnotherNumberOfComponents)
{
  vtkNew<vtkDoubleArray> array;
  array->SetName("metric");
  array->SetNumberOfComponents(4);
  array->SetNumberOfTuples(input->GetNumberOfPoints());
  array->Fill(1.0);
  input->GetPointData()->AddArray(array);
  this->ExpectRefused(Points, "Metric Array 'metric' has 4 components");
}

TEST_F(RefusedMetric, WithANaN)
{
  this->Add(6, Points)->SetComponent(17, 3, std::nan(""));
  this->ExpectRefused(Points, "NaN or infinite value at point 17");
}

TEST_F(RefusedMetric, NamesTheFirstPointThatIsIndefinite)
{
  vtkDoubleArray* array = this->Add(6, Points);
  for (const vtkIdType point : { 21, 40 })
  {
    array->SetComponent(point, 0, -2.0);
    array->SetComponent(point, 1, -2.0); // in any plane
  }
  this->ExpectRefused(Points, "not positive definite in the plane of the surface at point 21:");
}

TEST_F(RefusedMetric, NamesTheFirstCellThatIsZero)
{
  vtkDoubleArray* array = this->Add(9, Cells);
  for (const vtkIdType cell : { 5, 9 })
  {
    for (int c = 0; c < 9; ++c)
    {
      array->SetComponent(cell, c, 0.0);
    }
  }
  this->ExpectRefused(Cells, "at cell 5: its eigenvalues there are 0 and 0");
}

TEST_F(RefusedMetric, ThatIsNotSymmetric)
{
  this->Add(9, Cells)->SetComponent(3, 1, 0.5);
  this->ExpectRefused(Cells, "is not symmetric at cell 3");
}

TEST_F(RefusedMetric, OnlyWhereItIsUsed)
{
  input->GetPoints()->InsertNextPoint(0, 0, 5);
  AddPointArray(input, "f", 1, Wave);
  vtkDoubleArray* array = this->Add(6, Points);
  array->SetComponent(input->GetNumberOfPoints() - 1, 0, std::nan(""));
  poisson->SetInputArrayToProcess(MetricIndex, 0, 0, Points, "metric");
  poisson->SetInputDataObject(0, input);
  poisson->SetDepth(3);
  Messages messages(poisson);
  EXPECT_EQ(poisson->GetExecutive()->Update(), 1);
  EXPECT_TRUE(messages.errors.empty());
}

/// Ranks do not compute together with a Metric Array, however it is chosen.
TEST(MetricArray, MayBeChosenAsAnActiveAttribute)
{
  vtkNew<vtkScreenedPoisson> filter;
  EXPECT_FALSE(IsArrayChosen(filter, MetricIndex));
  filter->SetInputArrayToProcess(MetricIndex, 0, 0, Points, "None");
  EXPECT_FALSE(IsArrayChosen(filter, MetricIndex));
  const auto sphere = ToPolyData(GeodesicSphere(2));
  AddPointArray(sphere, "None", 6, [](const Vec3&, int) { return 1.0; });
  filter->SetInputDataObject(sphere);
  EXPECT_TRUE(IsArrayChosen(filter, MetricIndex));
  vtkNew<vtkScreenedPoisson> other;
  other->SetInputArrayToProcess(MetricIndex, 0, 0, Points, vtkDataSetAttributes::TENSORS);
  EXPECT_TRUE(IsArrayChosen(other, MetricIndex));
}

TEST(MetricArray, ThatChangesRepeatsWhatDependsOnIt)
{
  const Pair pair(GeodesicSphere(6));
  vtkNew<vtkScreenedPoisson> filter;
  filter->SetInputData(pair.given);
  filter->SetDepth(3);
  filter->SetInputArrayToProcess(0, 0, 0, Points, "f");
  filter->Update();
  const std::vector<double> own = PointValues(filter->GetOutput(), "Solution");
  filter->SetInputArrayToProcess(MetricIndex, 0, 0, Cells, "metric");
  filter->Update();
  const std::vector<double> inMetric = PointValues(filter->GetOutput(), "Solution");
  EXPECT_GT(Difference(own, inMetric), 1e-3);
  EXPECT_EQ(filter->GetNumberOfRuns("Space"), 1);
  EXPECT_EQ(filter->GetNumberOfRuns("System"), 2);
  vtkDataArray* metric = pair.given->GetCellData()->GetArray("metric");
  for (vtkIdType k = 0; k < metric->GetNumberOfTuples(); ++k)
  {
    metric->SetComponent(k, 0, 2.0 * metric->GetComponent(k, 0));
  }
  metric->Modified();
  pair.given->Modified();
  filter->Update();
  EXPECT_EQ(filter->GetNumberOfRuns("System"), 3);
  EXPECT_GT(Difference(inMetric, PointValues(filter->GetOutput(), "Solution")), 1e-3);
  filter->SetInputArrayToProcess(MetricIndex, 0, 0, Cells, "");
  filter->Update();
  EXPECT_LT(Difference(own, PointValues(filter->GetOutput(), "Solution")), 1e-3);
}

} // namespace
