// Compares solves to the accuracy of the grid with solves to a tolerance, on all real meshes:
// iterations, time, additional error, and the quality of the estimates. The error of the space is
// the difference to a grid two levels finer.
#include "AccuracyPeers.h"
#include "AlgebraicMultigrid.h"
#include "Equations/Poisson.h"
#include "Measure.h"
#include "Meshes.h"
#include "PointAreas.h"
#include "SetupCost.h"
#include "Spaces/GridSpace.h"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <filesystem>
#include <stdexcept>

namespace
{

using namespace gridfem;
using namespace gridfem::benchmarks;

constexpr int Depth = 7;
constexpr int Runs = 2; // timed runs; the first run touches new memory

std::vector<std::filesystem::path> MeshFiles()
{
  const std::string folder = testing::RealMesh("."); // empty if there is none
  if (folder.empty())
  {
    throw std::runtime_error("There is no folder of real meshes: set GRIDFEM_DATA_DIR.");
  }
  std::vector<std::filesystem::path> files;
  for (const auto& entry : std::filesystem::directory_iterator(folder))
  {
    const std::string extension = entry.path().extension().string();
    if (extension == ".ply" || extension == ".stl" || extension == ".STL")
    {
      files.push_back(entry.path());
    }
  }
  std::sort(files.begin(), files.end());
  return files;
}

/// A smooth function, or jumps with fine waves, of the place in the bounding cube.
MultiVector Values(const TriangleMesh& mesh, bool isSmooth)
{
  Vec3 low = mesh.points.front();
  Vec3 high = low;
  for (const Vec3& point : mesh.points)
  {
    low = low.cwiseMin(point);
    high = high.cwiseMax(point);
  }
  MultiVector f(static_cast<Id>(mesh.points.size()), 1);
  for (std::size_t i = 0; i < mesh.points.size(); ++i)
  {
    const Vec3 p = (mesh.points[i] - low) / (high - low).maxCoeff<Eigen::PropagateNaN>();
    const double step = std::sin(40 * p[0] + 30 * p[1] * p[2]) > 0 ? 1.0 : -1.0;
    f(static_cast<Id>(i), 0) = isSmooth ? std::sin(6 * p[0] + 1) * std::cos(5 * p[1]) + p[2] * p[2]
                                        : step + std::sin(60 * p[2]);
  }
  return f;
}

struct Answer
{
  PoissonSolution solution;
  MultiVector atPoints;
  double seconds = 0.0; // of the solve: start and iterations
};

/// λ = 100 / area.
Answer Solve(const GridSpace& space, const MultiVector& values, double area, double accuracy,
  double tolerance, int runs = 1)
{
  PoissonOptions options;
  options.screeningWeight = 100.0 / area * std::pow(space.UnitLength(), 2);
  options.accuracy = accuracy;
  options.solve.tolerance = tolerance;
  options.solve.maximumIterations = 300;
  const Multigrid multigrid =
    BuildMultigrid(space, options.screeningWeight, 1.0, options.multigrid);
  const MultiVector load = space.LoadOfValues({ FieldAssociation::Points, values });
  Answer answer;
  answer.seconds = 1e300;
  for (int run = 0; run < runs; ++run)
  {
    const Stopwatch watch;
    answer.solution = SolvePoisson(space, multigrid, load, {}, options);
    answer.seconds = std::min(answer.seconds, watch.Seconds());
  }
  answer.atPoints = space.ValuesAtPoints(answer.solution.coefficients);
  return answer;
}

GridSpace SpaceOf(const TriangleMesh& mesh, int depth, double normalStabilization)
{
  GridSpaceOptions options;
  options.functions.depth = depth;
  options.normalStabilization = normalStabilization;
  return BuildGridSpace(mesh, options);
}

struct Result
{
  double iterations;
  double time;  // over that to a tolerance of 1e-6
  double error; // over the error of the discrete solution
};

/// Data that the rows of a mesh share. Columns: smooth and rough data.
struct Subject
{
  std::string name;
  Eigen::VectorXd areas; // of the points
  MultiVector values;
  MultiVector truth;
  MultiVector discrete; // the solution in the space

  double Area() const { return areas.sum(); }
  double Norm(const Eigen::VectorXd& u) const { return std::sqrt(areas.dot(u.cwiseAbs2())); }
};

Subject SubjectOf(const std::string& name, const TriangleMesh& mesh, const GridSpace& space)
{
  Subject subject{ name, testing::AreasOfPoints(mesh), {}, {}, {} };
  subject.values.resize(static_cast<Id>(mesh.points.size()), 2);
  subject.values << Values(mesh, true), Values(mesh, false);
  const GridSpace finer = SpaceOf(mesh, Depth + 2, 1e-2);
  subject.truth = Solve(finer, subject.values, subject.Area(), 0.0, 1e-7).atPoints;
  subject.discrete = Solve(space, subject.values, subject.Area(), 0.0, 1e-11).atPoints;
  return subject;
}

/// A row of the table: a column of the subject.
Result Compare(const Subject& subject, Id column, const GridSpace& space, const Table& table)
{
  const MultiVector values = subject.values.col(column);
  const Answer accurate = Solve(space, values, subject.Area(), 0.1, 1e-9, Runs);
  const Answer tolerant = Solve(space, values, subject.Area(), 0.0, 1e-6, Runs);
  const Eigen::VectorXd truth = subject.truth.col(column);
  const Eigen::VectorXd discrete = subject.discrete.col(column);
  const Eigen::VectorXd found = accurate.atPoints.col(0);
  const double mean = subject.areas.dot(truth) / subject.Area();
  const double size = subject.Norm(truth.array() - mean);
  const double ofSpace = subject.Norm(discrete - truth);
  const double left = subject.Norm(found - discrete);
  const Result result{ double(accurate.solution.report.iterations),
    accurate.seconds / tolerant.seconds, subject.Norm(found - truth) / ofSpace };
  const SolutionAccuracy& said = accurate.solution.accuracy;
  table.Row({ subject.name, column == 0 ? "smooth" : "rough", Text("%.1e", ofSpace / size),
    Text("%.2f", said.discretization * size / ofSpace) + (said.isTrusted ? "" : " ?"),
    Text("%.3f", left / ofSpace), Text("%.1f", said.algebraic * size / left),
    Text("%.3f", result.error), Text("%.0f", result.iterations),
    std::to_string(tolerant.solution.report.iterations), Text("%.2f", result.time) });
  return result;
}

double Quantile(std::vector<double> values, double part)
{
  std::sort(values.begin(), values.end());
  return values[static_cast<std::size_t>(part * double(values.size() - 1))];
}

int CompareMeshes()
{
  const std::vector<std::filesystem::path> files = MeshFiles();
  if (files.empty())
  {
    std::printf("There are no meshes: set GRIDFEM_DATA_DIR\n");
    return 1;
  }
  std::printf(
    "\nDepth %d, lambda = 100 / area, Accuracy 0.1 beside a tolerance of 1e-6; errors in the "
    "mean square over the points\n",
    Depth);
  const Table table({ "mesh", "data", "error of the space", "said", "left / it", "said", "total",
    "iterations", "to 1e-6", "time / to 1e-6" });
  std::vector<double> iterations;
  std::vector<double> times;
  std::vector<double> errors;
  for (const std::filesystem::path& file : files)
  {
    const TriangleMesh mesh = testing::ReadMesh(file.string());
    const GridSpace space = SpaceOf(mesh, Depth, DefaultNormalStabilization);
    const Subject subject = SubjectOf(file.stem().string(), mesh, space);
    for (const Id column : { 0, 1 })
    {
      const Result result = Compare(subject, column, space, table);
      iterations.push_back(result.iterations);
      times.push_back(result.time);
      errors.push_back(result.error);
    }
  }
  PrintAtMost("accuracy_iterations_nine_in_ten", Quantile(iterations, 0.9), 4.0);
  PrintAtMost("accuracy_iterations_all", Quantile(iterations, 1.0), 8.0);
  PrintAtMost("accuracy_time_over_tolerance_median", Quantile(times, 0.5), 0.4);
  PrintAtMost("accuracy_total_error_over_discrete", Quantile(errors, 1.0), 1.1);
  return 0;
}

void CompareWithPeers()
{
  const MessagePassing libraries;
  const NamedMesh rocker = RockerArm(3);
  for (const bool isSmooth : { true, false })
  {
    ComparePeers(isSmooth ? "smooth" : "rough", rocker.mesh, 8, Values(rocker.mesh, isSmooth));
  }
}

} // namespace

/// Arguments: parts of meshes, peers.
int main(int argc, char** argv)
{
  const Parts parts(argc, argv);
  if (parts.Want("peers"))
  {
    CompareWithPeers();
  }
  return parts.Want("meshes") ? CompareMeshes() : 0;
}
