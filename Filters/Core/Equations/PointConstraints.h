// Values that the solution of an equation takes at given points, on any space. [DESIGN §3]
#ifndef GridFEM_PointConstraints_h
#define GridFEM_PointConstraints_h

#include "Algebra/ComponentMeans.h"
#include "Equations/RowPenalty.h"
#include "Equations/SolutionAccuracy.h"
#include "Krylov/PrecisionFallback.h"

namespace gridfem
{

struct ConstraintOptions
{
  /// Weight of a misfit, relative to the diagonal of the matrix. Each step divides the misfit by
  /// about this factor, or by about 30 beside pulled rows. The iterations of a step grow slowly
  /// with it. > 0
  double penalty = 1e3;
  /// Steps end when the largest misfit is this fraction of the range of the values, or of the root
  /// mean square of the solution if that is larger. > 0
  double tolerance = 1e-7;
  int maximumSteps = 12; // >= 1
  /// Errors are estimated on the surface of this space, which has the same functions with the mass
  /// of the mesh. Null: errors are not estimated.
  const SpaceLevels* estimateOn = nullptr;
};

/// The hierarchy of a M + b L + Cᵀ W C for held values at points.
class ConstrainedHierarchy
{
public:
  /// @param rows  RowsAtPoints of the constrained points; the row of a point without functions is
  ///   empty
  ConstrainedHierarchy(const SpaceLevels& space, double a, double b, HeldRows rows, double penalty,
    const MultigridOptions& options, const Progress& progress = {});

  const Multigrid& GetMultigrid() const { return multigrid_; }
  const RowPenalty& Penalty() const { return penalty_; }
  const SparseMatrix& Rows() const { return penalty_.Rows(); }
  bool IsPulled(Index row) const { return !pull_.empty() && pull_[row] > 0.0; }

private:
  std::vector<MultigridLevel> BuildLevels(const SpaceLevels& space, double a, double b,
    HeldRows rows, double penalty, const MultigridOptions& options, const Progress& progress);

  std::vector<double> pull_; // HeldRows::pull
  RowPenalty penalty_;
  Multigrid multigrid_;
};

struct ConstrainedSolution
{
  MultiVector coefficients;  // up to a constant on components that nothing holds (SetMeans)
  SolveReport report;        // of all steps, in sequence
  SolutionAccuracy accuracy; // of held components; unknown unless asked for
  int steps = 0;
  /// Largest difference from the held values, over all points and columns. Pulled rows do not
  /// count.
  double misfit = 0.0;
  double relativeMisfit = 0.0; // relative as the tolerance is; of the worst column
  /// All constraints are met. Otherwise they contradict each other, or are more than the functions
  /// can meet. The solution then has the least (weighted) squares of the misfits.
  bool isExact = true;
  std::vector<char> isHeld; // per component of the functions
  double wanted = 0.0;      // tolerance of the report; 0: as in the options
};

/// The means of components, with 0 for held components.
MultiVector MeansOfFree(const std::vector<char>& isHeld, MultiVector means);

/// Removes the constants of components that nothing holds. Keeps references to its arguments.
class FreeConstants
{
public:
  FreeConstants(const Components& components, const std::vector<char>& isHeld, int threads,
    const DistributedRows* distributed = nullptr);

  /// The removal as a projection; empty if all components are held. This object has to outlive it.
  Projection AsProjection() const;

private:
  const std::vector<char>& isHeld_;
  const std::vector<double> one_;
  const ComponentMeans means_;
};

/// Whether a constraint or mass holds each component of the functions.
std::vector<char> HeldComponents(
  const SpaceLevels& space, double a, const SparseMatrix& rows, const Components& components);

/// A constant for each component near the solution there: the mean of its constraints, or of the
/// values in the load.
/// @param load            as in SolveConstrained
/// @param componentOfRow  of the constraints (ComponentsOfRows)
MultiVector ConstantsOf(const SpaceLevels& space, double a, const MultiVector& load,
  const std::vector<Index>& componentOfRow, const MultiVector& values,
  const Components& components);

/// Minimizes ½ uᵀ (a M + b L) u - loadᵀ u among the functions with these values at the points. The
/// method is an augmented Lagrangian: each step solves with the penalty of the misfit and adds the
/// remaining misfit to the load. Pulled rows have their penalty alone. Components that have neither
/// a constraint nor mass are undetermined. Collective; each process has constraints of its own.
/// @param load    right-hand side: rows = functions; no rows: 0
/// @param values  rows = rows of C, one column per component
/// Throws InvalidInput when shapes do not fit, and Aborted. Same bits for any number of threads.
ConstrainedSolution SolveConstrained(const SpaceLevels& space, double a,
  const ConstrainedHierarchy& hierarchy, const MultiVector& load, const MultiVector& values,
  const ConstraintOptions& constraints, const SolveOptions& options, const Progress& progress = {});

/// |u| without its mean over the held components.
/// @param rest      u minus a constant on each component
/// @param constant  these constants
Columns SizeOfSolution(const SpaceLevels& surface, const Components& components,
  const std::vector<char>& isHeld, const MultiVector& rest, const MultiVector& constant,
  int threads);

/// Adds constants to components that nothing holds, so that they have these means. A mean of NaN
/// makes the whole component NaN.
/// @param space  with the mass of the mesh
/// @param means  rows = components of the functions, one column per component of the values
void SetMeans(const SpaceLevels& space, const std::vector<char>& isHeld, const MultiVector& means,
  MultiVector& coefficients, int threads = 0);

} // namespace gridfem

#endif
