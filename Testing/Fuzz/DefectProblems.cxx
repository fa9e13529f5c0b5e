// Solvers on surfaces with defects. The results must equal the results of the clean surface.
#include "Defects.h"
#include "RandomProblem.h"

#include "Solvers/CurvatureSolver.h"
#include "Solvers/DiffusionSolver.h"
#include "Solvers/DistanceSolver.h"
#include "Solvers/PoissonSolver.h"
#include "Solvers/SpectrumSolver.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <numeric>

namespace gridfem::testing
{
namespace
{

/// Degree that integrates the product of two trilinear functions on a plane exactly. Sums then do
/// not depend on the corner that a triangle begins at.
constexpr int ExactDegree = 6;

/// A surface with a field, as a solver gets it.
struct Given
{
  std::shared_ptr<const TriangleMesh> mesh;
  GivenField values;
  Id source; // a point that distances start at
};

struct Setting
{
  SurfaceOptions surface;
  double number;                    // a parameter of the problem, the same for both surfaces
  double normalStabilization = 0.0; // at least; 0: that of the solver
};

struct Solved
{
  MultiVector values;
  bool converged;
};

using Solve = Solved (*)(const Given& given, const Setting& setting);

void ChooseSurface(const Setting& setting, SurfaceOptions& options)
{
  options.space = setting.surface.space;
  options.choice.kind = setting.surface.choice.kind;
  options.choice.quadratureDegree = ExactDegree;
  options.choice.normalStabilization =
    std::max(options.choice.normalStabilization, setting.normalStabilization);
}

void SolveExactly(EquationOptions& equation)
{
  equation.solve.tolerance = 1e-10;
  equation.accuracy = 0.0;
}

Solved SolvePoisson(const Given& given, const Setting& setting)
{
  PoissonSolver::Options options;
  SolveExactly(options.equation);
  options.screeningWeight = std::pow(10.0, 3.0 * setting.number);
  SurfaceOptions surface;
  ChooseSurface(setting, surface);
  PoissonSolver::Input input;
  input.values = given.values;
  const auto result = PoissonSolver::Solve(given.mesh, input, options, surface);
  return { result.atPoints, result.report.converged };
}

Solved SolveHeat(const Given& given, const Setting& setting)
{
  DiffusionSolver::Options options;
  SolveExactly(options.equation);
  options.diffusionTime = std::pow(10.0, -1.0 - 2.0 * setting.number);
  SurfaceOptions surface = DiffusionSolver::SurfaceDefaults();
  ChooseSurface(setting, surface);
  DiffusionSolver::Input input;
  input.values = given.values;
  const auto result = DiffusionSolver::Solve(given.mesh, input, options, surface);
  return { result.steps.back().atPoints, result.steps.back().report.converged };
}

Solved SolveDistance(const Given& given, const Setting& setting)
{
  DistanceSolver::Options options;
  SolveExactly(options.equation);
  SurfaceOptions surface = DistanceSolver::SurfaceDefaults();
  ChooseSurface(setting, surface);
  DistanceSolver::Input input;
  input.ids = { given.source };
  const auto result = DistanceSolver::Solve(given.mesh, input, options, surface);
  return { result.atPoints, result.report.converged };
}

double LengthOf(const TriangleMesh& mesh)
{
  const Bounds bounds = BoundsOf(mesh.points, UsedPoints(mesh));
  return (bounds.high - bounds.low).maxCoeff<Eigen::PropagateNaN>();
}

/// Eigenvalues without a unit. Modes themselves depend on the choice of a basis.
Solved SolveSpectrum(const Given& given, const Setting& setting)
{
  SpectrumSolver::Options options;
  options.equation.solve.tolerance = 1e-9;
  options.numberOfModes = 6;
  SurfaceOptions surface = SpectrumSolver::SurfaceDefaults();
  ChooseSurface(setting, surface);
  const auto result = SpectrumSolver::Solve(given.mesh, {}, options, surface);
  MultiVector eigenvalues = MultiVector::Zero(6, 1);
  for (Id k = 0; k < std::min<Id>(6, result.NumberOfModes()); ++k)
  {
    eigenvalues(k, 0) = result.eigenvalues[k] * std::pow(LengthOf(*given.mesh), 2);
  }
  return { eigenvalues, result.spectrum.converged };
}

/// Mean and Gaussian curvature without a unit. The side that triangles face determines the sign. If
/// all are turned, it is the other side.
Solved SolveCurvatures(const Given& given, const Setting& setting)
{
  SurfaceOptions surface = CurvatureSolver::SurfaceDefaults();
  ChooseSurface(setting, surface);
  MultiVector numbers = CurvatureSolver::Solve(given.mesh, {}, surface).numbers.middleCols(2, 2);
  numbers.col(0) *= LengthOf(*given.mesh);
  numbers.col(1) *= std::pow(LengthOf(*given.mesh), 2);
  return { numbers.cwiseAbs(), true };
}

/// Returns the points where the surface is a single sheet. At others, several functions may have a
/// value, and the order of triangles decides which of them counts.
std::vector<char> PointsOfOneSheet(const TriangleMesh& mesh)
{
  std::map<std::pair<Id, Id>, int> sides;
  for (const auto& corner : mesh.triangles)
  {
    for (int k = 0; k < 3; ++k)
    {
      ++sides[std::minmax(corner[k], corner[(k + 1) % 3])];
    }
  }
  std::vector<int> borders(mesh.points.size(), 0);
  for (const auto& [side, count] : sides)
  {
    for (const Id end : { side.first, side.second })
    {
      borders[end] += count == 1 ? 1 : 0;
    }
  }
  std::vector<char> isSingle(borders.size());
  std::transform(
    borders.begin(), borders.end(), isSingle.begin(), [](int count) { return count <= 2; });
  return isSingle;
}

/// Returns the largest difference, relative to the size of the values. Infinite if other values are
/// unknown.
/// @param isCompared  a mark for each row
/// @param rowOf       for each row, its row in b
/// @param size        of the values, at least
double DifferenceOf(const MultiVector& a, const MultiVector& b, const std::vector<char>& isCompared,
  const std::vector<Id>& rowOf, double size)
{
  double largest = 0.0;
  for (Id row = 0; row < a.rows(); ++row)
  {
    for (Id c = 0; isCompared[row] && c < a.cols(); ++c)
    {
      const double expected = a(row, c);
      const double found = b(rowOf[row], c);
      if (std::isnan(expected) != std::isnan(found))
      {
        return std::numeric_limits<double>::infinity();
      }
      largest = std::fmax(largest, std::abs(expected - found));
      size = std::fmax(size, std::abs(expected));
    }
  }
  return largest > 0.0 ? largest / size : 0.0;
}

struct Problem
{
  const char* name;
  Solve solve;
  bool isAtPoints;
  double rounding; // the largest difference if only the order of sums is another
  double size;     // differences are relative to the values, or to this size if it is larger
};

/// The directions of heat determine the rounding of distances. They are integrated with other
/// errors if a triangle begins at another corner.
constexpr Problem Problems[] = { { "Poisson", SolvePoisson, true, 1e-8, 1.0 },
  { "heat", SolveHeat, true, 1e-8, 1.0 }, { "distance", SolveDistance, true, 1e-2, 0.0 },
  { "spectrum", SolveSpectrum, false, 1e-7, 1.0 },
  { "curvatures", SolveCurvatures, true, 1e-8, 1.0 } };

Setting RandomSetting(Choice& choice)
{
  Setting setting{ {}, choice.Real(0.0, 1.0) };
  SpaceOptions& space = setting.surface.space;
  space.depth = static_cast<int>(choice.Integer(3, 4));
  space.connectivityAware = !choice.OneIn(4);
  space.threads = static_cast<int>(choice.Of({ 1, 1, 1, 2 }));
  setting.surface.choice.kind = choice.OneIn(3) ? FunctionKind::Hats : FunctionKind::Grid;
  return setting;
}

std::string Describe(const DefectivePair& pair, const Problem& problem, const Setting& setting)
{
  const bool isOnHats = setting.surface.choice.kind == FunctionKind::Hats;
  return pair.description + (pair.isAligned ? ", aligned, " : ", ") +
         std::to_string(pair.clean.triangles.size()) + " and " +
         std::to_string(pair.defective.triangles.size()) + " triangles; " + problem.name +
         (isOnHats ? " on hats" : " on the grid") +
         (setting.surface.space.connectivityAware ? "" : ", plain") + ", depth " +
         std::to_string(setting.surface.space.depth);
}

/// The clean surface with its points where the defective surface has them.
TriangleMesh MovedAlike(const DefectivePair& pair)
{
  TriangleMesh moved = pair.clean;
  for (std::size_t point = 0; point < moved.points.size(); ++point)
  {
    moved.points[point] = pair.defective.points[pair.defectivePoint[point]];
  }
  return moved;
}

} // namespace

void CompareWithClean(Choice& choice, const Defects& defects, Outcome& outcome)
{
  const DefectivePair pair = MakeDefectivePair(choice, defects);
  Setting setting = RandomSetting(choice);
  if (defects.hasSeams && pair.isAligned && !setting.surface.space.connectivityAware)
  {
    // Seams put a face in a plane of the grid into two layers of cells, one of them with pieces far
    // smaller than a cell. Plain functions need the stabilization that the warning recommends.
    setting.normalStabilization = 1e-6;
  }
  // Curvatures depend on the triangles at a point, so refined triangles have other curvatures.
  const auto problems = static_cast<Id>(std::size(Problems)) - (defects.hasHangingNodes ? 1 : 0);
  const Problem& problem = Problems[choice.Integer(0, problems - 1)];
  const Id source = choice.Integer(0, static_cast<Id>(pair.clean.points.size()) - 1);
  outcome.description = Describe(pair, problem, setting);
  outcome.isIterative = true;
  const auto solve = [&](const TriangleMesh& mesh, const MultiVector& values, Id from)
  {
    const Field field{ FieldAssociation::Points, values };
    const Solved solved = problem.solve(
      { std::make_shared<const TriangleMesh>(mesh), GivenField::Of("f", field), from }, setting);
    outcome.converged = outcome.converged && solved.converged;
    return solved.values;
  };
  const MultiVector clean = solve(pair.clean, pair.values, source);
  std::vector<char> isCompared(static_cast<std::size_t>(clean.rows()), 1);
  std::vector<Id> sameRow(isCompared.size());
  std::iota(sameRow.begin(), sameRow.end(), Id(0));
  if (problem.isAtPoints)
  {
    isCompared = PointsOfOneSheet(pair.clean);
  }
  const auto differenceOf = [&](const MultiVector& other, const std::vector<Id>& rowOf)
  { return DifferenceOf(clean, other, isCompared, rowOf, problem.size); };
  const double found =
    differenceOf(solve(pair.defective, pair.defectiveValues, pair.defectivePoint[source]),
      problem.isAtPoints ? pair.defectivePoint : sameRow);

  double allowed = problem.rounding;
  if (defects.hasHangingNodes) // hats err by about as much as they differ from finer ones
  {
    allowed += 2.0 * differenceOf(solve(pair.fine, pair.fineValues, source), sameRow);
  }
  if (defects.hasSeams)
  {
    // Points of a seam move by up to 1e-6 of the surface. A part that enters another cell there has
    // other functions, which differ by as much as they err. The tip of a notch that enters a cell
    // even joins functions on both sides of the notch, with or without a seam.
    allowed += differenceOf(solve(MovedAlike(pair), pair.values, source), sameRow);
    ++setting.surface.space.depth;
    allowed += 1e-3 + 2.0 * differenceOf(solve(pair.clean, pair.values, source), sameRow);
  }
  outcome.Require(!outcome.converged || found <= allowed,
    "differs by " + std::to_string(found) + ", not at most " + std::to_string(allowed));
}

} // namespace gridfem::testing
