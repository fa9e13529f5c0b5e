// Whether the modes on a mesh are those of this mesh: it may have been moved since, or they may
// come from another one.
#ifndef GridFEM_ModeCheck_h
#define GridFEM_ModeCheck_h

#include "Problems/SpectralDescriptors.h"

#include <string>

namespace gridfem
{

/// Why the modes are not those of the mesh, for a message; empty when they may be.
///
/// Every mode is taken as linear on the triangles. Its square has to integrate to 1, and its
/// Rayleigh quotient has to be its eigenvalue. What the mesh is too coarse for is not held against
/// a mode: the integral by corners and the exact one lie on both sides of that of the true mode,
/// and how far they are apart says how far the true mode may be. Modes of few points per wave are
/// not looked at.
/// @param modes  rows = points of the mesh
/// Cost O(triangles · modes); the same for any number of threads.
/// @param divided  where several processes hold the surface, each with the mesh of its triangles;
///                 all call it
std::string FindMisfit(const TriangleMesh& mesh, const PointModes& modes, int threads,
  const DividedRows* divided = nullptr);

} // namespace gridfem

#endif
