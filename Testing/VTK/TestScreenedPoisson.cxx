// Tests Screened Poisson: values, gradients, units, tables, precision, stages, refusals.

#include "FilterSupport.h"

#include "Grid/TriangleMesh.h"

#include "vtkScreenedPoisson.h"

#include "vtkCharArray.h"
#include "vtkFloatArray.h"
#include "vtkIntArray.h"
#include "vtkStringArray.h"
#include "vtkTable.h"

#include <gtest/gtest.h>

#include <complex>

using namespace gridfem;
using namespace gridfem::testing;

namespace
{

using Poisson = vtkScreenedPoisson;

class ScreenedPoisson : public ::testing::Test
{
protected:
  ScreenedPoisson() : input(ToPolyData(GeodesicSphere(8))), messages(filter)
  {
    AddPointArray(input, "f", 1, Wave);
    filter->SetDepth(4);
    filter->SetInputData(input);
    filter->SetInputArrayToProcess(0, 0, 0, Points, "f");
  }

  std::vector<double> Solution()
  {
    filter->Update();
    return PointValues(filter->GetOutput(), "Solution");
  }

  std::vector<vtkIdType> Runs()
  {
    std::vector<vtkIdType> runs;
    for (const char* stage : Stages)
    {
      runs.push_back(filter->GetNumberOfRuns(stage));
    }
    return runs;
  }

  vtkSmartPointer<vtkPolyData> input;
  vtkNew<Poisson> filter;
  Messages messages;
};

using Counts = std::vector<vtkIdType>;

TEST_F(ScreenedPoisson, CoordinatesAreReproducedByTheirOwnGradient)
{
  filter->SetInputArrayToProcess(0, 0, 0, Points, "");
  filter->UseValueGradientOn();
  filter->SetTolerance(1e-8);
  std::vector<double> expected;
  for (vtkIdType k = 0; k < input->GetNumberOfPoints(); ++k)
  {
    const Vec3 p(input->GetPoint(k));
    expected.insert(expected.end(), p.data(), p.data() + 3);
  }
  for (const double stabilization : { 1e-12, 1e-2, 1.0 })
  {
    filter->SetNormalStabilization(stabilization);
    for (const double weight : { 0.0, 1e-6, 1.0, 1e6 })
    {
      filter->SetScreeningWeight(weight);
      // The coordinates lie in the space. The remaining error is the solver's tolerance.
      EXPECT_LT(Difference(this->Solution(), expected), 1e-6) << weight << " " << stabilization;
      EXPECT_EQ(FieldValue(filter->GetOutput(), "Converged"), 1) << weight;
    }
  }
}

TEST_F(ScreenedPoisson, AGivenGradientCountsAsTheValuesOwn)
{
  // f = the first two coordinates, g = their gradients in space.
  AddPointArray(input, "xy", 2, [](const Vec3& p, int c) { return p[c]; });
  AddPointArray(input, "g", 6, [](const Vec3&, int c) { return c == 0 || c == 4 ? 1.0 : 0.0; });
  filter->SetInputArrayToProcess(0, 0, 0, Points, "xy");
  filter->SetInputArrayToProcess(1, 0, 0, Points, "g");
  filter->SetScreeningWeight(1.0);
  const auto solution = this->Solution();
  EXPECT_LT(Difference(solution, PointValues(input, "xy")), 1e-6);
  EXPECT_EQ(filter->GetOutput()->GetPointData()->GetArray("Solution")->GetNumberOfComponents(), 2);
  // A scale and a scale array are multiplied.
  filter->SetGradientScale(0.5);
  AddPointArray(input, "two", 1, [](const Vec3&, int) { return 2.0; });
  filter->SetInputArrayToProcess(2, 0, 0, Points, "two");
  EXPECT_LT(Difference(this->Solution(), solution), 1e-6);
}

TEST_F(ScreenedPoisson, GradientsMayBeCellData)
{
  vtkNew<vtkFloatArray> g;
  g->SetName("g");
  g->SetNumberOfComponents(3);
  for (vtkIdType k = 0; k < input->GetNumberOfCells(); ++k)
  {
    g->InsertNextTuple3(0, 0, 1);
  }
  input->GetCellData()->AddArray(g);
  AddPointArray(input, "z", 1, [](const Vec3& p, int) { return p[2]; });
  filter->SetInputArrayToProcess(0, 0, 0, Points, "z");
  filter->SetInputArrayToProcess(1, 0, 0, Cells, "g");
  EXPECT_LT(Difference(this->Solution(), PointValues(input, "z")), 1e-6);
}

TEST_F(ScreenedPoisson, SmoothingLowersTheWaveAndSharpeningRaisesIt)
{
  AddPointArray(input, "z", 1, [](const Vec3& p, int) { return p[2]; });
  filter->SetInputArrayToProcess(0, 0, 0, Points, "z");
  filter->SetScreeningWeight(10.0);
  const auto largest = [&](double scale)
  {
    filter->SetUseValueGradient(true);
    filter->SetGradientScale(scale);
    const auto solution = this->Solution();
    return *std::max_element(solution.begin(), solution.end());
  };
  // z is an eigenfunction of the unit sphere: -Δz = 2z. The area is 4π, so w = 10 / (4π) in world
  // units, and u = z (w + 2 s) / (w + 2). Depth 4 resolves it to about a percent.
  const double w = 10.0 / (4 * 3.14159265358979);
  for (const double scale : { 0.0, 0.5, 2.0 })
  {
    EXPECT_NEAR(largest(scale), (w + 2 * scale) / (w + 2), 0.03) << scale;
  }
}

TEST_F(ScreenedPoisson, UnitsOfTheWeight)
{
  const double area = SurfaceArea(GeodesicSphere(8));
  filter->ReleaseDataFlagOn(); // each run starts anew, so that all make the same iterations
  filter->SetTolerance(1e-8);
  filter->SetParameterUnits(Poisson::World);
  filter->SetScreeningWeight(3.0);
  const auto world = this->Solution();
  filter->SetParameterUnits(Poisson::UnitArea);
  filter->SetScreeningWeight(3.0 * area);
  EXPECT_LT(Difference(this->Solution(), world), 1e-12);
  filter->SetParameterUnits(Poisson::UnitCube);
  filter->SetScreeningWeight(3.0 * 4.0); // the box has side 2
  EXPECT_LT(Difference(this->Solution(), world), 1e-12);
}

TEST_F(ScreenedPoisson, CellValuesGiveAPointSolution)
{
  vtkNew<vtkIntArray> seven;
  seven->SetName("seven");
  for (vtkIdType k = 0; k < input->GetNumberOfCells(); ++k)
  {
    seven->InsertNextValue(7);
  }
  input->GetCellData()->AddArray(seven);
  filter->SetInputArrayToProcess(0, 0, 0, Cells, "seven");
  const auto solution = this->Solution();
  EXPECT_LT(Difference(solution, std::vector<double>(input->GetNumberOfPoints(), 7.0)), 1e-9);
}

TEST_F(ScreenedPoisson, OutputKeepsTheInputAndItsPrecision)
{
  input->GetPointData()->GetArray("f")->SetComponentName(0, "height");
  filter->Update();
  EXPECT_EQ(filter->GetOutput()->GetPoints(), input->GetPoints());
  EXPECT_EQ(filter->GetOutput()->GetPolys(), input->GetPolys());
  EXPECT_EQ(
    filter->GetOutput()->GetPointData()->GetArray("f"), input->GetPointData()->GetArray("f"));
  EXPECT_STREQ(
    filter->GetOutput()->GetPointData()->GetArray("Solution")->GetComponentName(0), "height");

  vtkNew<vtkFloatArray> single;
  single->SetName("single");
  vtkNew<vtkCharArray> character;
  character->SetName("character");
  for (vtkIdType k = 0; k < input->GetNumberOfPoints(); ++k)
  {
    single->InsertNextValue(float(k % 5));
    character->InsertNextValue(char(k % 5));
  }
  input->GetPointData()->AddArray(single);
  input->GetPointData()->AddArray(character);
  const auto typeFor = [&](const char* name)
  {
    filter->SetInputArrayToProcess(0, 0, 0, Points, name);
    filter->Update();
    return filter->GetOutput()->GetPointData()->GetArray("Solution")->GetDataType();
  };
  EXPECT_EQ(typeFor("f"), VTK_DOUBLE);
  EXPECT_EQ(typeFor("single"), VTK_FLOAT);
  EXPECT_EQ(typeFor("character"), VTK_DOUBLE);
}

TEST_F(ScreenedPoisson, PointsWithoutPolygonsHaveNoValue)
{
  TriangleMesh mesh = GeodesicSphere(8);
  mesh.points.push_back({ 9, 9, 9 });
  auto data = ToPolyData(mesh);
  AddPointArray(data, "f", 1, Wave);
  filter->SetInputData(data);
  EXPECT_TRUE(std::isnan(this->Solution().back()));
}

TEST_F(ScreenedPoisson, WithoutValuesThePointsMoveToTheSolution)
{
  input->GetPoints()->InsertNextPoint(5, 6, 7); // no polygon uses it: it stays
  AddPointArray(input, "f", 1, Wave);
  AddPointArray(input, "normal", 3, [](const Vec3& p, int c) { return p[c]; });
  input->GetPointData()->SetActiveNormals("normal");
  filter->SetInputArrayToProcess(0, 0, 0, Points, "None");
  filter->SetParameterUnits(Poisson::World);
  filter->SetScreeningWeight(3.0); // w / (w + 2) of a sphere
  const auto solution = this->Solution();
  vtkPolyData* output = filter->GetOutput();
  const vtkIdType last = input->GetNumberOfPoints() - 1;
  EXPECT_EQ(Vec3(output->GetPoint(last)), Vec3(5, 6, 7));
  EXPECT_STREQ(output->GetPointData()->GetScalars()->GetName(), "NormalDisplacement");
  vtkDataArray* displacement = output->GetPointData()->GetArray("Displacement");
  for (vtkIdType k = 0; k < last; ++k)
  {
    const Vec3 before(input->GetPoint(k));
    const Vec3 after(output->GetPoint(k));
    EXPECT_EQ(after, Vec3(&solution[3 * k]));
    EXPECT_LT((after - 0.6 * before).norm(), 0.03);
    EXPECT_LT((Vec3(displacement->GetTuple3(k)) - (after - before)).norm(), 1e-12);
    EXPECT_GT(Vec3(output->GetPointData()->GetNormals()->GetTuple3(k)).dot(before), 0.9);
  }
}

TEST_F(ScreenedPoisson, EndsByAccuracyAndSaysHowGoodItIs)
{
  filter->SetDepth(5);
  filter->Update();
  vtkPolyData* output = filter->GetOutput();
  EXPECT_EQ(FieldValue(output, "Converged"), 1);
  EXPECT_LE(FieldValue(output, "Iterations"), 5);
  const double ofSpace = FieldValue(output, "DiscretizationError");
  EXPECT_GT(ofSpace, 0.0);
  EXPECT_LE(FieldValue(output, "AlgebraicError"), 0.1 * ofSpace);
  EXPECT_GT(FieldValue(output, "LargestDiscretizationError"), 0.0);
  const auto left = Column(filter, "AlgebraicError");
  const auto logs = Column(filter, "Log10DiscretizationError");
  EXPECT_LT(left.back(), left.front());
  EXPECT_NEAR(logs.front(), std::log10(ofSpace), 1e-12);

  const double loose = FieldValue(output, "Iterations");
  filter->SetAccuracy(1e-4);
  filter->Update();
  EXPECT_GT(FieldValue(filter->GetOutput(), "Iterations"), 0);
  EXPECT_LE(FieldValue(filter->GetOutput(), "AlgebraicError"), 1.1e-4 * ofSpace);
  filter->SetTolerance(1e-10);
  filter->SetAccuracy(1.0); // has no effect then
  filter->Update();
  auto* longer = vtkTable::SafeDownCast(filter->GetOutputDataObject(1));
  EXPECT_GT(longer->GetNumberOfRows(), loose + 1);
}

TEST_F(ScreenedPoisson, TheDepthFollowsFromTheWantedError)
{
  input = ToPolyData(GeodesicSphere(48));
  AddPointArray(input, "f", 1,
    [](const Vec3& p, int) { return std::pow(std::complex<double>(p[0], p[1]), 12).real(); });
  filter->SetInputData(input);
  filter->SetParameterUnits(Poisson::World);
  filter->SetScreeningWeight(156.0); // half of degree 12 is left
  filter->SetDepth(7);
  const auto fine = this->Solution(); // its error is a tenth of the wanted one
  const auto solve = [&](double wanted)
  {
    filter->SetWantedError(wanted);
    const auto solution = this->Solution();
    double difference = 0.0;
    double size = 0.0;
    for (std::size_t k = 0; k < solution.size(); ++k)
    {
      difference += std::pow(solution[k] - fine[k], 2);
      size += std::pow(fine[k], 2);
    }
    EXPECT_EQ(FieldValue(filter->GetOutput(), "Converged"), 1);
    EXPECT_LE(FieldValue(filter->GetOutput(), "DiscretizationError"), wanted);
    EXPECT_LT(std::sqrt(difference / size), 1.5 * wanted);
    return FieldValue(filter->GetOutput(), "UsedDepth");
  };
  EXPECT_EQ(solve(0.02), 5);
  EXPECT_EQ(solve(0.004), 6);
  EXPECT_EQ(solve(0.02), 5);
  EXPECT_TRUE(messages.warnings.empty());

  const auto runs = this->Runs();
  input->Modified();
  filter->Update();
  EXPECT_EQ(filter->GetNumberOfRuns("Hierarchy"), runs[2]) << "what was found is kept";
}

TEST_F(ScreenedPoisson, AWantedErrorThatNoDepthGivesWarns)
{
  filter->SetWantedError(1e-6);
  filter->SetFunctionSpace(Poisson::HatFunctions);
  this->Solution();
  ExpectOne(messages.warnings, "subdivide");
  EXPECT_EQ(FieldValue(filter->GetOutput(), "Converged"), 0);
}

TEST_F(ScreenedPoisson, AWantedErrorIsReachedWhereValuesAreHeld)
{
  AddPointArray(input, "held", 1, [](const Vec3& p, int) { return p[2] > 0.5 ? 1.0 : 0.0; });
  filter->SetInputArrayToProcess(4, 0, 0, Points, "held");
  filter->SetWantedError(0.03);
  const std::vector<double> solution = this->Solution();
  EXPECT_TRUE(messages.warnings.empty());
  EXPECT_EQ(FieldValue(filter->GetOutput(), "Converged"), 1);
  EXPECT_LE(FieldValue(filter->GetOutput(), "DiscretizationError"), 0.03);
  EXPECT_GE(FieldValue(filter->GetOutput(), "UsedDepth"), 5);
  EXPECT_LT(FieldValue(filter->GetOutput(), "Misfit"), 1e-5);
}

TEST_F(ScreenedPoisson, NotAccurateInTimeWarnsWithTheErrors)
{
  filter->SetMaximumIterations(1);
  filter->Update();
  EXPECT_EQ(FieldValue(filter->GetOutput(), "Converged"), 0);
  ExpectOne(messages.warnings, "function space");
}

TEST_F(ScreenedPoisson, TheTableHasARowPerIteration)
{
  filter->SetTolerance(1e-6);
  filter->Update();
  auto* table = vtkTable::SafeDownCast(filter->GetOutputDataObject(1));
  EXPECT_EQ(table->GetNumberOfRows(), FieldValue(filter->GetOutput(), "Iterations") + 1);
  for (const char* name : { "Iteration", "EnergyResidual", "Residual", "ConvergenceFactor" })
  {
    ASSERT_TRUE(table->GetColumnByName(name)) << name;
  }
  const auto energy = Column(filter, "EnergyResidual");
  const auto residual = Column(filter, "Residual");
  const auto logs = Column(filter, "Log10Residual");
  EXPECT_LE(energy.back(), filter->GetTolerance());
  const auto factor = Column(filter, "ConvergenceFactor");
  ASSERT_GE(energy.size(), 2u);
  EXPECT_EQ(factor.front(), 1.0);
  double product = 1.0;
  for (std::size_t i = 1; i < energy.size(); ++i)
  {
    EXPECT_DOUBLE_EQ(factor[i], energy[i] / energy[i - 1]);
    product *= factor[i];
  }
  EXPECT_NEAR(FieldValue(filter->GetOutput(), "ConvergenceFactor"),
    std::pow(product, 1.0 / double(energy.size() - 1)), 1e-12);
  EXPECT_EQ(residual.back(), FieldValue(filter->GetOutput(), "Residual"));
  EXPECT_NEAR(logs.back(), std::log10(residual.back()), 1e-12);
}

TEST_F(ScreenedPoisson, NotConvergedWarnsAndKeepsTheResult)
{
  filter->SetMaximumIterations(1);
  filter->SetTolerance(1e-14);
  EXPECT_EQ(filter->GetExecutive()->Update(), 1);
  EXPECT_TRUE(messages.errors.empty());
  ExpectOne(messages.warnings, "Maximum Iterations allows no more", "residual");
  EXPECT_EQ(FieldValue(filter->GetOutput(), "Converged"), 0);
  EXPECT_FALSE(PointValues(filter->GetOutput(), "Solution").empty());
}

TEST_F(ScreenedPoisson, ToleranceBelowRoundingEndsAtAStandstillAndSaysSo)
{
  filter->SetTolerance(1e-100);
  filter->SetMaximumIterations(5000);
  filter->Update();
  ExpectOne(messages.warnings, "stagnated");
  EXPECT_EQ(FieldValue(filter->GetOutput(), "Converged"), 0);
  EXPECT_LT(FieldValue(filter->GetOutput(), "Iterations"), 5000);
  EXPECT_GT(FieldValue(filter->GetOutput(), "DoublePrecisionSince"), 0);
  EXPECT_LT(FieldValue(filter->GetOutput(), "DoublePrecisionSince"),
    FieldValue(filter->GetOutput(), "Iterations"));
}

TEST_F(ScreenedPoisson, ThreadsDoNotChangeABit)
{
  filter->ReleaseDataFlagOn(); // each run starts anew
  filter->SetNumberOfThreads(1);
  const auto one = this->Solution();
  filter->SetNumberOfThreads(2);
  EXPECT_EQ(this->Solution(), one);
}

TEST_F(ScreenedPoisson, AChangeRunsOnlyItsOwnStages)
{
  filter->Update();
  EXPECT_EQ(this->Runs(), (Counts{ 1, 1, 1, 1, 1 }));
  filter->SetScreeningWeight(5.0);
  filter->Update();
  EXPECT_EQ(this->Runs(), (Counts{ 1, 1, 2, 1, 2 }));
  AddPointArray(input, "f", 1, [](const Vec3& p, int) { return p[0]; });
  input->Modified();
  filter->Update();
  EXPECT_EQ(this->Runs(), (Counts{ 1, 1, 2, 2, 3 }));
  vtkNew<vtkPolyData> copy; // a hop through ParaView makes a new data object
  copy->ShallowCopy(input);
  filter->SetInputData(copy);
  filter->Update();
  EXPECT_EQ(this->Runs(), (Counts{ 1, 1, 2, 2, 3 }));
  filter->SetTolerance(1e-7);
  filter->Update();
  EXPECT_EQ(this->Runs(), (Counts{ 1, 1, 2, 2, 4 }));
  filter->SetQuadratureDegree(4);
  filter->Update();
  EXPECT_EQ(this->Runs(), (Counts{ 1, 2, 3, 3, 5 }));
  filter->SetDepth(3);
  filter->Update();
  EXPECT_EQ(this->Runs(), (Counts{ 2, 3, 4, 4, 6 }));
  input->GetPoints()->SetPoint(0, 1.1, 0, 0);
  input->GetPoints()->Modified();
  filter->Update();
  EXPECT_EQ(this->Runs(), (Counts{ 3, 4, 5, 5, 7 }));
}

TEST_F(ScreenedPoisson, AnUpdatedWeightGivesTheSameAsAFreshFilter)
{
  filter->Update();
  filter->SetScreeningWeight(5.0);
  const auto updated = this->Solution();
  vtkNew<Poisson> fresh;
  fresh->SetDepth(4);
  fresh->SetScreeningWeight(5.0);
  fresh->SetInputData(input);
  fresh->SetInputArrayToProcess(0, 0, 0, Points, "f");
  fresh->Update();
  // The fresh solve starts from nested iteration, the other from its last solution.
  EXPECT_LT(Difference(updated, PointValues(fresh->GetOutput(), "Solution")), 1e-5);
}

TEST_F(ScreenedPoisson, AMissingArrayIsRefusedByName)
{
  filter->SetInputArrayToProcess(0, 0, 0, Points, "missing");
  ExpectRefused(filter, "'missing' does not exist");
}

TEST_F(ScreenedPoisson, AnArrayOfWrongLengthIsRefusedByName)
{
  vtkNew<vtkFloatArray> shortArray;
  shortArray->SetName("short");
  shortArray->InsertNextValue(1.0f);
  input->GetPointData()->AddArray(shortArray);
  filter->SetInputArrayToProcess(0, 0, 0, Points, "short");
  ExpectRefused(filter, "'short' has 1 values");
}

TEST_F(ScreenedPoisson, NaNInTheArrayIsRefusedByPoint)
{
  input->GetPointData()->GetArray("f")->SetComponent(17, 0, std::nan(""));
  ExpectRefused(filter, "'f' has a NaN or infinite value at point 17");
}

TEST_F(ScreenedPoisson, NumbersOutOfRangeAreRefused)
{
  filter->SetScreeningWeight(1e299);
  ExpectRefused(filter, "too large");
}

TEST_F(ScreenedPoisson, ValuesOfAnySizeAreSolved)
{
  filter->SetTolerance(1e-8);
  const std::vector<double> expected = this->Solution();
  for (const double size : { 1e-300, 1e-170, 1e170, 1e290 })
  {
    AddPointArray(input, "scaled", 1, [size](const Vec3& p, int c) { return size * Wave(p, c); });
    filter->SetInputArrayToProcess(0, 0, 0, Points, "scaled");
    std::vector<double> solution = this->Solution();
    EXPECT_EQ(FieldValue(filter->GetOutput(), "Converged"), 1) << size;
    std::transform(solution.begin(), solution.end(), solution.begin(),
      [size](double value) { return value / size; });
    EXPECT_LT(Difference(solution, expected), 1e-6) << size;
  }
}

TEST_F(ScreenedPoisson, TextIsRefused)
{
  vtkNew<vtkStringArray> text;
  text->SetName("text");
  text->SetNumberOfValues(input->GetNumberOfPoints());
  input->GetPointData()->AddArray(text);
  filter->SetInputArrayToProcess(0, 0, 0, Points, "text");
  ExpectRefused(filter, "'text' is not numeric");
}

TEST_F(ScreenedPoisson, AGradientOfWrongSizeIsRefused)
{
  filter->SetInputArrayToProcess(1, 0, 0, Points, "f");
  ExpectRefused(filter, "Gradient Array 'f' has 1 components");
}

TEST_F(ScreenedPoisson, ValueGradientOfCellDataIsRefused)
{
  vtkNew<vtkIntArray> label;
  label->SetName("label");
  label->SetNumberOfValues(input->GetNumberOfCells());
  label->FillValue(1);
  input->GetCellData()->AddArray(label);
  filter->SetInputArrayToProcess(0, 0, 0, Cells, "label");
  filter->UseValueGradientOn();
  ExpectRefused(filter, "'label' is a cell array");
}

TEST_F(ScreenedPoisson, ItRunsAfterARefusal)
{
  filter->SetInputArrayToProcess(0, 0, 0, Points, "missing");
  ExpectRefused(filter, "missing");
  filter->SetInputArrayToProcess(0, 0, 0, Points, "f");
  EXPECT_FALSE(this->Solution().empty());
}

} // namespace
