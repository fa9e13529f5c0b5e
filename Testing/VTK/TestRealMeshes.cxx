// Tests small real meshes with every defect that files have. All filters compute or refuse, and
// none crashes.

#include "FilterSupport.h"

#include "vtkClipToOctree.h"
#include "vtkConnectivityAwareBasis.h"
#include "vtkLaplaceSpectrum.h"
#include "vtkScreenedPoisson.h"

#include <gtest/gtest.h>

using namespace gridfem;
using namespace gridfem::testing;

namespace
{

class RealMeshes : public ::testing::TestWithParam<const char*>
{
};

TEST_P(RealMeshes, TheWholeChainComputes)
{
  const std::string path = RealMesh(std::string("small/") + GetParam());
  if (path.empty())
  {
    GTEST_SKIP() << "the folder of real meshes is not there";
  }
  auto input = ToPolyData(ReadMesh(path));
  vtkNew<vtkClipToOctree> clip;
  clip->SetDepth(4);
  clip->SetInputData(input);
  vtkNew<vtkConnectivityAwareBasis> basis;
  basis->SetInputConnection(clip->GetOutputPort());
  vtkNew<vtkScreenedPoisson> poisson;
  poisson->SetInputData(input);
  poisson->SetInputConnection(1, basis->GetOutputPort());
  vtkNew<vtkLaplaceSpectrum> spectrum;
  spectrum->SetNumberOfModes(4);
  spectrum->SetInputConnection(basis->GetOutputPort());
  EXPECT_EQ(poisson->GetExecutive()->Update(), 1);
  EXPECT_EQ(spectrum->GetExecutive()->Update(), 1);
  EXPECT_EQ(FieldValue(poisson->GetOutput(), "Converged"), 1);
  EXPECT_EQ(FieldValue(spectrum->GetOutput(), "Converged"), 1);
  const auto solution = PointValues(poisson->GetOutput(), "Solution");
  EXPECT_FALSE(solution.empty());
  EXPECT_TRUE(AllFinite(solution));
}

class BasisOfRealMeshes : public ::testing::TestWithParam<const char*>
{
};

/// A triangle without area is in one cell, and may belong to a patch of another.
TEST_P(BasisOfRealMeshes, IsReadFromItsArrays)
{
  const std::string path = RealMesh(GetParam());
  if (path.empty())
  {
    GTEST_SKIP() << "the folder of real meshes is not there";
  }
  vtkNew<vtkConnectivityAwareBasis> basis;
  basis->SetDepth(6);
  basis->ReleaseDataFlagOn(); // so that nothing else is there
  basis->SetInputData(ToPolyData(ReadMesh(path)));
  basis->Update();
  const vtkIdType points = basis->GetOutput()->GetNumberOfPoints();
  vtkNew<vtkScreenedPoisson> poisson;
  poisson->SetInputConnection(basis->GetOutputPort());
  poisson->Update();
  EXPECT_EQ(poisson->GetErrorCode(), 0UL);
  EXPECT_EQ(FieldValue(poisson->GetOutput(), "Converged"), 1);
  EXPECT_EQ(poisson->GetOutput()->GetNumberOfPoints(), points);
}

INSTANTIATE_TEST_SUITE_P(Large, BasisOfRealMeshes,
  ::testing::Values("cheese_18k.ply", "dragon_res3_nonmanifold.ply", "conrod.stl"));

INSTANTIATE_TEST_SUITE_P(Small, RealMeshes,
  ::testing::Values("degenerated-libigl.obj", "degtri_2dt_1edge_split_twice.off", "degtri_four.off",
    "degtri_nullface_bis.off", "degtri_sliding.off", "joinedtets.obj", "multibody.stl",
    "non_manifold_face_graph.off", "prim.off", "tetra_intersected_by_triangle.off",
    "twoboxes.ply"));

} // namespace
