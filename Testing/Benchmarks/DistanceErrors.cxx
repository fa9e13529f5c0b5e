#include "DistanceErrors.h"

#include "Largest.h"

#include <algorithm>
#include <cmath>

namespace gridfem::benchmarks
{

DistanceErrors ErrorsOf(const std::vector<double>& found, const std::vector<double>& exact)
{
  DistanceErrors errors;
  double longest = 0.0;
  double count = 0.0;
  for (std::size_t i = 0; i < found.size(); ++i)
  {
    if (std::isfinite(exact[i]))
    {
      const double error = std::abs(found[i] - exact[i]);
      longest = testing::Larger(longest, exact[i]);
      errors.largest = testing::Larger(errors.largest, error);
      errors.mean += error * error;
      count += 1.0;
    }
  }
  errors.largest /= longest;
  errors.mean = std::sqrt(errors.mean / count) / longest;
  return errors;
}

} // namespace gridfem::benchmarks
