// Tests Connectivity-Aware Basis: arrays of the basis, its levels, splitting, evaluation.

#include "FilterSupport.h"

#include "Grid/TriangleMesh.h"

#include "vtkClipToOctree.h"
#include "vtkConnectivityAwareBasis.h"
#include "vtkScreenedPoisson.h"

#include "vtkIdTypeArray.h"
#include "vtkPointData.h"
#include "vtkUnstructuredGrid.h"

#include <gtest/gtest.h>

#include <map>
#include <set>

using namespace gridfem;
using namespace gridfem::testing;

namespace
{

vtkUnstructuredGrid* BasisOutput(vtkConnectivityAwareBasis* filter)
{
  filter->Update();
  return vtkUnstructuredGrid::SafeDownCast(filter->GetOutputDataObject(1));
}

vtkSmartPointer<vtkConnectivityAwareBasis> MakeBasis(const TriangleMesh& mesh, int depth)
{
  auto filter = vtkSmartPointer<vtkConnectivityAwareBasis>::New();
  filter->SetDepth(depth);
  filter->SetInputData(ToPolyData(mesh));
  filter->Update();
  return filter;
}

/// There is one sheet in one layer of cells and two in the next. The second patch of a cell stands
/// out, and the first has the color of the cell.
TEST(ConnectivityAwareBasis, PatchesThatShareACellHaveTheirOwnColors)
{
  const TriangleMesh sheet = FlatRectangle(10, 10);
  TriangleMesh sheets;
  for (const double height : { 0.0, 0.02, 0.03 }) // the grid has a plane in the middle of them
  {
    const Id first = static_cast<Id>(sheets.points.size());
    for (const Vec3& point : sheet.points)
    {
      sheets.points.push_back(point + Vec3(0.0, 0.0, height));
    }
    for (const auto& corners : sheet.triangles)
    {
      sheets.triangles.push_back({ corners[0] + first, corners[1] + first, corners[2] + first });
    }
  }
  auto filter = MakeBasis(sheets, 3);
  vtkCellData* cells = filter->GetOutput()->GetCellData();
  const auto cellColor = Values(cells->GetArray("OctreeCellColor"));
  const auto patchColor = Values(cells->GetArray("PatchColor"));
  const auto patch = Values(cells->GetArray("PatchId"));
  std::map<double, std::set<double>> patches; // of each color
  for (std::size_t cell = 0; cell < patchColor.size(); ++cell)
  {
    const bool isSecond = patchColor[cell] >= 8;
    EXPECT_EQ(patchColor[cell], cellColor[cell] + (isSecond ? 8 : 0));
    patches[isSecond].insert(patch[cell]);
  }
  EXPECT_EQ(patches[false].size(), 128u);
  EXPECT_EQ(patches[true].size(), 64u);
}

TEST(ConnectivityAwareBasis, TablesFitTheMesh)
{
  auto filter = MakeBasis(GeodesicSphere(6), 4);
  vtkPolyData* output = filter->GetOutput();
  vtkDataArray* basisIds = output->GetFieldData()->GetArray("PatchBasisIds");
  vtkDataArray* patchCell = output->GetFieldData()->GetArray("PatchCellId");
  vtkDataArray* patchId = output->GetCellData()->GetArray("PatchId");
  ASSERT_TRUE(basisIds && patchCell && patchId);
  EXPECT_EQ(basisIds->GetNumberOfComponents(), 8);
  EXPECT_EQ(basisIds->GetDataType(), VTK_ID_TYPE);
  EXPECT_EQ(patchCell->GetNumberOfTuples(), basisIds->GetNumberOfTuples());
  const auto octreeCell = Values(output->GetCellData()->GetArray("OctreeCellId"));
  for (vtkIdType cell = 0; cell < output->GetNumberOfCells(); ++cell)
  {
    const auto patch = vtkIdType(patchId->GetComponent(cell, 0));
    EXPECT_EQ(patchCell->GetComponent(patch, 0), octreeCell[cell]);
  }
  const auto ids = Values(basisIds);
  const std::set<double> different(ids.begin(), ids.end());
  EXPECT_EQ(double(different.size()), FieldValue(output, "NumberOfBasisFunctions"));
  EXPECT_EQ(*different.begin(), 0.0);
}

TEST(ConnectivityAwareBasis, FunctionsSumToOne)
{
  auto filter = MakeBasis(GeodesicSphere(4), 2);
  std::vector<double> sum(filter->GetOutput()->GetNumberOfPoints(), 0.0);
  const int count = int(FieldValue(filter->GetOutput(), "NumberOfBasisFunctions"));
  for (int id = 0; id < count; ++id)
  {
    filter->SetBasisId(id);
    filter->Update();
    const auto values = PointValues(filter->GetOutput(), "BasisFunction");
    for (std::size_t k = 0; k < sum.size(); ++k)
    {
      EXPECT_GE(values[k], -1e-12);
      sum[k] += values[k];
    }
  }
  EXPECT_LT(Difference(sum, std::vector<double>(sum.size(), 1.0)), 1e-12);
  EXPECT_EQ(filter->GetNumberOfRuns("Space"), 1);
}

TEST(ConnectivityAwareBasis, ACoarseFunctionIsTrilinearAroundItsCorner)
{
  auto filter = MakeBasis(GeodesicSphere(4), 4);
  filter->SetLevel(0); // eight functions: the corners of the cube
  filter->SetBasisId(0);
  vtkUnstructuredGrid* basis = BasisOutput(filter);
  ASSERT_EQ(basis->GetNumberOfPoints(), 8);
  const Vec3 corner(basis->GetPoint(0));
  const double side = 16 * FieldValue(filter->GetOutput(), "GridSpacing");
  const auto values = PointValues(filter->GetOutput(), "BasisFunction");
  for (std::size_t k = 0; k < values.size(); ++k)
  {
    const Vec3 away = (Vec3(filter->GetOutput()->GetPoint(k)) - corner).cwiseAbs() / side;
    EXPECT_NEAR(values[k], (1 - away[0]) * (1 - away[1]) * (1 - away[2]), 1e-12);
  }
}

TEST(ConnectivityAwareBasis, AWrongBasisIdIsRefusedByNumber)
{
  auto filter = MakeBasis(GeodesicSphere(4), 3);
  filter->SetBasisId(1000000);
  ExpectRefused(filter, "Basis Id 1000000");
}

TEST(ConnectivityAwareBasis, VoxelsShowFunctionsAndTheirSupport)
{
  const TriangleMesh mesh = GeodesicSphere(6);
  auto filter = MakeBasis(mesh, 4);
  for (const int level : { 14, 3, 1 })
  {
    filter->SetLevel(level);
    vtkUnstructuredGrid* basis = BasisOutput(filter);
    vtkPointData* data = basis->GetPointData();
    double sum = 0.0;
    for (vtkIdType k = 0; k < basis->GetNumberOfPoints(); ++k)
    {
      EXPECT_EQ(data->GetArray("BasisId")->GetComponent(k, 0), k);
      EXPECT_EQ(data->GetArray("Component")->GetComponent(k, 0), 0);
      sum += data->GetArray("SupportArea")->GetComponent(k, 0);
    }
    EXPECT_NEAR(sum, 8 * SurfaceArea(mesh), 1e-10); // every patch touches eight functions
    EXPECT_EQ(basis->GetCellType(0), VTK_VOXEL);
    EXPECT_EQ(basis->GetCellData()->GetArray("Level")->GetComponent(0, 0), std::min(level, 4));
  }
}

TEST(ConnectivityAwareBasis, NearSheetsAreSplitWhenAware)
{
  auto filter = MakeBasis(TwoSheets(8, 0.01), 4);
  const double aware = FieldValue(filter->GetOutput(), "NumberOfBasisFunctions");
  const auto component = Values(BasisOutput(filter)->GetPointData()->GetArray("Component"));
  EXPECT_EQ(std::set<double>(component.begin(), component.end()), (std::set<double>{ 0, 1 }));
  filter->ConnectivityAwareOff();
  filter->Update();
  EXPECT_LT(FieldValue(filter->GetOutput(), "NumberOfBasisFunctions"), aware);
  EXPECT_EQ(FieldValue(filter->GetOutput(), "ConnectivityAware"), 0);
}

TEST(ConnectivityAwareBasis, WeldingMakesASoupTheSameBasis)
{
  const TriangleMesh mesh = GeodesicSphere(5);
  const double welded = FieldValue(MakeBasis(mesh, 4)->GetOutput(), "NumberOfBasisFunctions");
  auto soup = MakeBasis(Unweld(mesh), 4);
  EXPECT_EQ(FieldValue(soup->GetOutput(), "NumberOfBasisFunctions"), welded);
  soup->WeldCoincidentPointsOff();
  soup->Update();
  EXPECT_GT(FieldValue(soup->GetOutput(), "NumberOfBasisFunctions"), welded);
}

TEST(ConnectivityAwareBasis, AClippedInputGivesTheSameBasis)
{
  const TriangleMesh mesh = Unweld(TrefoilTube(60, 8, 0.3));
  auto direct = MakeBasis(mesh, 4);
  vtkNew<vtkClipToOctree> clip;
  clip->SetDepth(4);
  clip->SetInputData(ToPolyData(mesh));
  vtkNew<vtkConnectivityAwareBasis> chained;
  chained->SetDepth(7); // not used, because the clip has the grid
  chained->SetInputConnection(clip->GetOutputPort());
  chained->Update();
  for (const char* name : { "PatchBasisIds", "PatchCellId", "OctreeCells", "GridDepth" })
  {
    EXPECT_EQ(Values(chained->GetOutput()->GetFieldData()->GetArray(name)),
      Values(direct->GetOutput()->GetFieldData()->GetArray(name)))
      << name;
  }
  EXPECT_EQ(Values(chained->GetOutput()->GetCellData()->GetArray("PatchId")),
    Values(direct->GetOutput()->GetCellData()->GetArray("PatchId")));
}

/// The corners coincide: two corners of a triangle are one point then, and both belong to the
/// surface.
TEST(ConnectivityAwareBasis, IsReadForAMeshWithATriangleThatIsALine)
{
  TriangleMesh mesh = Unweld(GeodesicSphere(5));
  const auto& corner = mesh.triangles[17];
  mesh.points[corner[2]] = mesh.points[corner[1]];
  vtkSmartPointer<vtkPolyData> data = ToPolyData(mesh);
  vtkNew<vtkConnectivityAwareBasis> basis;
  basis->SetDepth(4);
  basis->ReleaseDataFlagOn(); // so that it is read from its arrays
  basis->SetInputData(data);
  vtkNew<vtkScreenedPoisson> alone;
  vtkNew<vtkScreenedPoisson> given;
  given->SetBasisConnection(basis->GetOutputPort());
  for (vtkScreenedPoisson* solver : { alone.Get(), given.Get() })
  {
    solver->SetDepth(4);
    solver->SetTolerance(1e-12);
    solver->SetInputData(data);
    solver->Update();
  }
  EXPECT_EQ(given->GetErrorCode(), 0UL);
  const auto values = Values(given->GetOutput()->GetPointData()->GetArray("Solution"));
  const auto expected = Values(alone->GetOutput()->GetPointData()->GetArray("Solution"));
  ASSERT_EQ(values.size(), expected.size());
  for (std::size_t k = 0; k < values.size(); ++k)
  {
    ASSERT_NEAR(values[k], expected[k], 1e-9) << k;
  }
}

TEST(ConnectivityAwareBasis, AMissingClipArrayIsRefusedByName)
{
  vtkNew<vtkClipToOctree> clip;
  clip->SetDepth(3);
  clip->SetInputData(ToPolyData(GeodesicSphere(4)));
  clip->Update();
  vtkNew<vtkPolyData> damaged;
  damaged->ShallowCopy(clip->GetOutput());
  damaged->GetFieldData()->RemoveArray("GridSpacing");
  vtkNew<vtkConnectivityAwareBasis> filter;
  filter->SetInputData(damaged);
  ExpectRefused(filter, "'GridSpacing'");
}

} // namespace
