// Tests that hidden cells, and duplicates of cells elsewhere, are left out of the computation.

#include "FilterSupport.h"

#include "Grid/TriangleMesh.h"

#include "vtkClipToOctree.h"
#include "vtkConnectivityAwareBasis.h"
#include "vtkLaplaceSpectrum.h"
#include "vtkScreenedPoisson.h"
#include "vtkSpectralSignatures.h"

#include "vtkUnsignedCharArray.h"

#include <gtest/gtest.h>

using namespace gridfem;
using namespace gridfem::testing;

namespace
{

/// Makes a sphere, and beside it a larger one whose cells alternate between hidden and duplicate.
vtkSmartPointer<vtkPolyData> SphereBesideGhosts(const TriangleMesh& sphere)
{
  auto data =
    ToPolyData(Join(sphere, Transform(GeodesicSphere(4), { 0, 0, 1 }, 0.0, 1.5, { 4, 0, 0 })));
  vtkNew<vtkUnsignedCharArray> ghosts;
  ghosts->SetName(vtkDataSetAttributes::GhostArrayName());
  ghosts->SetNumberOfTuples(data->GetNumberOfCells());
  for (vtkIdType cell = 0; cell < data->GetNumberOfCells(); ++cell)
  {
    const int kind =
      cell % 2 ? vtkDataSetAttributes::HIDDENCELL : vtkDataSetAttributes::DUPLICATECELL;
    ghosts->SetValue(cell, cell < vtkIdType(sphere.triangles.size()) ? 0 : kind);
  }
  data->GetCellData()->AddArray(ghosts);
  return data;
}

class GhostCells : public ::testing::Test
{
protected:
  /// Returns the values at the points of the first sphere.
  template<class Filter>
  std::vector<double> Run(Filter* filter, vtkPolyData* input, const char* array)
  {
    filter->SetDepth(4);
    filter->SetInputData(input);
    filter->Update();
    EXPECT_EQ(filter->GetOutput()->GetNumberOfCells(), input->GetNumberOfCells());
    vtkDataArray* values = filter->GetOutput()->GetPointData()->GetArray(array);
    auto all = Values(values);
    all.resize(sphere.points.size() * values->GetNumberOfComponents());
    return all;
  }

  const TriangleMesh sphere = GeodesicSphere(8);
  vtkSmartPointer<vtkPolyData> alone = ToPolyData(sphere);
  vtkSmartPointer<vtkPolyData> withGhosts = SphereBesideGhosts(sphere);
};

TEST_F(GhostCells, SolversLeaveThemOutAndPassThemOn)
{
  for (const int space : { 0, 1 })
  {
    vtkNew<vtkScreenedPoisson> poisson;
    poisson->SetFunctionSpace(space);
    EXPECT_EQ(this->Run(poisson.Get(), withGhosts, "Solution"),
      this->Run(poisson.Get(), alone, "Solution"));
    vtkNew<vtkLaplaceSpectrum> spectrum;
    spectrum->SetNumberOfModes(4);
    spectrum->SetFunctionSpace(space);
    EXPECT_EQ(
      this->Run(spectrum.Get(), withGhosts, "Mode"), this->Run(spectrum.Get(), alone, "Mode"));
    vtkNew<vtkSpectralSignatures> signatures;
    signatures->SetNumberOfModes(9);
    signatures->SetFunctionSpace(space);
    EXPECT_EQ(this->Run(signatures.Get(), withGhosts, "HeatKernelSignature"),
      this->Run(signatures.Get(), alone, "HeatKernelSignature"));
  }
}

TEST_F(GhostCells, TheClipLeavesThemOut)
{
  vtkNew<vtkClipToOctree> clip;
  clip->SetDepth(4);
  vtkNew<vtkConnectivityAwareBasis> basis;
  basis->SetDepth(4);
  for (vtkSurfaceFEMAlgorithm* filter : { static_cast<vtkSurfaceFEMAlgorithm*>(clip.Get()),
         static_cast<vtkSurfaceFEMAlgorithm*>(basis.Get()) })
  {
    filter->SetInputDataObject(alone);
    filter->Update();
    const vtkIdType cells = filter->GetPolyDataInput(0)->GetNumberOfCells();
    auto* output = vtkPolyData::SafeDownCast(filter->GetOutputDataObject(0));
    const vtkIdType pieces = output->GetNumberOfCells();
    filter->SetInputDataObject(withGhosts);
    filter->Update();
    EXPECT_EQ(output->GetNumberOfCells(), pieces);
    for (const double cell : Values(output->GetCellData()->GetArray("SourceCellId")))
    {
      EXPECT_LT(cell, double(cells));
    }
    auto* ghosts = output->GetCellData()->GetArray(vtkDataSetAttributes::GhostArrayName());
    EXPECT_EQ(ghosts->GetDataType(), VTK_UNSIGNED_CHAR);
  }
}

TEST_F(GhostCells, AChangeOfTheFlagsIsAChangeOfTheMesh)
{
  vtkNew<vtkScreenedPoisson> poisson;
  const auto before = this->Run(poisson.Get(), withGhosts, "Solution");
  auto* ghosts = vtkUnsignedCharArray::SafeDownCast(
    withGhosts->GetCellData()->GetArray(vtkDataSetAttributes::GhostArrayName()));
  ghosts->SetValue(0, vtkDataSetAttributes::HIDDENCELL);
  ghosts->Modified();
  withGhosts->Modified();
  EXPECT_NE(this->Run(poisson.Get(), withGhosts, "Solution"), before);
}

TEST_F(GhostCells, AFaceThatIsThereTwiceCountsOnce)
{
  for (const bool turned : { false, true })
  {
    TriangleMesh twice = sphere;
    for (auto triangle : sphere.triangles)
    {
      if (turned)
      {
        std::swap(triangle[1], triangle[2]);
      }
      twice.triangles.push_back(triangle);
    }
    const auto doubled = ToPolyData(twice);
    AddPointArray(doubled, "f", 1, Wave);
    vtkNew<vtkLaplaceSpectrum> ofDoubled;
    vtkNew<vtkLaplaceSpectrum> ofAlone;
    EXPECT_EQ(this->Run(ofDoubled.Get(), doubled, "Mode"), this->Run(ofAlone.Get(), alone, "Mode"));
  }
}

TEST_F(GhostCells, NothingButGhostsIsRefused)
{
  vtkDataArray* ghosts =
    withGhosts->GetCellData()->GetArray(vtkDataSetAttributes::GhostArrayName());
  ghosts->Fill(vtkDataSetAttributes::DUPLICATECELL);
  vtkNew<vtkScreenedPoisson> poisson;
  poisson->SetInputData(withGhosts);
  ExpectRefused(poisson, "vtkGhostType");
}

} // namespace
