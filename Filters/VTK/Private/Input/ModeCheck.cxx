#include "Input/ModeCheck.h"

#include "Base/Parallel.h"

#include <Eigen/Geometry>

#include <array>
#include <cmath>
#include <sstream>
#include <tuple>

namespace gridfem
{
namespace
{

/// The allowed errors of integrals on a mesh that resolves a mode well. They cover rounding to
/// single precision and the quadrature on the grid.
constexpr double MassTolerance = 2e-3;
constexpr double QuotientTolerance = 0.03;

/// The additional allowed error, as a multiple of the difference between the two integrals.
constexpr double CoarsenessAllowance = 4.0;

/// From this eigenvalue on, relative to the mean squared length of edges, waves have only a few
/// points. A mode may then even be zero at all points of the mesh.
constexpr double Unresolved = 2.0;

/// Linear functions are too steep on triangles flatter than this part of their longest edge.
constexpr double FlatHeight = 0.02;

/// Rayleigh quotients say nothing if such triangles have a larger share of the area.
constexpr double FlatShareAllowed = 0.05;

/// Integrals over some triangles, with a row per mode.
struct ModeIntegrals
{
  explicit ModeIntegrals(Id modes)
    : exact(Eigen::ArrayXd::Zero(modes)), byCorners(Eigen::ArrayXd::Zero(modes)),
      energy(Eigen::ArrayXd::Zero(modes))
  {
  }

  ModeIntegrals& operator+=(const ModeIntegrals& other)
  {
    exact += other.exact;
    byCorners += other.byCorners;
    energy += other.energy;
    area += other.area;
    flatArea += other.flatArea;
    squaredEdges += other.squaredEdges;
    return *this;
  }

  Eigen::ArrayXd exact;     // of the squared linear function
  Eigen::ArrayXd byCorners; // of its square by the mean over the corners
  Eigen::ArrayXd energy;    // of its squared gradient, without flat triangles
  double area = 0.0;
  double flatArea = 0.0;
  double squaredEdges = 0.0; // of the longest edges, by area
};

void AddTriangle(
  const TriangleMesh& mesh, Id triangle, const MultiVector& values, ModeIntegrals& sum)
{
  const auto& corner = mesh.triangles[triangle];
  const Vec3 edge[3] = { mesh.points[corner[2]] - mesh.points[corner[1]],
    mesh.points[corner[0]] - mesh.points[corner[2]],
    mesh.points[corner[1]] - mesh.points[corner[0]] };
  const double area = 0.5 * edge[0].cross(edge[1]).norm();
  const double longest2 =
    std::max({ edge[0].squaredNorm(), edge[1].squaredNorm(), edge[2].squaredNorm() });
  const bool isFlat = 2.0 * area <= FlatHeight * longest2;
  sum.area += area;
  sum.squaredEdges += area * longest2;
  sum.flatArea += isFlat ? area : 0.0;
  for (Id mode = 0; mode < values.cols(); ++mode)
  {
    const double a = values(corner[0], mode);
    const double b = values(corner[1], mode);
    const double c = values(corner[2], mode);
    const double squares = a * a + b * b + c * c;
    sum.exact[mode] += area / 6.0 * (squares + a * b + b * c + c * a);
    sum.byCorners[mode] += area / 3.0 * squares;
    // The gradient is Σ value x opposite edge, turned by 90° and over twice the area.
    sum.energy[mode] +=
      isFlat ? 0.0 : (a * edge[0] + b * edge[1] + c * edge[2]).squaredNorm() / (4.0 * area);
  }
}

ModeIntegrals Integrate(const TriangleMesh& mesh, const MultiVector& values, int threads)
{
  return ParallelSum(static_cast<Id>(mesh.triangles.size()), threads, ModeIntegrals(values.cols()),
    [&](Id begin, Id end)
    {
      ModeIntegrals sum(values.cols());
      for (Id triangle = begin; triangle < end; ++triangle)
      {
        AddTriangle(mesh, triangle, values, sum);
      }
      return sum;
    });
}

double FirstNonZero(const PointModes& modes)
{
  const Index zeros = CountZeroModes(modes);
  return zeros < static_cast<Index>(modes.eigenvalues.size()) ? modes.eigenvalues[zeros] : 0.0;
}

std::string Describe(Id mode, const char* what, double value, double expected)
{
  std::ostringstream text;
  text << what << " mode " << mode << " is " << value << " on this mesh instead of " << expected;
  return text.str();
}

} // namespace

std::string FindMisfit(const TriangleMesh& mesh, const PointModes& modes, int threads,
  const DistributedRows* distributed)
{
  ModeIntegrals sum = Integrate(mesh, modes.values, threads);
  for (Eigen::ArrayXd* numbers : { &sum.exact, &sum.byCorners, &sum.energy })
  {
    SumOverProcesses(distributed, *numbers);
  }
  std::array<double, 3> sizes = { sum.area, sum.flatArea, sum.squaredEdges };
  SumOverProcesses(distributed, sizes);
  std::tie(sum.area, sum.flatArea, sum.squaredEdges) = std::tie(sizes[0], sizes[1], sizes[2]);
  const bool hasQuotients = sum.flatArea <= FlatShareAllowed * sum.area;
  const double smallest = FirstNonZero(modes);
  for (Id mode = 0; mode < modes.values.cols(); ++mode)
  {
    const double eigenvalue = modes.eigenvalues[mode];
    if (eigenvalue * sum.squaredEdges > Unresolved * sum.area)
    {
      break;
    }
    const double mass = sum.exact[mode];
    const double coarseness = CoarsenessAllowance * (sum.byCorners[mode] - mass);
    if (!(std::abs(mass - 1.0) <= MassTolerance + coarseness))
    {
      return Describe(mode, "the integral of the squared", mass, 1.0);
    }
    const double quotient = sum.energy[mode] / mass;
    const double allowed = (QuotientTolerance + coarseness / mass + sum.flatArea / sum.area) *
                           std::max(eigenvalue, smallest);
    if (hasQuotients && !(std::abs(quotient - eigenvalue) <= allowed))
    {
      return Describe(mode, "the Rayleigh quotient of", quotient, eigenvalue);
    }
  }
  return {};
}

} // namespace gridfem
