#include "Spectrum/MapStarts.h"

#include <Eigen/Cholesky>

#include <algorithm>
#include <cmath>
#include <numeric>

namespace gridfem
{
namespace
{

constexpr Index SignedModes = 5;       // after the constant
constexpr double CloseRatio = 1.3;     // of eigenvalues that may change places
constexpr Index ModesOfLandmarks = 20; // at most
constexpr Index BandsOfLandmarks = 15;
constexpr double WidthOfBands = 7.0 / 128.0; // as a share of the range (WaveBands)

/// The importance of similar eigenvalues beside a function around a landmark.
constexpr double WeightOfEigenvalues = 1.0 / 600.0;

/// The orders of the signed modes: as they are, and with two close neighbors exchanged.
std::vector<std::vector<Index>> Orders(const ModeRows& surface, const ModeRows& reference)
{
  std::vector<Index> order(SignedModes + 1);
  std::iota(order.begin(), order.end(), 0);
  std::vector<std::vector<Index>> orders = { order };
  for (Index k = 1; k < SignedModes; ++k)
  {
    const double ratio = std::min(surface.eigenvalues[k + 1] / surface.eigenvalues[k],
      reference.eigenvalues[k + 1] / reference.eigenvalues[k]);
    if (ratio < CloseRatio)
    {
      orders.push_back(order);
      std::swap(orders.back()[k], orders.back()[k + 1]);
    }
  }
  return orders;
}

/// Returns the shares of the modes (rows) in functions around points (columns), each with norm 1:
/// for each point and band, the sum of the modes times their values at the point, with the weights
/// of the band.
Eigen::MatrixXd FunctionsAround(const ModeRows& modes, const std::vector<Id>& points, Index shares)
{
  const auto number = static_cast<double>(BandsOfLandmarks - 1);
  const double low = std::log(modes.eigenvalues[1]);
  const double range = std::log(modes.eigenvalues.back()) - low;
  const double width = std::max(WidthOfBands * range, 1e-3);
  Eigen::MatrixXd functions(modes.Count(), BandsOfLandmarks * static_cast<Index>(points.size()));
  Id column = 0;
  for (const Id point : points)
  {
    for (Index band = 0; band < BandsOfLandmarks; ++band, ++column)
    {
      const double energy = low + 2.0 * width + double(band) / number * (range - 4.0 * width);
      functions(0, column) = 0.0;
      for (Index k = 1; k < modes.Count(); ++k)
      {
        const double from = (energy - std::log(modes.eigenvalues[k])) / width;
        functions(k, column) = std::exp(-0.5 * from * from) * modes.values(modes.rowOf[point], k);
      }
    }
  }
  functions.colwise().normalize();
  return functions.topRows(shares);
}

std::vector<Id> PointsOf(const std::vector<Landmark>& landmarks, int side)
{
  std::vector<Id> points;
  for (const Landmark& landmark : landmarks)
  {
    points.push_back(landmark[side]);
  }
  return points;
}

} // namespace

std::vector<MultiVector> StartsBySigns(const ModeRows& surface, const ModeRows& reference)
{
  std::vector<MultiVector> starts;
  for (const std::vector<Index>& order : Orders(surface, reference))
  {
    for (unsigned signs = 0; signs < 1U << SignedModes; ++signs)
    {
      MultiVector start = MultiVector::Zero(SignedModes + 1, SignedModes + 1);
      start(0, 0) = 1.0;
      for (Index k = 1; k <= SignedModes; ++k)
      {
        start(k, order[k]) = (signs >> (k - 1)) % 2 == 0 ? 1.0 : -1.0;
      }
      starts.push_back(std::move(start));
    }
  }
  return starts;
}

/// Each row of the map is a least-squares problem of its own, because eigenvalues that differ weigh
/// on single entries.
MultiVector StartByLandmarks(
  const ModeRows& surface, const ModeRows& reference, const std::vector<Landmark>& landmarks)
{
  const Index modes = std::min(ModesOfLandmarks, surface.Count());
  const Eigen::MatrixXd onSurface = FunctionsAround(surface, PointsOf(landmarks, 0), modes);
  const Eigen::MatrixXd onReference = FunctionsAround(reference, PointsOf(landmarks, 1), modes);
  const Eigen::MatrixXd normal = onReference * onReference.transpose();
  Eigen::ArrayXXd differences(modes, modes);
  for (Index row = 0; row < modes; ++row)
  {
    for (Index column = 0; column < modes; ++column)
    {
      differences(row, column) =
        std::pow(surface.eigenvalues[row] - reference.eigenvalues[column], 2);
    }
  }
  differences /= differences.matrix().norm();
  const double weight = WeightOfEigenvalues * double(onSurface.cols());
  MultiVector start = MultiVector::Zero(modes, modes);
  start(0, 0) = 1.0;
  for (Index row = 1; row < modes; ++row)
  {
    Eigen::MatrixXd system = normal;
    system.diagonal() += weight * differences.row(row).matrix().transpose();
    system.diagonal().array() += 1e-9 * normal.trace() / double(modes);
    start.row(row).tail(modes - 1) =
      system.bottomRightCorner(modes - 1, modes - 1)
        .ldlt()
        .solve((onReference * onSurface.row(row).transpose()).tail(modes - 1))
        .transpose();
  }
  return start;
}

} // namespace gridfem
