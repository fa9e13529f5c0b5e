// Quadrature on a triangle, exact for polynomials up to a degree.
#ifndef GridFEM_QuadratureRule_h
#define GridFEM_QuadratureRule_h

#include "Base/Types.h"

#include <vector>

namespace gridfem
{

struct QuadratureRule
{
  struct Point
  {
    std::array<double, 3> barycentric; // sums to 1
    double weight;                     // fraction of the triangle's area; weights sum to 1
  };
  int degree;
  std::vector<Point> points;
};

/// Returns the rule of degree 2 (the thesis' three points between corners and centroid), 4, 6, 10
/// or 12. All weights are positive and all points are inside. Throws InvalidInput for another
/// degree.
const QuadratureRule& TriangleRule(int degree);

} // namespace gridfem

#endif
