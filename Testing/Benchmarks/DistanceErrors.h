// Errors of distances against exact distances.
#ifndef GridFEM_Benchmarks_DistanceErrors_h
#define GridFEM_Benchmarks_DistanceErrors_h

#include <vector>

namespace gridfem::benchmarks
{

/// In the longest exact distance.
struct DistanceErrors
{
  double largest = 0.0;
  double mean = 0.0; // root mean square over the points
};

/// Points that the source does not reach, at infinity, do not count.
DistanceErrors ErrorsOf(const std::vector<double>& found, const std::vector<double>& exact);

} // namespace gridfem::benchmarks

#endif
