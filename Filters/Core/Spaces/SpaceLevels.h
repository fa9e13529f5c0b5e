// The levels of a space, as a hierarchy of matrices is built from them and a nested iteration runs
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

class SurfaceSpace;

/// The connected components of the functions of one level.
struct Components
{
  std::vector<Index> ofFunction; // 0 .. count - 1
  Index count = 0;
};

/// How a level is relaxed.
struct LevelRelaxation
{
  PatchOrder order;
  PatchOrder groups;                       // relaxed together after a sweep over all; may be empty
  std::optional<LevelSmoothing> smoothing; // in place of the options of the hierarchy
};

/// Level 0 is the finest. All integrals are in the space's unit of length: mass in squared units,
/// stiffness without one. Const methods are safe to call from several threads, and all results are
/// the same, bit for bit, for any number of them. A method that takes a job throws Aborted. Where
/// processes divide a level, all of them call every method, in the same order.
class SpaceLevels
{
public:
  virtual ~SpaceLevels() = default;

  virtual std::size_t NumberOfLevels() const = 0;

  /// Of all processes.
  virtual Index NumberOfFunctions(std::size_t level) const = 0;

  /// a M + b L, in place where the matrix has the level's pattern already. Of a divided level what
  /// this process adds to it.
  virtual void FillMatrix(
    std::size_t level, double a, double b, SparseMatrix& matrix, const Job& job) const = 0;
  SparseMatrix Matrix(std::size_t level, double a, double b, const Job& job = {}) const;

  /// From level + 1 to this level, and its transpose; not for the coarsest.
  virtual SharedMatrix Prolongation(std::size_t level) const = 0;
  virtual SharedMatrix Restriction(std::size_t level) const = 0;

  virtual LevelRelaxation Relaxation(std::size_t level, const MultigridOptions& options) const = 0;
  virtual Components ComponentsOf(std::size_t level, const Job& job = {}) const = 0;

  /// About the longest extent of the surface, in units of length.
  virtual double Extent() const = 0;

  /// The levels below the finest as a space of their own, where the finest does not contain them;
  /// null where every level contains the next coarser one.
  virtual const SurfaceSpace* NestedLevels() const { return nullptr; }

  ///@{ The finest level.

  /// ∫ b_i.
  virtual const std::vector<double>& Integrals() const = 0;

  /// ∫ u² of every column, in squared units of length, for functions u of the space.
  virtual Columns SquaredNorms(const MultiVector& u, const Job& job = {}) const = 0;

  /// Rows = points of the mesh in this process; 0 at points that no function reaches.
  virtual MultiVector ValuesAtPoints(
    const MultiVector& coefficients, const Job& job = {}) const = 0;
  ///@}

  ///@{ Null where this process holds the level alone. Rows are those of the space; a level for the
  /// cycle belongs to the part A of a matrix.
  virtual const DividedRows* Divided(std::size_t) const { return nullptr; }
  virtual std::shared_ptr<const DividedLevel> Divide(
    std::size_t, const SparseMatrix& /*A*/, const MultigridOptions&) const
  {
    return nullptr;
  }
  ///@}
};

/// a M + b L on every level, ready to cycle.
Multigrid BuildMultigrid(const SpaceLevels& space, double a, double b,
  const MultigridOptions& options, const Progress& progress = {});

/// New values, in place, for a hierarchy of the same space or of a copy of it.
void UpdateMultigrid(const SpaceLevels& space, double a, double b, Multigrid& multigrid);

/// The levels of a hierarchy, as Multigrid takes them.
std::vector<MultigridLevel> BuildMultigridLevels(const SpaceLevels& space, double a, double b,
  const MultigridOptions& options, const Progress& progress = {});

} // namespace gridfem

#endif
