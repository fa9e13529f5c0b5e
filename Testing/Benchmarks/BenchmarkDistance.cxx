// Distances along a surface from ten points, one after the other, and the cost of held values.
//
// "from the mesh on" is clip, functions, both hierarchies and ten distances. The peer is the heat
// method of Crane, Weischedel and Wardetzky on hat functions with lumped mass and t = (mean edge)²,
// by CHOLMOD. Both matrices have one analysis and are factorized once. A further source costs two
// substitutions, with a gradient and a divergence between them. The other peer is CGAL's heat
// method with intrinsic Delaunay triangles, on one thread. Times are the least of three runs. The
// errors belong to one distance on surfaces where it is known, or computed exactly by CGAL.
#include "Cholmod.h"
#include "DistanceErrors.h"
#include "IntrinsicHeat.h"
#include "Measure.h"
#include "Meshes.h"
#include "PolyhedralDistances.h"
#include "SetupCost.h"

#include "Distance/GeodesicDistance.h"
#include "Equations/PointConstraints.h"
#include "Equations/Poisson.h"
#include "Spaces/GridSpace.h"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <filesystem>
#include <functional>
#include <stdexcept>

namespace
{

using namespace gridfem;
using namespace gridfem::benchmarks;

constexpr int Threads = 2;
constexpr int Sources = 10;

/// Some of ten points that are spread over the numbers of the mesh's points.
std::vector<Id> SourcesOf(const TriangleMesh& mesh, int count)
{
  std::vector<Id> sources;
  for (int k = 0; k < count; ++k)
  {
    sources.push_back(
      static_cast<Id>((k + 0.5) / Sources * static_cast<double>(mesh.points.size())));
  }
  return sources;
}

struct DistanceTimes
{
  double setup = 0.0;
  double firstSource = 0.0;
  double furtherSource = 0.0; // mean
  double substitutions = 0.0; // of a further source, for the peer
  double largest = 0.0;       // errors, where the distance is known
  double mean = 0.0;

  double Total() const { return setup + firstSource + (Sources - 1) * furtherSource; }
};

/// From the first source to all points; infinite where they are not known. Empty if none is known.
using Exact = std::vector<double>;

void MeasureErrors(const std::vector<double>& found, const Exact& exact, DistanceTimes& times)
{
  const DistanceErrors errors = ErrorsOf(found, exact);
  times.largest = errors.largest;
  times.mean = errors.mean;
}

/// Times the distances from all sources, with the errors of the first.
/// @param from  the distances from a source
template<class From>
void MeasureSources(
  const std::vector<Id>& sources, const Exact& exact, DistanceTimes& times, From&& from)
{
  for (std::size_t k = 0; k < sources.size(); ++k)
  {
    const Stopwatch watch;
    const std::vector<double> found = from(sources[k]);
    (k == 0 ? times.firstSource : times.furtherSource) += watch.Seconds();
    if (k == 0 && !exact.empty())
    {
      MeasureErrors(found, exact, times);
    }
  }
  times.furtherSource /= std::max<double>(1.0, double(sources.size()) - 1.0);
}

DistanceTimes MeasureGrid(
  const TriangleMesh& mesh, int depth, const std::vector<Id>& sources, const Exact& exact)
{
  DistanceTimes times;
  const Stopwatch setup;
  GridSpaceOptions options;
  options.functions.depth = depth;
  options.functions.threads = Threads;
  options.functions.joinAtPoints = true;
  options.normalStabilization = 0.1;
  auto space = std::make_shared<const GridSpace>(BuildGridSpace(mesh, options));
  DistanceOptions distances;
  distances.multigrid.threads = Threads;
  distances.multigrid.cycle = CycleType::V;
  const GeodesicDistance distance(
    std::move(space), std::make_shared<const TriangleMesh>(mesh), distances, Threads);
  times.setup = setup.Seconds();
  SolveOptions solve;
  solve.tolerance = 1e-4;
  MeasureSources(sources, exact, times,
    [&](Id source) { return distance.From({ source }, solve, Threads).atPoints; });
  return times;
}

/// The heat method on hat functions.
class HatHeat
{
public:
  explicit HatHeat(const TriangleMesh& mesh) : mesh_(mesh), hats_(AssembleCotangents(mesh))
  {
    double edges = 0.0;
    for (const auto& corner : mesh.triangles)
    {
      for (int k = 0; k < 3; ++k)
      {
        edges += (mesh.points[corner[k]] - mesh.points[corner[(k + 1) % 3]]).norm();
      }
    }
    const double edge = edges / static_cast<double>(3 * mesh.triangles.size());
    SymmetricMatrix heat = edge * edge * hats_.stiffness;
    heat.diagonal() += hats_.mass * Eigen::VectorXd::Ones(hats_.mass.cols()); // lumped
    // The stiffness alone has the constants in its null space.
    const double shift = 1e-9 / SurfaceArea(mesh);
    const SymmetricMatrix poisson = shift * hats_.mass + hats_.stiffness;
    heat_.Analyze(heat);
    poisson_.AnalyzeAs(heat_);
    heat_.Factor(heat);
    poisson_.Factor(poisson);
  }

  std::vector<double> From(Id source, double& substitutions) const
  {
    Eigen::MatrixXd b = Eigen::MatrixXd::Zero(hats_.mass.rows(), 1);
    b(hats_.row[source], 0) = 1.0;
    const Stopwatch first;
    const Eigen::MatrixXd u = heat_.Solve(b);
    substitutions += first.Seconds();
    const Eigen::MatrixXd load = this->LoadOfDistance(u);
    const Stopwatch second;
    const Eigen::MatrixXd phi = poisson_.Solve(load);
    substitutions += second.Seconds();
    std::vector<double> distance(mesh_.points.size());
    for (std::size_t i = 0; i < distance.size(); ++i)
    {
      distance[i] = phi(hats_.row[i], 0) - phi(hats_.row[source], 0);
    }
    return distance;
  }

private:
  /// ∫ <X, ∇φ_i> with X = -∇u / |∇u|.
  Eigen::MatrixXd LoadOfDistance(const Eigen::MatrixXd& u) const
  {
    Eigen::MatrixXd load = Eigen::MatrixXd::Zero(u.rows(), 1);
    for (const auto& corner : mesh_.triangles)
    {
      const Vec3 normal = (mesh_.points[corner[1]] - mesh_.points[corner[0]])
                            .cross(mesh_.points[corner[2]] - mesh_.points[corner[0]]);
      const double square = normal.squaredNorm();
      if (!(square > 0.0))
      {
        continue;
      }
      std::array<Vec3, 3> gradient;
      Vec3 sum = Vec3::Zero();
      for (int k = 0; k < 3; ++k)
      {
        const Vec3 edge = mesh_.points[corner[(k + 2) % 3]] - mesh_.points[corner[(k + 1) % 3]];
        gradient[k] = normal.cross(edge) / square;
        sum += u(hats_.row[corner[k]], 0) * gradient[k];
      }
      const Vec3 away = -sum.stableNormalized();
      for (int k = 0; k < 3; ++k)
      {
        load(hats_.row[corner[k]], 0) += 0.5 * std::sqrt(square) * away.dot(gradient[k]);
      }
    }
    return load;
  }

  const TriangleMesh& mesh_;
  CotangentSystem hats_;
  Cholmod heat_;
  Cholmod poisson_;
};

DistanceTimes MeasureHats(
  const TriangleMesh& mesh, const std::vector<Id>& sources, const Exact& exact)
{
  SetBlasThreads(Threads);
  DistanceTimes times;
  const Stopwatch setup;
  const HatHeat heat(mesh);
  times.setup = setup.Seconds();
  double all = 0.0;
  MeasureSources(sources, exact, times,
    [&](Id source)
    {
      double substitutions = 0.0;
      std::vector<double> found = heat.From(source, substitutions);
      all += source == sources.front() ? 0.0 : substitutions;
      return found;
    });
  times.substitutions = all / std::max<double>(1.0, double(sources.size()) - 1.0);
  return times;
}

DistanceTimes MeasureCgal(
  const TriangleMesh& mesh, const std::vector<Id>& sources, const Exact& exact)
{
  DistanceTimes times;
  const Stopwatch setup;
  IntrinsicHeat heat(mesh);
  if (!heat.IsManifold())
  {
    throw std::runtime_error("CGAL has no distances on a mesh that is no manifold.");
  }
  times.setup = setup.Seconds();
  MeasureSources(sources, exact, times, [&](Id source) { return heat.From(source); });
  return times;
}

/// The fastest of three runs, each in a process of its own.
template<class Run>
DistanceTimes Fastest(Run&& run)
{
  DistanceTimes fastest;
  for (int k = 0; k < 3; ++k)
  {
    const auto times = MeasureInOwnProcess<DistanceTimes>(run);
    fastest = k == 0 || times.Total() < fastest.Total() ? times : fastest;
  }
  return fastest;
}

void PrintTimes()
{
  TriangleMesh mesh = RealMesh("rocker arm", "rocker_arm.ply").mesh;
  const std::vector<Id> sources = SourcesOf(mesh, Sources);
  // The surface stays the same when its triangles are cut, and its points keep their numbers.
  Exact exact = PolyhedralDistances(mesh, sources[0]);
  while (mesh.points.size() < 500000)
  {
    mesh = testing::SubdivideInPlane(mesh);
  }
  std::printf("\nDistances from ten points of a rocker arm, %zu vertices, %d threads\n",
    mesh.points.size(), Threads);
  exact.resize(mesh.points.size(), INFINITY);
  const auto coarse = Fastest([&] { return MeasureGrid(mesh, 7, sources, exact); });
  const auto ours = Fastest([&] { return MeasureGrid(mesh, 8, sources, exact); });
  const auto peer = Fastest([&] { return MeasureHats(mesh, sources, exact); });
  const auto cgal = Fastest([&] { return MeasureCgal(mesh, sources, exact); });
  const Table table({ "by", "set-up s", "first source s", "a further source s", "substitutions s",
    "all ten s", "largest error", "root mean square" });
  const auto row = [&](const char* name, const DistanceTimes& times)
  {
    table.Row({ name, Text("%.2f", times.setup), Text("%.2f", times.firstSource),
      Text("%.2f", times.furtherSource),
      times.substitutions > 0.0 ? Text("%.2f", times.substitutions) : "",
      Text("%.1f", times.Total()), Text("%.2e", times.largest), Text("%.2e", times.mean) });
  };
  row("grid, depth 7", coarse);
  row("grid, depth 8", ours);
  row("hats, CHOLMOD", peer);
  row("hats, CGAL, intrinsic Delaunay", cgal);
  PrintAtLeast("distance/all-ten-faster-depth-7", peer.Total() / coarse.Total(), 2.0);
  PrintAtMost("distance/further-source-depth-7", coarse.furtherSource / peer.substitutions, 2.0);
  PrintAtLeast("distance/all-ten-faster-depth-8", peer.Total() / ours.Total(), 1.0);
}

/// One distance on a surface where it is known.
void PrintErrors(
  const Table& table, const std::string& name, const TriangleMesh& mesh, const Exact& exact)
{
  const auto row = [&](const char* by, const std::function<DistanceTimes()>& measure)
  {
    const auto times = MeasureInOwnProcess<DistanceTimes>(measure);
    table.Row({ name, Text("%.0f", static_cast<double>(mesh.points.size())), by,
      Text("%.2e", times.largest), Text("%.2e", times.mean) });
    return times;
  };
  const std::vector<Id> sources = SourcesOf(mesh, 1);
  const DistanceTimes coarse =
    row("grid, depth 7", [&] { return MeasureGrid(mesh, 7, sources, exact); });
  const DistanceTimes ours =
    row("grid, depth 8", [&] { return MeasureGrid(mesh, 8, sources, exact); });
  const DistanceTimes peer =
    row("hats, CHOLMOD", [&] { return MeasureHats(mesh, sources, exact); });
  const DistanceTimes cgal =
    row("hats, CGAL, intrinsic Delaunay", [&] { return MeasureCgal(mesh, sources, exact); });
  PrintAtMost("distance/error-depth-8-over-intrinsic-" + name, ours.largest / cgal.largest, 1.0);
  PrintAtMost("distance/error-depth-7-" + name, coarse.largest / peer.largest, 1.0);
  PrintAtMost("distance/error-depth-8-" + name, ours.largest / peer.largest, 1.0);
  PrintAtMost("distance/mean-error-depth-8-" + name, ours.mean / peer.mean, 1.0);
}

void PrintErrors()
{
  std::printf("\nErrors of one distance, over the longest\n");
  const Table table({ "on", "vertices", "by", "largest", "root mean square" });
  const auto known = [](const TriangleMesh& mesh, auto&& distance)
  {
    Exact exact;
    for (const Vec3& point : mesh.points)
    {
      exact.push_back(distance(mesh.points[SourcesOf(mesh, 1)[0]], point));
    }
    return exact;
  };
  const auto sphere = testing::Transform(testing::GeodesicSphere(400), { 1, 2, 3 }, 0.7);
  PrintErrors(table, "sphere", sphere,
    known(sphere,
      [](const Vec3& a, const Vec3& b) { return std::acos(std::clamp(a.dot(b), -1.0, 1.0)); }));
  const auto square = testing::Transform(testing::FlatRectangle(400, 400), { 1, 2, 3 }, 0.7);
  PrintErrors(table, "square", square,
    known(square, [](const Vec3& a, const Vec3& b) { return (a - b).norm(); }));
  for (const char* file : { "armadillo_100k.ply", "rocker_arm.ply", "fandisk_32k.ply",
         "knot_26k.ply", "genus3_13k.ply", "raptor_18k.ply", "neptune_30k.ply" })
  {
    const NamedMesh scan = RealMesh(std::filesystem::path(file).stem().string(), file);
    const Exact exact = PolyhedralDistances(scan.mesh, SourcesOf(scan.mesh, 1)[0]);
    if (!exact.empty())
    {
      PrintErrors(table, scan.name, scan.mesh, exact);
    }
  }
}

struct HeldTimes
{
  double hierarchy = 0.0;
  double solve = 0.0;
  double iterations = 0.0;
  double misfit = 0.0;
};

/// λ = 0 except for the start: the smoothest function with values held at evenly chosen points.
HeldTimes MeasureHeld(const TriangleMesh& mesh, int depth, int count)
{
  GridSpaceOptions options;
  options.functions.depth = depth;
  options.functions.threads = Threads;
  options.normalStabilization = 1e-2;
  const GridSpace space = BuildGridSpace(mesh, options);
  MultigridOptions multigrid;
  multigrid.threads = Threads;
  SolveOptions solve;
  solve.tolerance = 1e-6;
  Field field{ FieldAssociation::Points, MultiVector(static_cast<Id>(mesh.points.size()), 1) };
  for (Id i = 0; i < field.values.rows(); ++i)
  {
    field.values(i, 0) =
      std::sin(20.0 * mesh.points[i][0] / (space.UnitLength() * std::exp2(depth)));
  }
  const double lambda = 1e-3 * std::exp2(2 * (7 - depth)); // of a squared cell of depth 7
  const MultiVector load = space.LoadOfValues(field, Threads);
  std::vector<Id> points;
  for (int k = 0; k < count; ++k)
  {
    points.push_back(static_cast<Id>((k + 0.5) / count * double(mesh.points.size())));
  }
  MultiVector values(count, 1);
  for (int k = 0; k < count; ++k)
  {
    values(k, 0) = field.values(points[k], 0);
  }
  HeldTimes times;
  const Stopwatch build;
  const ConstraintOptions constraints;
  const ConstrainedHierarchy hierarchy(
    space, lambda, 1.0, space.RowsAtPoints(points), constraints.penalty, multigrid);
  times.hierarchy = build.Seconds();
  const Stopwatch watch;
  const ConstrainedSolution solution =
    SolveConstrained(space, lambda, hierarchy, lambda * load, values, constraints, solve);
  times.solve = watch.Seconds();
  times.iterations = solution.report.iterations;
  times.misfit = solution.misfit;
  return times;
}

/// Prints a row for each number of held points, and the iterations of the last row over the
/// iterations of the first, which holds none.
double PrintHeld(
  const Table& table, const TriangleMesh& mesh, int depth, const std::vector<int>& counts)
{
  double free = 0.0;
  double held = 0.0;
  for (const int count : counts)
  {
    const auto times =
      MeasureInOwnProcess<HeldTimes>([&] { return MeasureHeld(mesh, depth, count); });
    table.Row({ Text("%.0f", static_cast<double>(mesh.points.size())), std::to_string(depth),
      std::to_string(count), Text("%.2f", times.hierarchy), Text("%.2f", times.solve),
      Text("%.0f", times.iterations), Text("%.1e", times.misfit) });
    free = count == 0 ? times.iterations : free;
    held = times.iterations;
    if (count == counts.back())
    {
      PrintAtMost("distance/misfit-of-" + std::to_string(count) + "-held", times.misfit, 2e-6);
    }
  }
  return held / free;
}

void PrintHeld()
{
  const TriangleMesh mesh = RealMesh("bunny", "stanford_bunny.ply").mesh;
  std::printf("\nSmoothing with values held at some points, range 2, tolerance 1e-6\n");
  const Table table(
    { "vertices", "depth", "held", "hierarchy s", "solve s", "iterations", "largest misfit" });
  PrintAtMost(
    "distance/iterations-of-1000-held", PrintHeld(table, mesh, 7, { 0, 1, 10, 1000 }), 4.0);
  PrintHeld(table, mesh, 7, { 10000 });
  PrintAtMost("distance/iterations-of-100000-held",
    PrintHeld(table, testing::SubdivideInPlane(mesh), 9, { 0, 100000 }), 4.0);
}

} // namespace

/// Parts: times, errors, held.
int main(int argc, char** argv)
{
  const Parts parts(argc, argv);
  if (parts.Want("times"))
  {
    PrintTimes();
  }
  if (parts.Want("errors"))
  {
    PrintErrors();
  }
  if (parts.Want("held"))
  {
    PrintHeld();
  }
  return 0;
}
