// Maps a disk to the plane so that lengths change as little as possible.
#ifndef GridFEM_IsometricMap_h
#define GridFEM_IsometricMap_h

#include "Shape/DiskMetric.h"

#include "Base/Job.h"

#include <vector>

namespace gridfem
{

/// A map of a disk, and how it was found.
struct PlaneMap
{
  MultiVector plane; // a row of two coordinates for each vertex
  bool hasConverged = true;
  int steps = 0;
  double gain = 0.0; // part of the energy that another step would take away; NaN: no step was found
};

/// Minimizes the symmetric Dirichlet energy ∫ |J|² + |J⁻¹|², where J is the derivative of the map
/// [Smith and Schaefer 2015]. It is least where the map keeps lengths, and grows without bound
/// where a triangle shrinks to a line. So no step flips a triangle, or stops short of one.
///
/// Steps solve with the stiffness whose triangles have the weights of the energy, which suits parts
/// that are thousands of times too small [Rabinovich et al. 2017, Scalable Locally Injective
/// Mappings]. Once whole steps succeed, they also learn from steps before (L-BFGS). The map has
/// converged if another step would lower the energy by less than a thousandth. The least energy of
/// the surface, 4 for each area, does not count.
/// @param start  a map that flips no triangle; otherwise it is returned after no step
PlaneMap MapIsometrically(
  const Disk& disk, const std::vector<SideLengths>& sides, MultiVector start, const Job& job);

} // namespace gridfem

#endif
