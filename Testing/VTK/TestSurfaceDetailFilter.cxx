// Surface Detail as a user of VTK sees it.
#include "FilterSupport.h"
#include "Largest.h"
#include "Selections.h"

#include "vtkConnectivityAwareBasis.h"
#include "vtkSurfaceDetail.h"

#include "vtkPiecewiseFunction.h"

#include <gtest/gtest.h>

#include <limits>

using namespace gridfem;
using namespace gridfem::testing;

namespace
{

constexpr const char* DetailStages[] = { "Space", "System", "Metric", "Weights", "Signal",
  "Hierarchy", "RightHandSide", "Solve" };

/// Makes a sphere with waves on it, normals and a mask of its upper half.
vtkSmartPointer<vtkPolyData> WavySphere()
{
  auto data = ToPolyData(Mapped(Transform(GeodesicSphere(16), { 1, 2, 3 }, 0.4),
    [](const Vec3& p) -> Vec3
    { return p * (1.0 + 0.03 * std::sin(12.0 * p[0]) * std::sin(12.0 * p[1])); }));
  AddPointArray(data, "upper", 1, [](const Vec3& p, int) { return p[2] > 0.0 ? 1.0 : 0.5; });
  AddPointArray(data, "f", 2, Wave);
  data->GetPointData()->SetNormals(
    AddPointArray(data, "n", 3, [](const Vec3& p, int c) { return p.normalized()[c]; }));
  return data;
}

vtkSmartPointer<vtkSurfaceDetail> DetailOf(vtkPolyData* data, int functionSpace)
{
  auto filter = vtkSmartPointer<vtkSurfaceDetail>::New();
  filter->SetInputData(data);
  filter->SetDepth(4);
  filter->SetScreeningWeight(500.0);
  filter->SetFunctionSpace(functionSpace);
  return filter;
}

/// Returns the stages that run again.
std::vector<std::string> Reruns(vtkSurfaceDetail* filter, const std::function<void()>& change)
{
  std::vector<vtkIdType> before;
  for (const char* stage : DetailStages)
  {
    before.push_back(filter->GetNumberOfRuns(stage));
  }
  change();
  filter->Update();
  std::vector<std::string> runs;
  for (std::size_t k = 0; k < std::size(DetailStages); ++k)
  {
    if (filter->GetNumberOfRuns(DetailStages[k]) != before[k])
    {
      runs.emplace_back(DetailStages[k]);
    }
  }
  return runs;
}

/// Returns the standard deviation of the distances from the center, relative to their mean, because
/// smoothing shrinks.
double Roughness(vtkPolyData* data)
{
  double sum = 0.0;
  double squares = 0.0;
  for (vtkIdType p = 0; p < data->GetNumberOfPoints(); ++p)
  {
    const double radius = Vec3(data->GetPoint(p)).norm();
    sum += radius;
    squares += radius * radius;
  }
  const double points = double(data->GetNumberOfPoints());
  return std::sqrt(squares * points / (sum * sum) - 1.0);
}

std::vector<double> Positions(vtkPolyData* data)
{
  return Values(data->GetPoints()->GetData());
}

std::vector<double> PositionsFrom(vtkSurfaceDetail* filter)
{
  filter->Update();
  return Positions(filter->GetOutput());
}

/// Selects the points for which the condition is true.
vtkSmartPointer<vtkSelection> Select(
  vtkPolyData* data, const std::function<bool(const Vec3&)>& isSelected)
{
  std::vector<vtkIdType> ids;
  for (vtkIdType p = 0; p < data->GetNumberOfPoints(); ++p)
  {
    if (isSelected(Vec3(data->GetPoint(p))))
    {
      ids.push_back(p);
    }
  }
  return SelectPoints(ids);
}

/// Selects the points above the height.
vtkSmartPointer<vtkSelection> Above(vtkPolyData* data, double height)
{
  return Select(data, [height](const Vec3& p) { return p[2] > height; });
}

class SurfaceDetailFilter : public ::testing::TestWithParam<int>
{
};

} // namespace

TEST_P(SurfaceDetailFilter, SharpensAndSmooths)
{
  const auto sphere = WavySphere();
  for (const int transfer : { 0, 1, 2, 3, 4 })
  {
    const auto filter = DetailOf(sphere, GetParam());
    filter->SetTransferFunction(transfer);
    const auto roughness = [&](double scale)
    {
      filter->SetDetailScale(scale);
      filter->Update();
      EXPECT_EQ(FieldValue(filter->GetOutput(), "Converged"), 1);
      return Roughness(filter->GetOutput());
    };
    EXPECT_LT(roughness(0.0), 0.9 * Roughness(sphere)) << transfer;
    EXPECT_GT(roughness(2.0), 1.1 * Roughness(sphere)) << transfer;
    filter->SetDetailScale(1.0);
    filter->Update();
    EXPECT_EQ(Positions(filter->GetOutput()), Positions(sphere)) << transfer;
  }
}

TEST_P(SurfaceDetailFilter, RepeatsOnlyWhatDependsOnAChange)
{
  const auto filter = DetailOf(WavySphere(), GetParam());
  using Names = std::vector<std::string>;
  EXPECT_EQ(Reruns(filter, [] {}),
    Names({ "Space", "System", "Signal", "Hierarchy", "RightHandSide", "Solve" }));
  EXPECT_EQ(Reruns(filter, [&] { filter->SetDetailScale(0.3); }), Names());
  EXPECT_EQ(Reruns(filter, [&] { filter->SetInputArrayToProcess(1, 0, 0, Points, "upper"); }),
    Names({ "RightHandSide", "Solve" }));
  EXPECT_EQ(
    Reruns(filter, [&] { filter->SetScreeningWeight(50.0); }), Names({ "Hierarchy", "Solve" }));
  EXPECT_EQ(Reruns(filter, [&] { filter->SetTransferFunction(vtkSurfaceDetail::LargePositive); }),
    Names({ "Metric", "Weights", "Hierarchy", "RightHandSide", "Solve" }));
  EXPECT_EQ(Reruns(filter, [&] { filter->SetAnisotropy(3.0); }),
    Names({ "Weights", "Hierarchy", "RightHandSide", "Solve" }));
  EXPECT_EQ(Reruns(filter, [&] { filter->SetInputArrayToProcess(0, 0, 0, Points, "f"); }),
    Names({ "Signal", "RightHandSide", "Solve" }));
  const Names rightHandSide = { "RightHandSide", "Solve" };
  auto* sphere = vtkPolyData::SafeDownCast(filter->GetInputDataObject(0, 0));
  EXPECT_EQ(
    Reruns(filter, [&] { filter->SetInputDataObject(2, Above(sphere, 0.5)); }), rightHandSide);
  EXPECT_EQ(
    Reruns(filter, [&] { filter->SetInputDataObject(2, Above(sphere, 0.2)); }), rightHandSide);
  EXPECT_EQ(Reruns(filter, [&] { filter->SetInputDataObject(2, Above(sphere, 0.2)); }),
    Names()); // the same points
  EXPECT_EQ(Reruns(filter, [&] { filter->SetTransitionWidth(0.1); }), rightHandSide);
  EXPECT_EQ(Reruns(filter, [&] { filter->SetOutsideScale(0.0); }), Names());
  EXPECT_EQ(Reruns(filter, [&] { filter->SetDetailScale(3.0); }), Names());
  EXPECT_EQ(Reruns(filter, [&] { filter->SetInputDataObject(2, nullptr); }), rightHandSide);
  EXPECT_EQ(Reruns(filter, [&] { filter->SetTransitionWidth(0.2); }), Names());
  EXPECT_EQ(Reruns(filter, [&] { filter->SetTransferFunction(vtkSurfaceDetail::Custom); }),
    Names({ "Weights", "Hierarchy", "RightHandSide", "Solve" }));
  EXPECT_EQ(Reruns(filter, [&] { filter->GetCustomTransferFunction()->AddPoint(0.5, 0.1); }),
    Names({ "Weights", "Hierarchy", "RightHandSide", "Solve" }));
  EXPECT_EQ(Reruns(filter, [&] { filter->SetNumberOfThreads(1); }), Names());
}

/// The kept stages give the result of a new filter.
TEST_P(SurfaceDetailFilter, GivesTheSameAgainAsAtFirst)
{
  const auto sphere = WavySphere();
  const auto changed = DetailOf(sphere, GetParam());
  changed->SetTolerance(1e-10);
  changed->Update();
  changed->SetTransferFunction(vtkSurfaceDetail::LargeAbsolute);
  changed->Update();
  changed->SetAnisotropy(3.0);
  changed->SetInputArrayToProcess(1, 0, 0, Points, "upper");
  changed->SetDetailScale(0.5);
  changed->Update();
  const auto fresh = DetailOf(sphere, GetParam());
  fresh->SetTolerance(1e-10);
  fresh->SetTransferFunction(vtkSurfaceDetail::LargeAbsolute);
  fresh->SetAnisotropy(3.0);
  fresh->SetInputArrayToProcess(1, 0, 0, Points, "upper");
  fresh->SetDetailScale(0.5);
  fresh->Update();
  EXPECT_LE(Difference(Positions(changed->GetOutput()), Positions(fresh->GetOutput())), 1e-9);
  changed->SetTransferFunction(vtkSurfaceDetail::Isotropic);
  changed->Update();
  const auto isotropic = DetailOf(sphere, GetParam());
  isotropic->SetTolerance(1e-10);
  isotropic->SetInputArrayToProcess(1, 0, 0, Points, "upper");
  isotropic->SetDetailScale(0.5);
  isotropic->Update();
  EXPECT_LE(Difference(Positions(changed->GetOutput()), Positions(isotropic->GetOutput())), 1e-9);
}

TEST_P(SurfaceDetailFilter, ChangesWhereTheArraySays)
{
  const auto sphere = WavySphere();
  const auto filter = DetailOf(sphere, GetParam());
  filter->SetInputArrayToProcess(1, 0, 0, Points, "upper");
  filter->SetScreeningWeight(3000.0);
  filter->Update(); // scale 2 above, 1 below
  double above = 0.0;
  double farBelow = 0.0;
  for (vtkIdType p = 0; p < sphere->GetNumberOfPoints(); ++p)
  {
    const double moved =
      std::abs(filter->GetOutput()->GetPointData()->GetArray("NormalDisplacement")->GetTuple1(p));
    const double z = sphere->GetPoint(p)[2];
    above = z > 0.3 ? std::max(above, moved) : above;
    farBelow = z < -0.5 ? std::max(farBelow, moved) : farBelow;
  }
  EXPECT_GT(above, 5e-3);
  EXPECT_LT(farBelow, 0.05 * above);
}

/// The array is 1 at selected points and 0 farther from them than the width. In between it falls
/// with distance.
TEST_P(SurfaceDetailFilter, FadesOutWithinTheWidthOfTheTransition)
{
  const auto plane = ToPolyData(FlatRectangle(40, 40));
  const auto filter = DetailOf(plane, GetParam());
  filter->SetInputDataObject(2, Select(plane, [](const Vec3& p) { return p[0] < 0.3001; }));
  filter->SetTransitionWidth(0.24); // of the area 1
  filter->Update();
  const std::vector<double> selected = PointValues(filter->GetOutput(), "Selected");
  ASSERT_EQ(vtkIdType(selected.size()), plane->GetNumberOfPoints());
  for (vtkIdType p = 0; p < plane->GetNumberOfPoints(); ++p)
  {
    const double t = std::clamp((plane->GetPoint(p)[0] - 0.3) / 0.24, 0.0, 1.0);
    EXPECT_NEAR(selected[p], 1.0 - t * t * (3.0 - 2.0 * t), 1e-9);
    EXPECT_EQ(selected[p] == 1.0, plane->GetPoint(p)[0] < 0.3001);
    EXPECT_EQ(selected[p] == 0.0, plane->GetPoint(p)[0] > 0.54);
  }
  filter->SetParameterUnits(vtkSurfaceFEMAlgorithm::World);
  filter->SetTransitionWidth(0.11);
  filter->Update();
  const std::vector<double> steeper = PointValues(filter->GetOutput(), "Selected");
  for (vtkIdType p = 0; p < plane->GetNumberOfPoints(); ++p)
  {
    EXPECT_EQ(steeper[p] == 0.0, plane->GetPoint(p)[0] > 0.41);
  }
}

TEST_P(SurfaceDetailFilter, ChangesWhereTheSelectionIs)
{
  const auto sphere = WavySphere();
  const auto everywhere = DetailOf(sphere, GetParam());
  everywhere->SetScreeningWeight(3000.0);
  const auto filter = DetailOf(sphere, GetParam());
  filter->SetScreeningWeight(3000.0);
  filter->SetInputDataObject(2, Above(sphere, 0.0));
  const std::vector<double> whole = PositionsFrom(everywhere);
  const std::vector<double> half = PositionsFrom(filter);
  const std::vector<double> before = Positions(sphere);
  double moved = 0.0;
  double differenceInside = 0.0;
  double movedOutside = 0.0;
  for (std::size_t k = 0; k < half.size(); ++k)
  {
    const double z = before[k - k % 3 + 2];
    moved = Larger(moved, std::abs(whole[k] - before[k]));
    differenceInside =
      z > 0.3 ? Larger(differenceInside, std::abs(half[k] - whole[k])) : differenceInside;
    movedOutside = z < -0.5 ? Larger(movedOutside, std::abs(half[k] - before[k])) : movedOutside;
  }
  EXPECT_GT(moved, 5e-3);
  EXPECT_LT(differenceInside, 0.1 * moved);
  EXPECT_LT(movedOutside, 0.05 * moved);
}

/// The selection has no effect if the scales are equal, if it takes all points, or if it takes
/// none.
TEST_P(SurfaceDetailFilter, WithoutADifferenceTheSelectionDoesNotCount)
{
  const auto sphere = WavySphere();
  const auto plain = DetailOf(sphere, GetParam());
  plain->SetInputArrayToProcess(1, 0, 0, Points, "upper");
  plain->SetTolerance(1e-10);
  const auto filter = DetailOf(sphere, GetParam());
  filter->SetInputArrayToProcess(1, 0, 0, Points, "upper");
  filter->SetTolerance(1e-10);
  for (const char* array : { "", "f" })
  {
    const auto compare = [&](vtkSelection* selection, double inside, double outside, double same)
    {
      filter->SetInputDataObject(2, selection);
      filter->SetDetailScale(inside);
      filter->SetOutsideScale(outside);
      plain->SetDetailScale(same);
      for (const auto& each : { plain, filter })
      {
        each->SetInputArrayToProcess(0, 0, 0, Points, array);
        each->Update();
      }
      EXPECT_LE(Difference(Positions(filter->GetOutput()), Positions(plain->GetOutput())), 1e-9);
      EXPECT_LE(Difference(PointValues(filter->GetOutput(), "Filtered"),
                  PointValues(plain->GetOutput(), "Filtered")),
        1e-8);
    };
    compare(Above(sphere, 0.3), 0.4, 0.4, 0.4);
    compare(Above(sphere, -2.0), 0.4, 2.0, 0.4);
    compare(Above(sphere, 2.0), 0.4, 2.0, 2.0);
  }
}

/// Without a screening weight, the transition is all that other units change.
TEST_P(SurfaceDetailFilter, OtherUnitsChangeTheTransition)
{
  const auto sphere = WavySphere();
  const auto make = [&](int units)
  {
    const auto filter = DetailOf(sphere, GetParam());
    filter->SetTolerance(1e-10);
    filter->SetScreeningWeight(0.0);
    filter->SetDetailScale(3.0);
    filter->SetOutsideScale(0.0);
    filter->SetTransitionWidth(0.3);
    filter->SetParameterUnits(units);
    filter->SetInputDataObject(2, Above(sphere, 0.1));
    return filter;
  };
  const auto kept = make(vtkSurfaceDetail::World);
  const std::vector<double> inWorld = PositionsFrom(kept);
  kept->SetParameterUnits(vtkSurfaceDetail::UnitArea);
  const std::vector<double> inArea = PositionsFrom(kept);
  EXPECT_LE(Difference(inArea, PositionsFrom(make(vtkSurfaceDetail::UnitArea))), 1e-6);
  EXPECT_GT(Difference(inArea, inWorld), 0.01);
}

/// The two halves add up: the sum of their changes is the change by both together.
TEST_P(SurfaceDetailFilter, InsideAndOutsideAddUp)
{
  const auto sphere = WavySphere();
  const auto filter = DetailOf(sphere, GetParam());
  filter->SetTolerance(1e-10);
  filter->SetInputDataObject(2, Above(sphere, 0.1));
  const auto change = [&](double inside, double outside)
  {
    filter->SetDetailScale(inside);
    filter->SetOutsideScale(outside);
    std::vector<double> moved = PositionsFrom(filter);
    const std::vector<double> before = Positions(sphere);
    for (std::size_t k = 0; k < moved.size(); ++k)
    {
      moved[k] -= before[k];
    }
    return moved;
  };
  const std::vector<double> inside = change(3.0, 1.0);
  const std::vector<double> outside = change(1.0, 0.0);
  std::vector<double> both = change(3.0, 0.0);
  EXPECT_GT(Difference(both, std::vector<double>(both.size(), 0.0)), 0.01);
  for (std::size_t k = 0; k < both.size(); ++k)
  {
    both[k] -= inside[k] + outside[k];
  }
  EXPECT_LE(Difference(both, std::vector<double>(both.size(), 0.0)), 1e-12);
  EXPECT_EQ(filter->GetNumberOfRuns("Solve"), 1);
}

/// A new selection that changes nothing does not solve again. The result is the same as if it did.
TEST_P(SurfaceDetailFilter, OneSelectionAfterTheOtherGivesWhatEachGives)
{
  const auto sphere = WavySphere();
  const auto changed = DetailOf(sphere, GetParam());
  changed->SetTolerance(1e-10);
  const auto none = vtkSmartPointer<vtkSelection>();
  for (const auto& selection :
    { none, Above(sphere, 0.0), Above(sphere, 0.5), none, Above(sphere, 0.5) })
  {
    changed->SetInputDataObject(2, selection);
    const auto fresh = DetailOf(sphere, GetParam());
    fresh->SetTolerance(1e-10);
    fresh->SetInputDataObject(2, selection);
    EXPECT_LE(Difference(PositionsFrom(changed), PositionsFrom(fresh)), 1e-9);
    EXPECT_EQ(FieldValue(changed->GetOutput(), "Converged"), 1);
  }
  changed->SetInputArrayToProcess(1, 0, 0, Points, "upper");
  changed->SetScreeningWeight(50.0);
  const auto fresh = DetailOf(sphere, GetParam());
  fresh->SetTolerance(1e-10);
  fresh->SetInputDataObject(2, Above(sphere, 0.5));
  fresh->SetInputArrayToProcess(1, 0, 0, Points, "upper");
  fresh->SetScreeningWeight(50.0);
  EXPECT_LE(Difference(PositionsFrom(changed), PositionsFrom(fresh)), 1e-9);
}

/// An aborted run leaves only the last solution, from which the next run starts.
TEST_P(SurfaceDetailFilter, GoesOnAfterAnAbort)
{
  const auto sphere = WavySphere();
  const auto filter = DetailOf(sphere, GetParam());
  filter->SetTolerance(1e-10);
  filter->Update();
  const double iterations = FieldValue(filter->GetOutput(), "Iterations");
  vtkNew<vtkCallbackCommand> abort;
  abort->SetCallback(
    [](vtkObject* caller, unsigned long, void*, void*)
    {
      auto* algorithm = vtkAlgorithm::SafeDownCast(caller);
      const double progress = algorithm->GetProgress();
      algorithm->SetAbortExecute(progress > 0.7 && progress < 0.9); // in the solve
    });
  const auto observer = filter->AddObserver(vtkCommand::ProgressEvent, abort);
  filter->SetScreeningWeight(500.001);
  filter->Update();
  EXPECT_TRUE(IsEmptyData(filter->GetOutput()));
  filter->RemoveObserver(observer);
  filter->Modified();
  filter->Update();
  EXPECT_LT(FieldValue(filter->GetOutput(), "Iterations"), iterations);
  const auto fresh = DetailOf(sphere, GetParam());
  fresh->SetTolerance(1e-10);
  fresh->SetScreeningWeight(500.001);
  EXPECT_LE(Difference(Positions(filter->GetOutput()), PositionsFrom(fresh)), 1e-9);
}

/// The points of the curve are set by hand. The curve has no effect, or the effect of a preset
/// where the preset has no bend.
TEST_P(SurfaceDetailFilter, TakesATransferFunctionOfOnesOwn)
{
  const auto sphere = WavySphere();
  const auto with = [&](int transfer, vtkPiecewiseFunction* function)
  {
    const auto filter = DetailOf(sphere, GetParam());
    filter->SetTolerance(1e-10);
    filter->SetTransferFunction(transfer);
    if (function)
    {
      filter->SetCustomTransferFunction(function);
    }
    return PositionsFrom(filter);
  };
  vtkNew<vtkPiecewiseFunction> nothing;
  nothing->AddPoint(0.0, 0.0);
  EXPECT_LE(
    Difference(with(vtkSurfaceDetail::Custom, nothing), with(vtkSurfaceDetail::Isotropic, nullptr)),
    1e-9);
  vtkNew<vtkPiecewiseFunction> smooth; // the curve of LargeAbsolute
  for (int k = -100; k <= 100; ++k)
  {
    const double t = std::abs(k) / 100.0;
    smooth->AddPoint(k / 100.0, t * t * (3.0 - 2.0 * t));
  }
  const std::vector<double> custom = with(vtkSurfaceDetail::Custom, smooth);
  const std::vector<double> preset = with(vtkSurfaceDetail::LargeAbsolute, nullptr);
  EXPECT_LE(Difference(custom, preset), 1e-4);
  EXPECT_GT(Difference(with(vtkSurfaceDetail::LargePositive, nullptr), preset), 1e-3);
}

TEST_P(SurfaceDetailFilter, FiltersAnArrayAndKeepsTheShape)
{
  const auto sphere = WavySphere();
  const auto filter = DetailOf(sphere, GetParam());
  filter->SetInputArrayToProcess(0, 0, 0, Points, "f");
  filter->SetDetailScale(1.0);
  filter->Update();
  EXPECT_EQ(Positions(filter->GetOutput()), Positions(sphere));
  EXPECT_LE(
    Difference(PointValues(filter->GetOutput(), "Filtered"), PointValues(sphere, "f")), 1e-14);
  filter->SetDetailScale(0.0);
  filter->Update();
  EXPECT_GT(
    Difference(PointValues(filter->GetOutput(), "Filtered"), PointValues(sphere, "f")), 0.05);
}

/// The coordinates as an array give the result of the shape.
TEST_P(SurfaceDetailFilter, OfTheCoordinatesAsAnArrayIsTheShape)
{
  const auto sphere = WavySphere();
  AddPointArray(sphere, "xyz", 3, [](const Vec3& p, int c) { return p[c]; });
  const auto shape = DetailOf(sphere, GetParam());
  shape->Update();
  const auto array = DetailOf(sphere, GetParam());
  array->SetInputArrayToProcess(0, 0, 0, Points, "xyz");
  array->Update();
  const double moved = Difference(Positions(shape->GetOutput()), Positions(sphere));
  EXPECT_LE(Difference(PointValues(array->GetOutput(), "Filtered"), Positions(shape->GetOutput())),
    0.02 * moved);
}

TEST_P(SurfaceDetailFilter, RecomputesNormalsAndKeepsTheVolume)
{
  const auto sphere = WavySphere();
  const auto filter = DetailOf(sphere, GetParam());
  filter->SetDetailScale(0.0);
  filter->SetScreeningWeight(20.0);
  filter->KeepVolumeOn();
  filter->Update();
  vtkPolyData* output = filter->GetOutput();
  vtkDataArray* normals = output->GetPointData()->GetNormals();
  ASSERT_TRUE(normals);
  double radius = 0.0;
  for (vtkIdType p = 0; p < output->GetNumberOfPoints(); ++p)
  {
    const Vec3 place(output->GetPoint(p));
    radius += place.norm() / double(output->GetNumberOfPoints());
    EXPECT_GT(Vec3(normals->GetTuple3(p)).dot(place.normalized()), 0.97);
  }
  EXPECT_NEAR(radius, 1.0, 0.01); // without it, less than 0.95
}

INSTANTIATE_TEST_SUITE_P(BothSpaces, SurfaceDetailFilter,
  ::testing::Values(int(vtkSurfaceFEMAlgorithm::Grid), int(vtkSurfaceFEMAlgorithm::HatFunctions)));

TEST(SurfaceDetailOfVTK, RefusesWhatItCannotUse)
{
  constexpr double NaN = std::numeric_limits<double>::quiet_NaN();
  const auto refuses = [](const char* name, const std::function<void(vtkSurfaceDetail*)>& set)
  {
    const auto sphere = WavySphere();
    const auto filter = DetailOf(sphere, vtkSurfaceFEMAlgorithm::Grid);
    set(filter);
    ExpectRefused(filter, name);
  };
  refuses("Detail Scale", [](auto* filter) { filter->SetDetailScale(NaN); });
  refuses("Screening Weight", [](auto* filter) { filter->SetScreeningWeight(-1.0); });
  refuses("Smoothing Scale", [](auto* filter) { filter->SetSmoothingScale(NaN); });
  refuses("Anisotropy", [](auto* filter) { filter->SetAnisotropy(NaN); });
  refuses("Outside Scale", [](auto* filter) { filter->SetOutsideScale(NaN); });
  refuses("Transition Width", [](auto* filter) { filter->SetTransitionWidth(-0.1); });
  const auto setCustom = [](vtkSurfaceDetail* filter, vtkPiecewiseFunction* function)
  {
    filter->SetTransferFunction(vtkSurfaceDetail::Custom);
    filter->SetCustomTransferFunction(function);
  };
  vtkNew<vtkPiecewiseFunction> empty;
  refuses("Custom Transfer Function", [&](auto* filter) { setCustom(filter, empty); });
  refuses("Custom Transfer Function", [&](auto* filter) { setCustom(filter, nullptr); });
  vtkNew<vtkPiecewiseFunction> negative; // lengths of 1 - 4 = -3
  negative->AddPoint(0.0, -1.0);
  refuses("must be above 0", [&](auto* filter) { setCustom(filter, negative); });
  refuses("Detail Scale Array",
    [](auto* filter) { filter->SetInputArrayToProcess(1, 0, 0, Points, "f"); });
  refuses(
    "nothing", [](auto* filter) { filter->SetInputArrayToProcess(0, 0, 0, Points, "nothing"); });
}

TEST(SurfaceDetailOfVTK, TakesASharedBasis)
{
  const auto sphere = WavySphere();
  vtkNew<vtkConnectivityAwareBasis> basis;
  basis->SetInputData(sphere);
  basis->SetDepth(4);
  const auto shared = DetailOf(sphere, vtkSurfaceFEMAlgorithm::Grid);
  shared->SetBasisConnection(basis->GetOutputPort());
  shared->SetDepth(7);
  shared->Update();
  const auto alone = DetailOf(sphere, vtkSurfaceFEMAlgorithm::Grid);
  alone->Update();
  EXPECT_LE(Difference(Positions(shared->GetOutput()), Positions(alone->GetOutput())), 1e-9);
}

/// A flat surface has the same curvature everywhere.
TEST(SurfaceDetailOfVTK, OfAPlaneIsAPlane)
{
  const auto filter = DetailOf(ToPolyData(FlatRectangle(8, 8)), vtkSurfaceFEMAlgorithm::Grid);
  filter->SetTransferFunction(vtkSurfaceDetail::LargeAbsolute);
  filter->SetDetailScale(3.0);
  filter->Update();
  for (vtkIdType p = 0; p < filter->GetOutput()->GetNumberOfPoints(); ++p)
  {
    EXPECT_NEAR(filter->GetOutput()->GetPoint(p)[2], 0.0, 1e-9);
  }
}
