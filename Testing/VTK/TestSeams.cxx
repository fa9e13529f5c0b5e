// Tests surfaces with seams that coincide except for rounding, and with hanging nodes: the exact
// answers, points that stay, chains of filters, and no repeated steps.

#include "Spectra.h"

#include "Grid/OpenEdges.h"

#include "vtkClipToOctree.h"
#include "vtkConnectivityAwareBasis.h"
#include "vtkGeodesicDistance.h"
#include "vtkMultiBlockDataSet.h"
#include "vtkScreenedPoisson.h"
#include "vtkSurfaceDetail.h"

#include <gtest/gtest.h>

using namespace gridfem;
using namespace gridfem::testing;

namespace
{

using Algorithm = vtkSurfaceFEMAlgorithm;

constexpr int Around = 60;
constexpr int Along = 30;

/// A tube of radius 1 and length 3. Its seam coincides except for rounding.
TriangleMesh Tube()
{
  return Mapped(FlatRectangle(Around, Along, 2 * M_PI, 3.0),
    [](const Vec3& p) { return Vec3(std::cos(p[0]), std::sin(p[0]), p[1]); });
}

Id PointOfTube(int around, int along)
{
  return static_cast<Id>(along) * (Around + 1) + around;
}

/// A unit square whose right half is twice as fine.
TriangleMesh Halves()
{
  return gridfem::testing::Halves(20, 40);
}

/// The same surface without hanging nodes.
TriangleMesh Square()
{
  return FlatRectangle(40, 40);
}

/// Spaces, and whether the grid's functions know which parts are connected.
constexpr std::pair<int, bool> Spaces[] = { { Algorithm::Grid, true }, { Algorithm::Grid, false },
  { Algorithm::HatFunctions, true } };

vtkSmartPointer<vtkLaplaceSpectrum> SpectrumOf(vtkPolyData* input, int modes)
{
  auto filter = vtkSmartPointer<vtkLaplaceSpectrum>::New();
  filter->SetDepth(6);
  filter->SetNumberOfModes(modes);
  filter->SetInputData(input);
  return filter;
}

/// Expects eigenvalues with a relative error that trilinear functions of depth 6, and hats of this
/// mesh, stay below.
void ExpectNear(
  const std::vector<double>& found, const std::vector<double>& exact, double relativeError)
{
  ASSERT_GE(found.size(), exact.size());
  for (std::size_t k = 0; k < exact.size(); ++k)
  {
    EXPECT_NEAR(found[k], exact[k], relativeError * std::max(1.0, exact[k])) << "mode " << k;
  }
}

void ExpectSamePoints(vtkPolyData* a, vtkPolyData* b)
{
  EXPECT_EQ(Values(a->GetPoints()->GetData()), Values(b->GetPoints()->GetData()));
  EXPECT_EQ(a->GetNumberOfCells(), b->GetNumberOfCells());
}

/// The mesh of an output of triangles.
TriangleMesh MeshOf(vtkPolyData* data)
{
  TriangleMesh mesh;
  for (vtkIdType point = 0; point < data->GetNumberOfPoints(); ++point)
  {
    mesh.points.emplace_back(data->GetPoint(point));
  }
  for (vtkIdType cell = 0; cell < data->GetNumberOfCells(); ++cell)
  {
    vtkIdList* ids = data->GetCell(cell)->GetPointIds();
    mesh.triangles.push_back({ ids->GetId(0), ids->GetId(1), ids->GetId(2) });
  }
  return mesh;
}

} // namespace

TEST(Seams, ATubeHasTheSpectrumOfACylinder)
{
  const double first = std::pow(M_PI / 3.0, 2);
  const std::vector<double> exact = { 0, 1, 1, first, 1 + first, 1 + first, 4, 4 };
  for (const int precision : { VTK_DOUBLE, VTK_FLOAT })
  {
    const auto input = ToPolyData(Tube(), precision);
    for (const auto& [space, isAware] : Spaces)
    {
      const auto filter = SpectrumOf(input, 8);
      filter->SetFunctionSpace(space);
      filter->SetConnectivityAware(isAware);
      ExpectNear(Eigenvalues(filter), exact, 0.01);
      ExpectSamePoints(filter->GetOutput(), input);
      filter->WeldCoincidentPointsOff(); // a tube that is cut open
      EXPECT_NEAR(Eigenvalues(filter)[1], isAware ? 0.25 : 1.0, 0.01);
    }
  }
}

TEST(Seams, HangingNodesChangeNoSpectrum)
{
  std::vector<double> exact = { 0, 1, 1, 2, 4, 4, 5, 5 };
  for (double& value : exact)
  {
    value *= M_PI * M_PI;
  }
  for (const auto& [space, isAware] : Spaces)
  {
    const auto filter = SpectrumOf(ToPolyData(Halves()), 8);
    filter->SetFunctionSpace(space);
    filter->SetConnectivityAware(isAware);
    ExpectNear(Eigenvalues(filter), exact, 0.02);
  }
}

TEST(Seams, SolutionsAreThoseOfTheCleanMesh)
{
  const auto solve = [](const TriangleMesh& mesh, int space)
  {
    vtkNew<vtkScreenedPoisson> filter;
    const auto input = ToPolyData(mesh);
    AddPointArray(input, "f", 1, [](const Vec3& p, int) { return std::sin(4.7 * p[0]) + p[1]; });
    filter->SetInputData(input);
    filter->SetInputArrayToProcess(0, 0, 0, Points, "f");
    filter->SetDepth(6);
    filter->SetFunctionSpace(space);
    filter->SetTolerance(1e-9);
    filter->Update();
    EXPECT_EQ(FieldValue(filter->GetOutput(), "Converged"), 1.0);
    return PointValues(filter->GetOutput(), "Solution");
  };
  for (const int space : { Algorithm::Grid, Algorithm::HatFunctions })
  {
    const TriangleMesh halves = Halves();
    const std::vector<double> found = solve(halves, space);
    const std::vector<double> clean = solve(Square(), space);
    double largest = 0.0;
    for (std::size_t point = 0; point < halves.points.size(); ++point)
    {
      const auto column = static_cast<std::size_t>(std::lround(40 * halves.points[point][0]));
      const auto row = static_cast<std::size_t>(std::lround(40 * halves.points[point][1]));
      largest = Larger(largest, std::abs(found[point] - clean[41 * row + column]));
    }
    // The coarse half has squares of 1/20, so that linear interpolation of f errs by 0.007. The
    // equation may double this. Halves that fall apart differ by half.
    EXPECT_LT(largest, 0.014);
  }
}

TEST(Seams, DistancesCrossThem)
{
  const TriangleMesh tube = Tube();
  vtkNew<vtkGeodesicDistance> filter;
  filter->SetInputData(ToPolyData(tube));
  filter->SetDepth(6);
  filter->AddSourcePointId(PointOfTube(3, Along / 2));
  filter->Update();
  const std::vector<double> distance = PointValues(filter->GetOutput(), "Distance");
  ASSERT_EQ(distance.size(), tube.points.size());
  for (std::size_t k = 0; k < distance.size(); ++k)
  {
    const Vec3& p = tube.points[k];
    const double turn = std::atan2(p[1], p[0]) - 2 * M_PI * 3 / Around;
    const double exact = std::hypot(std::remainder(turn, 2 * M_PI), p[2] - 1.5);
    EXPECT_NEAR(distance[k], exact, 0.1); // a cell is 0.05
  }
}

TEST(Seams, DistancesCrossBlocks)
{
  vtkNew<vtkMultiBlockDataSet> blocks;
  blocks->SetBlock(0, ToPolyData(FlatRectangle(10, 20, 0.5, 1.0)));
  blocks->SetBlock(1, ToPolyData(Transform(FlatRectangle(20, 40, 0.5, 1.0), { 1, 0, 0 }, 0.0, 1.0,
                        { 0.5 + 1e-15, 0, 0 })));
  vtkNew<vtkGeodesicDistance> filter;
  filter->SetInputDataObject(blocks);
  filter->BlocksAsOneOn();
  filter->SetDepth(6);
  filter->AddSourcePointId(0);
  filter->Update();
  auto* output = vtkMultiBlockDataSet::SafeDownCast(filter->GetOutputDataObject(0));
  ASSERT_NE(output, nullptr);
  for (unsigned int block = 0; block < 2; ++block)
  {
    auto* data = vtkPolyData::SafeDownCast(output->GetBlock(block));
    const std::vector<double> distance = PointValues(data, "Distance");
    ASSERT_EQ(distance.size(), static_cast<std::size_t>(data->GetNumberOfPoints()));
    for (vtkIdType point = 0; point < data->GetNumberOfPoints(); ++point)
    {
      EXPECT_NEAR(distance[point], Vec3(data->GetPoint(point)).norm(), 0.03);
    }
  }
}

TEST(Seams, SmoothingKeepsThemClosed)
{
  const auto input = ToPolyData(Tube());
  vtkNew<vtkSurfaceDetail> filter;
  filter->SetInputData(input);
  filter->SetDetailScale(0.0);
  filter->Update();
  const TriangleMesh moved = MeshOf(filter->GetOutput());
  for (int row = 0; row <= Along; ++row)
  {
    const Vec3& first = moved.points[PointOfTube(0, row)];
    const Vec3& last = moved.points[PointOfTube(Around, row)];
    EXPECT_LT((first - last).norm(), 1e-9);
  }
}

TEST(Seams, AChainOfFiltersIsTheShortWay)
{
  for (const TriangleMesh& mesh : { Tube(), Halves() })
  {
    for (const int precision : { VTK_DOUBLE, VTK_FLOAT })
    {
      const auto input = ToPolyData(mesh, precision);
      vtkNew<vtkClipToOctree> clip;
      clip->SetInputData(input);
      clip->SetDepth(5);
      vtkNew<vtkConnectivityAwareBasis> basis;
      basis->SetInputConnection(clip->GetOutputPort());
      basis->Update();
      vtkNew<vtkPolyData> stored; // as read from a file: without the shortcut of one process
      stored->DeepCopy(basis->GetOutput());
      const auto direct = SpectrumOf(input, 6);
      direct->SetDepth(5);
      const std::vector<double> expected = Eigenvalues(direct);
      for (vtkPolyData* functions : { basis->GetOutput(), stored.Get() })
      {
        const auto onClip = SpectrumOf(functions, 6);
        const auto onBasis = SpectrumOf(input, 6);
        onBasis->SetInputDataObject(1, functions);
        // Cut points in single precision move by 1e-7 of the box.
        EXPECT_LT(Difference(Eigenvalues(onClip), expected), 1e-3 * expected.back());
        EXPECT_LT(Difference(Eigenvalues(onBasis), expected), 1e-3 * expected.back());
      }
    }
  }
}

/// Points of the seam come to one place in the clip; all others stay as they are.
TEST(Seams, TheClippedMeshIsClosed)
{
  const TriangleMesh tube = Tube();
  vtkNew<vtkClipToOctree> clip;
  clip->SetInputData(ToPolyData(tube));
  clip->SetDepth(5);
  clip->Update();
  const TriangleMesh clipped = MeshOf(clip->GetOutput());
  std::size_t rings = 0;
  for (const OpenEdge& edge : FindOpenEdges(clipped))
  {
    rings += edge[0][2] == edge[1][2] && (edge[0][2] == 0.0 || edge[0][2] == 3.0) ? 0 : 1;
  }
  EXPECT_EQ(rings, 0u); // no edge but those of the two rings is open
  for (std::size_t point = 0; point < tube.points.size(); ++point)
  {
    EXPECT_LT((clipped.points[point] - tube.points[point]).norm(), 1e-14);
  }
}

TEST(Seams, TheSameMeshRepeatsNothing)
{
  for (const TriangleMesh& mesh : { Tube(), Halves() })
  {
    for (const bool tracks : { false, true })
    {
      const auto filter = SpectrumOf(ToPolyData(mesh), 4);
      filter->SetTrackMetric(tracks);
      const std::vector<double> before = Eigenvalues(filter);
      filter->SetInputData(ToPolyData(mesh)); // equal data in other arrays
      EXPECT_EQ(Eigenvalues(filter), before);
      EXPECT_EQ(filter->GetNumberOfRuns("Space"), 1);
      EXPECT_EQ(filter->GetNumberOfRuns("Solve"), 1);
    }
  }
}
