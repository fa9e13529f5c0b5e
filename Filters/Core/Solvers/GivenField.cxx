#include "Solvers/GivenField.h"

#include "Base/Errors.h"

#include <cmath>
#include <memory>
#include <utility>

namespace gridfem
{
namespace
{

void RequireNumbers(const std::string& name, const Field& field, NaNs nans)
{
  for (Id row = 0; row < field.values.rows(); ++row)
  {
    for (Id c = 0; c < field.values.cols(); ++c)
    {
      const double value = field.values(row, c);
      if (!std::isfinite(value) && !(nans == NaNs::Kept && std::isnan(value)))
      {
        const bool onPoints = field.association == FieldAssociation::Points;
        throw InvalidInput("Array '" + name + "' has a NaN or infinite value at " +
                           (onPoints ? "point " : "triangle ") + std::to_string(row) + ".");
      }
    }
  }
}

} // namespace

GivenField GivenField::Of(std::string name, Field field, std::int64_t number)
{
  const auto kept = std::make_shared<const Field>(std::move(field));
  GivenField given;
  given.name = std::move(name);
  given.association = kept->association;
  given.components = kept->values.cols();
  given.version.Add(number);
  given.read = [kept, called = given.name](NaNs nans)
  {
    RequireNumbers(called, *kept, nans);
    return *kept;
  };
  return given;
}

StageKey KeyOf(const GivenField& field)
{
  StageKey key;
  key.Add(field.components > 0).Add(field.association).Add(field.version);
  return key;
}

StageKey KeyOf(const GivenConstraints& constraints)
{
  StageKey key;
  key.Add(static_cast<bool>(constraints)).Add(constraints.version);
  return key;
}

} // namespace gridfem
