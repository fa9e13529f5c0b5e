#include "Problems.h"

#include "Base/LargeMemory.h"
#include "Spaces.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace gridfem::benchmarks
{

namespace
{

/// sqrt of the largest quotient of the diagonals of eᵀ M e and uᵀ M u.
template<class Difference, class Product>
double LargestQuotient(const Difference& error, const Product& massError, const Difference& exact,
  const Product& massExact)
{
  const auto squares = error.cwiseProduct(massError).colwise().sum().eval();
  const auto norms = exact.cwiseProduct(massExact).colwise().sum().eval();
  const Eigen::RowVectorXd quotients = squares.cwiseQuotient(norms);
  return std::sqrt(quotients.maxCoeff<Eigen::PropagateNaN>());
}

/// The grid's corner of every finest function, world units.
std::vector<Vec3> Corners(const GridFunctions& space)
{
  const MultiVector coordinates = testing::CoordinateCoefficients(space);
  std::vector<Vec3> corners;
  for (Id i = 0; i < coordinates.rows(); ++i)
  {
    corners.emplace_back(coordinates(i, 0), coordinates(i, 1), coordinates(i, 2));
  }
  return corners;
}

struct Box
{
  Vec3 center;
  double side;
};

Box BoxOf(const TriangleMesh& mesh)
{
  Vec3 low = mesh.points.front();
  Vec3 high = low;
  for (const Vec3& point : mesh.points)
  {
    low = low.cwiseMin(point);
    high = high.cwiseMax(point);
  }
  return { 0.5 * (low + high), (high - low).maxCoeff<Eigen::PropagateNaN>() };
}

SpaceOptions OptionsOf(int depth, int threads, FunctionSupport support)
{
  SpaceOptions options;
  options.depth = depth;
  options.threads = threads;
  options.connectivityAware = support == FunctionSupport::ConnectivityAware;
  return options;
}

} // namespace

MultiVector Colors(const std::vector<Vec3>& points, const Vec3& center, double side, int columns)
{
  MultiVector values(static_cast<Id>(points.size()), columns);
  for (std::size_t i = 0; i < points.size(); ++i)
  {
    const Vec3 p = (points[i] - center) / side;
    for (int c = 0; c < columns; ++c)
    {
      values(static_cast<Id>(i), c) = std::sin(6.0 * p[c % 3] + 4.0 * p[(c + 1) % 3] + c);
    }
  }
  return values;
}

GridProblem SetUp(const TriangleMesh& mesh, int depth, int threads, FunctionSupport support,
  double screeningWeight, Index coarsestSize)
{
  const MemoryReuse reuse;
  GridProblem problem;
  const SpaceOptions options = OptionsOf(depth, threads, support);
  problem.space = BuildGridFunctions(mesh, options);
  problem.system = BuildLevelOperators(problem.space, TriangleRule(2), threads, coarsestSize);
  problem.options.screeningWeight = screeningWeight * std::pow(0.25, depth);
  problem.options.multigrid.threads = threads;
  problem.multigrid =
    std::make_unique<Multigrid>(BuildMultigrid(testing::ViewOf(problem.space, problem.system),
      problem.options.screeningWeight, 1.0, problem.options.multigrid));
  return problem;
}

void ChooseColors(GridProblem& problem, int columns)
{
  const GridFunctions& space = problem.space;
  const double half = 0.5 * std::pow(2.0, space.Finest().depth);
  const Vec3 center = space.GetGrid().ToWorld(Vec3(half, half, half));
  const double side =
    (space.GetGrid().ToWorld(Vec3(2 * half, 0, 0)) - space.GetGrid().ToWorld(Vec3(0, 0, 0))).norm();
  problem.exact = Colors(Corners(space), center, side, columns);
  problem.mass = testing::MassMatrix(space, problem.system);
  Multiply(problem.mass, problem.exact, problem.values);
  Multiply(testing::StiffnessMatrix(space, problem.system), problem.exact, problem.gradients);
}

MultiVector GridProblem::Solve(int columns, int iterations) const
{
  PoissonOptions poisson = options;
  poisson.solve.tolerance = iterations == 0 ? std::numeric_limits<double>::max() : 1e-15;
  poisson.solve.maximumIterations = std::max(1, iterations);
  const auto solve = [&](const MultiVector& f, const MultiVector& s)
  { return SolvePoisson(testing::ViewOf(space, system), *multigrid, f, s, poisson).coefficients; };
  return columns == values.cols() ? solve(values, gradients)
                                  : solve(values.leftCols(columns), gradients.leftCols(columns));
}

double GridProblem::Error(const MultiVector& x) const
{
  const MultiVector wanted = exact.leftCols(x.cols());
  const MultiVector error = x - wanted;
  MultiVector massError;
  Multiply(mass, error, massError);
  return LargestQuotient(error, massError, wanted, MultiVector(values.leftCols(x.cols())));
}

HatProblem AssembleProblem(const TriangleMesh& mesh, double screeningWeight)
{
  HatProblem problem;
  const double side = BoxOf(mesh).side;
  problem.hats = AssembleCotangents(mesh);
  problem.A = Combine(problem.hats, screeningWeight / (side * side));
  return problem;
}

void ChooseColors(const TriangleMesh& mesh, HatProblem& problem, int columns)
{
  problem.exact = ToRows(problem.hats, ColorsAtPoints(mesh, columns));
  problem.b = problem.A * problem.exact;
}

double HatProblem::Error(const Eigen::MatrixXd& x) const
{
  const Eigen::MatrixXd wanted = exact.leftCols(x.cols());
  const Eigen::MatrixXd error = x - wanted;
  return LargestQuotient(
    error, Eigen::MatrixXd(hats.mass * error), wanted, Eigen::MatrixXd(hats.mass * wanted));
}

MultiVector ColorsAtPoints(const TriangleMesh& mesh, int columns)
{
  const Box box = BoxOf(mesh);
  return Colors(mesh.points, box.center, box.side, columns);
}

HybridProblem SetUpHybrid(
  const TriangleMesh& mesh, int depth, int threads, FunctionSupport support, HatTransfer transfer)
{
  GridSpaceOptions options;
  options.functions = OptionsOf(depth, threads, support);
  return { BuildHatSpace(mesh, options, transfer) };
}

Multigrid HybridProblem::BuildCycle(double weight, const testing::HybridCycle& options) const
{
  return testing::BuildHybridCycle(space, weight / std::pow(space.Extent(), 2), options);
}

MultiVector HybridProblem::ToFunctions(const MultiVector& values) const
{
  MultiVector result(space.Hats().functions.Count(), values.cols());
  for (std::size_t point = 0; point < space.Hats().functions.ofPoint.size(); ++point)
  {
    if (space.Hats().functions.ofPoint[point] >= 0)
    {
      result.row(space.Hats().functions.ofPoint[point]) = values.row(static_cast<Id>(point));
    }
  }
  return result;
}

int IterationsToError(const std::function<double(int)>& error, double target, int most)
{
  int below = 0; // too few
  int enough = 1;
  while (!(error(enough) <= target))
  {
    if (enough >= most)
    {
      return -1;
    }
    below = enough;
    enough = std::min(2 * enough, most);
  }
  while (enough - below > 1)
  {
    const int middle = (below + enough) / 2;
    (error(middle) <= target ? enough : below) = middle;
  }
  return enough;
}

} // namespace gridfem::benchmarks
