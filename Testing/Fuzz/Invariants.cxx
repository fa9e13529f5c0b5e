#include "Invariants.h"

#include "Largest.h"
#include "Meshes.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>

namespace gridfem::testing
{
namespace
{

/// Degree that integrates the product of two trilinear functions on a plane exactly.
constexpr int ExactDegree = 6;

/// Returns 0 .. count - 1 in a random order.
std::vector<Id> RandomOrder(Choice& choice, std::size_t count)
{
  std::vector<Id> order(count);
  std::iota(order.begin(), order.end(), Id(0));
  for (Id k = static_cast<Id>(count) - 1; k > 0; --k)
  {
    std::swap(order[k], order[choice.Integer(0, k)]);
  }
  return order;
}

/// Returns the same surface with other numbers of points and triangles. Triangles may begin at any
/// corner and may be turned over.
TriangleMesh Reordered(Choice& choice, const TriangleMesh& mesh)
{
  const std::vector<Id> place = RandomOrder(choice, mesh.points.size());
  TriangleMesh result;
  result.points.resize(mesh.points.size());
  for (std::size_t point = 0; point < place.size(); ++point)
  {
    result.points[place[point]] = mesh.points[point];
  }
  for (const Id triangle : RandomOrder(choice, mesh.triangles.size()))
  {
    std::array<Id, 3> corner = mesh.triangles[triangle];
    std::rotate(corner.begin(), corner.begin() + choice.Integer(0, 2), corner.end());
    if (choice.OneIn(2))
    {
      std::swap(corner[1], corner[2]);
    }
    result.triangles.push_back({ place[corner[0]], place[corner[1]], place[corner[2]] });
  }
  return result;
}

double TraceOf(const SparseMatrix& A)
{
  const std::vector<double> diagonal = A.Diagonal();
  return std::accumulate(diagonal.begin(), diagonal.end(), 0.0);
}

Bounds BoundsOfUsed(const TriangleMesh& mesh)
{
  return BoundsOf(mesh.points, UsedPoints(mesh));
}

/// Builds the surface with another mesh and exact integrals.
RandomSurface WithMesh(const RandomSurface& surface, TriangleMesh mesh)
{
  RandomSurface other = surface;
  other.mesh = std::make_shared<const TriangleMesh>(std::move(mesh));
  other.options.quadratureDegree = std::max(ExactDegree, surface.options.quadratureDegree);
  other.Build();
  return other;
}

/// Requires the same number of functions on every level, and matrices that differ only by rounding
/// and `largest`.
void RequireSameMatrices(const FiniteElementSpace& a, const FiniteElementSpace& b, double stiffness,
  double largest, const std::string& what, Outcome& outcome)
{
  outcome.Require(a.NumberOfLevels() == b.NumberOfLevels(), what + " changes the levels");
  for (std::size_t level = 0; level < std::min(a.NumberOfLevels(), b.NumberOfLevels()); ++level)
  {
    outcome.Require(
      a.NumberOfFunctions(level) == b.NumberOfFunctions(level), what + " changes the functions");
  }
  const double expected = TraceOf(a.Matrix(0, 1.0, stiffness));
  const double found = TraceOf(b.Matrix(0, 1.0, stiffness));
  outcome.Require(
    std::abs(found - expected) <= 1e-9 * expected + largest, what + " changes a matrix");
}

/// A solution of λ u - Δu = λ f.
struct Solved
{
  MultiVector coefficients;
  MultiVector atPoints;
  double energy;   // uᵀ (λM + L) u, dimensionless
  double rounding; // error of the energy
  bool converged;
};

double EnergyOf(const FiniteElementSpace& space, double weight, const MultiVector& u)
{
  MultiVector product;
  Multiply(space.Matrix(0, weight, 1.0), u, product);
  return u.cwiseProduct(product).sum();
}

/// Returns how much rounding of the matrix's entries changes the energy of a solution. This is much
/// if functions that almost vanish on the surface have large coefficients. It happens next to a
/// face nearly parallel to a grid plane, with a small weight of the normal derivative.
double RoundingOfEnergy(const FiniteElementSpace& space, double weight, const MultiVector& u)
{
  SparseMatrix positive = space.Matrix(0, weight, 1.0);
  for (double& value : positive.value)
  {
    value = std::abs(value);
  }
  MultiVector product;
  Multiply(positive, u.cwiseAbs(), product);
  return 16.0 * std::numeric_limits<double>::epsilon() * u.cwiseAbs().cwiseProduct(product).sum();
}

/// @param weight  λ, per squared world unit
Solved Solve(const RandomSurface& surface, double weight, const Field& f)
{
  const FiniteElementSpace& space = *surface.space;
  PoissonOptions options;
  options.screeningWeight = weight * std::pow(space.UnitLength(), 2);
  options.solve.tolerance = 1e-9;
  options.solve.maximumIterations = 200;
  options.multigrid.threads = 1;
  const Multigrid multigrid =
    BuildMultigrid(space, options.screeningWeight, 1.0, options.multigrid);
  const PoissonSolution solution =
    SolvePoisson(space, multigrid, space.LoadOfValues(f), {}, options);
  return { solution.coefficients, space.ValuesAtPoints(solution.coefficients),
    EnergyOf(space, options.screeningWeight, solution.coefficients),
    RoundingOfEnergy(space, options.screeningWeight, solution.coefficients),
    solution.report.converged };
}

/// Whether every point has a single value. Sheets that touch at a point may have separate functions
/// there, and the order decides which function gives the value.
bool HasOneValue(const RandomSurface& surface)
{
  return surface.isOnHats || !surface.options.functions.connectivityAware ||
         surface.options.functions.joinAtPoints;
}

/// Returns the difference relative to u, in a norm over the area: the mean of the squared
/// differences at the triangles' corners.
/// @param ofCopy  for each corner of a triangle, its point in the copy
double Difference(const TriangleMesh& mesh, const MultiVector& u,
  const std::vector<std::array<Id, 3>>& ofCopy, const MultiVector& copied)
{
  double difference = 0.0;
  double size = 0.0;
  for (std::size_t t = 0; t < mesh.triangles.size(); ++t)
  {
    const auto& corner = mesh.triangles[t];
    const double area = (mesh.points[corner[1]] - mesh.points[corner[0]])
                          .cross(mesh.points[corner[2]] - mesh.points[corner[0]])
                          .norm();
    for (int k = 0; k < 3; ++k)
    {
      difference += area * std::pow(u(corner[k], 0) - copied(ofCopy[t][k], 0), 2);
      size += area * std::pow(u(corner[k], 0), 2);
    }
  }
  return size > 0.0 ? std::sqrt(difference / size) : 0.0;
}

double LargestCoordinate(const TriangleMesh& mesh)
{
  const auto [low, high] = BoundsOfUsed(mesh);
  return low.cwiseAbs().cwiseMax(high.cwiseAbs()).maxCoeff<Eigen::PropagateNaN>();
}

double ExtentOf(const TriangleMesh& mesh)
{
  const auto [low, high] = BoundsOfUsed(mesh);
  return (high - low).maxCoeff<Eigen::PropagateNaN>();
}

/// Returns the largest relative change of lengths on the triangles that rounding of the coordinates
/// can cause, here or after a move by the mesh's extent. It is infinite if rounding may decide
/// which triangles are flat.
double RoundingOn(const TriangleMesh& mesh)
{
  const double rounding =
    16.0 * std::numeric_limits<double>::epsilon() * (LargestCoordinate(mesh) + ExtentOf(mesh));
  double largest = 0.0;
  for (const auto& corner : mesh.triangles)
  {
    const Vec3 edge[] = { mesh.points[corner[1]] - mesh.points[corner[0]],
      mesh.points[corner[2]] - mesh.points[corner[1]],
      mesh.points[corner[0]] - mesh.points[corner[2]] };
    double longest = 0.0;
    bool isCollapsed = false;
    for (const Vec3& e : edge)
    {
      longest = testing::Larger(longest, e.norm());
      isCollapsed = isCollapsed || e.isZero(0.0);
    }
    const double height = edge[0].cross(edge[1]).norm() / longest;
    if (!isCollapsed)
    {
      largest = std::max(largest,
        height > 1e-8 * longest ? rounding / height : std::numeric_limits<double>::infinity());
    }
  }
  return largest;
}

/// Largest rounding on triangles whose solutions are compared.
constexpr double LargestRounding = 1e-5;

/// Requires the same energy and values of two solutions if both reach the tolerance.
void RequireSameSolution(const RandomSurface& a, const RandomSurface& b, double weight,
  const Field& f, const Field& fOfCopy, const std::string& what, Outcome& outcome)
{
  const double rounding = RoundingOn(*a.mesh);
  const Solved first = Solve(a, weight, f);
  const Solved second = Solve(b, weight, fOfCopy);
  if (!first.converged || !second.converged || !(rounding < LargestRounding))
  {
    return;
  }
  const double allowed = 1e-7 + 100.0 * rounding;
  outcome.Require(std::abs(first.energy - second.energy) <= allowed * first.energy + first.rounding,
    what + " changes the energy of a solution");
  outcome.Require(!HasOneValue(a) || Difference(*a.mesh, first.atPoints, b.mesh->triangles,
                                       second.atPoints) < 10.0 * allowed,
    what + " changes a solution");
}

/// Returns λ per squared world unit, from the scale of the surface to the scale of cells.
double WeightFor(Choice& choice, const RandomSurface& surface)
{
  return choice.PowerOfTen(-2.0, 4.0) /
         std::pow(surface.space->Extent() * surface.space->UnitLength(), 2);
}

/// Moves the mesh to points of a lattice near the origin. The lattice is 2^12 times finer than the
/// extent of the mesh. Coordinates, shifts and the surrounding grid then have no rounding errors.
/// Even for a triangle that hardly leans against a face, it is then known where it meets the face.
TriangleMesh OnFineLattice(const TriangleMesh& mesh, double& step)
{
  const Vec3 low = BoundsOfUsed(mesh).low;
  step = std::ldexp(1.0, std::ilogb(ExtentOf(mesh)) - 12);
  TriangleMesh result = mesh;
  const std::vector<char> used = UsedPoints(mesh);
  for (std::size_t point = 0; point < mesh.points.size(); ++point)
  {
    for (int axis = 0; axis < 3; ++axis)
    {
      result.points[point][axis] =
        used[point] ? step * std::nearbyint((mesh.points[point][axis] - low[axis]) / step) : 0.0;
    }
  }
  return result;
}

/// Whether a triangle is perpendicular to an axis. Such a triangle in a face between two cells
/// belongs to the upper cell.
bool HasTriangleAcross(const TriangleMesh& mesh, int axis)
{
  return std::any_of(mesh.triangles.begin(), mesh.triangles.end(),
    [&](const std::array<Id, 3>& corner)
    {
      const double x = mesh.points[corner[0]][axis];
      return mesh.points[corner[1]][axis] == x && mesh.points[corner[2]][axis] == x;
    });
}

/// Moves the mesh to another place by shifts, exchanges of axes and mirrors.
TriangleMesh PlacedAlongAxes(Choice& choice, const TriangleMesh& mesh, double step)
{
  const std::vector<Id> axisOf = RandomOrder(choice, 3);
  TriangleMesh result = mesh;
  for (int axis = 0; axis < 3; ++axis)
  {
    const bool isMirrored = choice.OneIn(2) && !HasTriangleAcross(mesh, axis);
    const double shift = step * double(choice.Integer(-(1 << 24), 1 << 24));
    for (std::size_t point = 0; point < mesh.points.size(); ++point)
    {
      const double x = mesh.points[point][axis];
      result.points[point][axisOf[axis]] = (isMirrored ? -x : x) + shift;
    }
  }
  return result;
}

void RequireNoPlaceOfGrids(Choice& choice, const RandomSurface& surface, Outcome& outcome)
{
  double step = 0.0;
  TriangleMesh mesh = OnFineLattice(*surface.mesh, step);
  if (!(SurfaceArea(mesh) > 1e-6 * std::pow(ExtentOf(mesh), 2)))
  {
    return; // narrower than the lattice
  }
  TriangleMesh placed = PlacedAlongAxes(choice, mesh, step);
  const RandomSurface here = WithMesh(surface, std::move(mesh));
  const RandomSurface there = WithMesh(surface, std::move(placed));
  RequireSameMatrices(*here.space, *there.space, 1.0, 0.0, "the place", outcome);
  const Field f = OrdinaryField(choice, *here.mesh, 1, FieldAssociation::Points);
  RequireSameSolution(here, there, WeightFor(choice, here), f, f, "the place", outcome);
}

const std::vector<Index>& HatOfPoint(const RandomSurface& surface)
{
  return dynamic_cast<const HatSpace&>(*surface.space).Hats().functions.ofPoint;
}

/// Returns the coefficients of the hats with these values at points. Values at coincident points
/// must be equal.
MultiVector HatsWith(const RandomSurface& surface, const MultiVector& atPoints)
{
  const std::vector<Index>& hatOfPoint = HatOfPoint(surface);
  MultiVector coefficients =
    MultiVector::Zero(surface.space->NumberOfFunctions(0), atPoints.cols());
  for (std::size_t point = 0; point < hatOfPoint.size(); ++point)
  {
    if (hatOfPoint[point] >= 0)
    {
      coefficients.row(hatOfPoint[point]) = atPoints.row(static_cast<Id>(point));
    }
  }
  return coefficients;
}

void RequireNoPlaceOfHats(Choice& choice, const RandomSurface& surface, Outcome& outcome)
{
  const TriangleMesh& mesh = *surface.mesh;
  const Vec3 axis = choice.Vector();
  const double angle = choice.Real(0.0, 6.3);
  TriangleMesh moved = Transform(mesh, axis, angle, 1.0, ExtentOf(mesh) * choice.Vector());
  const double rounding = RoundingOn(mesh);
  const std::vector<char> used = UsedPoints(mesh);
  if (!(rounding < LargestRounding) ||
      WeldCoincidentPoints(mesh.points, used) != WeldCoincidentPoints(moved.points, used))
  {
    return; // rounding decides about flat triangles or coincident points
  }
  const RandomSurface here = WithMesh(surface, mesh);
  const RandomSurface there = WithMesh(surface, std::move(moved));
  outcome.Require(here.space->NumberOfFunctions(0) == there.space->NumberOfFunctions(0),
    "the place changes the hats");
  const double weight = WeightFor(choice, here);
  const double ofHere = weight * std::pow(here.space->UnitLength(), 2);
  const double ofThere = weight * std::pow(there.space->UnitLength(), 2);
  const Field f = OrdinaryField(choice, mesh, 1, FieldAssociation::Points);

  // The energy on every triangle depends only on its sides.
  const MultiVector v = here.space->ValuesAtPoints(HatsWith(here, f.values));
  const double before = EnergyOf(*here.space, ofHere, HatsWith(here, v));
  const double after = EnergyOf(*there.space, ofThere, HatsWith(there, v));
  const double allowed = 1e-11 + 10.0 * rounding;
  const double canceled = 1e-14 * TraceOf(here.space->Matrix(0, ofHere, 1.0)) *
                          v.cwiseAbs2().maxCoeff<Eigen::PropagateNaN>();
  outcome.Require(
    std::abs(after - before) <= allowed * before + canceled, "the place changes energies");

  const Solved first = Solve(here, weight, f);
  const Solved second = Solve(there, weight, f);
  if (first.converged && second.converged)
  {
    const MultiVector difference = first.coefficients - HatsWith(here, second.atPoints);
    const double limit = std::pow(1e-7 + allowed, 2) * first.energy + canceled;
    outcome.Require(
      EnergyOf(*here.space, ofHere, difference) <= limit, "the place changes a solution on hats");
  }
}

} // namespace

bool HasOrdinarySize(const Grid& grid)
{
  return grid.spacing > 1e-100 && grid.spacing < 1e100;
}

double Displacement(const TriangleMesh& mesh, const Grid& grid)
{
  double largest = 0.0;
  for (const Vec3& point : mesh.points)
  {
    largest = testing::Larger(largest, point.cwiseAbs().maxCoeff<Eigen::PropagateNaN>());
  }
  return 4.0 * std::max(1e-10, 2e-15 * largest / grid.spacing);
}

bool IsThin(const TriangleMesh& mesh, const Grid& grid)
{
  Vec3 lowest = mesh.points.front();
  Vec3 highest = lowest;
  for (const Vec3& point : mesh.points)
  {
    lowest = lowest.cwiseMin(point);
    highest = highest.cwiseMax(point);
  }
  return (highest - lowest).minCoeff() < 1e3 * Displacement(mesh, grid) * grid.spacing;
}

void RequireNoOrder(Choice& choice, const RandomSurface& surface, double allowed, Outcome& outcome)
{
  RandomSurface other = surface;
  other.mesh = std::make_shared<const TriangleMesh>(Reordered(choice, *surface.mesh));
  other.Build();
  const FiniteElementSpace& space = *surface.space;
  outcome.Require(other.space->NumberOfFunctions(0) == space.NumberOfFunctions(0),
    "the order changes the functions");
  if (surface.options.quadratureDegree < ExactDegree)
  {
    return;
  }
  // A patch has eight functions with squared slopes of up to 3. The slopes of hats are unbounded.
  const double largest = 24.0 * allowed / std::pow(space.UnitLength(), 2);
  const double stiffness = surface.isOnHats ? 0.0 : 1.0;
  const double expected = TraceOf(space.Matrix(0, 1.0, stiffness));
  const double found = TraceOf(other.space->Matrix(0, 1.0, stiffness));
  outcome.Require(
    std::abs(found - expected) <= 1e-9 * expected + largest, "the order changes a matrix");
}

void RequireNoWelding(
  Choice& choice, const RandomSurface& surface, double allowed, Outcome& outcome)
{
  RandomSurface welded = surface;
  welded.options.functions.weldCoincidentPoints = true;
  const TriangleMesh& mesh = *surface.mesh;
  const RandomSurface shared = WithMesh(welded, mesh);
  const RandomSurface split = WithMesh(welded, Unweld(mesh));
  const double largest = 24.0 * allowed / std::pow(shared.space->UnitLength(), 2);
  RequireSameMatrices(*shared.space, *split.space, surface.isOnHats ? 0.0 : 1.0, largest,
    "sharing of points", outcome);

  const Field f = OrdinaryField(choice, mesh, 1, FieldAssociation::Points);
  Field ofSplit{ FieldAssociation::Points, MultiVector(split.mesh->points.size(), 1) };
  for (std::size_t t = 0; t < mesh.triangles.size(); ++t)
  {
    for (int k = 0; k < 3; ++k)
    {
      ofSplit.values(split.mesh->triangles[t][k], 0) = f.values(mesh.triangles[t][k], 0);
    }
  }
  RequireSameSolution(
    shared, split, WeightFor(choice, shared), f, ofSplit, "sharing of points", outcome);
}

void RequireNoPlace(Choice& choice, const RandomSurface& surface, Outcome& outcome)
{
  if (surface.isOnHats)
  {
    RequireNoPlaceOfHats(choice, surface, outcome);
  }
  else
  {
    RequireNoPlaceOfGrids(choice, surface, outcome);
  }
}

} // namespace gridfem::testing
