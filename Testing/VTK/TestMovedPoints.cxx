// Tests that arrays of a shape do not outlive it: normals, clip, basis and modes of a mesh whose
// points have moved since, and modes of another mesh.

#include "Spectra.h"

#include "Grid/TriangleMesh.h"

#include "vtkClipToOctree.h"
#include "vtkConnectivityAwareBasis.h"
#include "vtkLaplaceSpectrum.h"
#include "vtkScreenedPoisson.h"
#include "vtkSpectralSignatures.h"

#include "vtkPolyDataNormals.h"
#include "vtkTransform.h"
#include "vtkTransformFilter.h"

#include <gtest/gtest.h>

using namespace gridfem;
using namespace gridfem::testing;

namespace
{

vtkSmartPointer<vtkPolyData> Scaled(vtkPolyData* data, double x, double y, double z)
{
  vtkNew<vtkTransform> transform;
  transform->Scale(x, y, z);
  vtkNew<vtkTransformFilter> scale;
  scale->SetTransform(transform);
  scale->SetInputData(data);
  scale->Update();
  return scale->GetPolyDataOutput();
}

class MovedPoints : public ::testing::Test
{
protected:
  MovedPoints() : messages(signatures)
  {
    signatures->SetDepth(5);
    signatures->SetNumberOfModes(16);
  }

  std::vector<double> EigenvaluesFor(vtkPolyData* data)
  {
    signatures->SetInputData(data);
    signatures->Update();
    return Column(signatures, "Eigenvalue");
  }

  vtkIdType Solves() { return signatures->GetNumberOfRuns("Solve"); }

  vtkSmartPointer<vtkPolyData> sphere = ToPolyData(GeodesicSphere(16));
  vtkNew<vtkSpectralSignatures> signatures;
  Messages messages;
};

TEST_F(MovedPoints, NormalsFollowAndClipBasisAndModesGo)
{
  vtkNew<vtkPolyDataNormals> normals;
  normals->SetInputData(sphere);
  normals->ComputeCellNormalsOn();
  vtkNew<vtkConnectivityAwareBasis> basis;
  basis->SetInputConnection(normals->GetOutputPort());
  basis->SetDepth(5);
  basis->Update();
  auto before = WithModes(basis->GetOutput(), 16);
  ASSERT_TRUE(before->GetPointData()->GetNormals() && before->GetCellData()->GetNormals());

  signatures->SetInputData(before);
  signatures->SetFilterType(vtkSpectralSignatures::LowPass);
  signatures->SetLastMode(3);
  signatures->Update();
  vtkPolyData* moved = signatures->GetOutput();
  EXPECT_TRUE(messages.errors.empty() && messages.warnings.empty());
  EXPECT_FALSE(moved->GetCellData()->GetNormals());
  ASSERT_TRUE(moved->GetPointData()->GetNormals());
  EXPECT_GT(Vec3(moved->GetPointData()->GetNormals()->GetTuple3(5)).dot(Vec3(moved->GetPoint(5))),
    0.9); // three modes of a sphere are a sphere
  EXPECT_TRUE(moved->GetPointData()->HasArray("Displacement"));
  EXPECT_FALSE(moved->GetFieldData()->HasArray("PatchBasisIds"));
  EXPECT_FALSE(moved->GetFieldData()->HasArray("OctreeCells"));
  EXPECT_FALSE(moved->GetCellData()->HasArray("OctreeCellId"));
  EXPECT_FALSE(moved->GetFieldData()->HasArray("Eigenvalues"));
  EXPECT_FALSE(moved->GetPointData()->HasArray("Mode003"));
  EXPECT_TRUE(moved->GetPointData()->HasArray("HeatKernelSignature"));
}

/// Names of a clip and of modes are free on a mesh that carries none.
TEST_F(MovedPoints, OwnArraysWithNamesOfAClipOrOfModesStay)
{
  const std::vector<const char*> ofCells = { "PatchId", "SourceCellId", "OctreeCellColor" };
  for (const char* name : ofCells)
  {
    vtkNew<vtkDoubleArray> array;
    array->SetName(name);
    array->SetNumberOfTuples(sphere->GetNumberOfCells());
    array->Fill(3.0);
    sphere->GetCellData()->AddArray(array);
  }
  for (const char* name : { "Mode", "Mode000", "Mode012" })
  {
    AddPointArray(sphere, name, 1, Wave);
  }
  vtkNew<vtkScreenedPoisson> poisson;
  poisson->SetInputData(sphere);
  poisson->SetDepth(3);
  poisson->Update();
  vtkPolyData* moved = poisson->GetOutput();
  ASSERT_NE(moved->GetPoints(), sphere->GetPoints());
  for (const char* name : ofCells)
  {
    EXPECT_EQ(moved->GetCellData()->GetArray(name), sphere->GetCellData()->GetArray(name)) << name;
  }
  for (const char* name : { "Mode", "Mode000", "Mode012" })
  {
    EXPECT_TRUE(moved->GetPointData()->HasArray(name)) << name;
  }
  // The clip replaces only arrays that it writes, and a clip of a clip has those of the last one.
  vtkNew<vtkClipToOctree> clip;
  clip->SetInputData(sphere);
  clip->SetDepth(3);
  clip->Update();
  vtkCellData* cells = clip->GetOutput()->GetCellData();
  ASSERT_TRUE(cells->HasArray("PatchId"));
  EXPECT_EQ(cells->GetArray("PatchId")->GetComponent(0, 0), 3.0);
  EXPECT_EQ(cells->GetArray("SourceCellId")->GetRange()[0], 0.0);
  vtkNew<vtkConnectivityAwareBasis> basis;
  basis->SetInputData(ToPolyData(GeodesicSphere(4)));
  basis->SetDepth(3);
  vtkNew<vtkClipToOctree> again;
  again->SetInputConnection(basis->GetOutputPort());
  again->SetDepth(4);
  again->Update();
  EXPECT_FALSE(again->GetOutput()->GetCellData()->HasArray("PatchId"));
}

TEST_F(MovedPoints, ModesOfAnotherShapeAreComputedAnew)
{
  auto modes = WithModes(sphere, 16);
  const auto given = this->EigenvaluesFor(modes);
  EXPECT_EQ(this->Solves(), 0);
  EXPECT_TRUE(messages.warnings.empty());
  const auto doubled = this->EigenvaluesFor(Scaled(modes, 2, 2, 2));
  EXPECT_EQ(this->Solves(), 1);
  ExpectOne(messages.warnings, "another shape");
  EXPECT_NEAR(doubled[1], given[1] / 4, 1e-3);
  EXPECT_FALSE(signatures->GetOutput()->GetPointData()->HasArray("Mode003"));
  EXPECT_FALSE(signatures->GetOutput()->GetFieldData()->HasArray("Eigenvalues"));
  // The area is the same, but the shape is not: the squares alone do not reveal it.
  this->EigenvaluesFor(Scaled(modes, 1.25, 1.25, 0.64));
  EXPECT_EQ(this->Solves(), 2);
  EXPECT_EQ(this->EigenvaluesFor(modes), given); // and back
  EXPECT_EQ(this->Solves(), 2);
}

TEST_F(MovedPoints, ASecondLowPassKeepsTheShape)
{
  signatures->SetFilterType(vtkSpectralSignatures::LowPass);
  signatures->SetLastMode(3);
  signatures->SetInputData(Scaled(WithModes(sphere, 16), 1, 1, 2)); // stale modes
  signatures->Update();
  vtkNew<vtkPolyData> first;
  first->DeepCopy(signatures->GetOutput());
  signatures->SetInputData(first);
  signatures->Update();
  const double* bounds = signatures->GetOutput()->GetBounds();
  EXPECT_GT(bounds[1] - bounds[0], 1.0);
  EXPECT_GT(bounds[5] - bounds[4], 1.0);
}

TEST_F(MovedPoints, TrueModesAreBelievedWhateverTheMesh)
{
  const TriangleMesh meshes[] = { GeodesicSphere(2), GeodesicSphere(5, 100.0),
    Torus(200, 10, 1.0, 0.3), Torus(7, 5, 1.0, 0.4),
    Join(GeodesicSphere(6), Transform(GeodesicSphere(3), { 0, 0, 1 }, 0.3, 0.5, { 3, 0, 0 })),
    Unweld(GeodesicSphere(6)) };
  for (const TriangleMesh& mesh : meshes)
  {
    for (const int depth : { 3, 5 })
    {
      for (const int precision : { VTK_FLOAT, VTK_DOUBLE })
      {
        this->EigenvaluesFor(WithModes(ToPolyData(mesh, precision), 20, depth));
        EXPECT_TRUE(messages.warnings.empty()) << messages.warnings[0];
        EXPECT_EQ(this->Solves(), 0) << mesh.points.size() << " points, depth " << depth;
      }
    }
  }
}

TEST_F(MovedPoints, ANewRunRemovesTheModesOfAnOlderOneWithMore)
{
  auto many = WithModes(sphere, 9);
  auto few = WithModes(many, 3);
  EXPECT_TRUE(few->GetPointData()->HasArray("Mode002"));
  EXPECT_FALSE(few->GetPointData()->HasArray("Mode003"));
  EXPECT_EQ(few->GetFieldData()->GetArray("Eigenvalues")->GetNumberOfTuples(), 3);
  vtkNew<vtkLaplaceSpectrum> one;
  one->SetInputData(many);
  one->SetDepth(5);
  one->SetNumberOfModes(4);
  one->Update();
  EXPECT_TRUE(one->GetOutput()->GetPointData()->HasArray("Mode"));
  EXPECT_FALSE(one->GetOutput()->GetPointData()->HasArray("Mode000"));
}

TEST_F(MovedPoints, ABasisMovedByAHundredthOfACellIsRefused)
{
  for (const int precision : { VTK_FLOAT, VTK_DOUBLE })
  {
    auto mesh = ToPolyData(GeodesicSphere(6), precision);
    vtkNew<vtkConnectivityAwareBasis> basis;
    basis->SetInputData(mesh);
    basis->SetDepth(4);
    basis->Update();
    const double shift = 0.01 * FieldValue(basis->GetOutput(), "GridSpacing");
    const auto moved = [shift](vtkPolyData* data)
    {
      auto copy = vtkSmartPointer<vtkPolyData>::New();
      copy->ShallowCopy(data);
      vtkNew<vtkPoints> points;
      points->DeepCopy(data->GetPoints());
      for (vtkIdType k = 0; k < points->GetNumberOfPoints(); ++k)
      {
        const Vec3 point = Vec3(points->GetPoint(k)) + Vec3(shift, 0, 0);
        points->SetPoint(k, point.data());
      }
      copy->SetPoints(points);
      return copy;
    };
    vtkNew<vtkScreenedPoisson> poisson;
    poisson->SetInputData(0, moved(basis->GetOutput()));
    ExpectRefused(poisson, "moved");
    // The points move by less than a thousandth of a cell, for the second way of giving a basis.
    auto other = vtkSmartPointer<vtkPolyData>::New();
    other->DeepCopy(mesh);
    const Vec3 point = Vec3(mesh->GetPoint(7)) + Vec3(0.01 * shift, 0, 0);
    other->GetPoints()->SetPoint(7, point.data());
    poisson->SetInputData(0, other);
    poisson->SetInputData(1, basis->GetOutput());
    ExpectRefused(poisson, "another mesh");
  }
}

} // namespace
