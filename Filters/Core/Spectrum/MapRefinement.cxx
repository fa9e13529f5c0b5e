#include "Spectrum/MapRefinement.h"

#include "Base/Parallel.h"
#include "Spectrum/NearestRows.h"

#include <Eigen/Cholesky>

#include <algorithm>
#include <cmath>
#include <numeric>

namespace gridfem
{
namespace
{

/// Rows that are spread over a surface, at most.
constexpr Id LargestSpread = 3000;

/// The weight of all landmarks together in a matrix, as a share of the rows.
constexpr double ShareOfLandmarks = 0.1;

/// Landmarks would distort a map of so few modes.
constexpr Index FewModes = 40;

/// Keeps normal equations regular, as a share of their mean diagonal.
constexpr double Regularization = 1e-9;

/// Eigenvalues below this share of the largest are rounding.
constexpr double Rounding = 1e-12;

/// Returns rows, each of which is the farthest in space from the rows before it.
std::vector<Id> SpreadRows(const Eigen::MatrixX3d& places, Id count)
{
  std::vector<Id> spread;
  Eigen::ArrayXd distance =
    Eigen::ArrayXd::Constant(places.rows(), std::numeric_limits<double>::infinity());
  for (Id next = 0; static_cast<Id>(spread.size()) < count;)
  {
    spread.push_back(next);
    distance =
      distance.min((places.rowwise() - places.row(next).eval()).rowwise().squaredNorm().array());
    distance.maxCoeff(&next);
  }
  return spread;
}

std::vector<Id> FirstOf(const std::vector<Id>& rows, Id count)
{
  return { rows.begin(), rows.begin() + std::min<Id>(count, static_cast<Id>(rows.size())) };
}

MultiVector Select(const MultiVector& values, const std::vector<Id>& rows, Index columns)
{
  return values(rows, Eigen::seqN(0, columns));
}

} // namespace

ModeRows::ModeRows(const ModesOfShape& shape, Index count)
  : eigenvalues(shape.modes.eigenvalues.begin(), shape.modes.eigenvalues.begin() + count),
    rowOf(shape.isReached.size(), -1)
{
  const double least = Rounding * eigenvalues.back() * shape.modes.area;
  for (double& value : eigenvalues)
  {
    value = std::max(value * shape.modes.area, least);
  }
  for (std::size_t k = 0; k < shape.isReached.size(); ++k)
  {
    if (shape.isReached[k])
    {
      rowOf[k] = static_cast<Id>(point.size());
      point.push_back(static_cast<Id>(k));
    }
  }
  const double side = std::sqrt(shape.modes.area);
  values = side * Select(shape.modes.values, point, count);
  places.resize(static_cast<Id>(point.size()), 3);
  for (Id row = 0; row < places.rows(); ++row)
  {
    places.row(row) = shape.mesh.points[point[row]] / side;
  }
  spread = SpreadRows(places, std::min(LargestSpread, static_cast<Id>(places.rows())));
}

MapRefinement::MapRefinement(const ModeRows& surface, const ModeRows& reference,
  const std::vector<Landmark>& landmarks, int threads)
  : surface_(surface), reference_(reference), threads_(threads)
{
  for (const Landmark& landmark : landmarks)
  {
    marked_.push_back(surface.rowOf[landmark[0]]);
    partners_.push_back(reference.rowOf[landmark[1]]);
  }
}

std::vector<Id> MapRefinement::ImageOf(const MultiVector& matrix, const std::vector<Id>& rows,
  const std::vector<Id>& among, const Progress& progress) const
{
  const auto modes = static_cast<Index>(matrix.rows());
  const NearestRows reference(
    Select(reference_.values, among, modes) * matrix.transpose(), threads_);
  std::vector<Id> image =
    reference.Find(Select(surface_.values, rows, modes), { threads_, progress });
  for (Id& row : image)
  {
    row = among[row];
  }
  return image;
}

MultiVector MapRefinement::Fit(
  const std::vector<Id>& rows, const std::vector<Id>& image, Index modes) const
{
  MultiVector ofSurface = Select(surface_.values, rows, modes);
  MultiVector ofReference = Select(reference_.values, image, modes);
  Eigen::MatrixXd normal = ofSurface.transpose() * ofSurface;
  Eigen::MatrixXd right = ofSurface.transpose() * ofReference;
  if (!marked_.empty() && modes > FewModes)
  {
    const double weight = ShareOfLandmarks * double(rows.size()) / double(marked_.size());
    ofSurface = Select(surface_.values, marked_, modes);
    ofReference = Select(reference_.values, partners_, modes);
    normal += weight * ofSurface.transpose() * ofSurface;
    right += weight * ofSurface.transpose() * ofReference;
  }
  normal.diagonal().array() += Regularization * normal.diagonal().mean();
  return normal.ldlt().solve(right);
}

PartialMap MapRefinement::Refine(
  MultiVector matrix, const RefinementSizes& sizes, const Progress& progress) const
{
  const std::vector<Id> rows = FirstOf(surface_.spread, sizes.surfaceRows);
  const std::vector<Id> among = FirstOf(reference_.spread, sizes.referenceRows);
  PartialMap map;
  for (auto modes = static_cast<Index>(matrix.rows());; matrix = this->Fit(rows, map.image, modes))
  {
    progress.Check(std::pow(double(modes) / double(sizes.modes), 2));
    map.image = this->ImageOf(matrix, rows, among);
    if (modes >= sizes.modes)
    {
      break;
    }
    modes = std::min(sizes.modes, modes + std::max(1, static_cast<Index>(sizes.growth * modes)));
  }
  const auto modes = static_cast<Index>(matrix.rows());
  const MultiVector difference = Select(surface_.values, rows, modes) -
                                 Select(reference_.values, map.image, modes) * matrix.transpose();
  map.meanMismatch = std::sqrt(difference.squaredNorm() / double(difference.size()));
  map.matrix = std::move(matrix);
  return map;
}

double MapRefinement::MissedLandmarks(const MultiVector& matrix) const
{
  if (marked_.empty())
  {
    return 0.0;
  }
  const std::vector<Id> image = this->ImageOf(matrix, marked_, reference_.spread);
  double sum = 0.0;
  for (std::size_t k = 0; k < image.size(); ++k)
  {
    sum += (reference_.places.row(image[k]) - reference_.places.row(partners_[k])).norm();
  }
  return sum / double(image.size());
}

} // namespace gridfem
