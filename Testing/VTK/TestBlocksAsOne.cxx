// Checks all blocks of composite data as one surface: each block has the result of the whole
// surface.

#include "FilterSupport.h"
#include "GrowingSphere.h"
#include "Largest.h"
#include "Selections.h"

#include "vtkClipToOctree.h"
#include "vtkFarthestPoints.h"
#include "vtkGeodesicDistance.h"
#include "vtkHeatDiffusion.h"
#include "vtkLaplaceSpectrum.h"
#include "vtkMeanCurvatureFlow.h"
#include "vtkScreenedPoisson.h"
#include "vtkSurfaceDetail.h"

#include "vtkAppendFilter.h"
#include "vtkCompositeDataIterator.h"
#include "vtkImageData.h"
#include "vtkInformation.h"
#include "vtkIntArray.h"
#include "vtkMultiBlockDataGroupFilter.h"
#include "vtkMultiBlockDataSet.h"
#include "vtkPartitionedDataSet.h"
#include "vtkPartitionedDataSetCollection.h"
#include "vtkTable.h"
#include "vtkUnsignedCharArray.h"
#include "vtkUnstructuredGrid.h"

#include <gtest/gtest.h>

#include <utility>

using namespace gridfem;
using namespace gridfem::testing;

namespace
{

using Algorithm = vtkSurfaceFEMAlgorithm;

/// Returns the block that a triangle of the sphere goes to: eight octants in three parts.
int PartOf(const Vec3& center)
{
  return center[0] > 0.1 ? 0 : center[1] > 0.0 ? 1 : 2;
}

/// Returns a part of a surface with the point arrays "f" and "origin", the ids of its points in the
/// whole.
vtkSmartPointer<vtkPolyData> Part(const TriangleMesh& mesh, int part)
{
  TriangleMesh own;
  std::vector<vtkIdType> origin;
  std::vector<Index> place(mesh.points.size(), -1);
  for (auto triangle : mesh.triangles)
  {
    const Vec3 sum = mesh.points[triangle[0]] + mesh.points[triangle[1]] + mesh.points[triangle[2]];
    if (PartOf(sum / 3) != part)
    {
      continue;
    }
    for (auto& corner : triangle)
    {
      if (place[corner] < 0)
      {
        place[corner] = static_cast<Index>(own.points.size());
        own.points.push_back(mesh.points[corner]);
        origin.push_back(corner);
      }
      corner = place[corner];
    }
    own.triangles.push_back(triangle);
  }
  auto data = ToPolyData(own);
  AddPointArray(data, "f", 1, Wave);
  vtkNew<vtkIntArray> ids; // the name does not reveal that ids differ between blocks
  ids->SetName("origin");
  for (const vtkIdType id : origin)
  {
    ids->InsertNextValue(static_cast<int>(id));
  }
  data->GetPointData()->AddArray(ids);
  return data;
}

std::vector<vtkPolyData*> LeavesOf(vtkDataObject* data)
{
  std::vector<vtkPolyData*> leaves;
  auto* composite = vtkCompositeDataSet::SafeDownCast(data);
  auto leaf = vtkSmartPointer<vtkCompositeDataIterator>::Take(composite->NewIterator());
  for (leaf->InitTraversal(); !leaf->IsDoneWithTraversal(); leaf->GoToNextItem())
  {
    leaves.push_back(vtkPolyData::SafeDownCast(leaf->GetCurrentDataObject()));
  }
  return leaves;
}

class BlocksAsOne : public ::testing::Test
{
protected:
  BlocksAsOne()
    : mesh(Transform(GeodesicSphere(8), { 1, 2, 0 }, 0.3)),
      whole(ToPolyData(mesh)), parts{ Part(mesh, 0), Part(mesh, 1), Part(mesh, 2) },
      messages(filter)
  {
    AddPointArray(whole, "f", 1, Wave);
    this->SetUp(filter);
    filter->SetInputArrayToProcess(0, 0, 0, Points, "f");
  }

  static void SetUp(Algorithm* algorithm)
  {
    algorithm->SetDepth(4);
    algorithm->SetTolerance(1e-12);
    algorithm->BlocksAsOneOn();
  }

  /// Makes nested blocks: two parts in a group, a hole, an empty block, and the third part.
  vtkSmartPointer<vtkMultiBlockDataSet> Nested() const
  {
    auto blocks = vtkSmartPointer<vtkMultiBlockDataSet>::New();
    vtkNew<vtkMultiBlockDataSet> group;
    group->SetBlock(0, parts[0]);
    group->SetBlock(1, parts[1]);
    blocks->SetBlock(0, group);
    blocks->SetBlock(2, vtkNew<vtkPolyData>());
    blocks->SetBlock(3, parts[2]);
    blocks->GetMetaData(3u)->Set(vtkCompositeDataSet::NAME(), "third");
    return blocks;
  }

  /// The largest difference between an array of the leaves and the array of the whole.
  static double Apart(vtkDataObject* output, vtkPolyData* reference, const char* name)
  {
    double apart = 0.0;
    vtkDataArray* expected = reference->GetPointData()->GetArray(name);
    for (vtkPolyData* leaf : LeavesOf(output))
    {
      if (leaf->GetNumberOfPoints() == 0)
      {
        continue;
      }
      vtkDataArray* values = leaf->GetPointData()->GetArray(name);
      vtkDataArray* origin = leaf->GetPointData()->GetArray("origin");
      if (!values)
      {
        return INFINITY;
      }
      for (vtkIdType k = 0; k < values->GetNumberOfTuples(); ++k)
      {
        for (int c = 0; c < values->GetNumberOfComponents(); ++c)
        {
          apart = Larger(apart, std::abs(values->GetComponent(k, c) -
                                         expected->GetComponent(
                                           static_cast<vtkIdType>(origin->GetComponent(k, 0)), c)));
        }
      }
    }
    return apart;
  }

  /// Largest difference between values of the same point in different leaves.
  double ApartOnBorders(vtkDataObject* output, const char* name) const
  {
    double apart = 0.0;
    std::vector<double> seen(mesh.points.size(), NAN);
    for (vtkPolyData* leaf : LeavesOf(output))
    {
      const auto values = PointValues(leaf, name);
      vtkDataArray* origin = leaf->GetPointData()->GetArray("origin");
      for (std::size_t k = 0; k < values.size(); ++k)
      {
        double& value = seen[static_cast<std::size_t>(origin->GetComponent(k, 0))];
        apart = std::isnan(value) ? apart : Larger(apart, std::abs(value - values[k]));
        value = values[k];
      }
    }
    return apart;
  }

  vtkPolyData* Alone()
  {
    filter->SetInputDataObject(whole);
    filter->Update();
    return filter->GetOutput();
  }

  TriangleMesh mesh;
  vtkSmartPointer<vtkPolyData> whole;
  vtkSmartPointer<vtkPolyData> parts[3];
  vtkNew<vtkScreenedPoisson> filter;
  Messages messages;
};

TEST_F(BlocksAsOne, GiveTheSolutionOfTheWholeSurfaceInBothSpaces)
{
  for (const int space : { Algorithm::Grid, Algorithm::HatFunctions })
  {
    filter->SetFunctionSpace(space);
    vtkNew<vtkPolyData> reference;
    reference->ShallowCopy(this->Alone());
    filter->SetInputDataObject(this->Nested());
    filter->Update();
    auto* output = vtkMultiBlockDataSet::SafeDownCast(filter->GetOutputDataObject(0));
    ASSERT_TRUE(output);
    EXPECT_LT(this->Apart(output, reference, "Solution"), 1e-10);
    EXPECT_EQ(this->ApartOnBorders(output, "Solution"), 0.0);
  }
  EXPECT_TRUE(messages.errors.empty());
  EXPECT_TRUE(messages.warnings.empty());
}

/// The array differs between blocks, as normals of every block do.
TEST_F(BlocksAsOne, AreOneSurfaceWhereBordersHaveOtherValuesOnBothSides)
{
  for (int k = 0; k < 3; ++k)
  {
    AddPointArray(parts[k], "block", 1, [=](const Vec3&, int) { return k; });
  }
  for (const int space : { Algorithm::Grid, Algorithm::HatFunctions })
  {
    filter->SetFunctionSpace(space);
    vtkNew<vtkPolyData> reference;
    reference->ShallowCopy(this->Alone());
    filter->SetInputDataObject(this->Nested());
    filter->Update();
    EXPECT_LT(this->Apart(filter->GetOutputDataObject(0), reference, "Solution"), 1e-10);
    EXPECT_EQ(this->ApartOnBorders(filter->GetOutputDataObject(0), "Solution"), 0.0);
  }
}

TEST_F(BlocksAsOne, KeepTheirStructureTheirPointsAndTheirFieldArrays)
{
  vtkNew<vtkIntArray> own;
  own->SetName("BlockId");
  own->InsertNextValue(7);
  parts[0]->GetFieldData()->AddArray(own);
  filter->SetInputDataObject(this->Nested());
  filter->Update();
  auto* output = vtkMultiBlockDataSet::SafeDownCast(filter->GetOutputDataObject(0));
  ASSERT_EQ(output->GetNumberOfBlocks(), 4u);
  EXPECT_EQ(output->GetBlock(1), nullptr);
  EXPECT_STREQ(output->GetMetaData(3u)->Get(vtkCompositeDataSet::NAME()), "third");
  EXPECT_TRUE(IsEmptyData(output->GetBlock(2)));
  auto* group = vtkMultiBlockDataSet::SafeDownCast(output->GetBlock(0));
  ASSERT_TRUE(group);
  vtkPolyData* const leaves[] = { vtkPolyData::SafeDownCast(group->GetBlock(0)),
    vtkPolyData::SafeDownCast(group->GetBlock(1)), vtkPolyData::SafeDownCast(output->GetBlock(3)) };
  for (int k = 0; k < 3; ++k)
  {
    ASSERT_TRUE(leaves[k]);
    EXPECT_EQ(leaves[k]->GetPoints(), parts[k]->GetPoints());
    EXPECT_EQ(leaves[k]->GetPolys(), parts[k]->GetPolys());
    EXPECT_EQ(FieldValue(leaves[k], "Converged"), 1);
    EXPECT_EQ(FieldValue(leaves[k], "UsedDepth"), 4);
    EXPECT_EQ(leaves[k]->GetFieldData()->HasArray("BlockId"), k == 0);
  }
  // One chart, in the first block.
  auto* tables = vtkCompositeDataSet::SafeDownCast(filter->GetOutputDataObject(1));
  ASSERT_TRUE(tables);
  auto leaf = vtkSmartPointer<vtkCompositeDataIterator>::Take(tables->NewIterator());
  int rows = 0;
  for (leaf->InitTraversal(); !leaf->IsDoneWithTraversal(); leaf->GoToNextItem())
  {
    const auto here = vtkTable::SafeDownCast(leaf->GetCurrentDataObject())->GetNumberOfRows();
    EXPECT_EQ(here > 0, rows == 0);
    rows += static_cast<int>(here);
  }
}

TEST_F(BlocksAsOne, OfAPartitionedCollectionAndOfGridsGiveTheSame)
{
  vtkNew<vtkPolyData> reference;
  reference->ShallowCopy(this->Alone());
  vtkNew<vtkPartitionedDataSetCollection> collection;
  for (unsigned int k = 0; k < 3; ++k)
  {
    vtkNew<vtkAppendFilter> append; // an unstructured grid
    append->SetInputData(parts[k]);
    append->Update();
    vtkDataObject* part = parts[k];
    if (k == 1)
    {
      part = append->GetOutput();
    }
    vtkNew<vtkPartitionedDataSet> set;
    set->SetPartition(0, part);
    collection->SetPartitionedDataSet(k, set);
  }
  filter->SetInputDataObject(collection);
  filter->Update();
  auto* output = vtkPartitionedDataSetCollection::SafeDownCast(filter->GetOutputDataObject(0));
  ASSERT_TRUE(output);
  EXPECT_EQ(output->GetNumberOfPartitionedDataSets(), 3u);
  EXPECT_LT(this->Apart(output, reference, "Solution"), 1e-10);
}

TEST_F(BlocksAsOne, HaveTheSpectrumOfTheWholeSurface)
{
  for (const int space : { Algorithm::Grid, Algorithm::HatFunctions })
  {
    vtkNew<vtkLaplaceSpectrum> spectrum;
    this->SetUp(spectrum);
    spectrum->SetFunctionSpace(space);
    spectrum->SetNumberOfModes(9);
    spectrum->SetTolerance(1e-9);
    spectrum->SetInputDataObject(whole);
    spectrum->Update();
    const auto expected = Values(spectrum->GetOutput()->GetFieldData()->GetArray("Eigenvalues"));
    spectrum->SetInputDataObject(this->Nested());
    spectrum->Update();
    for (vtkPolyData* leaf : LeavesOf(spectrum->GetOutputDataObject(0)))
    {
      if (leaf->GetNumberOfPoints() > 0)
      {
        EXPECT_LT(
          Difference(Values(leaf->GetFieldData()->GetArray("Eigenvalues")), expected), 1e-9);
      }
    }
    EXPECT_EQ(this->ApartOnBorders(spectrum->GetOutputDataObject(0), "Mode"), 0.0);
    // Other modes come from the same solution.
    spectrum->SetMode(4);
    spectrum->Update();
    EXPECT_EQ(spectrum->GetNumberOfRuns("Solve"), 2);
    EXPECT_EQ(spectrum->GetNumberOfRuns("Space"), 2);
  }
}

TEST_F(BlocksAsOne, DistancesGoAcrossBlocks)
{
  vtkNew<vtkGeodesicDistance> distance;
  this->SetUp(distance);
  distance->SetTolerance(1e-9);
  distance->AddSourcePointId(0); // of the joined surface: the first point of the first block
  distance->SetInputDataObject(this->Nested());
  distance->Update();
  vtkNew<vtkGeodesicDistance> reference;
  this->SetUp(reference);
  reference->SetTolerance(1e-9);
  reference->AddSourcePointId(
    static_cast<vtkIdType>(parts[0]->GetPointData()->GetArray("origin")->GetComponent(0, 0)));
  reference->SetInputDataObject(whole);
  reference->Update();
  vtkDataObject* output = distance->GetOutputDataObject(0);
  EXPECT_LT(this->Apart(output, reference->GetOutput(), "Distance"), 1e-7);
  EXPECT_EQ(this->ApartOnBorders(output, "Distance"), 0.0);
  double farthest = 0.0;
  for (vtkPolyData* leaf : LeavesOf(output))
  {
    for (const double value : PointValues(leaf, "Distance"))
    {
      farthest = Larger(farthest, value);
    }
  }
  EXPECT_NEAR(farthest, M_PI, 0.15); // the other side
}

TEST_F(BlocksAsOne, ASelectionInOneBlockIsTheSourceForAll)
{
  auto selection = SelectPoints({ 5 });
  selection->GetNode(0)->GetProperties()->Set(
    vtkSelectionNode::COMPOSITE_INDEX(), 3); // the second part
  vtkNew<vtkGeodesicDistance> distance;
  this->SetUp(distance);
  distance->SetInputDataObject(0, this->Nested());
  distance->SetInputDataObject(3, selection);
  distance->Update();
  const auto leaves = LeavesOf(distance->GetOutputDataObject(0));
  const auto values = PointValues(leaves[1], "Distance");
  ASSERT_GT(values.size(), 5u);
  EXPECT_EQ(values[5], 0.0);
  EXPECT_EQ(std::count(values.begin(), values.end(), 0.0), 1);
  EXPECT_TRUE(AllFinite(PointValues(leaves[0], "Distance")));
}

TEST_F(BlocksAsOne, ASelectionInTheLastBlockIsThatOfTheWhole)
{
  std::vector<vtkIdType> ofBlock;
  std::vector<vtkIdType> ofWhole;
  vtkDataArray* origin = parts[2]->GetPointData()->GetArray("origin");
  for (vtkIdType point = 0; point < parts[2]->GetNumberOfPoints(); point += 2)
  {
    ofBlock.push_back(point);
    ofWhole.push_back(static_cast<vtkIdType>(origin->GetComponent(point, 0)));
  }
  auto inBlock = SelectPoints(ofBlock);
  inBlock->GetNode(0)->GetProperties()->Set(vtkSelectionNode::COMPOSITE_INDEX(), 6);
  vtkNew<vtkScreenedPoisson> poisson;
  vtkNew<vtkHeatDiffusion> heat;
  heat->SetDiffusionTime(0.05);
  vtkNew<vtkSurfaceDetail> detail;
  detail->SetDetailScale(3.0);
  for (const auto& [algorithm, result] :
    { std::pair<Algorithm*, const char*>{ poisson, "Solution" }, { heat, "Diffused" },
      { detail, "Filtered" } })
  {
    this->SetUp(algorithm);
    algorithm->SetInputArrayToProcess(0, 0, 0, Points, "f");
    const auto run = [&](vtkDataObject* input, vtkSelection* selection)
    {
      algorithm->SetInputDataObject(0, input);
      algorithm->SetInputDataObject(2, selection);
      algorithm->Update();
      auto output =
        vtkSmartPointer<vtkDataObject>::Take(algorithm->GetOutputDataObject(0)->NewInstance());
      output->ShallowCopy(algorithm->GetOutputDataObject(0));
      return output;
    };
    const auto blocks = run(this->Nested(), inBlock);
    const auto of = [](vtkDataObject* data) { return vtkPolyData::SafeDownCast(data); };
    const auto reference = run(whole, SelectPoints(ofWhole));
    const auto unselected = run(whole, nullptr);
    EXPECT_LT(this->Apart(blocks, of(reference), result), 1e-8) << result;
    EXPECT_GT(this->Apart(blocks, of(unselected), result), 1e-2) << result;
  }
}

TEST_F(BlocksAsOne, UnchangedInputRebuildsNothing)
{
  const auto runs = [&]
  {
    std::vector<vtkIdType> all;
    for (const char* stage : Stages)
    {
      all.push_back(filter->GetNumberOfRuns(stage));
    }
    return all;
  };
  filter->SetInputDataObject(this->Nested());
  filter->Update();
  EXPECT_EQ(runs(), (std::vector<vtkIdType>{ 1, 1, 1, 1, 1 }));
  filter->SetScreeningWeight(7.0);
  filter->Update();
  EXPECT_EQ(runs(), (std::vector<vtkIdType>{ 1, 1, 2, 1, 2 }));
  // Every hop through ParaView makes new data objects with the same arrays.
  vtkNew<vtkMultiBlockDataSet> again;
  again->ShallowCopy(this->Nested());
  filter->SetInputDataObject(again);
  filter->Update();
  EXPECT_EQ(runs(), (std::vector<vtkIdType>{ 1, 1, 2, 1, 2 }));
  // The same contents read again, and other values.
  parts[0] = Part(mesh, 0);
  filter->SetInputDataObject(this->Nested());
  filter->Update();
  EXPECT_EQ(runs(), (std::vector<vtkIdType>{ 1, 1, 2, 1, 2 }));
  for (vtkPolyData* part : parts)
  {
    AddPointArray(part, "f", 1, [](const Vec3& p, int) { return p[1]; });
  }
  filter->SetInputDataObject(this->Nested());
  filter->Update();
  EXPECT_EQ(runs(), (std::vector<vtkIdType>{ 1, 1, 2, 2, 3 }));
  EXPECT_TRUE(messages.errors.empty());
}

TEST_F(BlocksAsOne, WithoutKeepingStagesTheyAreComputedOnceAnExecution)
{
  filter->ReleaseDataFlagOn();
  filter->SetInputDataObject(this->Nested());
  filter->Update();
  EXPECT_EQ(filter->GetNumberOfRuns("Space"), 1);
  for (vtkPolyData* leaf : LeavesOf(filter->GetOutputDataObject(0)))
  {
    EXPECT_TRUE(leaf->GetNumberOfPoints() == 0 || leaf->GetPointData()->HasArray("Solution"));
  }
  filter->Modified();
  filter->Update();
  EXPECT_EQ(filter->GetNumberOfRuns("Space"), 2);
}

TEST_F(BlocksAsOne, OneWithoutTheArrayIsPassedOn)
{
  parts[1]->GetPointData()->RemoveArray("f");
  filter->SetInputDataObject(this->Nested());
  filter->Update();
  EXPECT_TRUE(messages.errors.empty());
  ExpectOne(messages.warnings, "no array 'f'");
  const auto leaves = LeavesOf(filter->GetOutputDataObject(0));
  ASSERT_EQ(leaves.size(), 4u);
  EXPECT_TRUE(leaves[0]->GetPointData()->HasArray("Solution"));
  EXPECT_FALSE(leaves[1]->GetPointData()->HasArray("Solution"));
  EXPECT_EQ(leaves[1]->GetNumberOfCells(), parts[1]->GetNumberOfCells());
  EXPECT_TRUE(leaves[3]->GetPointData()->HasArray("Solution"));
  filter->SetScreeningWeight(3.0);
  filter->Update();
  EXPECT_EQ(filter->GetNumberOfRuns("Space"), 1);
}

TEST_F(BlocksAsOne, WhatIsWrongIsSaidOnce)
{
  filter->SetInputArrayToProcess(0, 0, 0, Points, "g");
  filter->SetInputDataObject(this->Nested());
  filter->Update();
  EXPECT_EQ(messages.errors.size(), 1u);
  for (vtkPolyData* leaf : LeavesOf(filter->GetOutputDataObject(0)))
  {
    EXPECT_EQ(leaf->GetNumberOfPoints(), 0);
  }
  // One block has an array of points, another an array of cells. The surface has neither.
  vtkNew<vtkDoubleArray> cells;
  cells->SetName("f");
  cells->SetNumberOfTuples(parts[2]->GetNumberOfCells());
  cells->FillComponent(0, 1.0);
  parts[2]->GetPointData()->RemoveArray("f");
  parts[2]->GetCellData()->AddArray(cells);
  filter->SetInputArrayToProcess(0, 0, 0, Points, "f");
  filter->SetInputDataObject(this->Nested());
  filter->Update();
  ASSERT_EQ(messages.errors.size(), 2u);
  EXPECT_NE(messages.errors[1].find("(block 'third')"), std::string::npos) << messages.errors[1];
}

TEST_F(BlocksAsOne, AnEmptyInputAndAVolumeInBlocks)
{
  vtkNew<vtkMultiBlockDataSet> empty;
  empty->SetBlock(0, vtkNew<vtkPolyData>());
  empty->SetBlock(1, vtkNew<vtkPolyData>());
  filter->SetInputDataObject(empty);
  filter->Update();
  EXPECT_TRUE(messages.errors.empty());
  vtkNew<vtkImageData> box;
  box->SetDimensions(4, 4, 4);
  vtkNew<vtkMultiBlockDataSet> volumes;
  volumes->SetBlock(0, box);
  volumes->SetBlock(1, parts[0]);
  filter->SetInputDataObject(volumes);
  filter->Update();
  ExpectOne(messages.errors, "volume");
}

/// A copy of a cell that no block has gets no result: its own point has no id.
TEST_F(BlocksAsOne, ACopyWithoutItsCellHasNoId)
{
  const vtkIdType far = parts[0]->GetPoints()->InsertNextPoint(9.0, 9.0, 9.0);
  parts[0]->GetPolys()->InsertNextCell({ 0, 1, far });
  vtkNew<vtkUnsignedCharArray> ghosts;
  ghosts->SetName(vtkDataSetAttributes::GhostArrayName());
  ghosts->SetNumberOfTuples(parts[0]->GetNumberOfCells());
  ghosts->Fill(0);
  ghosts->SetValue(parts[0]->GetNumberOfCells() - 1, vtkDataSetAttributes::DUPLICATECELL);
  for (const char* name : { "f", "origin" })
  {
    parts[0]->GetPointData()->GetArray(name)->InsertNextTuple1(0.0);
  }
  parts[0]->GetCellData()->AddArray(ghosts);
  vtkNew<vtkFarthestPoints> farthest;
  this->SetUp(farthest);
  farthest->SetInputDataObject(this->Nested());
  farthest->Update();
  vtkPointData* points = LeavesOf(farthest->GetOutputDataObject(0))[0]->GetPointData();
  EXPECT_GE(points->GetArray("NearestPoint")->GetComponent(0, 0), 0);
  EXPECT_EQ(points->GetArray("NearestPoint")->GetComponent(far, 0), -1);
  EXPECT_TRUE(std::isnan(points->GetArray("Distance")->GetComponent(far, 0)));
}

TEST_F(BlocksAsOne, OffEveryBlockIsASurface)
{
  filter->BlocksAsOneOff();
  filter->SetInputDataObject(this->Nested());
  filter->Update();
  EXPECT_EQ(filter->GetNumberOfRuns("Space"), 3);
  EXPECT_GT(this->ApartOnBorders(filter->GetOutputDataObject(0), "Solution"), 1e-3);
}

/// Outputs with cells of their own are in the first block that has points.
TEST_F(BlocksAsOne, TheClipIsInTheFirstBlock)
{
  vtkNew<vtkClipToOctree> clip;
  clip->SetDepth(4);
  clip->BlocksAsOneOn();
  clip->SetInputDataObject(this->Nested());
  clip->Update();
  const auto leaves = LeavesOf(clip->GetOutputDataObject(0));
  EXPECT_GT(leaves[0]->GetNumberOfCells(), static_cast<vtkIdType>(mesh.triangles.size()));
  EXPECT_EQ(leaves[1]->GetNumberOfCells(), 0);
  // It is a surface with its basis, so solvers take it.
  vtkNew<vtkClipToOctree> reference;
  reference->SetDepth(4);
  reference->SetInputDataObject(whole);
  reference->Update();
  EXPECT_EQ(leaves[0]->GetNumberOfCells(), reference->GetOutput()->GetNumberOfCells());
}

TEST_F(BlocksAsOne, MoveTogetherThroughTheStepsOfAFlow)
{
  vtkNew<vtkMeanCurvatureFlow> flow;
  vtkNew<vtkMeanCurvatureFlow> reference;
  for (vtkMeanCurvatureFlow* each : { flow.Get(), reference.Get() })
  {
    this->SetUp(each);
    each->SetNumberOfSteps(3);
  }
  flow->SetInputDataObject(this->Nested());
  reference->SetInputDataObject(whole);
  for (const double step : { 3.0, 1.0, 0.0 })
  {
    flow->UpdateTimeStep(step);
    reference->UpdateTimeStep(step);
    double apart = 0.0;
    for (vtkPolyData* leaf : LeavesOf(flow->GetOutputDataObject(0)))
    {
      for (vtkIdType k = 0; k < leaf->GetNumberOfPoints(); ++k)
      {
        const auto origin =
          static_cast<vtkIdType>(leaf->GetPointData()->GetArray("origin")->GetComponent(k, 0));
        const Vec3 expected(reference->GetOutput()->GetPoint(origin));
        apart = Larger(apart, (Vec3(leaf->GetPoint(k)) - expected).norm());
      }
    }
    EXPECT_LT(apart, 1e-9) << step;
  }
  EXPECT_EQ(flow->GetNumberOfRuns("Space"), 1);
}

/// Reports on an earlier run are not those of this one.
TEST_F(BlocksAsOne, LoseTheReportsOfEarlierFilters)
{
  for (vtkPolyData* part : parts)
  {
    for (const char* name : { "Misfit", "Own" })
    {
      vtkNew<vtkDoubleArray> report;
      report->SetName(name);
      report->InsertNextValue(7.0);
      part->GetFieldData()->AddArray(report);
    }
  }
  filter->SetInputDataObject(this->Nested());
  filter->Update();
  for (vtkPolyData* leaf : LeavesOf(filter->GetOutputDataObject(0)))
  {
    EXPECT_FALSE(leaf->GetFieldData()->HasArray("Misfit"));
    EXPECT_EQ(leaf->GetFieldData()->HasArray("Own"), leaf->GetNumberOfPoints() > 0);
  }
}

TEST_F(BlocksAsOne, FollowTheTimesOfTheInput)
{
  vtkNew<GrowingSphere> source;
  vtkNew<vtkMultiBlockDataGroupFilter> group;
  group->AddInputConnection(source->GetOutputPort());
  group->AddInputConnection(source->GetOutputPort()); // the same piece twice counts once
  vtkNew<vtkLaplaceSpectrum> spectrum;
  this->SetUp(spectrum);
  spectrum->SetTolerance(1e-8);
  spectrum->SetNumberOfModes(4);
  spectrum->AllModesOn();
  spectrum->TrackMetricOn();
  spectrum->SetInputConnection(group->GetOutputPort());
  for (const double time : { 1.0, 3.0, 2.0 })
  {
    spectrum->UpdateTimeStep(time);
    for (vtkPolyData* leaf : LeavesOf(spectrum->GetOutputDataObject(0)))
    {
      const auto eigenvalues = Values(leaf->GetFieldData()->GetArray("Eigenvalues"));
      ASSERT_EQ(eigenvalues.size(), 4u);
      EXPECT_NEAR(eigenvalues[1] * time * time, 2.0, 0.1);
      EXPECT_EQ(FieldValue(leaf, "ReferenceTime"), 1.0);
    }
  }
  EXPECT_EQ(spectrum->GetNumberOfRuns("Solve"), 3);
  EXPECT_EQ(spectrum->GetNumberOfRuns("Space"), 1);
}

} // namespace
