// Values that the solution of an equation has at given points, on any space. [DESIGN §3]
#ifndef GridFEM_PointConstraints_h
#define GridFEM_PointConstraints_h

#include "Algebra/ComponentMeans.h"
#include "Krylov/PrecisionFallback.h"
#include "Problems/RowPenalty.h"
#include "Problems/SolutionAccuracy.h"

namespace gridfem
{

struct ConstraintOptions
{
  /// How strongly a misfit counts, relative to the diagonal of the matrix: what is left of it falls
  /// by about this factor in a step, and the iterations of a step grow with it slowly. > 0
  double penalty = 1e3;
  /// Steps end when the largest misfit is this part of the range of the values, or of the root mean
  /// square of the solution where that is more. > 0
  double tolerance = 1e-7;
  int maximumSteps = 12; // >= 1
  /// Errors are estimated on the surface of this space, which has the same functions with the mass
  /// of the mesh; null: they are not.
  const SpaceLevels* estimateOn = nullptr;
};

/// The hierarchy of a M + b L + Cᵀ W C for values that are held at points.
class ConstrainedHierarchy
{
public:
  /// @param rows  RowsAtPoints of the constrained points; a point without functions has none
  ConstrainedHierarchy(const SpaceLevels& space, double a, double b, SparseMatrix rows,
    double penalty, const MultigridOptions& options, const Progress& progress = {});

  const Multigrid& GetMultigrid() const { return multigrid_; }
  const RowPenalty& Penalty() const { return penalty_; }
  const SparseMatrix& Rows() const { return penalty_.Rows(); }

private:
  std::vector<MultigridLevel> BuildLevels(const SpaceLevels& space, double a, double b,
    SparseMatrix rows, double penalty, const MultigridOptions& options, const Progress& progress);
  void AddWholePenalty(
    std::size_t level, const DividedRows& divided, SparseMatrix& A, int threads) const;

  RowPenalty penalty_;
  Multigrid multigrid_;
};

struct ConstrainedSolution
{
  MultiVector coefficients;  // up to a constant on components that nothing holds (SetMeans)
  SolveReport report;        // of all steps, one after the other
  SolutionAccuracy accuracy; // of components that something holds; unknown unless asked for
  int steps = 0;
  /// Largest difference from the given values, over all points and columns.
  double misfit = 0.0;
  double relativeMisfit = 0.0; // as ConstraintOptions::tolerance has it, of the worst column
  /// All constraints are met. Else they contradict each other, or are more than the functions can
  /// meet, and the solution is the one with the least (weighted) squares of the misfits.
  bool isExact = true;
  std::vector<char> isHeld; // per component of the functions
  double wanted = 0.0;      // tolerance of the report; 0: that of the options
};

/// Means of components, 0 for those that something holds.
MultiVector MeansOfFree(const std::vector<char>& isHeld, MultiVector means);

/// Removes the constants of components that nothing holds. Keeps references to what it is made
/// from.
class FreeConstants
{
public:
  FreeConstants(const Components& components, const std::vector<char>& isHeld, int threads,
    const DividedRows* divided = nullptr);

  /// Empty where all are held; else to be used while this lives.
  Projection AsProjection() const;

private:
  const std::vector<char>& isHeld_;
  const std::vector<double> one_;
  const ComponentMeans means_;
};

/// Per component of the functions: whether a constraint or mass holds it.
std::vector<char> HeldComponents(
  const SpaceLevels& space, double a, const SparseMatrix& rows, const Components& components);

/// A constant for each component near what the solution has there: the means of its constraints, or
/// of the values in the load.
/// @param load            as SolveConstrained has it
/// @param componentOfRow  of the constraints (ComponentsOfRows)
MultiVector ConstantsOf(const SpaceLevels& space, double a, const MultiVector& load,
  const std::vector<Index>& componentOfRow, const MultiVector& values,
  const Components& components);

/// Minimises ½ uᵀ (a M + b L) u - loadᵀ u among the functions with these values at the points, by
/// an augmented Lagrangian: each step solves with the misfit's penalty and adds the misfit that is
/// left to the load. Components that have neither a constraint nor mass are not determined. Where
/// processes hold the surface together, all of them call it, as SolvePoisson, each with constraints
/// of its own.
/// @param load    right-hand side: rows = functions; may have no rows for 0
/// @param values  rows = rows of C, one column per component
/// Throws InvalidInput when shapes do not fit, and Aborted. Same bits for any number of threads.
ConstrainedSolution SolveConstrained(const SpaceLevels& space, double a,
  const ConstrainedHierarchy& hierarchy, const MultiVector& load, const MultiVector& values,
  const ConstraintOptions& constraints, const SolveOptions& options, const Progress& progress = {});

/// |u| without its mean over the components that something holds.
/// @param rest      functions that constants have to be added to, one for each component
/// @param constant  of each component
Columns SizeOfSolution(const SpaceLevels& surface, const Components& components,
  const std::vector<char>& isHeld, const MultiVector& rest, const MultiVector& constant,
  int threads);

/// Adds constants on components that nothing holds, so that they have these means; a mean of NaN
/// makes all of the component NaN.
/// @param space  with the mass of the mesh
/// @param means  rows = components of the functions, one column per component of the values
void SetMeans(const SpaceLevels& space, const std::vector<char>& isHeld, const MultiVector& means,
  MultiVector& coefficients, int threads = 0);

} // namespace gridfem

#endif
