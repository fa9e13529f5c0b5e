// A surface that moves by its mean curvature, step by step: its functions stay, and only the
// numbers in their matrices follow the metric. [T §5.1, §6.2.3; DESIGN §3]
#ifndef GridFEM_MeanCurvatureFlow_h
#define GridFEM_MeanCurvatureFlow_h

#include "Grid/TriangleMesh.h"
#include "Krylov/ConjugateGradients.h"
#include "Problems/HeldBoundary.h"
#include "Problems/MovedSurface.h"
#include "Problems/SolutionAccuracy.h"
#include "Spaces/FiniteElementSpace.h"

#include <functional>
#include <memory>
#include <optional>

namespace gridfem
{

/// What each step is scaled to, about the centroid of the area.
enum class Rescaling
{
  None = 0,
  ConstantArea = 1,
  ConstantVolume = 2 // of a closed surface; else of the cone to the centroid
};

struct FlowOptions
{
  double timeStep = 1e-3; // δ > 0, squared units of length of the space
  /// The stiffness stays that of the start: (M_t + δ L_0) X⁺ = M_t X [T (6.2)], so that the map
  /// from the start tends to a conformal one.
  bool conformalized = false;
  Rescaling rescaling = Rescaling::None;
  /// What stays where it is; empty: the boundary moves freely. Not for the conformalised flow, nor
  /// with a rescaling.
  SurfaceBoundary fixed;
  MultigridOptions multigrid;
  SolveOptions solve;

  /// Functions of the moved mesh, made anew in every step. Empty: those of the start are kept, and
  /// the metric is tracked on them. Not for the conformalised flow.
  std::function<std::unique_ptr<FiniteElementSpace>(const TriangleMesh& moved, const Job& job)>
    rebuild;

  FlowOptions()
  {
    solve.tolerance = 5e-4;         // of the thesis
    multigrid.cycle = CycleType::V; // a step takes one or two of either, and these take less time
  }
};

/// Why a flow cannot go on.
enum class FlowEnd
{
  None,
  Vanished,   // the surface has shrunk to less than 1e-10 of its size
  Breakdown,  // a matrix is not positive, numbers leave their range, or a solve goes astray
  VolumeLost, // there is none left to keep constant
  Unfit       // no functions can be made anew on the moved mesh
};

/// What one step came to.
struct FlowStep
{
  FlowEnd end = FlowEnd::None; // else the step was not made, and the rest says nothing
  int step = 0;                // counts from 1; 0 is the start
  double time = 0.0;           // squared units of length of the space, without regard to scaling
  double area = 0.0;           // of the moved mesh, world units; as the next two
  double volume = 0.0;
  double sphericity = 0.0; // SurfaceSize::Sphericity
  int iterations = 0;
  Id lockedSamples = 0; // whose metric was singular when the step began (SetMetric)
  bool converged = true;
  /// Of the way of this step: relative to its length in the mean square; the largest error in world
  /// units; that of the iteration is not known. Errors of the steps before are not among it, nor
  /// that a step takes finite time.
  SolutionAccuracy accuracy;
};

struct StepSolution
{
  MultiVector embedding;
  SolveReport report;
  SolutionAccuracy accuracy; // as in FlowStep
};

/// One step solves (M_t + δ L_t) X⁺ = M_t X for the three coordinates at once, from the last X and
/// the way that the coarser levels go from there.
/// From the second step on patterns, prolongations and orders are those of the first, unless
/// the functions are made anew. A boundary that is fixed takes part as HeldBoundary says. Same bits
/// for any number of threads, and for any way to a step. Hold a MemoryReuse over several steps.
class MeanCurvatureFlow
{
public:
  /// @param mesh  what the space was made from
  /// Throws InvalidInput for a time step that is not positive, a conformalised flow with functions
  /// that are made anew, fixed points that something else moves, and where there is no volume to be
  /// kept.
  MeanCurvatureFlow(std::shared_ptr<const FiniteElementSpace> space,
    std::shared_ptr<const TriangleMesh> mesh, FlowOptions options);

  /// Makes the next step. A step that cannot be made leaves the flow where it is, and so does
  /// Aborted, which it throws.
  FlowStep Advance(const Job& job);

  /// The number of the step that the flow has come to.
  int Step() const { return step_; }

  /// All that the next step depends on: the coefficients of the embedding, or the points when
  /// the functions are made anew; in units of length from the origin of the space.
  const MultiVector& Shape() const { return shape_; }

  /// Returns to a step by its shape.
  void GoTo(int step, MultiVector shape);
  void GoToStart();

  /// The points of the moved mesh, world units; those that are fixed and those that no function
  /// reaches stay.
  std::vector<Vec3> Points(const Job& job = {}) const;

  /// The start as a step.
  FlowStep Start(const Job& job = {}) const;

  /// The space in the metric that the last step used; null before the first.
  const FiniteElementSpace* Space() const { return moving_.get(); }

private:
  Id Prepare(MultiVector& embedding, const Job& job);
  void UpdateBoundary(double timeStep, int threads);
  StepSolution Solve(const MultiVector& embedding, const Job& job) const;
  void UpdateHierarchy(double timeStep, const Job& job);
  void FillMatrix(std::size_t level, double timeStep, SparseMatrix& matrix, const Job& job);
  std::vector<Vec3> WorldPoints(
    const FiniteElementSpace& space, const MultiVector& embedding, const Job& job) const;
  std::optional<double> ScaleOf(double area, double volume) const;

  std::shared_ptr<const FiniteElementSpace> start_;
  std::shared_ptr<const TriangleMesh> mesh_;
  FlowOptions options_;
  std::vector<char> moves_; // per point: a function reaches it, and it is not fixed
  double startArea_ = 0.0;  // world units
  double startVolume_ = 0.0;

  int step_ = 0;
  MultiVector shape_;
  std::unique_ptr<FiniteElementSpace> moving_;
  std::unique_ptr<Multigrid> multigrid_;
  std::unique_ptr<HeldBoundary> boundary_; // of functions as they are; null where nothing is held
  SparseMatrix mass_;                      // M_t
};

} // namespace gridfem

#endif
