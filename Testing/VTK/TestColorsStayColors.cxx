// Tests that colors, three or four bytes, come out of a filter as colors, rounded and clamped, and
// that a single byte is a number.

#include "AllFilters.h"

#include "vtkUnsignedCharArray.h"

#include <gtest/gtest.h>

using namespace gridfem;
using namespace gridfem::testing;

namespace
{

/// Adds bytes that jump at the equator.
vtkUnsignedCharArray* AddBytes(vtkPolyData* surface, const char* name, int components)
{
  const int north[] = { 250, 128, 5, 255 };
  const int south[] = { 5, 128, 250, 255 };
  vtkNew<vtkUnsignedCharArray> bytes;
  bytes->SetName(name);
  bytes->SetNumberOfComponents(components);
  bytes->SetNumberOfTuples(surface->GetNumberOfPoints());
  for (vtkIdType point = 0; point < surface->GetNumberOfPoints(); ++point)
  {
    for (int c = 0; c < components; ++c)
    {
      bytes->SetComponent(point, c, (surface->GetPoint(point)[2] > 0.0 ? north : south)[c]);
    }
  }
  surface->GetPointData()->AddArray(bytes);
  return bytes;
}

vtkSmartPointer<vtkSurfaceFEMAlgorithm> MakeSharpener()
{
  auto filter = vtkSmartPointer<vtkSurfaceDetail>::New();
  filter->SetDetailScale(4.0);
  return filter;
}

vtkSmartPointer<vtkSurfaceFEMAlgorithm> MakeBand()
{
  auto filter = vtkSmartPointer<vtkSpectralSignatures>::New();
  filter->SetNumberOfModes(20);
  filter->SetFilterType(vtkSpectralSignatures::LowPass);
  filter->SetLastMode(8);
  return filter;
}

vtkSmartPointer<vtkSurfaceFEMAlgorithm> MakeMasked()
{
  auto filter = Make<vtkHarmonicInterpolation>();
  filter->SetInputArrayToProcess(1, 0, 0, Points, "label");
  return filter;
}

class ColorsStayColors : public ::testing::TestWithParam<FilterCase>
{
protected:
  ColorsStayColors() { AddArraysOfAllFilters(surface); }

  vtkDataArray* Run(const char* array)
  {
    filter->SetDepth(4);
    filter->SetInputArrayToProcess(0, 0, 0, Points, array);
    filter->SetInputDataObject(surface);
    filter->Update();
    return vtkPolyData::SafeDownCast(filter->GetOutputDataObject(0))->GetPointData()->GetScalars();
  }

  vtkSmartPointer<vtkPolyData> surface = ToPolyData(GeodesicSphere(3));
  vtkSmartPointer<vtkSurfaceFEMAlgorithm> filter = this->GetParam().make();
};

TEST_P(ColorsStayColors, AsBytesNearTheNumbersOfTheSolution)
{
  for (const int components : { 3, 4 })
  {
    auto* colors = AddBytes(surface, "colors", components);
    vtkNew<vtkDoubleArray> numbers;
    numbers->DeepCopy(colors);
    numbers->SetName("numbers");
    surface->GetPointData()->AddArray(numbers);
    const std::vector<double> exact = Values(this->Run("numbers"));
    vtkDataArray* result = this->Run("colors");
    ASSERT_NE(result, nullptr);
    EXPECT_EQ(result->GetDataType(), VTK_UNSIGNED_CHAR);
    EXPECT_EQ(result->GetNumberOfComponents(), components);
    const std::vector<double> bytes = Values(result);
    ASSERT_EQ(bytes.size(), exact.size());
    double largest = 0.0;
    for (std::size_t k = 0; k < bytes.size(); ++k)
    {
      largest = Larger(largest, std::abs(bytes[k] - std::clamp(exact[k], 0.0, 255.0)));
    }
    EXPECT_LE(largest, 0.5 + 1e-9); // rounding
  }
}

TEST_P(ColorsStayColors, OneByteIsANumber)
{
  AddBytes(surface, "mask", 1);
  EXPECT_EQ(this->Run("mask")->GetDataType(), VTK_DOUBLE);
}

INSTANTIATE_TEST_SUITE_P(Filters, ColorsStayColors,
  ::testing::Values(FilterCase{ "ScreenedPoisson", &Make<vtkScreenedPoisson> },
    FilterCase{ "HarmonicInterpolation", &MakeMasked },
    FilterCase{ "HeatDiffusion", &Make<vtkHeatDiffusion> },
    FilterCase{ "SurfaceDetail", &MakeSharpener }, FilterCase{ "SpectralSignatures", &MakeBand }),
  NameOf);

} // namespace
