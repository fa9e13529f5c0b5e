// Tests surfaces that change with time. No filter shows the result of another time, and modes as
// time steps belong to one surface.

#include "GrowingSphere.h"
#include "Pieces/GatheredRanks.h"
#include "Pipeline/PipelineTime.h"

#include "vtkClipToOctree.h"
#include "vtkConnectivityAwareBasis.h"
#include "vtkHeatDiffusion.h"
#include "vtkLaplaceSpectrum.h"
#include "vtkMeanCurvatureFlow.h"
#include "vtkScreenedPoisson.h"
#include "vtkSpectralSignatures.h"

#include "vtkDummyController.h"

#include <gtest/gtest.h>

using namespace gridfem;
using namespace gridfem::testing;

namespace
{

using Pipeline = vtkStreamingDemandDrivenPipeline;

const double ForwardsAndBackwards[] = { 1, 2, 3, 2, 1, 3 };

std::vector<double> StepsOf(vtkAlgorithm* filter, int port = 0)
{
  filter->UpdateInformation();
  vtkInformation* info = filter->GetOutputInformation(port);
  const double* steps = info->Get(Pipeline::TIME_STEPS());
  return std::vector<double>(steps, steps + info->Length(Pipeline::TIME_STEPS()));
}

class Time : public ::testing::Test
{
protected:
  template<class Filter>
  void Connect(Filter* filter)
  {
    filter->SetDepth(4);
    filter->SetInputConnection(source->GetOutputPort());
  }

  /// Checks the output at every time, forward and backward.
  template<class Look>
  void AtEveryTime(vtkSurfaceFEMAlgorithm* filter, Look&& look)
  {
    EXPECT_EQ(StepsOf(filter), (std::vector<double>{ 1, 2, 3 }));
    for (const double time : ForwardsAndBackwards)
    {
      EXPECT_TRUE(filter->UpdateTimeStep(time));
      auto* output = vtkPolyData::SafeDownCast(filter->GetOutputDataObject(0));
      EXPECT_NEAR(output->GetBounds()[1], time, 0.05 * time);
      EXPECT_EQ(output->GetInformation()->Get(vtkDataObject::DATA_TIME_STEP()), time);
      look(output, time);
    }
  }

  vtkNew<GrowingSphere> source;
};

TEST_F(Time, ClipAndBasisFollowTheInput)
{
  vtkNew<vtkClipToOctree> clip;
  this->Connect(clip.Get());
  vtkNew<vtkConnectivityAwareBasis> basis;
  basis->SetInputConnection(clip->GetOutputPort());
  const auto look = [](vtkPolyData* output, double time)
  { EXPECT_NEAR(FieldValue(output, "GridSpacing"), time / 8, 0.05 * time); };
  this->AtEveryTime(clip, look);
  this->AtEveryTime(basis, look);
}

TEST_F(Time, ScreenedPoissonFollowsTheInput)
{
  vtkNew<vtkScreenedPoisson> poisson;
  this->Connect(poisson.Get());
  poisson->SetInputArrayToProcess(0, 0, 0, Points, "x");
  poisson->SetScreeningWeight(1e4);
  this->AtEveryTime(poisson,
    [](vtkPolyData* output, double time)
    {
      const auto solution = PointValues(output, "Solution");
      EXPECT_NEAR(*std::max_element(solution.begin(), solution.end()), time, 0.05 * time);
    });
}

TEST_F(Time, AnAbortEndsTheRequestedTimeAlone)
{
  vtkNew<vtkScreenedPoisson> poisson;
  this->Connect(poisson.Get());
  poisson->SetInputArrayToProcess(0, 0, 0, Points, "x");
  vtkNew<vtkCallbackCommand> abort;
  abort->SetCallback(
    [](vtkObject* object, unsigned long, void*, void*)
    {
      auto* filter = static_cast<vtkAlgorithm*>(object);
      if (filter->GetProgress() < 0.9)
      {
        filter->SetAbortExecute(1);
      }
    });
  const unsigned long observer = poisson->AddObserver(vtkCommand::ProgressEvent, abort);
  poisson->UpdateTimeStep(1.0);
  poisson->RemoveObserver(observer);
  EXPECT_TRUE(IsEmptyData(poisson->GetOutput()));
  poisson->UpdateTimeStep(2.0);
  EXPECT_TRUE(AllFinite(PointValues(poisson->GetOutput(), "Solution")));
  EXPECT_NEAR(poisson->GetOutput()->GetBounds()[1], 2.0, 0.1);
}

TEST_F(Time, ASingleStepOfHeatFollowsTheInput)
{
  vtkNew<vtkHeatDiffusion> heat;
  this->Connect(heat.Get());
  heat->SetInputArrayToProcess(0, 0, 0, Points, "x");
  const auto look = [](vtkPolyData* output, double time)
  {
    const auto diffused = PointValues(output, "Diffused");
    EXPECT_NEAR(*std::max_element(diffused.begin(), diffused.end()), time, 0.05 * time);
  };
  this->AtEveryTime(heat, look);
  heat->SetNumberOfSteps(2);
  EXPECT_EQ(StepsOf(heat), (std::vector<double>{ 1, 2 }));
  heat->SetTimeFrom(vtkHeatDiffusion::Input);
  this->AtEveryTime(heat,
    [&](vtkPolyData* output, double time)
    {
      EXPECT_EQ(FieldValue(output, "Step"), 2);
      look(output, time);
    });
}

TEST_F(Time, TheLastStepOfAFlowFollowsTheInput)
{
  vtkNew<vtkMeanCurvatureFlow> flow;
  this->Connect(flow.Get());
  flow->SetNumberOfSteps(2);
  EXPECT_EQ(StepsOf(flow), (std::vector<double>{ 0, 1, 2 }));
  flow->SetTimeFrom(vtkMeanCurvatureFlow::Input);
  this->AtEveryTime(
    flow, [](vtkPolyData* output, double) { EXPECT_EQ(FieldValue(output, "Step"), 2); });
}

TEST_F(Time, EigenvaluesScaleWithTheGrowingSurface)
{
  vtkNew<vtkLaplaceSpectrum> spectrum;
  this->Connect(spectrum.Get());
  spectrum->SetNumberOfModes(4);
  const auto look = [&](vtkPolyData* output, double time)
  {
    const auto eigenvalues = Values(output->GetFieldData()->GetArray("Eigenvalues"));
    ASSERT_EQ(eigenvalues.size(), 4u);
    EXPECT_NEAR(eigenvalues[1] * time * time, 2.0, 0.1);
    EXPECT_EQ(Column(spectrum, "Eigenvalue"), eigenvalues);
  };
  spectrum->AllModesOn();
  this->AtEveryTime(spectrum, look);
  spectrum->AllModesOff();
  spectrum->SetMode(2);
  this->AtEveryTime(spectrum, look);
}

TEST_F(Time, SignaturesFollowTheModesOfTheInput)
{
  vtkNew<vtkLaplaceSpectrum> spectrum;
  this->Connect(spectrum.Get());
  spectrum->SetNumberOfModes(9);
  spectrum->AllModesOn();
  vtkNew<vtkSpectralSignatures> signatures;
  for (const bool readsModes : { true, false })
  {
    signatures->SetDepth(4);
    signatures->SetNumberOfModes(9);
    signatures->SetInputConnection(
      readsModes ? spectrum->GetOutputPort() : source->GetOutputPort());
    this->AtEveryTime(signatures, [&](vtkPolyData*, double time)
      { EXPECT_NEAR(Column(signatures, "Eigenvalue")[1] * time * time, 2.0, 0.1); });
    EXPECT_EQ(signatures->GetNumberOfRuns("Solve") > 0, !readsModes);
  }
}

TEST_F(Time, ModesAsTimeAreThoseOfTheSurfaceAtOneTime)
{
  vtkNew<vtkLaplaceSpectrum> spectrum;
  this->Connect(spectrum.Get());
  spectrum->SetNumberOfModes(9);
  source->UpdateTimeStep(2.0); // shown before the filter was added
  const int runs = source->Runs;
  for (const double mode : { 3, 1, 8, 2 })
  {
    spectrum->UpdateTimeStep(mode);
    EXPECT_EQ(spectrum->GetOutput()->GetInformation()->Get(vtkDataObject::DATA_TIME_STEP()), mode);
    EXPECT_NEAR(Column(spectrum, "Eigenvalue")[1] * 4.0, 2.0, 0.1);
  }
  EXPECT_EQ(source->Runs, runs);
  EXPECT_EQ(spectrum->GetNumberOfRuns("Solve"), 1);

  spectrum->SetMode(2); // the animation's time is the surface's again ...
  spectrum->UpdateTimeStep(3.0);
  EXPECT_NEAR(Column(spectrum, "Eigenvalue")[1] * 9.0, 2.0, 0.1);
  spectrum->SetMode(-1); // ... and stays where it was
  spectrum->UpdateTimeStep(1.0);
  EXPECT_NEAR(Column(spectrum, "Eigenvalue")[1] * 9.0, 2.0, 0.1);
}

TEST_F(Time, AnotherReaderOfTheInputDoesNotChangeTheModes)
{
  vtkNew<vtkLaplaceSpectrum> spectrum;
  this->Connect(spectrum.Get());
  spectrum->SetNumberOfModes(9);
  for (const double mode : { 1, 3, 2 })
  {
    source->UpdateTimeStep(mode); // as the view does that shows the input, too
    spectrum->UpdateTimeStep(mode);
    EXPECT_NEAR(Column(spectrum, "Eigenvalue")[1], 2.0, 0.1);
  }
  EXPECT_EQ(spectrum->GetNumberOfRuns("Solve"), 1);
}

TEST_F(Time, WithoutARequestTheFirstTimeIsTaken)
{
  vtkNew<vtkLaplaceSpectrum> spectrum;
  this->Connect(spectrum.Get());
  spectrum->SetNumberOfModes(4);
  spectrum->UpdateTimeStep(3.0);
  EXPECT_EQ(source->Time, 1.0);
}

TEST_F(Time, ASharedBasisIsOfTheSameTime)
{
  vtkNew<vtkConnectivityAwareBasis> basis;
  this->Connect(basis.Get());
  vtkNew<vtkLaplaceSpectrum> spectrum;
  this->Connect(spectrum.Get());
  spectrum->SetBasisConnection(basis->GetOutputPort());
  spectrum->SetNumberOfModes(4);
  const Messages messages(spectrum);
  for (const double mode : { 2, 3, 1 })
  {
    spectrum->UpdateTimeStep(mode);
  }
  spectrum->SetMode(1);
  for (const double time : ForwardsAndBackwards)
  {
    spectrum->UpdateTimeStep(time);
    EXPECT_NEAR(Column(spectrum, "Eigenvalue")[1] * time * time, 2.0, 0.1);
  }
  EXPECT_TRUE(messages.errors.empty());
}

TEST_F(Time, ModesThatDoNotExistAreNoTimeSteps)
{
  vtkNew<vtkLaplaceSpectrum> spectrum;
  this->Connect(spectrum.Get());
  spectrum->SetDepth(2);
  spectrum->SetNumberOfModes(1000);
  EXPECT_EQ(StepsOf(spectrum).size(), 999u); // not known before the first run
  spectrum->Update();
  const std::size_t modes = Column(spectrum, "Eigenvalue").size();
  ASSERT_GT(modes, 8u);
  ASSERT_LT(modes, 1000u);
  for (int port = 0; port < 2; ++port)
  {
    EXPECT_EQ(StepsOf(spectrum, port).size(), modes - 1);
    EXPECT_EQ(StepsOf(spectrum, port).back(), static_cast<double>(modes - 1));
  }
  spectrum->UpdateTimeStep(8.0);
  const auto eighth = PointValues(spectrum->GetOutput(), "Mode");
  spectrum->SetMode(8);
  spectrum->UpdateTimeStep(1.0); // the sphere's time again
  EXPECT_EQ(PointValues(spectrum->GetOutput(), "Mode"), eighth);
  spectrum->SetMode(-1);
  spectrum->SetNumberOfModes(4);
  EXPECT_EQ(StepsOf(spectrum).size(), 3u);
}

} // namespace

/// Ranks gather data that stay the same at another time only once.
TEST(GatheredRanks, HaveTheTimeOfTheirInput)
{
  const vtkSmartPointer<vtkMultiProcessController> before =
    vtkMultiProcessController::GetGlobalController();
  vtkNew<vtkDummyController> alone;
  vtkMultiProcessController::SetGlobalController(alone);
  vtkNew<vtkPolyData> sphere;
  sphere->ShallowCopy(ToPolyData(GeodesicSphere(2)));
  vtkNew<vtkInformationVector> input;
  vtkNew<vtkInformationVector> outputs;
  input->Append(vtkNew<vtkInformation>());
  outputs->Append(vtkNew<vtkInformation>());
  input->GetInformationObject(0)->Set(vtkDataObject::DATA_OBJECT(), sphere);
  vtkNew<vtkPolyData> output;
  outputs->GetInformationObject(0)->Set(vtkDataObject::DATA_OBJECT(), output);
  vtkInformationVector* inputs[] = { input };
  GatheredRanks ranks;
  const auto timeAt = [&](std::optional<double> time)
  {
    SetTime(sphere, time);
    std::optional<double> seen;
    ranks.Run(inputs, 1, outputs, true, {},
      [&](vtkInformationVector** gathered, vtkInformationVector*)
      {
        seen = TimeOf(vtkDataObject::GetData(gathered[0]));
        return std::vector<double>();
      });
    return seen;
  };
  for (const std::optional<double> time :
    { std::make_optional(1.0), std::make_optional(2.0), std::optional<double>() })
  {
    EXPECT_EQ(timeAt(time), time);
  }
  vtkMultiProcessController::SetGlobalController(before);
}
