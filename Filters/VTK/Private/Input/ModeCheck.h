// Checks whether the modes on a mesh belong to this mesh. It may have been moved since, or they may
// come from another mesh.
#ifndef GridFEM_ModeCheck_h
#define GridFEM_ModeCheck_h

#include "Spectrum/SpectralDescriptors.h"

#include <string>

namespace gridfem
{

/// Returns the reason why the modes do not belong to the mesh, for a message. Empty if they may.
///
/// Every mode is taken as linear on the triangles. Its square has to integrate to 1, and its
/// Rayleigh quotient has to be its eigenvalue. A coarse mesh is not held against a mode. The
/// integral by corners and the exact integral lie on both sides of the true mode's integral. Their
/// difference bounds the distance of the true mode. Modes with few points per wave are not checked.
/// @param modes  rows are the points of the mesh
/// Cost O(triangles · modes); the same for any number of threads.
/// @param distributed  given if several processes hold the surface, each with the mesh of its
/// triangles; all call it
std::string FindMisfit(const TriangleMesh& mesh, const PointModes& modes, int threads,
  const DistributedRows* distributed = nullptr);

} // namespace gridfem

#endif
