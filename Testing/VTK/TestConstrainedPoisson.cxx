// Tests Screened Poisson with unknown, weighted and exactly held values.
#include "FilterSupport.h"
#include "Largest.h"

#include "vtkScreenedPoisson.h"

#include <gtest/gtest.h>

#include <limits>

using namespace gridfem;
using namespace gridfem::testing;

namespace
{

constexpr double NaN = std::numeric_limits<double>::quiet_NaN();

/// Whether a point lies in one of 26 caps around the axes, edges and corners of a cube. The caps
/// cover a fifth of a sphere.
bool IsInHole(const Vec3& p)
{
  const double cosine = 1.0 - 2.0 * 0.2 / 26.0;
  for (int k = 0; k < 27; ++k)
  {
    const Vec3 middle(k % 3 - 1, k / 3 % 3 - 1, k / 9 - 1);
    if (middle.norm() > 0.0 && middle.normalized().dot(p.normalized()) > cosine)
    {
      return true;
    }
  }
  return false;
}

class ConstrainedPoisson : public ::testing::TestWithParam<int>
{
protected:
  ConstrainedPoisson()
    : input(ToPolyData(Transform(GeodesicSphere(40), { 1, 2, 3 }, 0.1))), messages(filter)
  {
    AddPointArray(input, "f", 2, [](const Vec3& p, int c) { return 5.0 + p[c]; });
    AddPointArray(
      input, "holes", 2, [](const Vec3& p, int c) { return IsInHole(p) ? NaN : 5.0 + p[c]; });
    filter->SetFunctionSpace(this->GetParam());
    filter->SetDepth(5);
    filter->SetNormalStabilization(1e-2);
    filter->SetScreeningWeight(1e4);
    filter->SetInputData(input);
    filter->SetInputArrayToProcess(0, 0, 0, Points, "f");
  }

  std::vector<double> Solution()
  {
    filter->Update();
    return PointValues(filter->GetOutput(), "Solution");
  }

  void ExpectRefused(const std::string& reason)
  {
    filter->Modified();
    gridfem::testing::ExpectRefused(filter, reason);
  }

  vtkSmartPointer<vtkPolyData> input;
  vtkNew<vtkScreenedPoisson> filter;
  Messages messages;
};

} // namespace

TEST_P(ConstrainedPoisson, FillsHolesOfASmoothField)
{
  filter->SetInputArrayToProcess(0, 0, 0, Points, "holes");
  filter->FillUnknownOn();
  const auto filled = this->Solution();
  // The range is 2. In a hole of radius r the error is harmonic: r² / 4 of the Laplacian 2 x.
  EXPECT_LT(Difference(filled, PointValues(input, "f")), 0.02 * 2.0);
  EXPECT_TRUE(messages.warnings.empty()) << messages.warnings[0];
  EXPECT_EQ(FieldValue(filter->GetOutput(), "Converged"), 1);
}

TEST_P(ConstrainedPoisson, UnknownIsAWeightOfZeroOnTheTriangles)
{
  filter->SetInputArrayToProcess(0, 0, 0, Points, "holes");
  filter->FillUnknownOn();
  const auto filled = this->Solution();
  vtkNew<vtkDoubleArray> weight;
  weight->SetName("weight");
  for (vtkIdType cell = 0; cell < input->GetNumberOfCells(); ++cell)
  {
    vtkIdType size;
    const vtkIdType* corner;
    input->GetCellPoints(cell, size, corner);
    weight->InsertNextValue(1.0);
    for (int k = 0; k < 3; ++k)
    {
      if (IsInHole(Vec3(input->GetPoint(corner[k]))))
      {
        weight->SetValue(cell, 0.0);
      }
    }
  }
  input->GetCellData()->AddArray(weight);
  filter->FillUnknownOff();
  filter->SetInputArrayToProcess(0, 0, 0, Points, "f");
  filter->SetInputArrayToProcess(3, 0, 0, Cells, "weight");
  EXPECT_LT(Difference(this->Solution(), filled), 1e-9);
}

TEST_P(ConstrainedPoisson, PointValuesOfWeightZeroMayBeAnything)
{
  filter->SetInputArrayToProcess(0, 0, 0, Points, "holes");
  filter->FillUnknownOn();
  const auto filled = this->Solution();
  filter->FillUnknownOff();
  AddPointArray(input, "weight", 1, [](const Vec3& p, int) { return IsInHole(p) ? 0.0 : 1.0; });
  filter->SetInputArrayToProcess(3, 0, 0, Points, "weight");
  for (const double filler : { NaN, 0.0, -9999.0, 1e30 })
  {
    AddPointArray(
      input, "filled", 2, [=](const Vec3& p, int c) { return IsInHole(p) ? filler : 5.0 + p[c]; });
    filter->SetInputArrayToProcess(0, 0, 0, Points, "filled");
    EXPECT_LT(Difference(this->Solution(), filled), 1e-9) << filler;
    EXPECT_TRUE(messages.warnings.empty() && messages.errors.empty());
  }
  AddPointArray(input, "all", 1, [](const Vec3&, int) { return 1.0; });
  filter->SetInputArrayToProcess(0, 0, 0, Points, "holes");
  filter->SetInputArrayToProcess(3, 0, 0, Points, "all");
  this->ExpectRefused("where Value Weight Array 'all' is not 0");
}

TEST_P(ConstrainedPoisson, WeightsOfOneChangeNothing)
{
  filter->SetTolerance(1e-9);
  filter->SetScreeningWeight(100.0);
  const auto plain = this->Solution();
  AddPointArray(input, "weight", 1, [](const Vec3&, int) { return 1.0; });
  filter->SetInputArrayToProcess(3, 0, 0, Points, "weight");
  const auto weighted = this->Solution();
  EXPECT_LT(Difference(weighted, plain), 1e-7);
  // The factor on the weights is the same as on the screening weight.
  AddPointArray(input, "ten", 1, [](const Vec3&, int) { return 10.0; });
  filter->SetScreeningWeight(10.0);
  filter->SetInputArrayToProcess(3, 0, 0, Points, "ten");
  EXPECT_LT(Difference(this->Solution(), plain), 1e-7);
}

TEST_P(ConstrainedPoisson, HoldsValuesExactly)
{
  filter->SetScreeningWeight(10.0); // smooths much
  AddPointArray(input, "mask", 1, [](const Vec3& p, int) { return std::abs(p[2]) > 0.98; });
  const auto free = this->Solution();
  filter->SetInputArrayToProcess(4, 0, 0, Points, "mask");
  const auto held = this->Solution();
  const auto given = PointValues(input, "f");
  const auto mask = PointValues(input, "mask");
  double before = 0.0;
  double after = 0.0;
  for (std::size_t k = 0; k < given.size(); ++k)
  {
    before = Larger(before, mask[k / 2] * std::abs(free[k] - given[k]));
    after = Larger(after, mask[k / 2] * std::abs(held[k] - given[k]));
  }
  EXPECT_GT(before, 0.02);
  // On the grid there are more points in a cell than functions.
  EXPECT_LT(after, this->GetParam() == vtkSurfaceFEMAlgorithm::Grid ? 2e-3 : 2e-6);
  EXPECT_NEAR(FieldValue(filter->GetOutput(), "Misfit"), after, 1e-9);
}

/// Solves Laplace's equation on a disc: x² - y² from its values at the boundary alone.
TEST_P(ConstrainedPoisson, SolvesForValuesHeldAtTheBoundary)
{
  for (const int fineness : { 8, 40 }) // edges longer than a cell, and shorter
  {
    const auto data = ToPolyData(Transform(Disk(fineness), { 1, 2, 3 }, 0.0, 1.5));
    const auto exact = [](const Vec3& p) { return 4.0 + p[0] * p[0] - p[1] * p[1]; };
    AddPointArray(
      data, "f", 1, [&](const Vec3& p, int) { return p.norm() > 1.5 - 1e-9 ? exact(p) : 100.0; });
    AddPointArray(data, "exact", 1, [&](const Vec3& p, int) { return exact(p); });
    filter->SetInputData(data);
    filter->SetInputArrayToProcess(0, 0, 0, Points, "f");
    filter->SetScreeningWeight(0.0);
    filter->SetTolerance(1e-8);
    filter->BoundaryValuesOn();
    messages.warnings.clear();
    const auto found = this->Solution();
    EXPECT_TRUE(messages.warnings.empty()) << messages.warnings[0];
    EXPECT_LT(Difference(found, PointValues(data, "exact")), fineness == 8 ? 0.04 : 0.025);
  }
}

/// On a tube along z, flow enters at the bottom and leaves at the top. With screening, λ u = Δu
/// holds instead, and the flux is the flux of cosh.
TEST_P(ConstrainedPoisson, TakesAFluxAcrossTheBoundary)
{
  TriangleMesh tube = Mapped(FlatRectangle(80, 20, 2 * M_PI, 2.0),
    [](const Vec3& p) { return Vec3(std::cos(p[0]), std::sin(p[0]), p[1]); });
  for (Id row = 0; row <= 20; ++row)
  {
    tube.points[81 * row + 80] = tube.points[81 * row]; // welded
  }
  const auto data = ToPolyData(Transform(tube, { 1, 2, 0 }, 0.4));
  const Eigen::AngleAxisd turn(0.4, Vec3(1, 2, 0).normalized());
  const auto height = [&](const Vec3& p) { return (turn.inverse() * p)[2]; };
  const auto isEnd = [&](const Vec3& p, double z) { return std::abs(height(p) - z) < 1e-9; };
  AddPointArray(data, "flux", 1,
    [&](const Vec3& p, int) { return isEnd(p, 0.0)   ? -3.0
                                     : isEnd(p, 2.0) ? 3.0
                                                     : 77.0; });
  AddPointArray(data, "slope", 1,
    [&](const Vec3& p, int) { return isEnd(p, 2.0) ? 2.0 * std::sinh(4.0) : 0.0; });
  AddPointArray(data, "ten", 1, [&](const Vec3&, int) { return 10.0; });
  AddPointArray(data, "zero", 1, [&](const Vec3&, int) { return 0.0; });
  AddPointArray(data, "linear", 1, [&](const Vec3& p, int) { return 7.0 + 3.0 * height(p); });
  AddPointArray(data, "cosh", 1, [&](const Vec3& p, int) { return std::cosh(2.0 * height(p)); });
  filter->SetInputData(data);
  filter->SetTolerance(1e-8);
  filter->SetParameterUnits(vtkSurfaceFEMAlgorithm::World);
  filter->SetScreeningWeight(0.0);
  filter->SetInputArrayToProcess(0, 0, 0, Points, "ten");
  filter->SetInputArrayToProcess(6, 0, 0, Points, "flux");
  EXPECT_LT(Difference(this->Solution(), PointValues(data, "linear")), 0.02);
  ASSERT_EQ(messages.warnings.size(), 1u); // nothing holds it, and the flux is balanced
  EXPECT_EQ(messages.warnings[0].find("flux"), std::string::npos) << messages.warnings[0];

  filter->SetScreeningWeight(4.0);
  filter->SetInputArrayToProcess(0, 0, 0, Points, "zero");
  filter->SetInputArrayToProcess(6, 0, 0, Points, "slope");
  messages.warnings.clear();
  EXPECT_LT(Difference(this->Solution(), PointValues(data, "cosh")), 0.02 * std::cosh(4.0));
  EXPECT_TRUE(messages.warnings.empty()) << messages.warnings[0];

  filter->SetScreeningWeight(0.0);
  this->Solution();
  ExpectOne(messages.warnings, "does not add up to 0");
}

TEST_P(ConstrainedPoisson, SaysThatAClosedSurfaceHasNoBoundary)
{
  filter->SetTolerance(1e-9);
  const auto plain = this->Solution();
  filter->BoundaryValuesOn();
  EXPECT_LT(Difference(this->Solution(), plain), 1e-7);
  ExpectOne(messages.warnings, "no boundary");
  AddPointArray(input, "one", 1, [](const Vec3&, int) { return 1.0; });
  filter->SetInputArrayToProcess(6, 0, 0, Points, "one");
  this->ExpectRefused("as many components as the values");
}

TEST_P(ConstrainedPoisson, SaysWhereNothingIsKnown)
{
  const TriangleMesh one = GeodesicSphere(6);
  const auto two = ToPolyData(Join(one, Transform(one, { 1, 0, 0 }, 0.0, 1.0, { 5, 0, 0 })));
  AddPointArray(two, "f", 1, [](const Vec3& p, int) { return p[0] < 2.0 ? p[1] : NaN; });
  AddPointArray(two, "g", 1, [](const Vec3& p, int) { return p[0] < 2.0 ? p[1] : 3.0; });
  AddPointArray(two, "weight", 1, [](const Vec3& p, int) { return p[0] < 2.0 ? 1.0 : 0.0; });
  filter->SetInputData(two);
  filter->FillUnknownOn();
  const auto unknown = this->Solution();
  ExpectOne(messages.warnings, "1 of 2 connected");
  filter->SetInputArrayToProcess(0, 0, 0, Points, "g");
  filter->SetInputArrayToProcess(3, 0, 0, Points, "weight");
  const auto mean = this->Solution();
  for (std::size_t k = 0; k < unknown.size(); ++k)
  {
    const bool isFirst = k < one.points.size();
    ASSERT_EQ(std::isnan(unknown[k]), !isFirst);
    ASSERT_NEAR(mean[k], isFirst ? unknown[k] : 3.0, 1e-9);
  }
}

TEST_P(ConstrainedPoisson, RefusesWhatItCannotUse)
{
  filter->SetInputArrayToProcess(0, 0, 0, Points, "holes");
  this->ExpectRefused("NaN"); // FillUnknown is off
  filter->FillUnknownOn();
  AddPointArray(input, "negative", 1, [](const Vec3& p, int) { return p[0]; });
  filter->SetInputArrayToProcess(3, 0, 0, Points, "negative");
  this->ExpectRefused("0 or more");
  filter->SetInputArrayToProcess(3, 0, 0, Points, "f");
  this->ExpectRefused("one component");
  filter->SetInputArrayToProcess(3, 0, 0, Points, "None");
  filter->SetInputArrayToProcess(4, 0, 0, Points, "f");
  this->ExpectRefused("one component");
  AddPointArray(input, "zero", 1, [](const Vec3&, int) { return 0.0; });
  filter->SetInputArrayToProcess(4, 0, 0, Points, "zero");
  this->ExpectRefused("masked");
}

INSTANTIATE_TEST_SUITE_P(BothSpaces, ConstrainedPoisson,
  ::testing::Values(int(vtkSurfaceFEMAlgorithm::Grid), int(vtkSurfaceFEMAlgorithm::HatFunctions)));
