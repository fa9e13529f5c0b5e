// The lowest eigenpairs: seconds and memory against shift-invert on hat functions, and their errors
// where the truth is known.
#include "Largest.h"
#include "Measure.h"
#include "Meshes.h"
#include "SetupCost.h"
#include "SpectrumJobs.h"

#include <algorithm>
#include <cctype>
#include <cmath>
#include <cstdio>
#include <random>
#include <stdexcept>

namespace
{

using namespace gridfem;
using namespace gridfem::benchmarks;

constexpr double Pi = 3.14159265358979323846;
constexpr int Threads = 2;

void PrintJob(const Table& table, const std::string& name, const SpectrumJob& job)
{
  if (job.isStopped)
  {
    table.Row({ name, "", "stopped", "", "", Text("> %.0f", job.seconds),
      Text("> %.0f", 1e-6 * job.peak), "" });
    return;
  }
  table.Row({ name, Text("%.0f", job.unknowns), Text("%.0f", job.converged),
    Text("%.0f", job.steps), Text("%.2f", job.setup), Text("%.2f", job.seconds),
    Text("%.0f", 1e-6 * job.peak), Text("%.6g", job.eigenvalues.back()) });
}

/// Seconds of a job that gave all it was asked for; infinite else.
double SecondsIfAll(const SpectrumJob& job, int modes)
{
  return job.converged >= modes ? job.seconds : HUGE_VAL;
}

struct Peer
{
  std::string name;
  HatEigensolver solver;
};
const Peer Spectra{ "Spectra", SpectraSpectrum };
const Peer Slepc{ "SLEPc", SlepcSpectrum };

struct Contest
{
  std::string name;
  NamedMesh mesh;
  int depth;
  int modes;
  double speedBound;
  std::vector<Peer> peers{ Spectra, Slepc };
  double limit = HUGE_VAL; // of the peers, in units of our time
  double memoryBound = HUGE_VAL;
};

std::string LowerCase(std::string text)
{
  std::transform(
    text.begin(), text.end(), text.begin(), [](unsigned char c) { return std::tolower(c); });
  return text;
}

void RunContest(const Contest& contest)
{
  const TriangleMesh& mesh = contest.mesh.mesh;
  std::printf(
    "\n%d pairs of %s, %zu vertices, depth %d, from the triangles to values at the vertices\n",
    contest.modes, contest.mesh.name.c_str(), mesh.points.size(), contest.depth);
  const Table table({ "method", "unknowns", "converged", "steps or solves", "s set-up", "s",
    "MB peak", "last eigenvalue" });
  const SpectrumJob grid = GridSpectrum(mesh, contest.depth, contest.modes, Threads);
  PrintJob(table, "grid, 2 threads", grid);
  std::vector<SpectrumJob> jobs;
  for (const Peer& peer : contest.peers)
  {
    jobs.push_back(ShiftInvertSpectrum(
      peer.solver, mesh, contest.modes, Threads, PairTolerance, contest.limit * grid.seconds));
    PrintJob(table, peer.name + " and CHOLMOD, 2 threads", jobs.back());
  }
  double peak = HUGE_VAL;
  for (std::size_t k = 0; k < jobs.size(); ++k)
  {
    if (jobs[k].isStopped)
    {
      std::printf(
        "%s was stopped: its time and memory are at least these.\n", contest.peers[k].name.c_str());
    }
    PrintAtLeast(LowerCase(contest.peers[k].name) + "_seconds_over_grid_" + contest.name,
      jobs[k].seconds / SecondsIfAll(grid, contest.modes), contest.speedBound);
    peak = std::min(peak, jobs[k].peak);
  }
  if (contest.memoryBound < HUGE_VAL)
  {
    PrintAtMost(
      "peak_memory_over_shift_invert_" + contest.name, grid.peak / peak, contest.memoryBound);
  }
}

/// Largest relative difference of the eigenvalues 2 .. `count`.
double LargestError(
  const std::vector<double>& values, const std::vector<double>& exact, std::size_t count)
{
  double error = 0.0;
  for (std::size_t k = 1; k < std::min({ count, values.size(), exact.size() }); ++k)
  {
    error = gridfem::testing::Larger(error, std::abs(values[k] / exact[k] - 1.0));
  }
  return values.size() < count ? HUGE_VAL : error;
}

void RunSphere()
{
  std::printf("\nEigenvalues 2 to 100 of the unit sphere against l (l + 1), largest error\n");
  const TriangleMesh sphere = testing::GeodesicSphere(160);
  for (const auto& [depth, bound] :
    { std::pair{ 5, 0.015 }, std::pair{ 6, 0.004 }, std::pair{ 7, 0.0012 } })
  {
    const SpectrumJob job = GridSpectrum(sphere, depth, 100, Threads);
    PrintAtMost("sphere_eigenvalues_error_depth" + std::to_string(depth),
      LargestError(job.eigenvalues, SphereEigenvalues(100), 100), bound);
  }
}

/// A direction on the sphere, an angle and a shift, the same in every run.
TriangleMesh RandomlyMoved(const TriangleMesh& mesh, std::mt19937& generator)
{
  const auto number = [&] { return 2.0 * double(generator()) / double(std::mt19937::max()) - 1.0; };
  const double z = number();
  const double longitude = Pi * number();
  const double r = std::sqrt(1.0 - z * z);
  const double angle = Pi * number();
  return testing::Transform(mesh, { r * std::cos(longitude), r * std::sin(longitude), z }, angle,
    1.0, { number(), number(), number() });
}

/// (largest - smallest) / mean over ten rigid motions, the worst of the first eigenvalues.
void RunRigidMotions(const NamedMesh& mesh)
{
  constexpr int Motions = 10;
  constexpr int Modes = 100;
  constexpr int Depth = 7;
  std::mt19937 generator(1);
  std::vector<std::vector<double>> spectra;
  for (int k = 0; k < Motions; ++k)
  {
    spectra.push_back(
      GridSpectrum(RandomlyMoved(mesh.mesh, generator), Depth, Modes, Threads).eigenvalues);
  }
  double spread50 = 0.0;
  double spread100 = 0.0;
  for (int mode = 1; mode < Modes; ++mode)
  {
    double low = HUGE_VAL;
    double high = 0.0;
    for (const std::vector<double>& spectrum : spectra)
    {
      low = std::min(low, spectrum.at(mode));
      high = gridfem::testing::Larger(high, spectrum.at(mode));
    }
    const double spread = 2.0 * (high - low) / (high + low);
    spread50 = mode < 50 ? gridfem::testing::Larger(spread50, spread) : spread50;
    spread100 = gridfem::testing::Larger(spread100, spread);
  }
  std::printf("\n%s, ten rigid motions, depth %d\n", mesh.name.c_str(), Depth);
  std::string name = mesh.name;
  std::replace(name.begin(), name.end(), ' ', '_');
  PrintAtMost("rigid_motions_spread_first_50_" + name, spread50, 0.005);
  PrintAtMost("rigid_motions_spread_first_100_" + name, spread100, 0.015);
}

/// The pulley with walls 1.5 cells thick at depth 5: its longest side is 2.
TriangleMesh ThinPulley()
{
  return testing::Pulley(160, 1.5 * 2.0 / 32.0);
}

void RunThinWalls()
{
  constexpr int Modes = 50;
  constexpr double Accuracy = 0.02;
  const TriangleMesh pulley = ThinPulley();
  TriangleMesh fine = pulley;
  while (fine.points.size() < 200000)
  {
    fine = testing::SubdivideInPlane(fine);
  }
  const std::vector<double> truth =
    ShiftInvertSpectrum(SlepcSpectrum, fine, Modes, Threads, TruthTolerance).eigenvalues;
  std::printf("\nPulley with walls 1.5 cells thick at depth 5, eigenvalues 2 to %d, largest error "
              "against hat functions on %zu vertices\n",
    Modes, fine.points.size());
  const Table table({ "depth", "plain", "connectivity-aware" });
  int plainDepth = 0;
  int awareDepth = 0;
  for (const int depth : { 4, 5, 6, 7, 8 })
  {
    const auto error = [&](FunctionSupport support)
    {
      return LargestError(
        GridSpectrum(pulley, depth, Modes, Threads, support).eigenvalues, truth, Modes);
    };
    const double plain = error(FunctionSupport::Plain);
    const double aware = error(FunctionSupport::ConnectivityAware);
    table.Row({ std::to_string(depth), Text("%.4f", plain), Text("%.4f", aware) });
    plainDepth = plainDepth == 0 && plain <= Accuracy ? depth : plainDepth;
    awareDepth = awareDepth == 0 && aware <= Accuracy ? depth : awareDepth;
    if (plainDepth > 0 && awareDepth > 0)
    {
      break;
    }
  }
  if (awareDepth == 0)
  {
    throw std::runtime_error("No depth of the connectivity-aware functions is accurate enough.");
  }
  constexpr int NextDepth = 9; // the least that the plain functions need if none was enough
  PrintAtLeast("thin_walls_depths_plain_needs_more",
    (plainDepth > 0 ? plainDepth : NextDepth) - awareDepth, 1.0);
}

/// The unit cube with every side face cut into `strips` upright needles per unit and the lids into
/// fans: all triangles are about 1 : strips.
TriangleMesh NeedleCube(int strips)
{
  TriangleMesh mesh;
  const int around = 4 * strips;
  for (const double z : { 0.0, 1.0 })
  {
    for (int k = 0; k < around; ++k)
    {
      const double t = double(k % strips) / strips;
      const std::array<Vec3, 4> side{ Vec3(t, 0, z), Vec3(1, t, z), Vec3(1 - t, 1, z),
        Vec3(0, 1 - t, z) };
      mesh.points.push_back(side[k / strips]);
    }
    mesh.points.push_back(Vec3(0.5, 0.5, z));
  }
  const Id top = around + 1;
  for (Id k = 0; k < around; ++k)
  {
    const Id next = (k + 1) % around;
    mesh.triangles.push_back({ k, next, top + next });
    mesh.triangles.push_back({ k, top + next, top + k });
    mesh.triangles.push_back({ next, k, around });
    mesh.triangles.push_back({ top + k, top + next, top + around });
  }
  return mesh;
}

void RunNeedles()
{
  constexpr int Modes = 100;
  constexpr int Depth = 6;
  const auto tilted = [](const TriangleMesh& mesh) {
    return testing::Transform(mesh, { 1, 2, 3 }, 0.7);
  };
  const TriangleMesh needles = tilted(NeedleCube(1000));
  const TriangleMesh uniform = tilted(testing::Box(60));
  const auto grid = [&](const TriangleMesh& mesh)
  { return GridSpectrum(mesh, Depth, Modes, Threads).eigenvalues; };
  const auto hats = [&](const TriangleMesh& mesh)
  { return ShiftInvertSpectrum(SlepcSpectrum, mesh, Modes, Threads, TruthTolerance).eigenvalues; };
  std::printf(
    "\nCube of needles 1 : 1000 against a uniform mesh of the same cube, eigenvalues 2 to "
    "%d\n",
    Modes);
  const double gridDifference = LargestError(grid(needles), grid(uniform), Modes);
  const double hatDifference = LargestError(hats(needles), hats(uniform), Modes);
  std::printf("Largest difference: grid %.2e, hat functions %.3g\n", gridDifference, hatDifference);
  PrintAtMost("needles_largest_difference_of_eigenvalues", gridDifference, 0.005);
}

} // namespace

/// Arguments: parts of 160704, dragon, thousand, sphere, motions, walls, needles. Only where it is
/// named: thousand-restarted, which gives Spectra the time to fill its basis and to restart, when
/// there are two of them in memory.
int main(int argc, char** argv)
{
  const Parts parts(argc, argv);
  if (parts.Want("160704"))
  {
    RunContest({ "100_pairs_160704", RockerArm(2), 7, 100, 8.0 });
  }
  if (parts.Want("dragon"))
  {
    RunContest({ "100_pairs_dragon", RealMesh("dragon", "dragon_871k.ply"), 8, 100, 10.0 });
  }
  if (parts.Want("thousand"))
  {
    RunContest({ "1000_pairs_160704", RockerArm(2), 7, 1000, 4.0, { Spectra }, 6.0, 0.5 });
  }
  if (parts.IsNamed("thousand-restarted"))
  {
    RunContest(
      { "1000_pairs_160704_restarted", RockerArm(2), 7, 1000, 4.0, { Spectra }, 20.0, 0.5 });
  }
  if (parts.Want("sphere"))
  {
    RunSphere();
  }
  if (parts.Want("motions"))
  {
    RunRigidMotions(RockerArm(0));
    RunRigidMotions({ "pulley", ThinPulley() });
  }
  if (parts.Want("walls"))
  {
    RunThinWalls();
  }
  if (parts.Want("needles"))
  {
    RunNeedles();
  }
}
