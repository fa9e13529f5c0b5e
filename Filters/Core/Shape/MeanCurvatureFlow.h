// A surface that moves by its mean curvature, step by step. Its functions stay, and only the
// numbers in their matrices follow the metric. [T §5.1, §6.2.3; DESIGN §3]
#ifndef GridFEM_MeanCurvatureFlow_h
#define GridFEM_MeanCurvatureFlow_h

#include "Equations/HeldBoundary.h"
#include "Equations/SolutionAccuracy.h"
#include "Grid/OrientedMesh.h"
#include "Grid/TriangleMesh.h"
#include "Krylov/ConjugateGradients.h"
#include "Shape/MovedSurface.h"
#include "Spaces/FiniteElementSpace.h"

#include <functional>
#include <memory>
#include <optional>

namespace gridfem
{

/// The quantity that each step is scaled to, about the centroid of the area.
enum class Rescaling
{
  None = 0,
  ConstantArea = 1,
  ConstantVolume = 2 // of a closed surface; else of the cone to the centroid
};

struct FlowOptions
{
  double timeStep = 1e-3; // δ > 0, squared units of length of the space
  /// Every step uses the stiffness matrix of the start: (M_t + δ L_0) X⁺ = M_t X [T (6.2)]. The map
  /// from the start then tends to a conformal map.
  bool conformalized = false;
  Rescaling rescaling = Rescaling::None;
  /// The part of the surface that stays in place; empty: the boundary moves freely. Not for the
  /// conformalized flow, nor with a rescaling.
  SurfaceBoundary fixed;
  MultigridOptions multigrid;
  SolveOptions solve;

  /// Makes new functions of the moved mesh in every step. Empty: the functions of the start are
  /// kept, and the metric is tracked on them. Not for the conformalized flow.
  std::function<std::unique_ptr<FiniteElementSpace>(const TriangleMesh& moved, const Job& job)>
    rebuild;

  FlowOptions()
  {
    solve.tolerance = 5e-4;         // from the thesis
    multigrid.cycle = CycleType::V; // takes less time; a step needs one or two cycles
  }
};

/// Why a flow cannot go on.
enum class FlowEnd
{
  None,
  Vanished,   // the surface has shrunk to less than 1e-10 of its size
  Breakdown,  // the matrix is not positive, numbers leave their range, or a solve fails
  VolumeLost, // no volume is left to keep constant
  Unfit       // no functions can be made on the moved mesh
};

/// The result of one step.
struct FlowStep
{
  FlowEnd end = FlowEnd::None; // otherwise the step was not made, and the rest is meaningless
  int step = 0;                // counts from 1; 0 is the start
  double time = 0.0;           // squared units of length of the space, regardless of scaling
  double area = 0.0;           // of the moved mesh, world units; so are the next two
  double volume = 0.0;
  double sphericity = 0.0; // SurfaceSize::Sphericity
  int iterations = 0;
  Id lockedSamples = 0; // samples with a singular metric when the step began (SetMetric)
  bool converged = true;
  std::string where; // the device of the cycles; see Multigrid::Where
  /// Errors of this step's displacement. They are relative to its length in the mean square; the
  /// largest error is in world units. The error of the iteration is unknown. Errors of earlier
  /// steps and of the finite time step are not included.
  SolutionAccuracy accuracy;
};

struct StepSolution
{
  MultiVector embedding;
  SolveReport report;
  SolutionAccuracy accuracy; // as in FlowStep
};

/// One step solves (M_t + δ L_t) X⁺ = M_t X for the three coordinates at once. The solve starts
/// from the last X plus the displacement that the coarser levels find.
/// From the second step on, patterns, prolongations and orders stay the same, unless every step
/// makes new functions. HeldBoundary describes the terms of a fixed boundary. Same bits for any
/// number of threads, and for any path to a step. Hold a MemoryReuse over several steps.
class MeanCurvatureFlow
{
public:
  /// @param mesh  the mesh that the space was made from
  /// Throws InvalidInput for a time step that is not positive and for a conformalized flow with
  /// functions that are made anew. It also throws for fixed points that another option would move,
  /// and if there is no volume to keep.
  MeanCurvatureFlow(std::shared_ptr<const FiniteElementSpace> space,
    std::shared_ptr<const TriangleMesh> mesh, FlowOptions options);

  /// Makes the next step. If the step cannot be made or is aborted (throws Aborted), the flow stays
  /// where it is.
  FlowStep Advance(const Job& job);

  /// The number of the current step.
  int Step() const { return step_; }

  /// Everything that the next step depends on: the coefficients of the embedding, or the points if
  /// the functions are made anew. In units of length from the origin of the space.
  const MultiVector& Shape() const { return shape_; }

  /// Returns to a step, given its shape.
  void GoTo(int step, MultiVector shape);
  void GoToStart();

  /// The points of the moved mesh, world units. Fixed points and points that no function reaches
  /// stay.
  std::vector<Vec3> Points(const Job& job = {}) const;

  /// The start as a step.
  FlowStep Start(const Job& job = {}) const;

  /// The space in the metric of the last step; null before the first.
  const FiniteElementSpace* Space() const { return moving_.get(); }

private:
  Id Prepare(MultiVector& embedding, const Job& job);
  void UpdateBoundary(double timeStep, int threads);
  StepSolution Solve(const MultiVector& embedding, const Job& job) const;
  void UpdateHierarchy(double timeStep, const Job& job);
  FlowStep Rescale(const MultiVector& before, StepSolution& solution, std::vector<Vec3>& points,
    int threads) const;
  void Keep(const std::vector<Vec3>& points, MultiVector embedding);
  void FillMatrix(std::size_t level, double timeStep, SparseMatrix& matrix, const Job& job);
  std::vector<Vec3> WorldPoints(
    const FiniteElementSpace& space, const MultiVector& embedding, const Job& job) const;
  SurfaceSize Size(const std::vector<Vec3>& points, int threads) const;
  std::optional<double> ScaleOf(double area, double volume) const;

  std::shared_ptr<const FiniteElementSpace> start_;
  std::shared_ptr<const TriangleMesh> mesh_;
  OrientedMesh oriented_; // for volumes
  FlowOptions options_;
  std::vector<char> moves_; // per point: a function reaches it, and it is not fixed
  double startArea_ = 0.0;  // world units
  double startVolume_ = 0.0;

  int step_ = 0;
  MultiVector shape_;
  std::unique_ptr<FiniteElementSpace> moving_;
  std::unique_ptr<Multigrid> multigrid_;
  std::unique_ptr<HeldBoundary> boundary_; // on the current functions; null if nothing is held
  SparseMatrix mass_;                      // M_t
};

} // namespace gridfem

#endif
