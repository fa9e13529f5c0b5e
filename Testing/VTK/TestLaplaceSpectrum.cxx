// Tests Laplace Spectrum: eigenvalues in world units, normalized modes, time steps, caching.

#include "Largest.h"
#include "Spectra.h"

#include "Grid/TriangleMesh.h"

#include "vtkConnectivityAwareBasis.h"

#include "vtkCallbackCommand.h"
#include "vtkInformation.h"
#include "vtkMultiBlockDataSet.h"
#include "vtkPartitionedDataSet.h"
#include "vtkPartitionedDataSetCollection.h"
#include "vtkStreamingDemandDrivenPipeline.h"
#include "vtkTable.h"

#include <gtest/gtest.h>

#include <algorithm>

using namespace gridfem;
using namespace gridfem::testing;

namespace
{

using Spectrum = vtkLaplaceSpectrum;

class LaplaceSpectrum : public ::testing::Test
{
protected:
  LaplaceSpectrum() : messages(filter)
  {
    filter->SetDepth(4);
    filter->SetNumberOfModes(9);
    filter->SetInputData(ToPolyData(GeodesicSphere(8)));
  }

  std::vector<double> ModeAt(double time)
  {
    filter->UpdateTimeStep(time);
    return PointValues(filter->GetOutput(), "Mode");
  }

  vtkNew<Spectrum> filter;
  Messages messages;
};

TEST_F(LaplaceSpectrum, TablesOfAPartitionedCollectionAreAMultiBlock)
{
  const vtkSmartPointer<vtkPolyData> ball = ToPolyData(GeodesicSphere(8));
  vtkNew<vtkPartitionedDataSetCollection> collection;
  collection->SetPartition(0, 0, ball);
  collection->SetPartition(0, 1, ToPolyData(GeodesicSphere(6, 0.5)));
  collection->SetPartition(2, 0, ToPolyData(GeodesicSphere(4, 2.0))); // nothing between
  collection->GetMetaData(0u)->Set(vtkCompositeDataSet::NAME(), "small");
  collection->GetMetaData(2u)->Set(vtkCompositeDataSet::NAME(), "large");
  filter->SetInputDataObject(collection);
  const auto expect = [&](int rows)
  {
    EXPECT_TRUE(vtkPartitionedDataSetCollection::SafeDownCast(filter->GetOutputDataObject(0)));
    auto* tables = vtkMultiBlockDataSet::SafeDownCast(filter->GetOutputDataObject(1));
    ASSERT_TRUE(tables);
    ASSERT_EQ(tables->GetNumberOfBlocks(), 3u);
    const char* const names[] = { "small 0", "small 1", "large" };
    for (unsigned int block = 0; block < 3; ++block)
    {
      EXPECT_STREQ(tables->GetMetaData(block)->Get(vtkCompositeDataSet::NAME()), names[block]);
      auto* table = vtkTable::SafeDownCast(tables->GetBlock(block));
      ASSERT_TRUE(table);
      EXPECT_EQ(table->GetNumberOfRows(), rows);
      const double radius = block == 0 ? 1.0 : block == 1 ? 0.5 : 2.0;
      EXPECT_NEAR(table->GetValueByName(1, "Eigenvalue").ToDouble() * radius * radius, 2.0, 0.3);
    }
  };
  filter->Update();
  expect(9);
  const vtkIdType runs = filter->GetNumberOfRuns("Solve");
  filter->Update();
  EXPECT_EQ(filter->GetNumberOfRuns("Solve"), runs);
  expect(9);
  filter->SetNumberOfModes(4); // the pipeline fills its own again
  filter->Update();
  EXPECT_GT(filter->GetNumberOfRuns("Solve"), runs);
  expect(4);
  filter->SetInputDataObject(ball);
  filter->Update();
  EXPECT_TRUE(vtkTable::SafeDownCast(filter->GetOutputDataObject(1)));
  filter->SetInputDataObject(collection);
  filter->Update();
  expect(4);
  EXPECT_TRUE(messages.errors.empty());
}

TEST_F(LaplaceSpectrum, ASphereHasItsEigenvalues)
{
  const auto eigenvalues = Eigenvalues(filter);
  ASSERT_EQ(eigenvalues.size(), 9u);
  EXPECT_NEAR(eigenvalues[0], 0.0, 1e-8);
  for (int k = 1; k < 9; ++k)
  {
    // l (l + 1); depth 4 and 512 flat triangles are good for a few percent
    const double exact = k < 4 ? 2.0 : 6.0;
    EXPECT_NEAR(eigenvalues[k], exact, 0.05 * exact);
  }
  EXPECT_EQ(FieldValue(filter->GetOutput(), "Converged"), 1);
}

TEST_F(LaplaceSpectrum, EigenvaluesScaleWithTheSquaredLength)
{
  const auto plain = Eigenvalues(filter);
  filter->SetInputData(ToPolyData(GeodesicSphere(8, 10.0)));
  const auto scaled = Eigenvalues(filter);
  for (int k = 1; k < 9; ++k)
  {
    EXPECT_NEAR(100 * scaled[k], plain[k], 1e-6);
  }
}

TEST_F(LaplaceSpectrum, ModesHaveUnitNormInWorldUnits)
{
  for (const double radius : { 1.0, 10.0 })
  {
    const TriangleMesh mesh = GeodesicSphere(8, radius);
    filter->SetInputData(ToPolyData(mesh));
    const double constant = 1.0 / std::sqrt(SurfaceArea(mesh));
    filter->SetMode(0);
    for (const double value : this->ModeAt(0))
    {
      EXPECT_NEAR(std::abs(value), constant, 1e-6 * constant);
    }
    // ∫ φ², by one point per vertex of a nearly uniform mesh
    filter->SetMode(-1);
    const auto mode = this->ModeAt(2);
    double sum = 0.0;
    for (const double value : mode)
    {
      sum += value * value / double(mode.size());
    }
    EXPECT_NEAR(sum * SurfaceArea(mesh), 1.0, 0.15);
  }
}

TEST_F(LaplaceSpectrum, AModeThatDoesNotExistIsRefused)
{
  filter->SetMode(9);
  ExpectRefused(filter, "Mode 9 does not exist");
}

TEST_F(LaplaceSpectrum, TheTableListsTheModes)
{
  const auto eigenvalues = Eigenvalues(filter);
  auto* table = vtkTable::SafeDownCast(filter->GetOutputDataObject(1));
  ASSERT_EQ(table->GetNumberOfRows(), 9);
  EXPECT_EQ(Column(filter, "Eigenvalue"), eigenvalues);
  EXPECT_EQ(table->GetColumnByName("Mode")->GetVariantValue(4).ToInt(), 4);
  for (const double residual : Column(filter, "Residual"))
  {
    EXPECT_LE(residual, 1e-3); // its square is at most the tolerance
  }
}

TEST_F(LaplaceSpectrum, MoreModesThanExistWarnsAndGivesAll)
{
  filter->SetDepth(2);
  filter->SetNumberOfModes(100000);
  const auto eigenvalues = Eigenvalues(filter);
  EXPECT_TRUE(messages.errors.empty());
  ASSERT_FALSE(messages.warnings.empty());
  EXPECT_NE(messages.warnings[0].find("modes exist"), std::string::npos);
  EXPECT_GT(eigenvalues.size(), 20u);
  EXPECT_LT(eigenvalues.size(), 1000u);
}

TEST_F(LaplaceSpectrum, MoreModesThanMemoryHoldsAreRefusedWithTheEstimate)
{
  filter->SetInputData(ToPolyData(GeodesicSphere(16)));
  filter->SetDepth(7); // about 80,000 functions: their square takes 300 GB
  filter->SetNumberOfModes(100000);
  ExpectRefused(filter, "Number Of Modes 100000");
}

TEST_F(LaplaceSpectrum, ManyModesAnnounceWhatTheyCostAndCanBeAborted)
{
  filter->SetInputData(ToPolyData(GeodesicSphere(16)));
  filter->SetDepth(6); // about 20,000 functions
  filter->SetNumberOfModes(15000);
  filter->SetNumberOfThreads(1);
  vtkNew<vtkCallbackCommand> abort;
  abort->SetCallback(
    [](vtkObject* caller, unsigned long, void*, void*)
    {
      auto* algorithm = static_cast<vtkAlgorithm*>(caller);
      const char* text = algorithm->GetProgressText(); // tells the cost when the solve begins
      algorithm->SetAbortExecute(text && std::string(text).find("hours") != std::string::npos);
    });
  filter->AddObserver(vtkCommand::ProgressEvent, abort);
  filter->Update();
  EXPECT_EQ(filter->GetOutput()->GetNumberOfPoints(), 0);
  ExpectOne(messages.warnings, "15000 modes of", "hours");
  ASSERT_TRUE(filter->GetProgressText());
  EXPECT_NE(std::string(filter->GetProgressText()).find("hours"), std::string::npos);
}

TEST_F(LaplaceSpectrum, TheDepthFollowsFromTheAccuracy)
{
  filter->SetInputData(ToPolyData(GeodesicSphere(32)));
  int depth = 0;
  for (const double accuracy : { 0.1, 0.003 })
  {
    filter->SetAccuracy(accuracy);
    const auto eigenvalues = Eigenvalues(filter);
    for (int k = 1; k < 9; ++k)
    {
      // the facets' own error is 2e-3
      EXPECT_NEAR(eigenvalues[k] / (k < 4 ? 2.0 : 6.0), 1.0, 1.2 * accuracy + 2e-3);
    }
    EXPECT_EQ(FieldValue(filter->GetOutput(), "Converged"), 1);
    EXPECT_GT(FieldValue(filter->GetOutput(), "UsedDepth"), depth);
    depth = static_cast<int>(FieldValue(filter->GetOutput(), "UsedDepth"));
    for (const double error : Column(filter, "EstimatedError"))
    {
      EXPECT_LE(error, accuracy);
    }
    const auto isTrusted = Column(filter, "TrustedEstimate");
    ASSERT_EQ(isTrusted.size(), 9u);
    EXPECT_EQ(FieldValue(filter->GetOutput(), "TrustedEstimate"),
      *std::min_element(isTrusted.begin(), isTrusted.end()));
  }
  EXPECT_LE(depth, 6);
  // Another time step computes nothing, though the depth was found by trying.
  const vtkIdType runs = filter->GetNumberOfRuns("Solve");
  this->ModeAt(5);
  EXPECT_EQ(filter->GetNumberOfRuns("Solve"), runs);
  EXPECT_TRUE(messages.warnings.empty());
}

TEST_F(LaplaceSpectrum, AnAccuracyOutOfReachIsReported)
{
  vtkNew<vtkConnectivityAwareBasis> basis;
  basis->SetInputData(filter->GetInput());
  basis->SetDepth(4);
  filter->SetBasisConnection(basis->GetOutputPort());
  filter->SetAccuracy(1e-5);
  EXPECT_EQ(Eigenvalues(filter).size(), 9u);
  ExpectOne(messages.warnings, "not reached");
  EXPECT_EQ(FieldValue(filter->GetOutput(), "Converged"), 0);
  EXPECT_EQ(FieldValue(filter->GetOutput(), "UsedDepth"), 4);
}

TEST_F(LaplaceSpectrum, TwoComponentsHaveTwoZeros)
{
  const TriangleMesh sphere = GeodesicSphere(6);
  filter->SetInputData(
    ToPolyData(Join(sphere, Transform(sphere, { 0, 0, 1 }, 0.3, 1.0, { 3, 0, 0 }))));
  const auto eigenvalues = Eigenvalues(filter);
  EXPECT_NEAR(eigenvalues[1], 0.0, 1e-8);
  EXPECT_GT(eigenvalues[2], 1.0);
}

TEST_F(LaplaceSpectrum, ManyComponentsSayHowManyModesAreNeeded)
{
  TriangleMesh bubbles = GeodesicSphere(2);
  for (int k = 1; k < 12; ++k)
  {
    bubbles = Join(bubbles,
      Transform(GeodesicSphere(2), { 0, 0, 1 }, 0.3, 1.0, { 3.0 * (k % 4), 3.0 * (k / 4), 0 }));
  }
  filter->SetInputData(ToPolyData(bubbles));
  filter->SetDepth(5);
  filter->SetNumberOfModes(4);
  EXPECT_EQ(Eigenvalues(filter), std::vector<double>(4, 0.0));
  ExpectOne(messages.warnings, "All 4 modes are constants", "a Number Of Modes above 12.");
  filter->SetNumberOfModes(13);
  EXPECT_GT(Eigenvalues(filter).back(), 1.0);
}

TEST_F(LaplaceSpectrum, ModesOfADrumAreZeroOnItsBoundary)
{
  filter->SetInputData(ToPolyData(FlatRectangle(24, 24)));
  filter->SetNumberOfModes(4);
  EXPECT_NEAR(Eigenvalues(filter)[0], 0.0, 1e-8);
  filter->ZeroBoundaryValuesOn();
  const double exact = 2.0 * 3.14159265358979323846 * 3.14159265358979323846;
  EXPECT_NEAR(Eigenvalues(filter)[0], exact, 0.03 * exact);
  // Mode 0 is a time step, because it is not constant. It is 2 sin(πx) sin(πy).
  const std::vector<double> first = this->ModeAt(0.0);
  double inside = 0.0;
  double onBoundary = 0.0;
  for (vtkIdType k = 0; k < static_cast<vtkIdType>(first.size()); ++k)
  {
    const Vec3 p(filter->GetOutput()->GetPoint(k));
    double& largest = std::min({ p[0], p[1], 1.0 - p[0], 1.0 - p[1] }) > 1e-9 ? inside : onBoundary;
    largest = Larger(largest, std::abs(first[k]));
  }
  EXPECT_NEAR(inside, 2.0, 0.1);
  EXPECT_LT(onBoundary, 0.05);
  EXPECT_TRUE(messages.warnings.empty());
}

TEST_F(LaplaceSpectrum, ModesHaveThePrecisionOfThePoints)
{
  for (const int precision : { VTK_FLOAT, VTK_DOUBLE })
  {
    filter->SetInputData(ToPolyData(GeodesicSphere(6), precision));
    filter->Update();
    EXPECT_EQ(filter->GetOutput()->GetPointData()->GetArray("Mode")->GetDataType(), precision);
  }
}

/// Cases for the grid's functions and for hats.
class LaplaceSpectrumOnEither
  : public LaplaceSpectrum
  , public ::testing::WithParamInterface<int>
{
protected:
  LaplaceSpectrumOnEither() { filter->SetFunctionSpace(this->GetParam()); }
};

TEST_P(LaplaceSpectrumOnEither, TimeStepsAreModesAndAreNeverSolvedAgain)
{
  filter->UpdateInformation();
  for (int port = 0; port < 2; ++port)
  {
    vtkInformation* info = filter->GetOutputInformation(port);
    ASSERT_EQ(info->Length(vtkStreamingDemandDrivenPipeline::TIME_STEPS()), 8);
    EXPECT_EQ(info->Get(vtkStreamingDemandDrivenPipeline::TIME_STEPS())[3], 4.0);
    EXPECT_EQ(info->Get(vtkStreamingDemandDrivenPipeline::TIME_RANGE())[1], 8.0);
  }
  filter->AllModesOn();
  filter->Update();
  std::vector<std::vector<double>> modes;
  for (int mode = 0; mode < 9; ++mode)
  {
    modes.push_back(PointValues(filter->GetOutput(), ("Mode00" + std::to_string(mode)).c_str()));
    EXPECT_FALSE(modes.back().empty());
  }
  EXPECT_FALSE(
    filter->GetOutputInformation(0)->Has(vtkStreamingDemandDrivenPipeline::TIME_STEPS()));
  filter->AllModesOff();
  for (const int mode : { 3, 1, 8 })
  {
    EXPECT_EQ(this->ModeAt(mode), modes[mode]);
    EXPECT_EQ(filter->GetOutput()->GetInformation()->Get(vtkDataObject::DATA_TIME_STEP()), mode);
  }
  EXPECT_EQ(this->ModeAt(100), modes[8]);
  EXPECT_EQ(this->ModeAt(0), modes[1]); // mode 0 is no time step
  EXPECT_EQ(this->ModeAt(std::nan("")), modes[1]);
  filter->SetMode(5);
  EXPECT_EQ(this->ModeAt(1), modes[5]);
  filter->SetMode(0);
  EXPECT_EQ(this->ModeAt(1), modes[0]);
  EXPECT_EQ(filter->GetNumberOfRuns("Solve"), 1);
  EXPECT_EQ(filter->GetNumberOfRuns("Space"), 1);
}

TEST_P(LaplaceSpectrumOnEither, NotConvergedWarnsAndKeepsTheResult)
{
  filter->SetTolerance(1e-16);
  filter->SetMaximumIterations(1);
  EXPECT_EQ(Eigenvalues(filter).size(), 9u);
  ExpectOne(messages.warnings, "residual");
  EXPECT_EQ(FieldValue(filter->GetOutput(), "Converged"), 0);
}

TEST_P(LaplaceSpectrumOnEither, AFieldArrayTellsOfACutGroup)
{
  filter->SetNumberOfModes(6);
  EXPECT_EQ(Eigenvalues(filter).size(), 6u);
  EXPECT_EQ(FieldValue(filter->GetOutput(), "CutsGroup"), 1);
  filter->SetNumberOfModes(9);
  EXPECT_EQ(Eigenvalues(filter).size(), 9u); // 1 + 3 + 5
  EXPECT_EQ(FieldValue(filter->GetOutput(), "CutsGroup"), 0);
  EXPECT_TRUE(messages.warnings.empty());
}

TEST_P(LaplaceSpectrumOnEither, RepeatsBitForBitOnAnyNumberOfThreads)
{
  filter->ReleaseDataFlagOn(); // each run starts anew
  filter->SetNumberOfThreads(1);
  const auto eigenvalues = Eigenvalues(filter);
  const auto mode = PointValues(filter->GetOutput(), "Mode");
  for (const int threads : { 1, 2 })
  {
    filter->SetNumberOfThreads(threads);
    filter->Modified();
    EXPECT_EQ(Eigenvalues(filter), eigenvalues);
    EXPECT_EQ(PointValues(filter->GetOutput(), "Mode"), mode);
  }
  EXPECT_EQ(filter->GetNumberOfRuns("Solve"), 3);
}

INSTANTIATE_TEST_SUITE_P(BothSpaces, LaplaceSpectrumOnEither,
  ::testing::Values(int(Spectrum::Grid), int(Spectrum::HatFunctions)));

} // namespace
