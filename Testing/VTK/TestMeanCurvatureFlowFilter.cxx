// Tests Mean Curvature Flow: steps as time, kept and repeated steps, continuation, and the failure
// rule.

#include "FilterSupport.h"
#include "Largest.h"

#include "vtkConnectivityAwareBasis.h"
#include "vtkMeanCurvatureFlow.h"

#include "vtkFloatArray.h"
#include "vtkInformation.h"
#include "vtkStreamingDemandDrivenPipeline.h"

#include <gtest/gtest.h>

using namespace gridfem;
using namespace gridfem::testing;

namespace
{

using Flow = vtkMeanCurvatureFlow;

class MeanCurvatureFlowFilter : public ::testing::TestWithParam<int>
{
protected:
  MeanCurvatureFlowFilter() : messages(filter)
  {
    filter->SetFunctionSpace(this->GetParam());
    filter->SetDepth(4);
    filter->SetTimeStep(1e-3);
    filter->SetNumberOfSteps(5);
    filter->SetInputData(this->Surface());
  }

  static vtkSmartPointer<vtkPolyData> Surface(int precision = VTK_DOUBLE)
  {
    return ToPolyData(Transform(Torus(24, 12, 1.0, 0.4), { 1, 2, 0 }, 0.4), precision);
  }

  std::vector<double> PointsAt(double time)
  {
    filter->UpdateTimeStep(time);
    return Values(filter->GetOutput()->GetPoints()->GetData());
  }

  vtkNew<Flow> filter;
  Messages messages;
};

TEST_P(MeanCurvatureFlowFilter, AFlatSquareInAPlaneOfTheGridTakesFewIterations)
{
  filter->SetInputData(ToPolyData(FlatRectangle(20, 20)));
  filter->Update();
  EXPECT_EQ(FieldValue(filter->GetOutput(), "Converged"), 1);
  for (const double iterations : Column(filter, "Iterations"))
  {
    EXPECT_LE(iterations, 5);
  }
  EXPECT_TRUE(messages.errors.empty());
}

TEST_P(MeanCurvatureFlowFilter, StepsAreTimeStepsFromTheInputOn)
{
  filter->UpdateInformation();
  for (int port = 0; port < 2; ++port)
  {
    vtkInformation* info = filter->GetOutputInformation(port);
    ASSERT_EQ(info->Length(vtkStreamingDemandDrivenPipeline::TIME_STEPS()), 6);
    EXPECT_EQ(info->Get(vtkStreamingDemandDrivenPipeline::TIME_RANGE())[1], 5.0);
  }
  filter->Update(); // without a time: the last step
  EXPECT_EQ(FieldValue(filter->GetOutput(), "Step"), 5);
  EXPECT_EQ(FieldValue(filter->GetOutput(), "Converged"), 1);
  const auto last = Values(filter->GetOutput()->GetPoints()->GetData());
  EXPECT_EQ(this->PointsAt(0), Values(this->Surface()->GetPoints()->GetData()));
  const std::vector<double> ones(filter->GetOutput()->GetNumberOfPoints(), 1.0);
  EXPECT_LT(Difference(PointValues(filter->GetOutput(), "QuasiConformalError"), ones), 1e-7);
  EXPECT_LT(Difference(PointValues(filter->GetOutput(), "ConformalFactor"), ones), 1e-12);
  EXPECT_EQ(this->PointsAt(5), last);
  EXPECT_EQ(this->PointsAt(1e9), last);
  EXPECT_EQ(filter->GetOutput()->GetInformation()->Get(vtkDataObject::DATA_TIME_STEP()), 1e9);
  EXPECT_EQ(this->PointsAt(std::nan("")), this->PointsAt(0));
  EXPECT_EQ(filter->GetNumberOfRuns("Step"), 5);
  EXPECT_TRUE(messages.errors.empty() && messages.warnings.empty());
}

TEST_P(MeanCurvatureFlowFilter, BackAndForthGivesTheSameBitsOfTheSameSteps)
{
  std::vector<std::vector<double>> steps;
  for (int step = 0; step <= 5; ++step)
  {
    steps.push_back(this->PointsAt(step));
  }
  for (const int step : { 3, 4, 1, 5, 2, 0, 5 })
  {
    EXPECT_EQ(this->PointsAt(step), steps[step]) << step;
  }
  EXPECT_EQ(filter->GetNumberOfRuns("Step"), 5);
  vtkNew<Flow> again;
  again->SetFunctionSpace(this->GetParam());
  again->SetDepth(4);
  again->SetTimeStep(1e-3);
  again->SetNumberOfSteps(5);
  again->SetNumberOfThreads(1);
  again->SetInputData(this->Surface());
  again->Update();
  EXPECT_EQ(Values(again->GetOutput()->GetPoints()->GetData()), steps[5]);
}

TEST_P(MeanCurvatureFlowFilter, MoreStepsContinueAndFewerComputeNothing)
{
  const auto third = this->PointsAt(3);
  filter->SetNumberOfSteps(8);
  this->PointsAt(8);
  EXPECT_EQ(filter->GetNumberOfRuns("Step"), 8);
  EXPECT_EQ(Column(filter, "Step").size(), 9u);
  filter->SetNumberOfSteps(3);
  EXPECT_EQ(this->PointsAt(8), third);
  EXPECT_EQ(Column(filter, "Step").size(), 4u);
  EXPECT_EQ(filter->GetNumberOfRuns("Step"), 8);
  filter->SetTimeStep(2e-3);
  EXPECT_NE(this->PointsAt(3), third);
  EXPECT_EQ(filter->GetNumberOfRuns("Step"), 11);
  EXPECT_EQ(filter->GetNumberOfRuns("System"), 1);
}

TEST_P(MeanCurvatureFlowFilter, TheTableTellsOfEveryStep)
{
  filter->Update();
  EXPECT_EQ(Column(filter, "Step"), (std::vector<double>{ 0, 1, 2, 3, 4, 5 }));
  const auto area = Column(filter, "Area");
  EXPECT_NEAR(area[0], SurfaceArea(Torus(24, 12, 1.0, 0.4)), 1e-9);
  const auto time = Column(filter, "Time");
  for (int k = 1; k < 6; ++k)
  {
    EXPECT_LT(area[k], area[k - 1]);
    EXPECT_NEAR(time[k], k * 1e-3 * area[0], 1e-9); // world units
  }
  EXPECT_NEAR(FieldValue(filter->GetOutput(), "FlowTime"), time[5], 1e-12);
  for (const char* name :
    { "Volume", "Sphericity", "QuasiConformalError", "Iterations", "LockedSamples", "Seconds" })
  {
    EXPECT_TRUE(AllFinite(Column(filter, name)) && Column(filter, name).size() == 6u) << name;
  }
}

TEST_P(MeanCurvatureFlowFilter, ArraysBelongToTheMovedSurface)
{
  for (const int precision : { VTK_FLOAT, VTK_DOUBLE })
  {
    auto surface = this->Surface(precision);
    AddPointArray(surface, "kept", 1, Wave);
    vtkNew<vtkFloatArray> normals;
    normals->SetName("Normals");
    normals->SetNumberOfComponents(3);
    normals->SetNumberOfTuples(surface->GetNumberOfPoints());
    normals->Fill(0.5);
    surface->GetPointData()->SetNormals(normals);
    filter->SetInputData(surface);
    filter->Update();
    vtkPolyData* output = filter->GetOutput();
    EXPECT_EQ(output->GetNumberOfCells(), surface->GetNumberOfCells());
    EXPECT_EQ(output->GetPoints()->GetDataType(), precision);
    EXPECT_FALSE(PointValues(output, "kept").empty());
    EXPECT_EQ(normals->GetComponent(0, 0), 0.5); // the input's stay
    for (vtkIdType k = 0; k < output->GetNumberOfPoints(); ++k)
    {
      const Vec3 normal(output->GetPointData()->GetNormals()->GetTuple3(k));
      ASSERT_NEAR(normal.norm(), 1.0, 1e-5);
      const Vec3 displacement(output->GetPointData()->GetArray("Displacement")->GetTuple3(k));
      const Vec3 moved = Vec3(output->GetPoint(k)) - Vec3(surface->GetPoint(k));
      ASSERT_NEAR((moved - displacement).norm(), 0.0, 1e-6);
    }
    for (const double error : PointValues(output, "QuasiConformalError"))
    {
      ASSERT_GE(error, 1.0);
    }
  }
}

/// VTK keeps an array active as normals if it replaces normals under their name.
TEST_P(MeanCurvatureFlowFilter, ActiveNormalsOfAnotherShapeAreNoNormals)
{
  for (const bool isShort : { false, true })
  {
    auto surface = this->Surface(VTK_DOUBLE);
    for (const bool isReplaced : { false, true })
    {
      vtkNew<vtkDoubleArray> array;
      array->SetName("Normals");
      array->SetNumberOfComponents(isReplaced && !isShort ? 6 : 3);
      array->SetNumberOfTuples(isReplaced && isShort ? 2 : surface->GetNumberOfPoints());
      array->Fill(0.5);
      isReplaced ? surface->GetPointData()->AddArray(array)
                 : surface->GetPointData()->SetNormals(array);
    }
    ASSERT_NE(surface->GetPointData()->GetNormals(), nullptr);
    filter->SetInputData(surface);
    filter->Update();
    EXPECT_TRUE(messages.errors.empty());
    EXPECT_EQ(filter->GetOutput()->GetPointData()->GetNormals(), nullptr);
  }
}

TEST_P(MeanCurvatureFlowFilter, ABasisIsTakenAndDoesNotComeOut)
{
  const auto alone = this->PointsAt(5);
  vtkNew<vtkConnectivityAwareBasis> basis;
  basis->SetInputData(this->Surface());
  basis->SetDepth(4);
  filter->SetBasisConnection(basis->GetOutputPort());
  filter->SetDepth(7);
  EXPECT_LT(Difference(this->PointsAt(5), alone), 1e-9);

  filter->SetInputConnection(0, basis->GetOutputPort());
  filter->SetInputConnection(1, nullptr);
  filter->UpdateTimeStep(2);
  vtkPolyData* output = filter->GetOutput();
  ASSERT_GT(output->GetNumberOfPoints(), 0);
  EXPECT_EQ(output->GetCellData()->GetAbstractArray("PatchId"), nullptr);
  EXPECT_EQ(output->GetFieldData()->GetAbstractArray("PatchBasisIds"), nullptr);
  EXPECT_EQ(output->GetFieldData()->GetAbstractArray("GridDepth"), nullptr);
  EXPECT_TRUE(messages.errors.empty());
}

TEST_P(MeanCurvatureFlowFilter, ClippingAgainIsNearTracking)
{
  filter->SetInputData(ToPolyData(GeodesicSphere(16)));
  filter->Update();
  const auto tracked = Column(filter, "Area");
  const auto moved = Values(filter->GetOutput()->GetPoints()->GetData());
  filter->TrackMetricOff();
  filter->Update();
  EXPECT_NEAR(Column(filter, "Area")[5], tracked[5], 0.01 * tracked[5]);
  EXPECT_LT(Difference(Values(filter->GetOutput()->GetPoints()->GetData()), moved), 0.02);
  filter->ConformalizedOn();
  ExpectRefused(filter, "Track Metric");
}

TEST_P(MeanCurvatureFlowFilter, TheConformalisedFlowWarnsWhereNoSphereComesOut)
{
  filter->ConformalizedOn();
  filter->Update();
  ExpectOne(messages.warnings, "sphere");
  this->PointsAt(2);
  EXPECT_EQ(messages.warnings.size(), 1u); // not at every time step
  const auto area = Column(filter, "Area");
  EXPECT_NEAR(area[5], area[0], 1e-9 * area[0]); // the default of Rescale
  filter->SetInputData(ToPolyData(GeodesicSphere(8)));
  filter->Update();
  EXPECT_EQ(messages.warnings.size(), 1u);
}

TEST_P(MeanCurvatureFlowFilter, AVanishedSurfaceEndsTheFlowWithAWarning)
{
  filter->SetInputData(ToPolyData(GeodesicSphere(6)));
  filter->SetTimeStep(0.02);
  filter->SetNumberOfSteps(60);
  filter->Update();
  ExpectOne(messages.warnings, "ends after");
  EXPECT_TRUE(messages.errors.empty());
  EXPECT_GT(filter->GetOutput()->GetNumberOfPoints(), 0);
  EXPECT_TRUE(AllFinite(Values(filter->GetOutput()->GetPoints()->GetData())));
  EXPECT_EQ(FieldValue(filter->GetOutput(), "Converged"), 0);
  EXPECT_EQ(FieldValue(filter->GetOutput(), "Step"), double(Column(filter, "Step").size() - 1));
  for (const char* name : { "ConformalFactor", "QuasiConformalError", "Displacement" })
  {
    EXPECT_TRUE(AllFinite(PointValues(filter->GetOutput(), name))) << name;
  }
}

TEST_P(MeanCurvatureFlowFilter, AnAbortKeepsTheStepsSoFar)
{
  const auto undisturbed = this->PointsAt(5);
  vtkNew<Flow> other;
  other->SetFunctionSpace(this->GetParam());
  other->SetDepth(4);
  other->SetTimeStep(1e-3);
  other->SetNumberOfSteps(2);
  other->SetInputData(this->Surface());
  other->Update();
  other->SetNumberOfSteps(5);
  vtkNew<vtkCallbackCommand> abortOnce; // set before, older VTK takes it back when it starts
  abortOnce->SetCallback(
    [](vtkObject* caller, unsigned long, void*, void*)
    {
      vtkAlgorithm::SafeDownCast(caller)->AbortExecuteOn();
      caller->RemoveObservers(vtkCommand::ProgressEvent);
    });
  other->AddObserver(vtkCommand::ProgressEvent, abortOnce);
  EXPECT_EQ(other->GetExecutive()->Update(), 1);
  EXPECT_TRUE(IsEmptyData(other->GetOutput()));
  other->Modified();
  other->Update();
  EXPECT_EQ(Values(other->GetOutput()->GetPoints()->GetData()), undisturbed);
  EXPECT_EQ(other->GetNumberOfRuns("Step"), 5);
}

TEST_P(MeanCurvatureFlowFilter, AFixedBoundaryStaysInEveryStepAndAllElseMoves)
{
  filter->SetInputData(ToPolyData(Mapped(FlatRectangle(16, 16), [](const Vec3& p)
    { return Vec3(p[0], p[1], 0.3 * std::sin(5.0 * p[0]) * std::cos(4.0 * p[1])); })));
  for (const bool track : { true, false })
  {
    filter->SetTrackMetric(track);
    filter->FixedBoundaryOn();
    const std::vector<double> start = this->PointsAt(0);
    const std::vector<double> end = this->PointsAt(5);
    for (int k = 0; k < 17 * 17; ++k)
    {
      const bool isFixed = k % 17 == 0 || k % 17 == 16 || k / 17 == 0 || k / 17 == 16;
      double moved = 0.0;
      for (int axis = 0; axis < 3; ++axis)
      {
        moved = Larger(moved, std::abs(end[3 * k + axis] - start[3 * k + axis]));
      }
      EXPECT_EQ(moved == 0.0, isFixed) << k;
    }
    const std::vector<double> area = Column(filter, "Area");
    EXPECT_TRUE(std::is_sorted(area.rbegin(), area.rend()));
    filter->FixedBoundaryOff();
    EXPECT_NE(this->PointsAt(5), end);
  }
  EXPECT_TRUE(messages.errors.empty());
  EXPECT_TRUE(messages.warnings.empty());
  filter->FixedBoundaryOn();
  filter->TrackMetricOn();
  filter->ConformalizedOn();
  ExpectRefused(filter, "Fixed Boundary");
}

TEST_P(MeanCurvatureFlowFilter, UnusableValuesAreRefusedAndEmptyInputsAreNot)
{
  for (const double step : { 0.0, -1.0, std::nan(""), double(HUGE_VAL) })
  {
    filter->SetTimeStep(step);
    ExpectRefused(filter, "Time Step");
  }
  filter->SetTimeStep(1e-3);
  filter->SetInputData(ToPolyData(FlatRectangle(6, 6)));
  filter->SetRescale(Flow::ConstantVolume);
  ExpectRefused(filter);
  messages.errors.clear();
  filter->SetInputData(vtkNew<vtkPolyData>());
  EXPECT_EQ(filter->GetExecutive()->Update(), 1);
  EXPECT_TRUE(IsEmptyData(filter->GetOutput()));
  EXPECT_TRUE(IsEmptyData(filter->GetOutputDataObject(1)));
  EXPECT_TRUE(messages.errors.empty());
}

INSTANTIATE_TEST_SUITE_P(BothSpaces, MeanCurvatureFlowFilter,
  ::testing::Values(int(Flow::Grid), int(Flow::HatFunctions)),
  [](const auto& space) { return std::string(space.param == 0 ? "Grid" : "HatFunctions"); });

} // namespace
