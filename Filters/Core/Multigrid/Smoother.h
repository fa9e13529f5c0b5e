// Relaxation on one level: Gauss-Seidel [T §4.2] and the multiplicative patch smoother. No
// orientation of the surface slows the patch smoother down. Both work in blocks of neighboring
// cells. Blocks of one color do not touch each other, so they run in parallel and the result never
// depends on threads.
#ifndef GridFEM_Smoother_h
#define GridFEM_Smoother_h

#include "Algebra/SparseMatrix.h"
#include "Multigrid/UnknownGroups.h"

#include <memory>
#include <vector>

namespace gridfem
{

/// Patches of a level in the order in which a forward sweep visits them. A backward sweep visits
/// them in the opposite order. It knows no mesh: groups of unknowns suffice.
struct PatchOrder
{
  UnknownGroups dof;
  /// Block k has the patches blockBegin[k] .. blockBegin[k + 1). Blocks are sorted by color.
  std::vector<Id> blockBegin;
  /// Color c has the blocks colorBegin[c] .. colorBegin[c + 1). The matrix does not couple
  /// unknowns of two blocks of one color.
  std::vector<Id> colorBegin;
  /// The height of each unknown's grid corner in cells; empty if unknowns have no corner. The
  /// matrix does not couple unknowns whose heights differ by more than one.
  std::vector<Index> slice;
  /// The number i + 4 j + 12 k of each unknown's grid corner; empty if unknowns have no corner.
  /// Coupled unknowns differ by at most one in i, j and k, so the difference determines their
  /// relative position.
  std::vector<Index> corner;
};

enum class SweepDirection
{
  Forward,
  Backward
};

/// Precision of the factors that a patch smoother stores.
enum class FactorPrecision
{
  Mixed = 0,  // single where its rounding changes nothing, else double
  Single = 1, // single wherever its range holds the numbers, however they are rounded
  Double = 2
};

/// Interface of all smoothers. Real is the precision of the vectors and of the matrix.
template<class Real>
class BasicSmoother
{
public:
  virtual ~BasicSmoother() = default;

  /// One sweep: improves x for A x = b, with the matrix the smoother was made for. Any number of
  /// columns; same bits for any number of threads (0: all). The backward sweep is the adjoint of
  /// the forward sweep.
  virtual void Sweep(const BasicSparseMatrix<Real>& A, const Vectors<Real>& b, Vectors<Real>& x,
    SweepDirection direction, int threads) const = 0;

  /// True if double precision could make a sweep better.
  virtual bool HasSingleFactors() const { return false; }

  /// True if sweeps compute in single precision. If vectors are in double, x has to be a
  /// correction, and the largest number of b near 1.
  virtual bool IsSingle() const { return false; }

  /// Takes new values of the matrix in place. Returns false if it cannot; a new smoother then has
  /// to be made.
  virtual bool Refill(const SparseMatrix& /*A*/, const PatchOrder& /*order*/, int /*threads*/)
  {
    return false;
  }

  /// Number of patches that a sweep does not relax in all directions that double precision
  /// resolves.
  virtual Id UnresolvedPatches() const { return 0; }

  /// Memory in bytes.
  virtual std::size_t Memory() const = 0;
};

using Smoother = BasicSmoother<double>;

/// Gauss-Seidel: relaxes every unknown once, in the order of the first patch that contains it.
/// Leaves alone the unknowns of no patch and rows whose diagonal is not a positive number. Throws
/// InvalidInput when the order does not fit the matrix.
std::unique_ptr<Smoother> MakeGaussSeidel(const SparseMatrix& A, const PatchOrder& order);

/// Gauss-Seidel of [T §4.2, Fig. 4.3]. Slabs of slices are relaxed in parallel, and the threads
/// wait for each other only once in `sweeps` sweeps. One Sweep does all of these sweeps.
/// Sweep i of a slab leaves out the i slices at its lower end and the i + 1 slices at its upper
/// end. When all slabs are done, the slices around each boundary follow. The result equals, bit for
/// bit, `sweeps` successive sweeps, each first over the slabs' and then over the boundaries'
/// slices.
/// The thesis has a slab per thread; here slabs depend on the slices alone. Throws InvalidInput
/// when the order has no slices, the matrix couples slices that do not touch, or sweeps < 1.
std::unique_ptr<Smoother> MakeSliceGaussSeidel(
  const SparseMatrix& A, const PatchOrder& order, int sweeps);

/// Boundaries of the slabs: the lowest slice of every slab but the lowest. Slabs hold about equally
/// many unknowns. They have at least the 2 `sweeps` slices that keep the boundaries of a slab
/// apart.
std::vector<Index> SlabBoundaries(const std::vector<Index>& slice, int sweeps);

/// Multiplicative Schwarz: solves the block of A of each patch. The local solve is a pivoted
/// Cholesky of the block, scaled by its diagonal and stopped at pivot 1e-14.
/// The smoother stores the inverse factor of the kept part. It is in single precision where
/// rounding changes nothing (no pivot below 1e-11), else in double. The sweep stays symmetric and
/// as good as with exact solves on any surface.
/// Leaves alone the unknowns of no patch and unknowns whose diagonal is not a positive number.
/// Patches of another size than PatchKernelWidth take general loops, with all factors in double.
/// Throws InvalidInput when the order does not fit the matrix or patches have more than 64
/// unknowns. [NUMERICS §1]
std::unique_ptr<Smoother> MakePatchSmoother(const SparseMatrix& A, const PatchOrder& order,
  int threads = 0, FactorPrecision precision = FactorPrecision::Mixed);

/// The patch smoother for vectors in single precision. Pivots below 1e-6 stop the Cholesky
/// factorization. In their directions, rounding would disturb the corrections too much. Patches
/// whose numbers leave the range of single precision are left alone.
std::unique_ptr<BasicSmoother<float>> MakeSinglePatchSmoother(
  const SparseMatrix& A, const PatchOrder& order, int threads = 0);

/// Makes a smoother with the same sweep as MakePatchSmoother's, in a half to a third of the time.
/// Rows are stencils of the grid, and everything is stored and computed in single precision
/// (Smoother::IsSingle). Patches with pivots below 1e-6 are relaxed once more in double precision.
/// Flat faces almost parallel to a plane of the grid have such patches. Returns null if more than a
/// tenth of the patches have such pivots. The result is also null if patches are not the eight
/// corners of a cell, or if many of them share a cell. See StencilBlocks.
/// @param patternFits  if not null: false if the result is null for any values of the matrix
std::unique_ptr<Smoother> MakeStencilSmoother(
  const SparseMatrix& A, const PatchOrder& order, int threads = 0, bool* patternFits = nullptr);

} // namespace gridfem

#endif
