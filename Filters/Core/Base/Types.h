// Scalar and vector types shared by all of Core.
// Ids have 64 bits. Arrays of numbers of points, pieces, patches and functions have 32, because
// they fill most of the memory; a mesh with more than 2^31 - 1 of a kind is refused
// (RequireIndices).
#ifndef GridFEM_Types_h
#define GridFEM_Types_h

// Threads are split over fixed blocks by Parallel.h; Eigen's own would change bits with their
// number.
#ifndef EIGEN_DONT_PARALLELIZE
#define EIGEN_DONT_PARALLELIZE
#endif
#include <Eigen/Core>
#include <Eigen/Geometry>

#include <array>
#include <cstdint>

namespace gridfem
{

using Id = std::int64_t;
using Index = std::int32_t;
using Vec3 = Eigen::Vector3d;

/// Several vectors side by side: one row per function (or point), one column per right-hand side.
/// Row-major, so that the columns of one row are neighbours in memory and fill SIMD lanes.
template<class Real>
using Vectors = Eigen::Matrix<Real, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>;
using MultiVector = Vectors<double>;

} // namespace gridfem

#endif
