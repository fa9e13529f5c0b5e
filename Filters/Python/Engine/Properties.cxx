#include "Properties.h"

#include "Base/Errors.h"
#include "Solvers/Requirements.h"

#include <cmath>
#include <limits>

namespace gridfem
{
namespace
{

constexpr double Infinity = std::numeric_limits<double>::infinity();

} // namespace

double Properties::Take(const std::string& name, const Property& property)
{
  known_[name] = property;
  const auto given = given_.find(name);
  if (given == given_.end())
  {
    return property.standard;
  }
  RequireInRange(name, given->second, property.least, property.most);
  return given->second;
}

double Properties::Number(const std::string& name, double standard, double least, double most)
{
  return this->Take(name, { standard, least, most });
}

int Properties::Integer(const std::string& name, int standard, int least, int most)
{
  const double value = this->Take(name, { double(standard), double(least), double(most) });
  if (value != std::floor(value))
  {
    throw InvalidInput(LabelOf(name) + " must be an integer.");
  }
  return static_cast<int>(value);
}

bool Properties::Switch(const std::string& name, bool standard)
{
  return this->Take(name, { standard ? 1.0 : 0.0, -Infinity, Infinity }) != 0.0;
}

void Properties::RequireNoOther() const
{
  for (const auto& [name, value] : given_)
  {
    if (known_.count(name) == 0)
    {
      throw InvalidInput(owner_ + " has no property " + name);
    }
  }
}

} // namespace gridfem
