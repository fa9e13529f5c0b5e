// Relaxation on one level: Gauss-Seidel [T §4.2] and the multiplicative patch smoother that no
// orientation of the surface slows down. Both work in blocks of neighbouring cells; blocks of one
// colour do not touch each other, so they run in parallel and the result never depends on threads.
#ifndef GridFEM_Smoother_h
#define GridFEM_Smoother_h

#include "Algebra/SparseMatrix.h"
#include "Multigrid/UnknownGroups.h"

#include <memory>
#include <vector>

namespace gridfem
{

/// Patches of a level in the order a forward sweep visits them; a backward sweep visits them in the
/// opposite order. Knows no mesh: groups of unknowns suffice.
struct PatchOrder
{
  UnknownGroups dof;
  /// Block k has the patches blockBegin[k] .. blockBegin[k + 1). Blocks are sorted by colour.
  std::vector<Id> blockBegin;
  /// Colour c has the blocks colourBegin[c] .. colourBegin[c + 1). Unknowns of two blocks of one
  /// colour are not coupled by the matrix.
  std::vector<Id> colourBegin;
  /// Per unknown, the height of its grid corner in cells; empty where unknowns have none. Unknowns
  /// whose heights differ by more than one are not coupled by the matrix.
  std::vector<Index> slice;
  /// Per unknown, i + 4 j + 12 k of its grid corner; empty where unknowns have none. Coupled
  /// unknowns differ by at most one in i, j and k, so that the difference tells their positions.
  std::vector<Index> corner;
};

enum class SweepDirection
{
  Forward,
  Backward
};

/// Of the factors that a patch smoother stores.
enum class FactorPrecision
{
  Mixed = 0,  // single where its rounding changes nothing, else double
  Single = 1, // single wherever it holds the numbers, however they are rounded
  Double = 2
};

/// Real: of the vectors and of the matrix.
template<class Real>
class BasicSmoother
{
public:
  virtual ~BasicSmoother() = default;

  /// One sweep: improves x for A x = b, with the matrix the smoother was made for. Any number of
  /// columns; same bits for any number of threads (0: all). The backward sweep is the adjoint of
  /// the forward one.
  virtual void Sweep(const BasicSparseMatrix<Real>& A, const Vectors<Real>& b, Vectors<Real>& x,
    SweepDirection direction, int threads) const = 0;

  /// True if double precision could make a sweep better.
  virtual bool HasSingleFactors() const { return false; }

  /// True if sweeps compute in single precision. Where vectors are in double, x is to be a
  /// correction, and the largest number of b near 1.
  virtual bool IsSingle() const { return false; }

  /// Takes new values of the matrix in place. False where it cannot: then a new smoother has to be
  /// made.
  virtual bool Refill(const SparseMatrix& /*A*/, const PatchOrder& /*order*/, int /*threads*/)
  {
    return false;
  }

  /// Patches that a sweep does not relax in all directions that double precision resolves.
  virtual Id UnresolvedPatches() const { return 0; }

  /// Bytes held.
  virtual std::size_t Memory() const = 0;
};

using Smoother = BasicSmoother<double>;

/// Gauss-Seidel: every unknown once, in the order of the first patch that contains it. Unknowns of
/// no patch, and rows whose diagonal is not a positive number, are left alone. Throws InvalidInput
/// when the order does not fit the matrix.
std::unique_ptr<Smoother> MakeGaussSeidel(const SparseMatrix& A, const PatchOrder& order);

/// Gauss-Seidel of [T §4.2, Fig. 4.3]: slabs of slices are relaxed in parallel, and the threads
/// wait for each other only once in `sweeps` sweeps, all of which one Sweep does. Sweep i of a slab
/// leaves out the i slices at its lower and the i + 1 at its upper end; when all slabs are done,
/// what was left out around each boundary follows. The result is, bit for bit, that of so many
/// sweeps one after the other, each first over the slabs' and then over the boundaries' slices. The
/// thesis has a slab per thread; here they depend on the slices alone. Throws InvalidInput when the
/// order has no slices, the matrix couples slices that do not touch, or sweeps < 1.
std::unique_ptr<Smoother> MakeSliceGaussSeidel(
  const SparseMatrix& A, const PatchOrder& order, int sweeps);

/// Where its slabs meet: the lowest slice of every slab but the lowest. Slabs hold about equally
/// many unknowns, and at least the 2 `sweeps` slices that keep the boundaries of a slab apart.
std::vector<Index> SlabBoundaries(const std::vector<Index>& slice, int sweeps);

/// Multiplicative Schwarz: for each patch solves its block of A. Local solve: scaled by the
/// diagonal, pivoted Cholesky, stopped at pivot 1e-14. The inverse of the factor of the kept part
/// is stored, in single precision where its rounding changes nothing (no pivot below 1e-11), else
/// in double: the sweep stays symmetric and as good as with exact solves, whatever the surface.
/// Unknowns whose diagonal is not a positive number, and unknowns of no patch, are left alone.
/// Patches of another size than PatchKernelWidth take general loops, with all factors in double.
/// Throws InvalidInput when the order does not fit the matrix or patches have more than 64
/// unknowns. [NUMERICS §1]
std::unique_ptr<Smoother> MakePatchSmoother(const SparseMatrix& A, const PatchOrder& order,
  int threads = 0, FactorPrecision precision = FactorPrecision::Mixed);

/// The same for vectors in single precision: pivots below 1e-6 stop the Cholesky, because rounding
/// would disturb corrections in these directions more than it serves the others, and patches whose
/// numbers leave the range of single precision are left alone.
std::unique_ptr<BasicSmoother<float>> MakeSinglePatchSmoother(
  const SparseMatrix& A, const PatchOrder& order, int threads = 0);

/// The first in a half to a third of the time: rows are stencils of the grid, and all is stored and
/// computed in single precision (Smoother::IsSingle). Patches with pivots below 1e-6, as flat faces
/// have that are almost parallel to a plane of the grid, are relaxed once more in double precision.
/// Null where these are more than a tenth, and where patches are not the eight corners of a cell or
/// many share one; see StencilBlocks.
/// @param patternFits  if not null: false where it is null for any values of the matrix
std::unique_ptr<Smoother> MakeStencilSmoother(
  const SparseMatrix& A, const PatchOrder& order, int threads = 0, bool* patternFits = nullptr);

} // namespace gridfem

#endif
