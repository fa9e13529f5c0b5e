#include "Grid/RequireSurface.h"

#include "Base/Errors.h"

namespace gridfem
{

void RequireSurface(const TriangleMesh& mesh)
{
  Validate(mesh);
  const auto [low, high] = BoundsOf(mesh.points, UsedPoints(mesh));
  // For lengths outside this range, squares of lengths or of eigenvalues leave the range of
  // doubles.
  constexpr double largest = 1e70;
  const double extent = (high - low).maxCoeff();
  if (low.minCoeff() < -largest || high.maxCoeff() > largest ||
      (extent > 0.0 && extent < 1.0 / largest))
  {
    throw InvalidInput("The surface is too large, too far away or too small for the range of "
                       "numbers. Scale it first, for example with the Transform filter.");
  }
  // Clipping rounds to about 1e-13 of the extent, so a narrower surface falls apart.
  if (!(SurfaceArea(mesh) > 1e-11 * (high - low).squaredNorm()))
  {
    throw InvalidInput("The surface has no area: all polygons are degenerate or narrower than the "
                       "rounding of their points.");
  }
}

} // namespace gridfem
