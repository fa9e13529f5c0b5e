// Tests selections, in the form that ParaView makes them, as inputs of filters.
#include "FilterSupport.h"
#include "Selections.h"

#include "vtkGeodesicDistance.h"
#include "vtkHarmonicInterpolation.h"
#include "vtkHeatDiffusion.h"
#include "vtkScreenedPoisson.h"
#include "vtkSurfaceDetail.h"

#include "vtkDataSetTriangleFilter.h"
#include "vtkImageData.h"
#include "vtkInformation.h"
#include "vtkMultiBlockDataSet.h"
#include "vtkOutputWindow.h"
#include "vtkUnsignedIntArray.h"
#include "vtkUnstructuredGrid.h"

#include <gtest/gtest.h>

#include <set>

using namespace gridfem;
using namespace gridfem::testing;

namespace
{

vtkSmartPointer<vtkDoubleArray> Numbers(int components, const std::vector<double>& numbers)
{
  auto array = vtkSmartPointer<vtkDoubleArray>::New();
  array->SetNumberOfComponents(components);
  for (const double number : numbers)
  {
    array->InsertNextValue(number);
  }
  return array;
}

/// Returns the selection by a rectangle on the screen, seen along z: x and y between the bounds.
vtkSmartPointer<vtkSelection> SelectFrustum(double xLow, double xHigh, double yLow, double yHigh)
{
  std::vector<double> corners;
  for (const double x : { xLow, xHigh })
  {
    for (const double y : { yLow, yHigh })
    {
      for (const double z : { 10.0, -10.0 }) // near, far
      {
        corners.insert(corners.end(), { x, y, z, 1.0 });
      }
    }
  }
  return SelectionOf(
    NodeOf(vtkSelectionNode::POINT, vtkSelectionNode::FRUSTUM, Numbers(4, corners)));
}

vtkSmartPointer<vtkPolyData> Sphere()
{
  auto data = ToPolyData(Transform(GeodesicSphere(12), { 1, 2, 3 }, 0.4));
  AddPointArray(data, "f", 1, Wave);
  return data;
}

/// Returns the points above the height.
std::vector<vtkIdType> PointsAbove(vtkDataSet* data, double height)
{
  std::vector<vtkIdType> points;
  for (vtkIdType p = 0; p < data->GetNumberOfPoints(); ++p)
  {
    if (data->GetPoint(p)[2] > height)
    {
      points.push_back(p);
    }
  }
  return points;
}

vtkSmartPointer<vtkSurfaceDetail> DetailOf(vtkDataObject* data, vtkSelection* selection)
{
  auto filter = vtkSmartPointer<vtkSurfaceDetail>::New();
  filter->SetInputDataObject(0, data);
  filter->SetInputDataObject(2, selection);
  filter->SetDepth(4);
  filter->SetTransitionWidth(0.0);
  return filter;
}

/// Returns the selected points.
std::vector<vtkIdType> Selected(vtkPolyData* output)
{
  const std::vector<double> inside = PointValues(output, "Selected");
  EXPECT_EQ(vtkIdType(inside.size()), output->GetNumberOfPoints());
  std::vector<vtkIdType> points;
  for (std::size_t p = 0; p < inside.size(); ++p)
  {
    EXPECT_TRUE(inside[p] == 0.0 || inside[p] == 1.0);
    if (inside[p] == 1.0)
    {
      points.push_back(vtkIdType(p));
    }
  }
  return points;
}

std::vector<vtkIdType> Selected(vtkDataObject* data, vtkSelection* selection)
{
  const auto filter = DetailOf(data, selection);
  filter->Update();
  return Selected(filter->GetOutput());
}

template<class Filter>
vtkSmartPointer<Filter> SolverOf(vtkPolyData* data)
{
  auto filter = vtkSmartPointer<Filter>::New();
  filter->SetInputData(data);
  filter->SetDepth(4);
  return filter;
}

/// Adds a mask of the points.
void AddMask(vtkPolyData* data, const std::vector<vtkIdType>& points)
{
  const std::set<vtkIdType> marked(points.begin(), points.end());
  vtkIdType point = 0;
  AddPointArray(data, "mask", 1, [&](const Vec3&, int) { return double(marked.count(point++)); });
}

/// Expects that a selection of points holds their values as a mask does.
/// @param index   of the mask among the arrays of the filter
/// @param misfit  largest error of a held value
/// @param change  least difference of a point that is no longer held
template<class Filter>
void ExpectToHold(int index, const char* result, double misfit, double change, void (*set)(Filter*))
{
  const auto sphere = Sphere();
  const std::vector<vtkIdType> held = PointsAbove(sphere, 0.8);
  AddMask(sphere, held);
  const auto solver = [&](bool mask, vtkSelection* selection)
  {
    const auto filter = SolverOf<Filter>(sphere);
    filter->SetInputArrayToProcess(0, 0, 0, Points, "f");
    if (mask)
    {
      filter->SetInputArrayToProcess(index, 0, 0, Points, "mask");
    }
    filter->SetInputDataObject(2, selection);
    set(filter);
    return filter;
  };
  const auto byMask = solver(true, nullptr);
  byMask->Update();
  const auto bySelection = solver(false, SelectPoints(held));
  bySelection->Update();
  const std::vector<double> solution = PointValues(bySelection->GetOutput(), result);
  EXPECT_EQ(solution, PointValues(byMask->GetOutput(), result));
  const double said = FieldValue(bySelection->GetOutput(), "Misfit");
  EXPECT_EQ(said, FieldValue(byMask->GetOutput(), "Misfit"));
  EXPECT_LT(said, misfit);
  const std::vector<double> f = PointValues(sphere, "f");
  for (const vtkIdType point : held)
  {
    EXPECT_NEAR(solution[point], f[point], misfit);
  }

  // Another selection holds others, on the same matrices of the space.
  bySelection->SetInputDataObject(2, SelectPoints({ 5 }));
  bySelection->Update();
  const std::vector<double> again = PointValues(bySelection->GetOutput(), result);
  EXPECT_NEAR(again[5], f[5], 1e-5);
  EXPECT_GT(std::abs(again[held[0]] - f[held[0]]), change);
  EXPECT_EQ(bySelection->GetNumberOfRuns("System"), 1);
  ExpectRefused(solver(false, SelectPoints({})), "not selected");
}

} // namespace

TEST(Selection, OfPointsIsTheirIds)
{
  const std::vector<vtkIdType> ids = { 3, 17, 200 };
  EXPECT_EQ(Selected(Sphere(), SelectPoints(ids)), ids);
}

TEST(Selection, OfCellsIsTheirPoints)
{
  const auto sphere = Sphere();
  std::set<vtkIdType> expected;
  vtkNew<vtkIdList> points;
  for (const vtkIdType cell : { 5, 6, 300 })
  {
    sphere->GetCellPoints(cell, points);
    expected.insert(points->begin(), points->end());
  }
  EXPECT_EQ(Selected(sphere, SelectIds(vtkSelectionNode::CELL, { 5, 6, 300 })),
    std::vector<vtkIdType>(expected.begin(), expected.end()));
}

TEST(Selection, OfAFrustumIsWhatLiesInIt)
{
  const auto sphere = Sphere();
  std::vector<vtkIdType> expected;
  for (vtkIdType p = 0; p < sphere->GetNumberOfPoints(); ++p)
  {
    const Vec3 point(sphere->GetPoint(p));
    if (point[0] > 0.1 && point[0] < 0.6 && point[1] > -0.3 && point[1] < 0.4)
    {
      expected.push_back(p);
    }
  }
  EXPECT_EQ(Selected(sphere, SelectFrustum(0.1, 0.6, -0.3, 0.4)), expected);
}

TEST(Selection, OfAThresholdOrItsInverseIsWhereTheArrayLiesBetween)
{
  const auto sphere = Sphere();
  std::vector<vtkIdType> between;
  std::vector<vtkIdType> others;
  const std::vector<double> f = PointValues(sphere, "f");
  for (vtkIdType p = 0; p < sphere->GetNumberOfPoints(); ++p)
  {
    (f[p] >= 0.2 && f[p] <= 0.9 ? between : others).push_back(p);
  }
  const auto range = Numbers(2, { 0.2, 0.9 });
  range->SetName("f");
  const auto node = NodeOf(vtkSelectionNode::POINT, vtkSelectionNode::THRESHOLDS, range);
  EXPECT_EQ(Selected(sphere, SelectionOf(node)), between);
  node->GetProperties()->Set(vtkSelectionNode::INVERSE(), 1);
  EXPECT_EQ(Selected(sphere, SelectionOf(node)), others);
}

TEST(Selection, OfGlobalIdsAndOfPlacesIsTheirPoints)
{
  const auto sphere = Sphere();
  vtkNew<vtkIdTypeArray> global;
  for (vtkIdType p = 0; p < sphere->GetNumberOfPoints(); ++p)
  {
    global->InsertNextValue(1000 - p);
  }
  sphere->GetPointData()->SetGlobalIds(global);
  const std::vector<vtkIdType> expected = { 40, 90 };
  EXPECT_EQ(Selected(sphere, SelectionOf(NodeOf(vtkSelectionNode::POINT,
                               vtkSelectionNode::GLOBALIDS, IdArray({ 960, 910 })))),
    expected);
  std::vector<double> places;
  for (const vtkIdType point : expected)
  {
    const Vec3 place(sphere->GetPoint(point));
    places.insert(places.end(), place.data(), place.data() + 3);
  }
  const auto node =
    NodeOf(vtkSelectionNode::POINT, vtkSelectionNode::LOCATIONS, Numbers(3, places));
  node->GetProperties()->Set(vtkSelectionNode::EPSILON(), 1e-3);
  EXPECT_EQ(Selected(sphere, SelectionOf(node)), expected);
}

/// The array of an earlier extraction stays and is not mixed up with the new one.
TEST(Selection, DoesNotTakeWhatAnotherExtractionHasMarked)
{
  const auto sphere = Sphere();
  vtkNew<vtkDoubleArray> old;
  old->SetName("vtkInsidedness");
  old->SetNumberOfTuples(sphere->GetNumberOfPoints());
  old->Fill(1.0);
  sphere->GetPointData()->AddArray(old);
  vtkNew<vtkIdList> points;
  sphere->GetCellPoints(5, points);
  std::vector<vtkIdType> expected(points->begin(), points->end());
  std::sort(expected.begin(), expected.end());
  EXPECT_EQ(Selected(sphere, SelectIds(vtkSelectionNode::CELL, { 5 })), expected);
  EXPECT_TRUE(sphere->GetPointData()->HasArray("vtkInsidedness"));
}

/// Ids belong to the data set that the user clicks on, not to its surface.
TEST(Selection, OfAGridMarksThePointsOfItsSurface)
{
  vtkNew<vtkImageData> image;
  image->SetDimensions(7, 6, 5);
  vtkNew<vtkDataSetTriangleFilter> tetrahedra;
  tetrahedra->SetInputData(image);
  tetrahedra->Update();
  vtkUnstructuredGrid* grid = tetrahedra->GetOutput();
  for (const int kind : { vtkSelectionNode::POINT, vtkSelectionNode::CELL })
  {
    std::set<vtkIdType> wanted; // of the grid
    std::vector<vtkIdType> ids = PointsAbove(grid, 3.5);
    wanted.insert(ids.begin(), ids.end());
    if (kind == vtkSelectionNode::CELL)
    {
      ids.clear();
      for (vtkIdType cell = 0; cell < grid->GetNumberOfCells(); ++cell)
      {
        vtkIdList* points = grid->GetCell(cell)->GetPointIds();
        if (std::all_of(points->begin(), points->end(),
              [&](vtkIdType p) { return grid->GetPoint(p)[2] > 2.5; }))
        {
          ids.push_back(cell);
        }
      }
      wanted.clear();
      for (vtkIdType p = 0; p < grid->GetNumberOfPoints(); ++p)
      {
        if (grid->GetPoint(p)[2] > 2.5)
        {
          wanted.insert(p);
        }
      }
    }
    const auto filter = DetailOf(grid, SelectIds(kind, ids));
    filter->Update();
    const std::vector<vtkIdType> found = Selected(filter->GetOutput());
    EXPECT_GT(found.size(), 20u);
    const std::vector<double> original = PointValues(filter->GetOutput(), "vtkOriginalPointIds");
    ASSERT_EQ(vtkIdType(original.size()), filter->GetOutput()->GetNumberOfPoints());
    std::set<vtkIdType> marked(found.begin(), found.end());
    for (std::size_t p = 0; kind == vtkSelectionNode::POINT && p < original.size(); ++p)
    {
      EXPECT_EQ(marked.count(vtkIdType(p)), wanted.count(vtkIdType(original[p]))) << p;
    }
    for (const vtkIdType p : found)
    {
      EXPECT_TRUE(wanted.count(vtkIdType(original[p]))) << p;
    }
  }
}

/// An id counts only in its block. An id without a block counts in all of them.
TEST(Selection, OfABlockIsOfThatBlock)
{
  vtkNew<vtkMultiBlockDataSet> blocks;
  blocks->SetBlock(0, Sphere());
  blocks->SetBlock(1, Sphere());
  const auto node =
    NodeOf(vtkSelectionNode::POINT, vtkSelectionNode::INDICES, IdArray({ 7, 8, 9 }));
  const auto counts = [&](vtkSelection* selection)
  {
    const auto filter = DetailOf(blocks, selection);
    filter->Update();
    auto* output = vtkMultiBlockDataSet::SafeDownCast(filter->GetOutputDataObject(0));
    std::vector<std::size_t> numbers;
    for (unsigned int block : { 0, 1 })
    {
      numbers.push_back(Selected(vtkPolyData::SafeDownCast(output->GetBlock(block))).size());
    }
    return numbers;
  };
  EXPECT_EQ(counts(SelectionOf(node)), std::vector<std::size_t>({ 3, 3 }));
  node->GetProperties()->Set(vtkSelectionNode::COMPOSITE_INDEX(), 2);
  EXPECT_EQ(counts(SelectionOf(node)), std::vector<std::size_t>({ 0, 3 }));
  vtkNew<vtkUnsignedIntArray> whole;
  whole->InsertNextValue(1);
  const auto all =
    counts(SelectionOf(NodeOf(vtkSelectionNode::CELL, vtkSelectionNode::BLOCKS, whole)));
  EXPECT_EQ(all, std::vector<std::size_t>({ std::size_t(Sphere()->GetNumberOfPoints()), 0 }));
}

/// Without nodes VTK extracts nothing, not even a tree of blocks.
TEST(Selection, WithoutNodesTakesNothingOfBlocks)
{
  vtkNew<vtkCallbackCommand> fail;
  fail->SetCallback([](vtkObject*, unsigned long, void*, void* text)
    { ADD_FAILURE() << static_cast<const char*>(text); });
  const unsigned long tag =
    vtkOutputWindow::GetInstance()->AddObserver(vtkCommand::ErrorEvent, fail);
  vtkNew<vtkMultiBlockDataSet> blocks;
  blocks->SetBlock(0, Sphere());
  blocks->SetBlock(1, Sphere());
  const auto filter = DetailOf(blocks, SelectionOf(nullptr));
  filter->Update();
  auto* output = vtkMultiBlockDataSet::SafeDownCast(filter->GetOutputDataObject(0));
  EXPECT_TRUE(Selected(vtkPolyData::SafeDownCast(output->GetBlock(1))).empty());
  vtkOutputWindow::GetInstance()->RemoveObserver(tag);
}

TEST(Selection, ThatCannotBeEvaluatedIsRefused)
{
  const auto rows = SelectIds(vtkSelectionNode::ROW, { 1 });
  ExpectRefused(DetailOf(Sphere(), rows), "points or of cells");
  const auto own =
    SelectionOf(NodeOf(vtkSelectionNode::POINT, vtkSelectionNode::USER, IdArray({ 1 })));
  ExpectRefused(DetailOf(Sphere(), own), "cannot be evaluated");
  const auto mixed = SelectPoints({ 1 });
  mixed->AddNode(NodeOf(vtkSelectionNode::CELL, vtkSelectionNode::INDICES, IdArray({ 1 })));
  ExpectRefused(DetailOf(Sphere(), mixed), "both points and cells");
  const auto frustum = [](vtkAbstractArray* list)
  { return SelectionOf(NodeOf(vtkSelectionNode::POINT, vtkSelectionNode::FRUSTUM, list)); };
  ExpectRefused(DetailOf(Sphere(), frustum(IdArray({ 1 }))), "eight corners");
  ExpectRefused(DetailOf(Sphere(), frustum(nullptr)), "eight corners");
  const auto node = NodeOf(vtkSelectionNode::POINT, vtkSelectionNode::INDICES, IdArray({ 1 }));
  node->SetSelectionData(nullptr);
  ExpectRefused(DetailOf(Sphere(), SelectionOf(node)), "without data");
}

/// VTK crashes on the first two, and takes other points or none for the rest.
TEST(Selection, WithAListThatDoesNotFitIsRefused)
{
  const auto refuse = [](int content, vtkDataArray* list, const char* name, const char* reason)
  {
    SCOPED_TRACE(reason);
    const auto node = NodeOf(vtkSelectionNode::POINT, content, list);
    list->SetName(name);
    node->GetProperties()->Set(vtkSelectionNode::COMPONENT_NUMBER(), 0);
    ExpectRefused(DetailOf(Sphere(), SelectionOf(node)), reason);
  };
  refuse(vtkSelectionNode::VALUES, Numbers(1, { 0.0, std::nan(""), 1.0 }), "f", "not numbers");
  const auto cut = Sphere();
  cut->GetPointData()->GetArray("f")->SetNumberOfTuples(7);
  const auto range = Numbers(2, { 0.2, 0.9 });
  range->SetName("f");
  const auto node = NodeOf(vtkSelectionNode::POINT, vtkSelectionNode::THRESHOLDS, range);
  ExpectRefused(DetailOf(cut, SelectionOf(node)), "'f', which does not have numbers for all");
  node->GetProperties()->Set(vtkSelectionNode::COMPONENT_NUMBER(), 1);
  ExpectRefused(DetailOf(Sphere(), SelectionOf(node)), "the component 1 of the array 'f'");
  refuse(vtkSelectionNode::VALUES, IdArray({ 1 }), "f", "Both must be of one type");
  refuse(vtkSelectionNode::INDICES, Numbers(1, { 1.0 }), "ids", "a list of integers");
  refuse(vtkSelectionNode::THRESHOLDS, Numbers(1, { 0.1, 0.2, 0.3 }), "f", "two for a range");
  refuse(vtkSelectionNode::LOCATIONS, Numbers(3, { 0.0, INFINITY, 0.0 }), "places", "finite");
  refuse(vtkSelectionNode::BLOCKS, IdArray({ 1 }), "blocks", "an input with blocks");
  refuse(vtkSelectionNode::FRUSTUM, Numbers(4, std::vector<double>(32, 1.0)), "corners", "volume");
}

namespace
{

/// Returns a sphere whose cell 5 names a point that does not exist.
vtkSmartPointer<vtkPolyData> SphereWithAWrongCorner(vtkIdType corner)
{
  const auto sphere = Sphere();
  const vtkIdType corners[3] = { 0, 1, corner };
  sphere->GetPolys()->ReplaceCellAtId(5, 3, corners);
  return sphere;
}

} // namespace

TEST(Selection, OfCellsWithAPointThatDoesNotExistIsRefused)
{
  for (const vtkIdType corner : { vtkIdType(-1), vtkIdType(1) << 40 })
  {
    const auto sphere = SphereWithAWrongCorner(corner);
    ExpectRefused(DetailOf(sphere, SelectIds(vtkSelectionNode::CELL, { 5 })),
      "Cell 5 uses point " + std::to_string(corner), "but the mesh has");
    ExpectRefused(DetailOf(sphere, SelectPoints({ 3 })), "Cell 5 uses point");
  }
}

TEST(Selection, InABlockBesideABadOneIsTaken)
{
  vtkNew<vtkMultiBlockDataSet> blocks;
  blocks->SetBlock(0, SphereWithAWrongCorner(vtkIdType(1) << 40));
  blocks->SetBlock(1, Sphere());
  const auto filter = DetailOf(blocks, SelectPoints({ 3, 17 }));
  Messages messages(filter);
  filter->Update();
  ExpectOne(messages.errors, "Cell 5 uses point");
  auto* output = vtkMultiBlockDataSet::SafeDownCast(filter->GetOutputDataObject(0));
  EXPECT_TRUE(IsEmptyData(output->GetBlock(0)));
  EXPECT_EQ(
    Selected(vtkPolyData::SafeDownCast(output->GetBlock(1))), (std::vector<vtkIdType>{ 3, 17 }));
}

/// ParaView has one node for each of its processes. The nodes of others are ignored, however many.
TEST(Selection, TakesTheNodesOfThisProcess)
{
  const auto selection = SelectPoints({ 5 });
  for (const int process : { 1, 2, 3, 0, 4 })
  {
    const auto node =
      NodeOf(vtkSelectionNode::POINT, vtkSelectionNode::INDICES, IdArray({ 10 + process }));
    node->GetProperties()->Set(vtkSelectionNode::PROCESS_ID(), process);
    selection->AddNode(node);
  }
  EXPECT_EQ(Selected(Sphere(), selection), std::vector<vtkIdType>({ 5, 10 }));
}

TEST(Selection, ByAnExpressionThatCannotBeEvaluatedIsRefused)
{
  auto selection = vtkSmartPointer<vtkSelection>::New();
  selection->SetNode(
    "A", NodeOf(vtkSelectionNode::POINT, vtkSelectionNode::INDICES, IdArray({ 1, 2 })));
  selection->SetNode(
    "B", NodeOf(vtkSelectionNode::POINT, vtkSelectionNode::INDICES, IdArray({ 2, 3 })));
  selection->SetExpression("A&!B");
  EXPECT_EQ(Selected(Sphere(), selection), std::vector<vtkIdType>({ 1 }));
  selection->SetExpression("A&");
  ExpectRefused(DetailOf(Sphere(), selection), "the expression 'A&'");
}

TEST(Selection, OfNothingIsNoPoint)
{
  EXPECT_TRUE(Selected(Sphere(), SelectPoints({})).empty());
  EXPECT_TRUE(Selected(Sphere(), SelectionOf(nullptr)).empty());
}

TEST(Selection, OfSourcesOfDistancesIsAMaskOfThem)
{
  const auto sphere = Sphere();
  const std::vector<vtkIdType> sources = PointsAbove(sphere, 0.9);
  AddMask(sphere, sources);
  const auto byMask = SolverOf<vtkGeodesicDistance>(sphere);
  byMask->SetInputArrayToProcess(0, 0, 0, Points, "mask");
  byMask->Update();
  const auto bySelection = SolverOf<vtkGeodesicDistance>(sphere);
  bySelection->SetInputDataObject(3, SelectPoints(sources));
  bySelection->Update();
  EXPECT_EQ(PointValues(bySelection->GetOutput(), "Distance"),
    PointValues(byMask->GetOutput(), "Distance"));

  // The selection adds to the ids. A new selection repeats only the solve.
  const auto hierarchies = bySelection->GetNumberOfRuns("Hierarchy");
  bySelection->SetInputDataObject(3, SelectPoints({ 5 }));
  bySelection->AddSourcePointId(100);
  bySelection->Update();
  const auto byIds = SolverOf<vtkGeodesicDistance>(sphere);
  byIds->AddSourcePointId(5);
  byIds->AddSourcePointId(100);
  byIds->Update();
  EXPECT_EQ(
    PointValues(bySelection->GetOutput(), "Distance"), PointValues(byIds->GetOutput(), "Distance"));
  EXPECT_EQ(bySelection->GetNumberOfRuns("Hierarchy"), hierarchies);
  EXPECT_EQ(bySelection->GetNumberOfRuns("Solve"), 2);

  const auto byNothing = SolverOf<vtkGeodesicDistance>(sphere);
  byNothing->SetInputDataObject(3, SelectPoints({}));
  ExpectRefused(byNothing, "The Selection takes no point");
}

TEST(Selection, OfKnownValuesIsAMaskOfThem)
{
  const auto sphere = Sphere();
  const std::vector<vtkIdType> known = { 0, 50, 100, 150, 200, 250, 300, 350 };
  AddMask(sphere, known);
  const auto interpolation = [&](bool mask, vtkSelection* selection)
  {
    const auto filter = SolverOf<vtkHarmonicInterpolation>(sphere);
    filter->SetInputArrayToProcess(0, 0, 0, Points, "f");
    if (mask)
    {
      filter->SetInputArrayToProcess(1, 0, 0, Points, "mask");
    }
    filter->SetInputDataObject(3, selection);
    return filter;
  };
  const auto valuesOf = [](vtkHarmonicInterpolation* filter)
  {
    filter->Update();
    return PointValues(filter->GetOutput(), "Interpolated");
  };
  const std::vector<double> byMask = valuesOf(interpolation(true, nullptr));
  EXPECT_EQ(valuesOf(interpolation(false, SelectPoints(known))), byMask);
  EXPECT_EQ(valuesOf(interpolation(true, SelectPoints({ 50, 300 }))), byMask); // known anyway
  EXPECT_NE(valuesOf(interpolation(true, SelectPoints({ 51 }))), byMask);
  ExpectRefused(interpolation(false, SelectPoints({})), "not selected");
}

TEST(Selection, OfHeldValuesIsAConstraintArray)
{
  ExpectToHold<vtkScreenedPoisson>(
    4, "Solution", 1e-5, 0.1, [](auto* filter) { filter->SetScreeningWeight(1.0); });
}

TEST(Selection, OfHeldHeatIsAConstraintArray)
{
  ExpectToHold<vtkHeatDiffusion>(
    2, "Diffused", 1e-6, 0.01, [](auto* filter) { filter->SetDiffusionTime(0.02); });
}
