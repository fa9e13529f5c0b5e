// Detail of a surface or of an array on it, amplified or damped: the screened Poisson equation with
// the gradients of the signal times σ, in a metric that depends on the principal curvatures.
// [T §5.2]
// As the signal f is a function of the space, the solution of (λM + L) u = λ f + div σ∇f is f + v
// with (λM + L) v = StiffnessTimes(f, σ - 1): so σ = 1 changes nothing whatever the metric and the
// tolerance, and a tolerance is one on the change.
#ifndef GridFEM_SurfaceDetail_h
#define GridFEM_SurfaceDetail_h

#include "Problems/Poisson.h"
#include "Problems/PrincipalCurvatures.h"

#include <functional>

namespace gridfem
{

/// The curvatures of every triangle, the means of its points', and the direction of the larger one.
struct TriangleCurvatures
{
  MultiVector values;          // triangles x 2, per world length: maximum, minimum
  std::vector<Vec3> direction; // of the maximum; 0 where there is none
};

TriangleCurvatures CurvaturesOnTriangles(
  const TriangleMesh& mesh, const PrincipalCurvatures& curvatures, int threads = 0);

/// What the absolute curvatures do not exceed on nine tenths of the area; 0 for a plane.
double UsualCurvature(const TriangleMesh& mesh, const TriangleCurvatures& curvatures);

/// How lengths along a principal direction count, for its curvature. Above 0 and finite; 1 for the
/// metric of the surface.
using TransferFunction = std::function<double(double curvature)>;

/// Which curvatures are enlarged.
enum class CurvatureTransfer
{
  Isotropic,
  LargeNegative,
  LargePositive,
  LargeAbsolute,
  Custom // what part of the way is the caller's; here the absolute, in a straight line
};

/// How a length along a curvature counts: 1 for small ones, `largest` from 1 and -1 on, as far as
/// they are enlarged.
/// @param curvature  in units of the usual one
double LengthOf(CurvatureTransfer transfer, double curvature, double largest);

/// From 0 to 1 as x does, without a kink at its ends.
double SmoothStep(double x);

/// The weights of the elements in the metric diag(α(κ₁)², α(κ₂)²). [T (5.16), (5.17)]
/// @param curvatures  elements x 2 (MeansOnElements of TriangleCurvatures::values)
/// Throws InvalidInput where α is not above 0 and finite.
std::vector<ElementWeights> WeightsOfMetric(
  const MultiVector& curvatures, const TransferFunction& alpha);

/// A signal in the space: as a function of it, and what of it no function has.
struct SignalInSpace
{
  MultiVector coefficients;
  MultiVector remainder; // points x columns: values less those of the function
  SolveReport report;    // of the projection
};

/// The coordinates are functions of every space, and have no remainder. In world units from the
/// origin of the space.
SignalInSpace ShapeInSpace(const FiniteElementSpace& space, const Job& job = {});

/// A field on points is projected, with its gradients, as for SurfaceDerivatives.
SignalInSpace ProjectSignal(const FiniteElementSpace& space, const Field& f,
  const MultigridOptions& multigrid, const SolveOptions& solve, const Job& job = {});

/// Scales points of a moved mesh about their centroid to the volume of the mesh; leaves them alone
/// where that is not possible, because a volume is 0 or has turned over.
void ScaleToVolume(const TriangleMesh& mesh, std::vector<Vec3>& points, int threads = 0);

} // namespace gridfem

#endif
