// Scalar and vector types shared by all of Core.
// Ids have 64 bits. Arrays that store ids of points, pieces, patches and functions use 32 bits,
// because they fill most of the memory. A mesh with more than 2^31 - 1 items of a kind is refused
// (RequireIndices).
#ifndef GridFEM_Types_h
#define GridFEM_Types_h

// Parallel.h distributes fixed blocks over threads. Eigen's own threads would make the bits of
// results depend on their number.
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
/// The storage is row-major, so that the columns of a row are contiguous in memory and fill SIMD
/// lanes.
template<class Real>
using Vectors = Eigen::Matrix<Real, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>;
using MultiVector = Vectors<double>;

} // namespace gridfem

#endif
