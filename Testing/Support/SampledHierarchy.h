// Multigrid hierarchies without a mesh: integrals are sums over sample points in the unit grid.
// All levels use the same samples, so their matrices obey PᵀAP to rounding.
#ifndef GridFEM_Testing_SampledHierarchy_h
#define GridFEM_Testing_SampledHierarchy_h

#include "Dense.h"
#include "Multigrid/Multigrid.h"

#include <cstdint>

namespace gridfem::testing
{

struct Sample
{
  Vec3 position; // in units of the finest cells
  Vec3 normal;   // gradients are taken orthogonal to it; zero: full gradients
  double weight;
};

/// Samples that integrate trilinear elements exactly over the whole cube of 2^depth cells per side.
std::vector<Sample> SolidCube(int depth);

/// The same over the flat square z = 0: a two-dimensional problem. Functions above it have zero
/// rows.
std::vector<Sample> FlatSquare(int depth);

/// Points of the plane z = height + slope x inside the cube of 2^depth cells, some 16 per cell. The
/// functions are nearly dependent, as they are on any surface.
std::vector<Sample> TiltedPlane(int depth, double height, double slope);

/// Levels depth .. coarsestDepth of mass * M + stiffness * L on the cells that hold samples.
std::vector<MultigridLevel> SampledHierarchy(
  const std::vector<Sample>& samples, int depth, int coarsestDepth, double mass, double stiffness);

/// Entries in [-1, 1], the same for the same seed.
MultiVector RandomVectors(Id rows, Id columns, std::uint32_t seed = 1);

/// The largest difference of two blocks relative to the largest entry of the second.
double RelativeDifference(const MultiVector& a, const MultiVector& b);

/// All entries of a dense matrix that are not zero.
SparseMatrix Sparse(const Eigen::MatrixXd& A);

} // namespace gridfem::testing

#endif
