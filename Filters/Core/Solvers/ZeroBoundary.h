// The functions of a surface that vanish on its boundary.
#ifndef GridFEM_ZeroBoundary_h
#define GridFEM_ZeroBoundary_h

#include "Equations/PenalizedLevels.h"
#include "Solvers/Surface.h"

#include <memory>

namespace gridfem
{

/// The levels of the surface, whose stiffness has a penalty on the values along the boundary. Null
/// if the surface has no boundary. Functions of the grid cannot vanish along a curve and still have
/// a slope across it. The penalty therefore grows with the resolution only as fast as the error of
/// the functions along the curve falls, so that eigenvalues keep their second order. Hat functions
/// can vanish there, up to rounding. Collective. Keeps a reference to the space of the surface.
/// Babuška: The Finite Element Method with Penalty, 1973.
std::unique_ptr<const PenalizedLevels> ZeroOnBoundary(const Surface& surface);

} // namespace gridfem

#endif
