// Tests data sets that are not vtkPolyData: their surface is extracted, once.

#include "FilterSupport.h"

#include "vtkHarmonicInterpolation.h"
#include "vtkLaplaceSpectrum.h"
#include "vtkScreenedPoisson.h"

#include "vtkAppendFilter.h"
#include "vtkCompositeDataIterator.h"
#include "vtkErrorCode.h"
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

/// "f" is an array of cells in one block. The filter looks for an array of points.
TEST_F(OtherDataSets, AnArrayThatBlocksHaveOnlyOfTheOtherKindIsAnError)
{
  const auto blocks = Blocks(sphere, { false, false });
  vtkNew<vtkDoubleArray> cells;
  cells->SetName("f");
  cells->SetNumberOfTuples(sphere->GetNumberOfCells());
  cells->Fill(1.0);
  vtkPolyData::SafeDownCast(blocks->GetBlock(1))->GetCellData()->AddArray(cells);
  filter->SetInputDataObject(blocks);
  filter->Update();
  EXPECT_EQ(messages.errors.size(), 2u);
  EXPECT_TRUE(messages.warnings.empty());
}

/// The blocks have the array that the places lack.
TEST_F(OtherDataSets, AnArrayThatPlacesLackIsAnErrorForBlocks)
{
  for (const bool isFurther : { false, true })
  {
    const auto places = ToPolyData(GeodesicSphere(2));
    AddPointArray(places, isFurther ? "f" : "other", 1, Wave);
    AddPointArray(sphere, "further", 1, Wave);
    vtkNew<vtkHarmonicInterpolation> interpolation;
    interpolation->SetDepth(4);
    interpolation->SetInputDataObject(0, Blocks(sphere, { true, true }));
    interpolation->SetInputDataObject(2, places);
    interpolation->SetInputArrayToProcess(0, 0, 0, Points, "f");
    interpolation->AddFurtherArray(isFurther ? "further" : nullptr);
    const Messages ofThis(interpolation);
    interpolation->Update();
    EXPECT_EQ(ofThis.errors.size(), 2u) << isFurther;
    EXPECT_TRUE(ofThis.warnings.empty()) << isFurther;
  }
}

TEST_F(OtherDataSets, TheErrorCodeTellsThatABlockFailed)
{
  const auto blocks = Blocks(sphere, { true, true });
  vtkPolyData::SafeDownCast(blocks->GetBlock(0))->GetPointData()->RemoveArray("f");
  AddPointArray(vtkPolyData::SafeDownCast(blocks->GetBlock(0)), "f", 1,
    [](const Vec3&, int) { return std::nan(""); });
  filter->SetInputDataObject(blocks);
  filter->Update();
  ExpectOne(messages.errors, "NaN");
  EXPECT_EQ(filter->GetErrorCode(), static_cast<unsigned long>(vtkErrorCode::UnknownError));
  filter->SetInputDataObject(Blocks(sphere, { true, true }));
  filter->Update();
  EXPECT_EQ(filter->GetErrorCode(), static_cast<unsigned long>(vtkErrorCode::NoError));
}

namespace
{

/// Aborts a filter once, in its second block.
class AbortInSecondBlock
{
public:
  explicit AbortInSecondBlock(vtkAlgorithm* filter)
  {
    vtkNew<vtkCallbackCommand> listen;
    listen->SetClientData(&starts_);
    listen->SetCallback(
      [](vtkObject* caller, unsigned long event, void* client, void*)
      {
        constexpr int OfSecondBlock = 3; // the first is that of the whole
        int& starts = *static_cast<int*>(client);
        starts += event == vtkCommand::StartEvent ? 1 : 0;
        auto* algorithm = static_cast<vtkAlgorithm*>(caller);
        if (starts == OfSecondBlock && algorithm->GetProgress() > 0.0)
        {
          algorithm->SetAbortExecute(1);
          ++starts;
        }
      });
    filter->AddObserver(vtkCommand::StartEvent, listen);
    filter->AddObserver(vtkCommand::ProgressEvent, listen);
  }

private:
  int starts_ = 0;
};

} // namespace

TEST_F(OtherDataSets, AnAbortInOneBlockEmptiesAll)
{
  const AbortInSecondBlock abort(filter);
  filter->SetInputDataObject(Blocks(sphere, { true, true, true }));
  filter->Update();
  EXPECT_TRUE(messages.errors.empty());
  EXPECT_EQ(filter->GetNumberOfRuns("Solve"), 1); // the first block had a result
  EXPECT_EQ(filter->GetErrorCode(), static_cast<unsigned long>(vtkErrorCode::NoError));
  for (int port = 0; port < 2; ++port)
  {
    auto* output = vtkCompositeDataSet::SafeDownCast(filter->GetOutputDataObject(port));
    ASSERT_TRUE(output);
    output->Print(std::cerr);
    const auto leaf = vtkSmartPointer<vtkCompositeDataIterator>::Take(output->NewIterator());
    for (leaf->InitTraversal(); !leaf->IsDoneWithTraversal(); leaf->GoToNextItem())
    {
      EXPECT_TRUE(IsEmptyData(leaf->GetCurrentDataObject())) << port;
    }
  }
}
