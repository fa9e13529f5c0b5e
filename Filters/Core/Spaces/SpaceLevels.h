// The levels of a space. A hierarchy of matrices is built from them, and a nested iteration runs
// over them. Several processes may hold a level together.
#ifndef GridFEM_SpaceLevels_h
#define GridFEM_SpaceLevels_h

#include "Algebra/ColumnAlgebra.h"
#include "Base/Job.h"
#include "Multigrid/Multigrid.h"

#include <memory>
#include <vector>

namespace gridfem
{

/// The connected components of the functions of one level.
struct Components
{
  std::vector<Index> ofFunction; // 0 .. count - 1
  Index count = 0;
  /// Whether the stiffness holds the functions of a component, so that constants have energy.
  /// Empty: none.
  std::vector<char> isHeld;
};

/// The way a level is relaxed.
struct LevelRelaxation
{
  PatchOrder order;
  PatchOrder groups; // unknowns relaxed together after a sweep over all; may be empty
  std::optional<LevelSmoothing> smoothing; // replaces the options of the hierarchy
};

/// Level 0 is the finest. All integrals are in the space's unit of length: mass in squared units,
/// stiffness dimensionless. Const methods may be called from several threads. All results are the
/// same, bit for bit, for any number of threads. A method that takes a job may throw Aborted.
/// Collective: if several processes divide a level, all of them call every method, in the same
/// order.
class SpaceLevels
{
public:
  virtual ~SpaceLevels() = default;

  virtual std::size_t NumberOfLevels() const = 0;

  /// Number of functions in all processes together.
  virtual Index NumberOfFunctions(std::size_t level) const = 0;

  /// Computes a M + b L, in place if the matrix already has the level's pattern. On a distributed
  /// level, it computes this process's part.
  virtual void FillMatrix(
    std::size_t level, double a, double b, SparseMatrix& matrix, const Job& job) const = 0;
  SparseMatrix Matrix(std::size_t level, double a, double b, const Job& job = {}) const;

  /// From level + 1 to this level, and the transpose. Not for the coarsest level.
  virtual SharedMatrix Prolongation(std::size_t level) const = 0;
  virtual SharedMatrix Restriction(std::size_t level) const = 0;

  virtual LevelRelaxation Relaxation(std::size_t level, const MultigridOptions& options) const = 0;
  virtual Components ComponentsOf(std::size_t level, const Job& job = {}) const = 0;

  /// Approximate longest extent of the surface, in units of length.
  virtual double Extent() const = 0;

  /// Returns the levels below the finest as a space of their own if the finest level does not
  /// contain them. Returns null if every level contains the next coarser one.
  virtual const SpaceLevels* NestedLevels() const { return nullptr; }

  ///@{ The finest level.

  /// Returns ∫ b_i.
  virtual const std::vector<double>& Integrals() const = 0;

  /// Returns ∫ u² of every column, in squared units of length, for functions u of the space.
  virtual Columns SquaredNorms(const MultiVector& u, const Job& job = {}) const = 0;

  /// Returns values with rows = points of the mesh in this process; 0 at points that no function
  /// reaches.
  virtual MultiVector ValuesAtPoints(
    const MultiVector& coefficients, const Job& job = {}) const = 0;
  ///@}

  ///@{ Null if this process holds the level alone. Rows are the rows of the space. In Divide, A is
  /// this process's part of a matrix; the result is the distributed level for cycles.
  virtual const DistributedRows* Distributed(std::size_t) const { return nullptr; }
  virtual std::shared_ptr<const DistributedLevel> Divide(
    std::size_t, const SparseMatrix& /*A*/, const MultigridOptions&) const
  {
    return nullptr;
  }
  ///@}
};

/// Builds a M + b L on every level, ready to cycle.
Multigrid BuildMultigrid(const SpaceLevels& space, double a, double b,
  const MultigridOptions& options, const Progress& progress = {});

/// Recomputes the values of a hierarchy in place, for the same space or a copy of it.
void UpdateMultigrid(const SpaceLevels& space, double a, double b, Multigrid& multigrid);

/// Builds the levels of a hierarchy, as the constructor of Multigrid takes them.
std::vector<MultigridLevel> BuildMultigridLevels(const SpaceLevels& space, double a, double b,
  const MultigridOptions& options, const Progress& progress = {});

} // namespace gridfem

#endif
