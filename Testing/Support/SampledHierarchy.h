// Multigrid hierarchies without a mesh. Integrals are sums over sample points in the unit grid. All
// levels use the same samples, so their matrices satisfy PᵀAP up to rounding.
#ifndef GridFEM_Testing_SampledHierarchy_h
#define GridFEM_Testing_SampledHierarchy_h

#include "Dense.h"
#include "Multigrid/Multigrid.h"

namespace gridfem::testing
{

struct Sample
{
  Vec3 position; // in units of the finest cells
  Vec3 normal;   // gradients are taken orthogonal to it; zero: full gradients
  double weight;
};

/// Returns samples that integrate trilinear elements exactly over the whole cube of 2^depth cells
/// per side.
std::vector<Sample> SolidCube(int depth);

/// Returns samples over the flat square z = 0, for a two-dimensional problem. Functions above the
/// square have zero rows.
std::vector<Sample> FlatSquare(int depth);

/// Returns points of the plane z = height + slope x inside the cube of 2^depth cells per side,
/// about 16 per cell. The functions are nearly dependent, as on any surface.
std::vector<Sample> TiltedPlane(int depth, double height, double slope);

/// Returns levels depth .. coarsestDepth of mass * M + stiffness * L, on the cells that contain
/// samples.
std::vector<MultigridLevel> SampledHierarchy(
  const std::vector<Sample>& samples, int depth, int coarsestDepth, double mass, double stiffness);

/// Returns all nonzero entries of a dense matrix.
SparseMatrix Sparse(const Eigen::MatrixXd& A);

} // namespace gridfem::testing

#endif
