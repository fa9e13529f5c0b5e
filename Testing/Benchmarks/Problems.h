// One Poisson problem in the two discretizations that are compared: B-splines of the grid and hat
// functions of the mesh. λ = 0.01 for a mesh of longest side 1; the exact solution is a smooth
// color, so that errors are known without another solver.
#ifndef GridFEM_Benchmarks_Problems_h
#define GridFEM_Benchmarks_Problems_h

#include "CotangentSystem.h"
#include "Equations/Poisson.h"
#include "Support/Hybrid.h"

#include <functional>
#include <memory>

namespace gridfem::benchmarks
{

/// The value of λ in units of the unit cube, as the thesis gives it.
constexpr double ScreeningWeight = 0.01;

/// Smooth values in [-1, 1], a wave or so along the longest side, at points in world units.
/// @return rows = points
MultiVector Colors(const std::vector<Vec3>& points, const Vec3& center, double side, int columns);

struct GridProblem
{
  GridFunctions space;
  LevelOperators system;
  PoissonOptions options;
  std::unique_ptr<Multigrid> multigrid;
  SparseMatrix mass;
  MultiVector exact;     // coefficients of the colors at the grid's corners
  MultiVector values;    // M exact
  MultiVector gradients; // L exact

  /// Solves for the first columns in exactly that many steps of conjugate gradients; 0: the start
  /// by nested iteration and its correction by one cycle.
  MultiVector Solve(int columns, int iterations) const;

  /// Largest relative error of the columns, L2 over the surface.
  double Error(const MultiVector& x) const;
};

/// From the triangles to a hierarchy that is ready to solve. Every table calls this "set-up".
GridProblem SetUp(const TriangleMesh& mesh, int depth, int threads,
  FunctionSupport support = FunctionSupport::ConnectivityAware,
  double screeningWeight = ScreeningWeight, Index coarsestSize = 256);

/// Chooses the exact solution; not part of the set-up.
void ChooseColors(GridProblem& problem, int columns);

struct HatProblem
{
  CotangentSystem hats;
  SymmetricMatrix A; // λM + L
  Eigen::MatrixXd exact;
  Eigen::MatrixXd b; // A exact

  double Error(const Eigen::MatrixXd& x) const;
};

/// The matrix alone, which is the peers' "assembly" in every table.
HatProblem AssembleProblem(const TriangleMesh& mesh, double screeningWeight = ScreeningWeight);
void ChooseColors(const TriangleMesh& mesh, HatProblem& problem, int columns);

/// Colors at the points of a mesh, centered and scaled by its bounding box.
MultiVector ColorsAtPoints(const TriangleMesh& mesh, int columns);

/// Hat functions of the mesh above the levels of a grid: the same equation as HatProblem's.
struct HybridProblem
{
  HatSpace space;

  /// The cycle for λ = `weight` in units of the unit cube. It holds on to nothing of this.
  Multigrid BuildCycle(double weight, const testing::HybridCycle& options) const;

  /// Values at the mesh's points as values of the functions.
  MultiVector ToFunctions(const MultiVector& values) const;
};

/// Everything that does not depend on λ.
HybridProblem SetUpHybrid(const TriangleMesh& mesh, int depth, int threads,
  FunctionSupport support = FunctionSupport::ConnectivityAware,
  HatTransfer transfer = HatTransfer::Evaluation);

/// The least number of iterations after which `error` is at most `target`; -1: not within `most`.
/// Takes the error for decreasing, and so searches by doubling and halving.
int IterationsToError(const std::function<double(int)>& error, double target, int most = 256);

} // namespace gridfem::benchmarks

#endif
