// Amplifies or damps the detail of a surface or of an array on it. It solves the screened Poisson
// equation with the gradients of the signal times σ, in a metric that depends on the principal
// curvatures. [T §5.2]
// The signal f is a function of the space. The solution of (λM + L) u = λ f + div σ∇f is therefore
// f + v with (λM + L) v = StiffnessTimes(f, σ - 1). Therefore σ = 1 changes nothing, for any metric
// and tolerance. The tolerance applies to the change.
#ifndef GridFEM_SurfaceDetail_h
#define GridFEM_SurfaceDetail_h

#include "Equations/Poisson.h"
#include "Shape/PrincipalCurvatures.h"

#include <functional>

namespace gridfem
{

/// The curvatures of every triangle, which are the means of its points', and the direction of the
/// larger curvature.
struct TriangleCurvatures
{
  MultiVector values;          // triangles x 2, per world length: maximum, minimum
  std::vector<Vec3> direction; // of the maximum; 0 if there is none
};

TriangleCurvatures CurvaturesOnTriangles(
  const TriangleMesh& mesh, const PrincipalCurvatures& curvatures, int threads = 0);

/// The bound of the absolute curvatures on nine tenths of the area; 0 for a plane.
double UsualCurvature(const TriangleMesh& mesh, const TriangleCurvatures& curvatures);

/// The length factor along a principal direction, as a function of its curvature. Above 0 and
/// finite; 1 for the metric of the surface.
using TransferFunction = std::function<double(double curvature)>;

/// The curvatures that are enlarged.
enum class CurvatureTransfer
{
  Isotropic,
  LargeNegative,
  LargePositive,
  LargeAbsolute,
  Custom // the caller's choice; in LengthOf, linear in the absolute curvature
};

/// The length factor for a curvature: 1 for small curvatures, `largest` from 1 and -1 on, if
/// `transfer` enlarges curvatures of that sign.
/// @param curvature  in units of the usual curvature
double LengthOf(CurvatureTransfer transfer, double curvature, double largest);

/// Rises from 0 to 1 like x, without a kink at its ends.
double SmoothStep(double x);

/// The weights of the elements in the metric diag(α(κ₁)², α(κ₂)²). [T (5.16), (5.17)]
/// @param curvatures  elements x 2 (MeansOnElements of TriangleCurvatures::values)
/// Throws InvalidInput where α is not above 0 and finite.
std::vector<ElementWeights> WeightsOfMetric(
  const MultiVector& curvatures, const TransferFunction& alpha);

/// A signal in the space: its best function, and the remainder that no function has.
struct SignalInSpace
{
  MultiVector coefficients;
  MultiVector remainder; // points x columns: values minus the function's values
  SolveReport report;    // of the projection
};

/// The coordinates of the surface. They are functions of every space, and have no remainder. In
/// world units from the origin of the space.
SignalInSpace ShapeInSpace(const FiniteElementSpace& space, const Job& job = {});

/// Projects a field on points together with its gradients, as for SurfaceDerivatives.
SignalInSpace ProjectSignal(const FiniteElementSpace& space, const Field& f,
  const MultigridOptions& multigrid, const SolveOptions& solve, const Job& job = {});

/// Scales the points of a moved mesh about the centroid of its area to the volume of the mesh.
/// Leaves them alone if that is impossible, because a volume is 0 or has turned inside out.
/// @param moves  a flag for each point; the other points stay
void ScaleToVolume(const TriangleMesh& mesh, const std::vector<char>& moves,
  std::vector<Vec3>& points, int threads = 0);

} // namespace gridfem

#endif
