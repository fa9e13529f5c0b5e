// Tests one square in five tessellations, and fields that all of them hold exactly. Results on a
// grid depend on the surface, not on its triangles.
#include "FilterSupport.h"

#include "vtkHarmonicInterpolation.h"
#include "vtkHeatDiffusion.h"
#include "vtkScreenedPoisson.h"
#include "vtkSurfaceGradient.h"

#include <gtest/gtest.h>

using namespace gridfem;
using namespace gridfem::testing;

namespace
{

struct Tessellation
{
  const char* name;
  TriangleMesh flat; // of the unit square
};

std::vector<Tessellation> Tessellations()
{
  return { { "squares", FlatRectangle(20, 20) }, { "needles", FlatRectangle(6, 400) },
    { "large triangles", FlatRectangle(2, 2) }, { "a soup", Unweld(FlatRectangle(10, 14)) },
    { "triangles in four", SubdivideInPlane(FlatRectangle(4, 6)) } };
}

/// The corners and the center, which are points of all tessellations.
bool IsCommon(const Vec3& p)
{
  const bool isCorner = std::abs(p[0] - 0.5) > 0.4999 && std::abs(p[1] - 0.5) > 0.4999;
  return isCorner || (p - Vec3(0.5, 0.5, 0.0)).norm() < 1e-6;
}

/// Returns the turned mesh with the point arrays `linear` (three components) and `mask`. The mask
/// is not constant at the common points. The cell array `side` is 1 and 2, with the colors `color`.
vtkSmartPointer<vtkPolyData> DataOf(const TriangleMesh& flat)
{
  auto data = ToPolyData(Transform(flat, { 1, 2, 3 }, 0.3));
  vtkNew<vtkDoubleArray> linear;
  linear->SetName("linear");
  linear->SetNumberOfComponents(3);
  vtkNew<vtkDoubleArray> mask;
  mask->SetName("mask");
  for (const Vec3& p : flat.points)
  {
    linear->InsertNextTuple3(p[0], 2.0 * p[1] - p[0], 1.0 + 3.0 * p[1]);
    mask->InsertNextValue(IsCommon(p) ? 1.0 : 0.0);
  }
  vtkNew<vtkDoubleArray> side;
  side->SetName("side");
  vtkNew<vtkDoubleArray> color;
  color->SetName("color");
  for (const auto& corner : flat.triangles)
  {
    const double x = (flat.points[corner[0]] + flat.points[corner[1]] + flat.points[corner[2]])[0];
    side->InsertNextValue(x < 1.5 ? 1.0 : 2.0);
    color->InsertNextValue(x < 1.5 ? 0.2 : 0.7);
  }
  data->GetPointData()->AddArray(linear);
  data->GetPointData()->AddArray(mask);
  data->GetCellData()->AddArray(side);
  data->GetCellData()->AddArray(color);
  return data;
}

/// Returns the sorted values of the array at the points that all tessellations share.
std::vector<double> AtCommonPoints(vtkPolyData* output, const TriangleMesh& flat, const char* name)
{
  const std::vector<double> values = PointValues(output, name);
  const std::size_t components = values.size() / flat.points.size();
  std::vector<std::pair<std::array<double, 2>, std::size_t>> places;
  for (std::size_t k = 0; k < flat.points.size(); ++k)
  {
    if (IsCommon(flat.points[k]))
    {
      places.push_back(
        { { std::round(2.0 * flat.points[k][0]), std::round(2.0 * flat.points[k][1]) }, k });
    }
  }
  std::sort(places.begin(), places.end());
  std::vector<double> found;
  for (std::size_t k = 0; k < places.size(); ++k)
  {
    for (std::size_t c = 0; c < components && (k == 0 || places[k].first != places[k - 1].first);
         ++c)
    {
      found.push_back(values[components * places[k].second + c]);
    }
  }
  return found;
}

/// Expects the same result on all tessellations.
/// @param prepare  chooses arrays and properties
template<class Filter, class Prepare>
void ExpectTheSame(const char* array, Prepare&& prepare)
{
  std::vector<double> first;
  for (const Tessellation& tessellation : Tessellations())
  {
    const auto filter = vtkSmartPointer<Filter>::New();
    filter->SetInputData(DataOf(tessellation.flat));
    filter->SetDepth(5);
    filter->SetTolerance(1e-12);
    filter->SetNormalStabilization(1e-2);
    filter->SetQuadratureDegree(6); // exact on every piece of a triangle
    prepare(filter);
    filter->Update();
    const auto output = vtkPolyData::SafeDownCast(filter->GetOutputDataObject(0));
    const std::vector<double> found = AtCommonPoints(output, tessellation.flat, array);
    ASSERT_GE(found.size(), 5u) << tessellation.name;
    first = first.empty() ? found : first;
    ASSERT_EQ(found.size(), first.size()) << tessellation.name;
    for (std::size_t k = 0; k < found.size(); ++k)
    {
      EXPECT_NEAR(found[k], first[k], 1e-5) << array << ", " << tessellation.name;
    }
  }
  const auto [least, largest] = std::minmax_element(first.begin(), first.end());
  EXPECT_GT(*largest - *least, 0.01) << array; // the values differ
}

} // namespace

TEST(Tessellation, DoesNotMatterToASmoothedField)
{
  ExpectTheSame<vtkScreenedPoisson>("Solution",
    [](vtkScreenedPoisson* filter) { filter->SetInputArrayToProcess(0, 0, 0, Points, "linear"); });
}

TEST(Tessellation, DoesNotMatterToHeldValues)
{
  ExpectTheSame<vtkScreenedPoisson>("Solution",
    [](vtkScreenedPoisson* filter)
    {
      filter->SetInputArrayToProcess(0, 0, 0, Cells, "color");
      filter->SetScreeningWeight(10.0);
      filter->SetInputArrayToProcess(3, 0, 0, Cells, "side"); // weights
    });
  ExpectTheSame<vtkScreenedPoisson>("Solution",
    [](vtkScreenedPoisson* filter)
    {
      filter->SetInputArrayToProcess(0, 0, 0, Points, "linear");
      filter->SetInputArrayToProcess(4, 0, 0, Points, "mask");
      filter->SetScreeningWeight(10.0);
    });
}

TEST(Tessellation, DoesNotMatterToInterpolatedValues)
{
  for (const int smoothness :
    { vtkHarmonicInterpolation::Harmonic, vtkHarmonicInterpolation::Biharmonic })
  {
    ExpectTheSame<vtkHarmonicInterpolation>("Interpolated",
      [&](vtkHarmonicInterpolation* filter)
      {
        filter->SetInputArrayToProcess(0, 0, 0, Points, "linear");
        filter->SetInputArrayToProcess(1, 0, 0, Points, "mask");
        filter->SetSmoothness(smoothness);
      });
  }
}

TEST(Tessellation, DoesNotMatterToHeat)
{
  for (const bool isHeld : { false, true })
  {
    ExpectTheSame<vtkHeatDiffusion>("Diffused",
      [&](vtkHeatDiffusion* filter)
      {
        filter->SetInputArrayToProcess(0, 0, 0, Points, "linear");
        filter->SetDiffusionTime(0.05);
        if (isHeld)
        {
          filter->SetInputArrayToProcess(2, 0, 0, Points, "mask");
        }
      });
  }
  ExpectTheSame<vtkHeatDiffusion>("Diffused",
    [](vtkHeatDiffusion* filter)
    {
      filter->SetInputArrayToProcess(0, 0, 0, Cells, "color");
      filter->SetInputArrayToProcess(1, 0, 0, Cells, "side"); // a source
      filter->SetDiffusionTime(0.05);
    });
}

TEST(Tessellation, DoesNotMatterToGradients)
{
  ExpectTheSame<vtkSurfaceGradient>("Gradient",
    [](vtkSurfaceGradient* filter) { filter->SetInputArrayToProcess(0, 0, 0, Points, "linear"); });
}
