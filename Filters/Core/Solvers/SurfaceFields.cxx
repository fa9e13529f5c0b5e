#include "Solvers/SurfaceFields.h"

#include "Base/Errors.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace gridfem
{
namespace
{

std::string NameOf(const GivenField& values)
{
  return values ? values.name : "coordinates";
}

} // namespace

Field UsedCoordinates(const TriangleMesh& mesh)
{
  const std::vector<char> used = UsedPoints(mesh);
  Field field;
  field.values = MultiVector::Zero(static_cast<Id>(mesh.points.size()), 3);
  for (std::size_t point = 0; point < used.size(); ++point)
  {
    if (used[point])
    {
      field.values.row(point) = mesh.points[point].transpose();
    }
  }
  return field;
}

Field ReadField(const Surface& surface, const GivenField& field, NaNs nans)
{
  if (!field)
  {
    return UsedCoordinates(surface.CurrentMesh());
  }
  Field read;
  surface.Together([&] { read = field.read(nans); });
  return read;
}

std::unique_ptr<const Field> ReadOptional(const Surface& surface, const GivenField& field)
{
  return field ? std::make_unique<const Field>(ReadField(surface, field)) : nullptr;
}

Eigen::RowVectorXd LargeConstants(
  const Surface& surface, const MultiVector& values, const std::vector<char>& isUsed)
{
  constexpr double SmallVariation = 1e-5;
  constexpr double None = -std::numeric_limits<double>::infinity();
  const auto larger = [](double a, double b) { return std::fmax(a, b); };
  Eigen::RowVectorXd greatest = Eigen::RowVectorXd::Constant(values.cols(), None);
  Eigen::RowVectorXd smallest = greatest; // its negative
  for (Id row = 0; row < values.rows(); ++row)
  {
    if (isUsed.empty() || isUsed[row])
    {
      greatest = greatest.binaryExpr(values.row(row), larger);
      smallest = smallest.binaryExpr(-values.row(row), larger);
    }
  }
  Eigen::RowVectorXd constants = Eigen::RowVectorXd::Zero(values.cols());
  for (Id c = 0; c < values.cols(); ++c)
  {
    const double most = surface.Largest(greatest[c]);
    const double least = -surface.Largest(smallest[c]);
    const double size = std::min(std::abs(most), std::abs(least));
    if (most - least < SmallVariation * size)
    {
      constants[c] = least + 0.5 * (most - least);
    }
  }
  return constants;
}

Eigen::RowVectorXd TakeConstantsOut(const Surface& surface, Field& field)
{
  const bool onPoints = field.association == FieldAssociation::Points;
  const Eigen::RowVectorXd constants = LargeConstants(surface, field.values,
    onPoints ? UsedPoints(surface.Mesh(), surface.Threads()) : std::vector<char>());
  if (!constants.isZero(0.0))
  {
    field.values.rowwise() -= constants;
  }
  return constants;
}

void RequireHoldable(const GivenField& values, const GivenConstraints& constraints, bool onBoundary)
{
  if ((constraints || onBoundary) && !values.IsOnPoints())
  {
    throw InvalidInput((constraints ? constraints.property : std::string("Boundary Values")) +
                       " needs point data, but '" + values.name +
                       "' is a cell array. Convert it with Cell Data to Point Data.");
  }
}

HeldValues HoldConstraints(
  const Surface& surface, const GivenField& values, const GivenConstraints& constraints)
{
  PointValues known;
  known.values.resize(0, ComponentsOf(values));
  if (!constraints)
  {
    return surface.Hold(known.points, known.values);
  }
  surface.Together([&] { known = constraints.find(); });
  if (!surface.Any(!known.points.empty()))
  {
    throw InvalidInput("No value of '" + NameOf(values) +
                       "' is known at a point of a polygon: all are NaN, masked, or not selected.");
  }
  return surface.Hold(known.points, known.values);
}

} // namespace gridfem
