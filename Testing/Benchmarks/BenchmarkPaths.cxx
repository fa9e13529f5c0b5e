// Shortest paths between points of scans, beside the exact paths of CGAL.
//
// Both are timed from the mesh on, on one thread: the least of three runs, and the mean over the
// sources. One path leads from a source to one target, the next row from a source to ten. CGAL
// builds its tree of windows for all points, whatever the targets are.
#include "Measure.h"
#include "PolyhedralDistances.h"
#include "SetupCost.h"

#include "Largest.h"
#include "Solvers/PathSolver.h"

#include <cmath>
#include <cstdio>
#include <filesystem>
#include <memory>

namespace
{

using namespace gridfem;
using namespace gridfem::benchmarks;

constexpr int Sources = 5;
constexpr int Targets = 10;
constexpr int Runs = 3;

/// Some points that are spread over the numbers of the mesh's points, between 0 and 1.
Id PointAt(const TriangleMesh& mesh, double place)
{
  return static_cast<Id>(place * static_cast<double>(mesh.points.size()));
}

struct PathTimes
{
  double ours = 0.0; // seconds, mean over the sources
  double peers = 0.0;
  double longer = 0.0;   // largest difference of lengths, relative; NaN where one is unknown
  double unproven = 0.0; // paths that may not be the shortest
};

PathTimes Compare(const std::shared_ptr<const TriangleMesh>& mesh, int targets)
{
  SurfaceOptions surface = PathSolver::SurfaceDefaults();
  surface.space.threads = 1;
  PathTimes times;
  for (int k = 0; k < Sources; ++k)
  {
    PathSolver::Input input;
    input.sources.ids = { PointAt(*mesh, (k + 0.5) / Sources) };
    for (int t = 0; t < targets; ++t)
    {
      input.targets.ids.push_back(PointAt(*mesh, (t + 0.25 + 0.1 * k) / Targets));
    }
    PathSolver::Result found;
    times.ours +=
      LeastSeconds(Runs, [&](int) { found = PathSolver::Solve(mesh, input, {}, surface); });
    std::vector<double> exact;
    times.peers += LeastSeconds(Runs,
      [&](int) { exact = PolyhedralDistances(*mesh, input.sources.ids[0], input.targets.ids); });
    for (int t = 0; t < targets; ++t)
    {
      const PathSolver::Path& path = found.paths.at(static_cast<std::size_t>(t));
      const double difference = std::abs(path.path.length / exact.at(t) - 1.0);
      times.longer = testing::Larger(times.longer, difference);
      times.unproven += path.isShortest ? 0.0 : 1.0;
    }
  }
  times.ours /= Sources;
  times.peers /= Sources;
  return times;
}

} // namespace

int main()
{
  const Table table({ "mesh", "triangles", "paths", "ours s", "CGAL s", "CGAL over ours",
    "largest difference", "not proven" });
  for (const char* file : { "rocker_arm.ply", "fandisk_32k.ply", "knot_26k.ply", "genus3_13k.ply",
         "raptor_18k.ply", "neptune_30k.ply", "armadillo_100k.ply" })
  {
    const std::string name = std::filesystem::path(file).stem().string();
    const auto mesh = std::make_shared<const TriangleMesh>(RealMesh(name, file).mesh);
    for (const int targets : { 1, Targets })
    {
      const PathTimes times = Compare(mesh, targets);
      table.Row({ name, std::to_string(mesh->triangles.size()), std::to_string(targets),
        Text("%.3f", times.ours), Text("%.3f", times.peers), Text("%.1f", times.peers / times.ours),
        Text("%.1e", times.longer), Text("%.0f", times.unproven) });
      const std::string which = name + "-" + std::to_string(targets);
      PrintAtLeast("paths/faster-" + which, times.peers / times.ours, 1.0);
      PrintAtMost("paths/difference-" + which, times.longer, 1e-9);
    }
  }
  return 0;
}
