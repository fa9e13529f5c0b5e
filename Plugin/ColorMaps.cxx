#include "ColorMaps.h"

#include "vtkSMPropertyHelper.h"
#include "vtkSMTransferFunctionPresets.h"
#include "vtkSMTransferFunctionProxy.h"

#include <algorithm>
#include <sstream>
#include <vector>

namespace
{

/// ColorBrewer's Set2 and, in the same order of hues, Dark2.
constexpr unsigned char Categories[16][3] = { { 102, 194, 165 }, { 252, 141, 98 },
  { 141, 160, 203 }, { 231, 138, 195 }, { 166, 216, 84 }, { 255, 217, 47 }, { 229, 196, 148 },
  { 179, 179, 179 }, { 27, 158, 119 }, { 217, 95, 2 }, { 117, 112, 179 }, { 231, 41, 138 },
  { 102, 166, 30 }, { 230, 171, 2 }, { 166, 118, 29 }, { 102, 102, 102 } };

/// Viridis of matplotlib, at even distances.
constexpr unsigned char Viridis[][3] = { { 68, 1, 84 }, { 72, 40, 120 }, { 62, 73, 137 },
  { 49, 104, 142 }, { 38, 130, 142 }, { 31, 158, 137 }, { 53, 183, 121 }, { 110, 206, 88 },
  { 181, 222, 43 }, { 253, 231, 37 } };
constexpr int LastOfViridis = sizeof(Viridis) / sizeof(Viridis[0]) - 1;

constexpr int NumberOfStripes = 20;
constexpr double Shade = 0.72; // brightness of every second stripe
constexpr const char* StripesName = "Distance Stripes";

/// Appends a position and the color of a stripe to the points of a color map.
void AddStripeEnd(int stripe, double position, std::vector<double>& points)
{
  const double place = LastOfViridis * (stripe + 0.5) / NumberOfStripes;
  const int low = std::min(static_cast<int>(place), LastOfViridis - 1);
  points.push_back(position);
  for (int channel = 0; channel < 3; ++channel)
  {
    const double color =
      Viridis[low][channel] + (place - low) * (Viridis[low + 1][channel] - Viridis[low][channel]);
    points.push_back((stripe % 2 == 1 ? Shade : 1.0) * color / 255.0);
  }
}

/// The points of the stripes between 0 and 1. Each stripe has one color from end to end.
std::vector<double> StripePoints()
{
  constexpr double Gap = 1e-6; // points of a map must not coincide
  std::vector<double> points;
  for (int stripe = 0; stripe < NumberOfStripes; ++stripe)
  {
    AddStripeEnd(stripe, (stripe + (stripe > 0 ? Gap : 0.0)) / NumberOfStripes, points);
    AddStripeEnd(stripe, (stripe + 1.0) / NumberOfStripes, points);
  }
  return points;
}

} // namespace

/// Does not look at the array again, because its values are known: 0 to 7, or 0 to 15.
void gridfem::SetCategories(vtkSMProxy* map, bool all)
{
  const unsigned int count = all ? 16 : 8;
  std::vector<double> points;
  for (unsigned int value = 0; value < count; ++value)
  {
    points.push_back(value);
    for (unsigned char channel : Categories[value])
    {
      points.push_back(channel / 255.0);
    }
  }
  vtkSMPropertyHelper(map, "RGBPoints")
    .Set(points.data(), static_cast<unsigned int>(points.size()));
  // There are as many entries as values, one for each value. Annotated values would look the same,
  // but are looked up one by one.
  vtkSMPropertyHelper(map, "Discretize").Set(1);
  vtkSMPropertyHelper(map, "NumberOfTableValues").Set(static_cast<int>(count));
  vtkSMPropertyHelper(map, "ScalarRangeInitialized").Set(1);
  map->UpdateVTKObjects();
}

void gridfem::SetStripes(vtkSMProxy* map)
{
  constexpr int TableSize = 1000; // so that the ends of stripes are where they belong
  double range[2] = { 0.0, 1.0 };
  vtkSMTransferFunctionProxy::GetRange(map, range);
  const std::vector<double> points = StripePoints();
  vtkSMPropertyHelper(map, "RGBPoints")
    .Set(points.data(), static_cast<unsigned int>(points.size()));
  vtkSMPropertyHelper(map, "ColorSpace").Set("RGB");
  vtkSMPropertyHelper(map, "NumberOfTableValues").Set(TableSize);
  map->UpdateVTKObjects();
  vtkSMTransferFunctionProxy::RescaleTransferFunction(map, range[0], range[1], false);
}

void gridfem::OfferStripes()
{
  vtkSMTransferFunctionPresets* presets = vtkSMTransferFunctionPresets::GetInstance();
  if (presets->HasPreset(StripesName))
  {
    return;
  }
  std::ostringstream text;
  text << R"({"ColorSpace": "RGB", "Name": ")" << StripesName << R"(", "RGBPoints": [)";
  const char* separator = "";
  for (double number : StripePoints())
  {
    text << separator << number;
    separator = ", ";
  }
  text << "]}";
  presets->AddPreset(StripesName, text.str());
}
