// Tests that three ways of working give the same answer, through memory and through files. They are
// one filter on a mesh; clip, basis and solver in a chain; and one basis for several solvers.

#include "FilterSupport.h"

#include "vtkClipToOctree.h"
#include "vtkConnectivityAwareBasis.h"
#include "vtkLaplaceSpectrum.h"
#include "vtkScreenedPoisson.h"

#include "vtkTransform.h"
#include "vtkTransformFilter.h"
#include "vtkXMLPolyDataReader.h"
#include "vtkXMLPolyDataWriter.h"

#include <gtest/gtest.h>

using namespace gridfem;
using namespace gridfem::testing;

namespace
{

vtkSmartPointer<vtkPolyData> MakeInput(int precision = VTK_DOUBLE)
{
  auto data = ToPolyData(Torus(30, 14, 1.0, 0.4), precision);
  AddPointArray(data, "f", 1, [](const Vec3& p, int) { return std::sin(4 * p[0]) + p[1] * p[2]; });
  return data;
}

/// Returns the data that a file keeps: everything but the shortcuts in memory.
vtkSmartPointer<vtkPolyData> ThroughFile(vtkPolyData* data)
{
  vtkNew<vtkXMLPolyDataWriter> writer;
  writer->SetInputData(data);
  writer->SetWriteToOutputString(true);
  writer->Write();
  vtkNew<vtkXMLPolyDataReader> reader;
  reader->SetReadFromInputString(true);
  reader->SetInputString(writer->GetOutputString());
  reader->Update();
  return reader->GetOutput();
}

class Pipeline : public ::testing::Test
{
protected:
  Pipeline() : Pipeline(MakeInput()) {}

  explicit Pipeline(vtkSmartPointer<vtkPolyData> mesh) : input(mesh), messages(solver)
  {
    clip->SetDepth(4);
    clip->SetInputData(input);
    basis->SetInputConnection(clip->GetOutputPort());
    directBasis->SetDepth(4);
    directBasis->SetInputData(input);
    solver->SetDepth(4);
    solver->SetTolerance(1e-12);
    solver->SetInputArrayToProcess(0, 0, 0, Points, "f");
  }

  /// The solution at the input's points.
  std::vector<double> Solve(vtkPolyData* mesh, vtkPolyData* basisData = nullptr)
  {
    solver->SetInputData(0, mesh);
    if (basisData)
    {
      solver->SetInputData(1, basisData);
    }
    else
    {
      solver->RemoveAllInputConnections(1);
    }
    solver->Update();
    auto values = PointValues(solver->GetOutput(), "Solution");
    EXPECT_EQ(values.size(), std::size_t(mesh->GetNumberOfPoints()));
    values.resize(std::min(values.size(), std::size_t(input->GetNumberOfPoints())));
    return values;
  }

  void ExpectPairRefused(vtkPolyData* mesh, vtkPolyData* basisData, const std::string& reason)
  {
    solver->SetInputData(0, mesh);
    solver->SetInputData(1, basisData);
    ExpectRefused(solver, reason);
  }

  vtkSmartPointer<vtkPolyData> input;
  vtkNew<vtkClipToOctree> clip;
  vtkNew<vtkConnectivityAwareBasis> basis;
  vtkNew<vtkConnectivityAwareBasis> directBasis;
  vtkNew<vtkScreenedPoisson> solver;
  Messages messages;
};

// The ways differ by rounding, because clipped triangles are summed in another order and cut points
// go through world coordinates. The solver's tolerance of 1e-12 hardly enlarges it.
constexpr double SameAnswer = 1e-9;

TEST_F(Pipeline, ChainAndSharedBasisGiveTheAnswerOfOneFilter)
{
  const auto alone = this->Solve(input);
  basis->Update();
  directBasis->Update();
  EXPECT_LT(Difference(this->Solve(basis->GetOutput()), alone), SameAnswer);
  EXPECT_LT(Difference(this->Solve(directBasis->GetOutput()), alone), SameAnswer);
  EXPECT_LT(Difference(this->Solve(input, basis->GetOutput()), alone), SameAnswer);
  EXPECT_EQ(this->Solve(input, directBasis->GetOutput()), alone);
}

TEST_F(Pipeline, ABasisFromAFileGivesTheSameAnswer)
{
  const auto alone = this->Solve(input);
  basis->Update();
  directBasis->Update();
  for (vtkPolyData* live : { basis->GetOutput(), directBasis->GetOutput() })
  {
    auto stored = ThroughFile(live);
    EXPECT_LT(Difference(this->Solve(stored), alone), SameAnswer);
    EXPECT_LT(Difference(this->Solve(input, stored), alone), SameAnswer);
  }
}

TEST_F(Pipeline, AClipFromAFileGivesTheSameBasis)
{
  clip->Update();
  directBasis->Update();
  basis->SetInputData(ThroughFile(clip->GetOutput()));
  basis->Update();
  EXPECT_EQ(Values(basis->GetOutput()->GetFieldData()->GetArray("PatchBasisIds")),
    Values(directBasis->GetOutput()->GetFieldData()->GetArray("PatchBasisIds")));
}

TEST_F(Pipeline, APlainBasisSurvivesAFile)
{
  solver->ConnectivityAwareOff();
  const auto alone = this->Solve(input);
  directBasis->ConnectivityAwareOff();
  directBasis->Update();
  auto stored = ThroughFile(directBasis->GetOutput());
  solver->ConnectivityAwareOn(); // not used: the basis decides
  EXPECT_LT(Difference(this->Solve(stored), alone), SameAnswer);
}

TEST_F(Pipeline, ASoupSurvivesAFile)
{
  auto soup = ToPolyData(Unweld(Torus(30, 14, 1.0, 0.4)));
  AddPointArray(soup, "f", 1, [](const Vec3& p, int) { return std::sin(4 * p[0]); });
  input = soup;
  const auto alone = this->Solve(soup);
  directBasis->SetInputData(soup);
  directBasis->Update();
  EXPECT_LT(Difference(this->Solve(ThroughFile(directBasis->GetOutput())), alone), SameAnswer);
}

TEST_F(Pipeline, SinglePrecisionPointsCostOnlyTheirRounding)
{
  input = MakeInput(VTK_FLOAT);
  const auto alone = this->Solve(input);
  directBasis->SetInputData(input);
  directBasis->Update();
  auto stored = ThroughFile(directBasis->GetOutput());
  // Cut points are rounded to 1e-7; the solution follows smoothly.
  EXPECT_LT(Difference(this->Solve(stored), alone), 1e-5);
  EXPECT_LT(Difference(this->Solve(input, stored), alone), 1e-5);
}

TEST_F(Pipeline, PolygonsFindTheirTrianglesAgain)
{
  // Quads: the basis stores the cell, the solver finds the triangle.
  vtkNew<vtkPolyData> quads;
  vtkNew<vtkPoints> points;
  points->SetDataTypeToDouble();
  vtkNew<vtkCellArray> polys;
  for (int k = 0; k < 4; ++k)
  {
    points->InsertNextPoint(k, 0.0, 0.3 * k * k);
    points->InsertNextPoint(k, 1.0, 0.5 * k);
  }
  for (vtkIdType k = 0; k < 3; ++k)
  {
    polys->InsertNextCell({ 2 * k, 2 * k + 1, 2 * k + 3, 2 * k + 2 });
  }
  quads->SetPoints(points);
  quads->SetPolys(polys);
  AddPointArray(quads, "f", 1, [](const Vec3& p, int) { return std::sin(p[0]) + p[1]; });
  input = quads;
  const auto alone = this->Solve(quads);
  directBasis->SetInputData(quads);
  directBasis->Update();
  auto stored = ThroughFile(directBasis->GetOutput());
  EXPECT_LT(Difference(this->Solve(quads, stored), alone), SameAnswer);
}

TEST_F(Pipeline, TwoSolversShareOneSystem)
{
  directBasis->Update();
  solver->SetInputData(0, input);
  solver->SetInputConnection(1, directBasis->GetOutputPort());
  solver->Update();
  vtkNew<vtkLaplaceSpectrum> spectrum;
  spectrum->SetNumberOfModes(4);
  spectrum->SetInputConnection(directBasis->GetOutputPort()); // the basis on port 0 this time
  spectrum->Update();
  EXPECT_EQ(solver->GetNumberOfRuns("System"), 1);
  EXPECT_EQ(spectrum->GetNumberOfRuns("System"), 0);
  EXPECT_EQ(FieldValue(spectrum->GetOutput(), "Converged"), 1);
}

TEST_F(Pipeline, ANaNInAnUnusedPointDoesNotDefeatASharedBasis)
{
  const double nowhere[] = { std::nan(""), 0, 0 };
  input->GetPoints()->InsertNextPoint(nowhere);
  AddPointArray(input, "f", 1, [](const Vec3& p, int) { return p[1]; });
  auto alone = this->Solve(input);
  directBasis->Update();
  auto shared = this->Solve(input, directBasis->GetOutput());
  alone.pop_back();
  shared.pop_back();
  EXPECT_EQ(shared, alone); // exactly: the basis is taken as it is
}

TEST_F(Pipeline, WithoutKeptStagesABasisIsReadFromItsArrays)
{
  const auto alone = this->Solve(input);
  directBasis->ReleaseDataFlagOn();
  directBasis->Update();
  EXPECT_LT(Difference(this->Solve(input, directBasis->GetOutput()), alone), SameAnswer);
  EXPECT_LT(Difference(this->Solve(directBasis->GetOutput()), alone), SameAnswer);
}

TEST_F(Pipeline, AnArrayChangedBeforeTheChainDoesNotRebuildIt)
{
  solver->SetInputConnection(0, basis->GetOutputPort());
  solver->Update();
  AddPointArray(input, "f", 1, [](const Vec3& p, int) { return p[1]; });
  input->Modified();
  solver->Update();
  EXPECT_EQ(clip->GetNumberOfRuns("Space"), 1);
  EXPECT_EQ(basis->GetNumberOfRuns("Space"), 1);
  EXPECT_EQ(solver->GetNumberOfRuns("Space"), 1);
  EXPECT_EQ(solver->GetNumberOfRuns("Hierarchy"), 1);
  EXPECT_EQ(solver->GetNumberOfRuns("Solve"), 2);
  basis->SetBasisId(3); // shows a function; solves nothing
  solver->Update();
  EXPECT_EQ(solver->GetNumberOfRuns("Space"), 1);
}

TEST_F(Pipeline, ABasisOfAnotherMeshIsRefused)
{
  directBasis->Update();
  auto moved = MakeInput();
  moved->GetPoints()->SetPoint(40, 0.5, 0.5, 0.5);
  this->ExpectPairRefused(moved, directBasis->GetOutput(), "made from another mesh");
}

TEST_F(Pipeline, ABasisOfALargerMeshIsRefused)
{
  auto smaller = MakeInput();
  vtkNew<vtkCellArray> polys;
  for (vtkIdType cell = 0; cell < smaller->GetNumberOfCells() / 2; ++cell)
  {
    vtkNew<vtkIdList> ids;
    smaller->GetCellPoints(cell, ids);
    polys->InsertNextCell(ids);
  }
  smaller->SetPolys(polys);
  directBasis->Update();
  this->ExpectPairRefused(smaller, directBasis->GetOutput(), "made from another mesh");
}

TEST_F(Pipeline, ABasisOfTheSameCellsInAnotherOrderIsRefused)
{
  auto reversed = MakeInput();
  vtkNew<vtkCellArray> polys;
  for (vtkIdType cell = reversed->GetNumberOfCells() - 1; cell >= 0; --cell)
  {
    vtkNew<vtkIdList> ids;
    reversed->GetCellPoints(cell, ids);
    polys->InsertNextCell(ids);
  }
  reversed->SetPolys(polys);
  directBasis->Update();
  this->ExpectPairRefused(reversed, directBasis->GetOutput(), "another order");
}

TEST_F(Pipeline, AMeshThatIsNoBasisIsRefusedOnPortOne)
{
  clip->Update();
  this->ExpectPairRefused(input, clip->GetOutput(), "not the output of a basis filter");
}

TEST_F(Pipeline, DamagedTablesAreRefusedByName)
{
  directBasis->Update();
  auto stored = ThroughFile(directBasis->GetOutput());
  struct Damage
  {
    const char* array;
    bool isCellData;
    double value;
  };
  const Damage damages[] = { { "PatchId", true, -1 }, { "PatchId", true, 1e9 },
    { "PatchId", true, std::nan("") }, { "OctreeCellId", true, 1e9 },
    { "PatchBasisIds", false, -5 }, { "PatchBasisIds", false, 1e12 }, { "PatchCellId", false, 1e9 },
    { "OctreeCells", false, 16 }, { "GridDepth", false, 77 }, { "GridSpacing", false, 0 },
    { "GridOrigin", false, INFINITY }, { "NumberOfBasisFunctions", false, 1e12 },
    { "NumberOfBasisFunctions", false, 2e9 }, { "GridSpacing", false, 1e-320 },
    // In range: functions of other corners of the grid.
    { "PatchBasisIds", false, 1 }, { "PatchBasisIds", false, 200 } };
  for (const Damage& damage : damages)
  {
    vtkNew<vtkPolyData> damaged;
    damaged->ShallowCopy(stored);
    vtkFieldData* place = damage.isCellData ? static_cast<vtkFieldData*>(damaged->GetCellData())
                                            : damaged->GetFieldData();
    vtkDataArray* original = place->GetArray(damage.array);
    vtkNew<vtkDoubleArray> array; // holds any value
    array->DeepCopy(original);
    array->SetName(damage.array);
    array->SetComponent(0, 0, damage.value);
    place->AddArray(array);
    solver->SetInputData(0, damaged);
    SCOPED_TRACE(damage.value);
    ExpectRefused(solver, damage.array);
  }
}

TEST_F(Pipeline, AMovedBasisIsRefused)
{
  directBasis->Update();
  vtkNew<vtkTransform> transform;
  transform->Translate(0.3, 0, 0);
  vtkNew<vtkTransformFilter> move;
  move->SetTransform(transform);
  move->SetInputData(directBasis->GetOutput());
  move->Update();
  solver->SetInputData(0, move->GetOutput());
  ExpectRefused(solver, "moved");
}

TEST_F(Pipeline, DroppedCellsLeaveAUsableBasis)
{
  directBasis->Update();
  vtkNew<vtkPolyData> part;
  part->ShallowCopy(directBasis->GetOutput());
  vtkNew<vtkCellArray> polys;
  vtkNew<vtkPolyData> kept;
  kept->SetPoints(part->GetPoints());
  kept->GetPointData()->ShallowCopy(part->GetPointData());
  kept->GetFieldData()->ShallowCopy(part->GetFieldData());
  kept->GetCellData()->CopyAllocate(part->GetCellData());
  for (vtkIdType cell = 0; cell < part->GetNumberOfCells() / 2; ++cell)
  {
    vtkNew<vtkIdList> ids;
    part->GetCellPoints(cell, ids);
    kept->GetCellData()->CopyData(part->GetCellData(), cell, polys->InsertNextCell(ids));
  }
  kept->SetPolys(polys);
  solver->SetInputData(0, kept);
  EXPECT_EQ(solver->GetExecutive()->Update(), 1);
  EXPECT_TRUE(messages.errors.empty() && messages.warnings.empty());
  const auto solution = PointValues(solver->GetOutput(), "Solution");
  std::vector<char> isUsed(solution.size(), 0);
  for (vtkIdType cell = 0; cell < kept->GetNumberOfCells(); ++cell)
  {
    vtkNew<vtkIdList> ids;
    kept->GetCellPoints(cell, ids);
    for (vtkIdType k = 0; k < ids->GetNumberOfIds(); ++k)
    {
      isUsed[ids->GetId(k)] = 1;
    }
  }
  for (std::size_t point = 0; point < solution.size(); ++point)
  {
    ASSERT_EQ(std::isfinite(solution[point]), isUsed[point] != 0) << point;
  }
}

} // namespace
