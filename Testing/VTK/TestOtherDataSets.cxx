// Tests data sets that are not vtkPolyData: their surface is extracted, once.

#include "FilterSupport.h"

#include "vtkLaplaceSpectrum.h"
#include "vtkScreenedPoisson.h"

#include "vtkAppendFilter.h"
#include "vtkImageData.h"
#include "vtkMultiBlockDataSet.h"
#include "vtkUnstructuredGrid.h"
#include "vtkWeakPointer.h"

#include <gtest/gtest.h>

using namespace gridfem;
using namespace gridfem::testing;

namespace
{

/// Returns the same triangles as an unstructured grid, with points and cells in the same order.
vtkSmartPointer<vtkUnstructuredGrid> AsGrid(vtkPolyData* surface)
{
  vtkNew<vtkAppendFilter> append;
  append->SetInputData(surface);
  append->Update();
  return append->GetOutput();
}

class OtherDataSets : public ::testing::Test
{
protected:
  OtherDataSets() : messages(filter)
  {
    AddPointArray(sphere, "f", 1, Wave);
    filter->SetDepth(4);
    filter->SetTolerance(1e-10);
    filter->SetInputArrayToProcess(0, 0, 0, Points, "f");
  }

  std::vector<double> Solution(vtkDataSet* input)
  {
    filter->SetInputDataObject(input);
    filter->Update();
    return PointValues(filter->GetOutput(), "Solution");
  }

  vtkSmartPointer<vtkPolyData> sphere = ToPolyData(GeodesicSphere(8));
  vtkNew<vtkScreenedPoisson> filter;
  Messages messages;
};

} // namespace

TEST_F(OtherDataSets, AnUnstructuredGridGivesWhatItsTrianglesGive)
{
  const auto expected = this->Solution(sphere);
  const auto grid = AsGrid(sphere);
  const auto solution = this->Solution(grid);
  ASSERT_EQ(solution.size(), expected.size());
  const auto original =
    Values(filter->GetOutput()->GetPointData()->GetArray("vtkOriginalPointIds"));
  for (std::size_t k = 0; k < solution.size(); ++k)
  {
    EXPECT_NEAR(solution[k], expected[static_cast<std::size_t>(original[k])], 1e-7);
  }
  EXPECT_EQ(filter->GetOutput()->GetNumberOfCells(), sphere->GetNumberOfCells());
}

TEST_F(OtherDataSets, OnlyWhatDependsOnAChangeIsComputedAgain)
{
  const auto grid = AsGrid(sphere);
  this->Solution(grid);
  filter->SetScreeningWeight(7.0);
  filter->Update();
  EXPECT_EQ(filter->GetNumberOfRuns("System"), 1);
  // A calculator upstream gives other values on the same cells.
  vtkNew<vtkUnstructuredGrid> other;
  other->ShallowCopy(grid);
  other->GetPointData()->RemoveArray("f");
  vtkNew<vtkDoubleArray> values;
  values->SetName("f");
  values->SetNumberOfTuples(grid->GetNumberOfPoints());
  values->FillComponent(0, 3.0);
  other->GetPointData()->AddArray(values);
  for (const double value : this->Solution(other))
  {
    EXPECT_NEAR(value, 3.0, 1e-7);
  }
  EXPECT_EQ(filter->GetNumberOfRuns("System"), 1);
  EXPECT_EQ(filter->GetNumberOfRuns("RightHandSide"), 2);
}

TEST_F(OtherDataSets, AVolumeIsItsBoundary)
{
  vtkNew<vtkImageData> box;
  box->SetDimensions(9, 9, 9); // a cube of side 8
  vtkNew<vtkLaplaceSpectrum> spectrum;
  spectrum->SetInputDataObject(box);
  spectrum->SetDepth(5);
  spectrum->SetNumberOfModes(4);
  spectrum->Update();
  EXPECT_EQ(spectrum->GetOutput()->GetNumberOfPoints(), 6 * 81); // a face each
  const auto eigenvalues = Column(spectrum, "Eigenvalue");
  vtkNew<vtkLaplaceSpectrum> hats;
  hats->SetInputDataObject(box);
  hats->SetFunctionSpace(vtkSurfaceFEMAlgorithm::HatFunctions);
  hats->SetNumberOfModes(4);
  hats->Update();
  const auto onHats = Column(hats, "Eigenvalue");
  for (int k = 1; k < 4; ++k)
  {
    EXPECT_NEAR(eigenvalues[k] / onHats[k], 1.0, 0.03);
  }
}

TEST_F(OtherDataSets, AreFreedWithTheirFilter)
{
  vtkWeakPointer<vtkDataSet> input;
  {
    const auto grid = AsGrid(sphere);
    input = grid;
    vtkNew<vtkScreenedPoisson> own;
    own->SetDepth(3);
    own->SetInputDataObject(grid);
    own->Update();
    EXPECT_GT(own->GetOutput()->GetNumberOfCells(), 0);
  }
  EXPECT_EQ(input, nullptr);
}

TEST_F(OtherDataSets, CellsWithoutASurfaceAreRefused)
{
  vtkNew<vtkUnstructuredGrid> empty;
  this->filter->SetInputDataObject(empty);
  filter->Update();
  EXPECT_TRUE(messages.errors.empty());
  EXPECT_TRUE(IsEmptyData(filter->GetOutput()));

  vtkNew<vtkUnstructuredGrid> points;
  points->SetPoints(sphere->GetPoints());
  filter->SetInputDataObject(points);
  ExpectRefused(filter, "no surface");
}

/// Makes the filter's input of blocks, only some of which have the array.
vtkSmartPointer<vtkMultiBlockDataSet> Blocks(vtkPolyData* block, std::initializer_list<bool> have)
{
  auto blocks = vtkSmartPointer<vtkMultiBlockDataSet>::New();
  unsigned int index = 0;
  for (const bool has : have)
  {
    vtkNew<vtkPolyData> copy;
    copy->ShallowCopy(block);
    if (!has)
    {
      copy->GetPointData()->RemoveArray("f");
    }
    blocks->SetBlock(index++, copy);
  }
  return blocks;
}

TEST_F(OtherDataSets, ABlockWithoutTheArrayIsPassedOn)
{
  filter->SetInputDataObject(Blocks(sphere, { true, false, true }));
  filter->Update();
  EXPECT_TRUE(messages.errors.empty());
  ExpectOne(messages.warnings, "no array 'f'");
  auto* output = vtkMultiBlockDataSet::SafeDownCast(filter->GetOutputDataObject(0));
  ASSERT_TRUE(output);
  for (unsigned int block = 0; block < 3; ++block)
  {
    auto* surface = vtkPolyData::SafeDownCast(output->GetBlock(block));
    ASSERT_TRUE(surface);
    EXPECT_EQ(surface->GetNumberOfCells(), sphere->GetNumberOfCells());
    EXPECT_EQ(surface->GetPointData()->HasArray("Solution"), block != 1);
  }
}

TEST_F(OtherDataSets, AnArrayThatNoBlockHasIsAnError)
{
  filter->SetInputDataObject(Blocks(sphere, { false, false }));
  filter->Update();
  EXPECT_EQ(messages.errors.size(), 2u); // of each block
  EXPECT_TRUE(messages.warnings.empty());
}
