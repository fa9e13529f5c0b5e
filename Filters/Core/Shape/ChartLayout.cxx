#include "Shape/ChartLayout.h"

#include <algorithm>
#include <cmath>
#include <numeric>

namespace gridfem
{
namespace
{

constexpr double Margin = 0.02; // of the side of a square with the area of all charts

void TurnLongestAlongX(MultiVector& chart)
{
  chart.rowwise() -= chart.colwise().mean().eval();
  const Eigen::Matrix2d spread = chart.transpose() * chart;
  const double angle = 0.5 * std::atan2(2.0 * spread(0, 1), spread(0, 0) - spread(1, 1));
  chart *= Eigen::Rotation2Dd(angle).toRotationMatrix(); // rows turn back by the angle
  chart.rowwise() -= chart.colwise().minCoeff().eval();
}

} // namespace

void ArrangeCharts(std::vector<MultiVector>& charts)
{
  double area = 0.0;
  double widest = 0.0;
  std::vector<double> width;
  std::vector<double> height;
  for (MultiVector& chart : charts)
  {
    TurnLongestAlongX(chart);
    width.push_back(chart.col(0).maxCoeff());
    height.push_back(chart.col(1).maxCoeff());
    widest = std::max(widest, width.back());
    area += width.back() * height.back();
  }
  const double gap = Margin * std::sqrt(area);
  const double row = std::max(widest, 1.1 * std::sqrt(area));
  std::vector<std::size_t> order(charts.size());
  std::iota(order.begin(), order.end(), 0);
  std::stable_sort(order.begin(), order.end(),
    [&](std::size_t a, std::size_t b) { return height[a] > height[b]; });
  double x = 0.0;
  double y = 0.0;
  double rowHeight = 0.0;
  for (const std::size_t k : order)
  {
    if (x > 0.0 && x + width[k] > row)
    {
      x = 0.0;
      y += rowHeight + gap;
      rowHeight = 0.0;
    }
    charts[k].col(0).array() += x;
    charts[k].col(1).array() += y;
    x += width[k] + gap;
    rowHeight = std::max(rowHeight, height[k]);
  }
}

} // namespace gridfem
