#include "Solvers/Surface.h"

#include "Base/UnsolvedRows.h"
#include "Distance/GeodesicDistance.h"
#include "Solvers/MemoryEstimate.h"

#include <cmath>

namespace gridfem
{

double Surface::WeightInSpaceUnits(double weight) const
{
  double length2 = 1.0; // the squared unit of length, world units
  switch (this->UsedOptions().parameterUnits)
  {
    case ParameterUnits::UnitArea:
      length2 = this->Area();
      break;
    case ParameterUnits::UnitCube:
      length2 = this->LongestSide() * this->LongestSide();
      break;
    case ParameterUnits::World:
      break;
  }
  const double unit = this->Space().UnitLength();
  return weight / length2 * unit * unit;
}

double Surface::LengthInWorldUnits(double length) const
{
  return length * this->Space().UnitLength() / std::sqrt(this->WeightInSpaceUnits(1.0));
}

std::unique_ptr<DistanceMethod> Surface::MakeDistance(
  const DistanceOptions& options, const Job& job) const
{
  RequireFirstDegree(this->UsedOptions().choice.kind, "Distances");
  return std::make_unique<GeodesicDistance>(this->WholeSpace(), this->SharedMesh(), options, job);
}

void Surface::Require(const MemoryNeed& own) const
{
  RequireMemory(own, AvailableMemory());
}

MultiVector Surface::ValuesAtPoints(const MultiVector& coefficients, const Progress& progress) const
{
  MultiVector values = this->Space().ValuesAtPoints(coefficients, this->MakeJob(progress));
  this->CompleteAtPoints(values);
  return values;
}

void Surface::CompleteAtPoints(MultiVector& atPoints) const
{
  ClearRows(this->Space().PointsWithFunctions(), atPoints);
  this->FillCopies(atPoints);
}

} // namespace gridfem
