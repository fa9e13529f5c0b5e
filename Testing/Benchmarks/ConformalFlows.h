// The conformalized mean-curvature flow (M_t + δ L_0) X⁺ = M_t X by several discretizations and
// solvers, as the thesis compares them. [T (6.2), §6.2.3]
#ifndef GridFEM_Benchmarks_ConformalFlows_h
#define GridFEM_Benchmarks_ConformalFlows_h

#include "CotangentSystem.h"
#include "Spaces/FiniteElementSpace.h"

#include <memory>

namespace gridfem::benchmarks
{

/// Functions whose matrices a peer solves. Both matrices have one pattern.
class MovingSystem
{
public:
  virtual ~MovingSystem() = default;

  /// Coefficients of the surface's points before it moves.
  virtual Eigen::MatrixXd Start() const = 0;

  /// The mass becomes the mass of the surface with these coefficients. In place.
  virtual void Move(const Eigen::MatrixXd& coefficients) = 0;

  /// The points of the mesh, world units.
  virtual std::vector<Vec3> Points(const Eigen::MatrixXd& coefficients) const = 0;

  /// A time in squared world units, as the matrices need it.
  virtual double TimeOf(double worldTime) const = 0;

  const SymmetricMatrix& Mass() const { return mass_; }
  const SymmetricMatrix& Stiffness() const { return stiffness_; } // of the start

protected:
  SymmetricMatrix mass_;
  SymmetricMatrix stiffness_;
};

/// Hat functions. A move only sums up areas, in one pass over the triangles and on one thread.
std::unique_ptr<MovingSystem> MakeHatSystem(std::shared_ptr<const TriangleMesh> mesh);

/// The finest level of a space.
std::unique_ptr<MovingSystem> MakeSpaceSystem(
  std::shared_ptr<const FiniteElementSpace> space, int threads);

/// A flow that starts again for each length of its steps.
class ConformalFlow
{
public:
  virtual ~ConformalFlow() = default;

  /// Back to the start. The data that all steps share is prepared here, or in the first step.
  /// @param timeStep  squared world units
  virtual void Begin(double timeStep) = 0;

  /// @return  iterations of the solver, the largest over the coordinates; 0 of a direct one
  /// Throws std::runtime_error when the step cannot be made.
  virtual int Step() = 0;

  virtual std::vector<Vec3> Points() const = 0;
};

/// The symbolic part is done once in Begin.
std::unique_ptr<ConformalFlow> MakeCholmodFlow(std::shared_ptr<MovingSystem> system, int threads);

/// BoomerAMG with a new hierarchy in every step; the solve starts from the last points.
/// @param tolerance  on |r| over |M x|, x centered at 0
std::unique_ptr<ConformalFlow> MakeAmgFlow(std::shared_ptr<MovingSystem> system, double tolerance);

/// MeanCurvatureFlow.
/// @param mesh  what the space was made from
std::unique_ptr<ConformalFlow> MakeMultigridFlow(std::shared_ptr<const FiniteElementSpace> space,
  std::shared_ptr<const TriangleMesh> mesh, double tolerance, int threads);

} // namespace gridfem::benchmarks

#endif
