// Solves one screened Poisson equation, or the spectrum, on the ranks of the program, and in one
// process by Core alone. Or counts the messages between the ranks in one cycle. Prints one row of a
// table: run it once for each number of ranks. `peers` is `hats` and the same system by algebraic
// multigrid on the same ranks and with the same owners.
//
//   mpiexec -n N BenchmarkRanks poisson|spectrum|hats|hat_spectrum|peers|messages MESH DEPTH [core]
//
// MESH is a file or torus:N. The first rank reads the file and sends each rank its part. Every rank
// makes its own share of the N x N / 4 quadrilaterals of the torus, so no rank holds the whole.
#include "Base/Parallel.h"
#include "Equations/Poisson.h"
#include "Parallel/RankSurface.h"
#include "Peers/AlgebraicMultigrid.h"
#include "Peers/DistributedAmg.h"
#include "Spectrum/Spectrum.h"
#include "Support/Meshes.h"

#include <sys/resource.h>

#include <chrono>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <string>

using namespace gridfem;

namespace
{

/// The messages that this rank has sent.
struct Traffic
{
  double messages = 0.0;
  double bytes = 0.0;
  double sums = 0.0; // of numbers of all ranks
  double sumBytes = 0.0;
};

Traffic traffic;

double BytesOf(int count, MPI_Datatype type)
{
  int size = 0;
  MPI_Type_size(type, &size);
  return double(count) * double(size);
}

} // namespace

/// MPI's interface for profiling: these functions replace the functions of the library.
extern "C" int MPI_Isend(const void* buffer, int count, MPI_Datatype type, int rank, int tag,
  MPI_Comm ranks, MPI_Request* request)
{
  traffic.messages += 1.0;
  traffic.bytes += BytesOf(count, type);
  return PMPI_Isend(buffer, count, type, rank, tag, ranks, request);
}

extern "C" int MPI_Allreduce(
  const void* sent, void* received, int count, MPI_Datatype type, MPI_Op operation, MPI_Comm ranks)
{
  traffic.sums += 1.0;
  traffic.sumBytes += BytesOf(count, type);
  return PMPI_Allreduce(sent, received, count, type, operation, ranks);
}

namespace
{

constexpr double Weight = 0.01; // for a surface whose longest side is 1
constexpr double Tolerance = 1e-8;
constexpr int Modes = 20;

/// Rows first .. last of a torus of `along` rows.
TriangleMesh TorusRows(Id along, Id first, Id last)
{
  constexpr double Turn = 6.283185307179586;
  const Id around = along / 4;
  TriangleMesh mesh;
  const auto point = [&](Id row, Id k)
  {
    const double u = Turn * double(row % along) / double(along);
    const double v = Turn * double(k) / double(around);
    const double radius = 1.0 + 0.4 * std::cos(v) * (1.0 + 0.1 * std::sin(40.0 * u));
    return Vec3(radius * std::cos(u), radius * std::sin(u), 0.4 * std::sin(v));
  };
  for (Id row = first; row <= last; ++row)
  {
    for (Id k = 0; k < around; ++k)
    {
      mesh.points.push_back(point(row, k));
    }
  }
  for (Id row = 0; row < last - first; ++row)
  {
    for (Id k = 0; k < around; ++k)
    {
      const Id next = (k + 1) % around;
      const Id a = row * around;
      const Id b = (row + 1) * around;
      mesh.triangles.push_back({ a + k, b + k, b + next });
      mesh.triangles.push_back({ a + k, b + next, a + next });
    }
  }
  return mesh;
}

TriangleMesh OwnPart(const Communicator& ranks, const std::string& name)
{
  if (name.rfind("torus:", 0) == 0)
  {
    const Id along = std::atoll(name.c_str() + 6);
    return TorusRows(
      along, along * ranks.Rank() / ranks.Size(), along * (ranks.Rank() + 1) / ranks.Size());
  }
  return ranks.Rank() == 0 ? testing::ReadMesh(name) : TriangleMesh();
}

MultiVector WaveAt(const std::vector<Vec3>& points)
{
  MultiVector values(static_cast<Id>(points.size()), 1);
  for (std::size_t k = 0; k < points.size(); ++k)
  {
    values(static_cast<Id>(k), 0) = std::sin(9.0 * points[k][0]) * std::cos(7.0 * points[k][1]);
  }
  return values;
}

double PeakMegabytes()
{
  rusage usage{};
  getrusage(RUSAGE_SELF, &usage);
  return double(usage.ru_maxrss) / 1024.0;
}

class Stopwatch
{
public:
  double Seconds() const
  {
    return std::chrono::duration<double>(std::chrono::steady_clock::now() - begin_).count();
  }

private:
  std::chrono::steady_clock::time_point begin_ = std::chrono::steady_clock::now();
};

struct Measured
{
  double before; // memory with the mesh alone
  double setUp;
  double solve;
  Id functions;
  int iterations;
  bool converged;
};

template<class Result>
void Take(const Result& result, Measured& measured)
{
  measured.iterations = result.iterations;
  measured.converged = result.converged;
}

SpectrumOptions ModesOptions(int threads)
{
  SpectrumOptions options;
  options.numberOfModes = Modes;
  options.multigrid.threads = threads;
  return options;
}

RankSpaceOptions SurfaceOptions(int depth, int threads)
{
  RankSpaceOptions options;
  options.space.functions.depth = depth;
  options.space.functions.threads = threads;
  return options;
}

PoissonOptions EquationOn(const SurfaceSpace& space, int threads)
{
  PoissonOptions options;
  const double cell = 1.0 / space.Extent();
  options.screeningWeight = Weight * cell * cell;
  options.solve.tolerance = Tolerance;
  options.multigrid.threads = threads;
  return options;
}

struct Problem
{
  bool isSpectrum;
  bool hasHats; // above the grid
};

/// From the load on, with the values at points.
void Solve(const SurfaceSpace& space, const MultiVector& load, const Problem& problem, int threads,
  Measured& measured)
{
  const Stopwatch solve;
  if (problem.isSpectrum)
  {
    const Spectrum spectrum = ComputeSpectrum(space, ModesOptions(threads));
    space.ValuesAtPoints(spectrum.vectors);
    Take(spectrum, measured);
  }
  else
  {
    const PoissonOptions poisson = EquationOn(space, threads);
    const Multigrid multigrid =
      BuildMultigrid(space, poisson.screeningWeight, 1.0, poisson.multigrid);
    const PoissonSolution solution = SolvePoisson(space, multigrid, load, MultiVector(), poisson);
    space.ValuesAtPoints(solution.coefficients);
    Take(solution.report, measured);
  }
  measured.solve = solve.Seconds();
  measured.functions = space.NumberOfFunctions(0);
}

Measured OnRanks(
  const Communicator& ranks, const std::string& name, int depth, const Problem& problem)
{
  const TriangleMesh own = OwnPart(ranks, name);
  Measured measured{ PeakMegabytes(), 0.0, 0.0, 0, 0, false };
  const Stopwatch setUp;
  const int threads = std::max(1, NumberOfThreads(0) / ranks.RanksOfMachine());
  const RankSurface surface(ranks, own, SurfaceOptions(depth, threads), problem.hasHats);
  const RankLevels& levels = surface.Levels();
  const MultiVector load = levels.LoadOfValues({ FieldAssociation::Points, WaveAt(own.points) });
  measured.setUp = setUp.Seconds();
  Solve(levels, load, problem, threads, measured);
  return measured;
}

/// The contributions to λM + L of the hats from the triangles that a rank integrates.
benchmarks::SymmetricMatrix OwnCotangents(
  const RankLevels& levels, double lambda, std::vector<int>& number)
{
  TriangleMesh mesh = levels.Space().Own().Mesh();
  const std::vector<double>& isIntegrated = levels.Hats()->IsIntegrated();
  std::size_t kept = 0;
  for (std::size_t t = 0; t < mesh.triangles.size(); ++t)
  {
    if (isIntegrated[t] > 0.0)
    {
      mesh.triangles[kept++] = mesh.triangles[t];
    }
  }
  mesh.triangles.resize(kept);
  const benchmarks::CotangentSystem system = benchmarks::AssembleCotangents(mesh);
  const std::vector<Index>& hatOf = levels.Hats()->Own().Hats().functions.ofPoint;
  number.resize(static_cast<std::size_t>(system.mass.rows()));
  for (std::size_t point = 0; point < system.row.size(); ++point)
  {
    if (system.row[point] >= 0)
    {
      number[static_cast<std::size_t>(system.row[point])] =
        static_cast<int>(levels.Numbering(0).number[static_cast<std::size_t>(hatOf[point])]);
    }
  }
  return benchmarks::Combine(system, lambda);
}

void PrintPeer(const Communicator& ranks, const char* peer, double setUp, double solve,
  int iterations, double difference)
{
  if (ranks.Rank() == 0)
  {
    std::printf("| %s | %d | %d | %.2f | %.2f | %.2f | %.1e |\n", peer, ranks.Size(), iterations,
      setUp, solve, setUp + solve, difference);
  }
}

/// Our time is from the rank's triangles to its rows of the solution. The peers start from the
/// triangles and owners that ours has found, so they send no triangles and number nothing.
void PrintPeers(const Communicator& ranks, const std::string& name, int depth)
{
  const TriangleMesh own = OwnPart(ranks, name);
  const benchmarks::MessagePassing petsc;
  const Stopwatch begin;
  const RankSurface surface(ranks, own, SurfaceOptions(depth, 1), true);
  const RankLevels& levels = surface.Levels();
  const PoissonOptions poisson = EquationOn(levels, 1);
  const Multigrid multigrid =
    BuildMultigrid(levels, poisson.screeningWeight, 1.0, poisson.multigrid);
  const double setUp = begin.Seconds();
  const MultiVector load = levels.LoadOfValues({ FieldAssociation::Points, WaveAt(own.points) });
  const Stopwatch solve;
  const PoissonSolution solution = SolvePoisson(levels, multigrid, load, MultiVector(), poisson);
  PrintPeer(ranks, "ours", setUp, solve.Seconds(), solution.report.iterations, 0.0);

  const auto rows = levels.Numbering(0).OwnFunctions();
  const Eigen::VectorXd ours = solution.coefficients.col(0).tail(rows);
  const double unit = levels.UnitLength();
  for (const auto cycle :
    { benchmarks::DistributedCycle::Gamg, benchmarks::DistributedCycle::BoomerAmg })
  {
    const Stopwatch peerBegin;
    std::vector<int> number;
    const benchmarks::SymmetricMatrix part =
      OwnCotangents(levels, poisson.screeningWeight / (unit * unit), number);
    const auto peer = benchmarks::MakeDistributedAmg(
      ranks.Handle(), { part, number, static_cast<int>(rows) }, cycle);
    const double peerSetUp = peerBegin.Seconds();
    const Stopwatch peerSolve;
    const Eigen::VectorXd values =
      peer->Solve(poisson.screeningWeight * load.col(0).tail(rows), Tolerance);
    const double seconds = peerSolve.Seconds();
    const double difference =
      rows > 0 ? (values - ours).cwiseAbs().maxCoeff<Eigen::PropagateNaN>() : 0.0;
    double most[] = { std::isnan(difference) ? HUGE_VAL : difference, // MPI may drop NaN
      rows > 0 ? ours.cwiseAbs().maxCoeff<Eigen::PropagateNaN>() : 0.0 };
    ranks.Maximum(most, 2);
    PrintPeer(ranks, cycle == benchmarks::DistributedCycle::Gamg ? "PETSc GAMG" : "hypre BoomerAMG",
      peerSetUp, seconds, peer->Iterations(), most[0] / most[1]);
  }
}

/// One cycle of one column in double precision; the most that a rank sends.
void PrintMessages(const Communicator& ranks, const std::string& name, int depth, CycleType cycle)
{
  const RankSpace space(ranks, OwnPart(ranks, name), SurfaceOptions(depth, 1));
  const RankLevels levels(space);
  PoissonOptions poisson = EquationOn(levels, 1);
  poisson.multigrid.cycle = cycle;
  const Multigrid multigrid =
    BuildMultigrid(levels, poisson.screeningWeight, 1.0, poisson.multigrid);
  const MultiVector b = MultiVector::Ones(multigrid.Matrix().rows, 1);
  MultiVector x;
  traffic = {};
  multigrid.Precondition(b, x);
  double most[] = { traffic.messages, traffic.bytes, traffic.sums, traffic.sumBytes };
  ranks.Maximum(most, 4);
  std::size_t distributed = 0;
  while (distributed < levels.NumberOfLevels() && levels.Distributed(distributed))
  {
    ++distributed;
  }
  if (ranks.Rank() == 0)
  {
    const double functions = double(space.Numberings().front().total);
    std::printf("| %s | %s | %d | %.0f | %zu | %.0f | %.0f | %.0f | %.0f | %.0f |\n", name.c_str(),
      cycle == CycleType::W ? "W" : "V", ranks.Size(), functions, distributed, most[0],
      most[1] / 1e3, most[2], most[3] / 1e3, most[1] / std::sqrt(functions / ranks.Size()));
  }
}

Measured OnCore(const std::string& name, int depth, const Problem& problem)
{
  TriangleMesh mesh = OwnPart(Communicator(MPI_COMM_SELF), name);
  Measured measured{ PeakMegabytes(), 0.0, 0.0, 0, 0, false };
  const Field f{ FieldAssociation::Points, WaveAt(mesh.points) };
  const Stopwatch setUp;
  GridSpaceOptions options;
  options.functions.depth = depth;
  std::unique_ptr<const FiniteElementSpace> space;
  if (problem.hasHats)
  {
    space = std::make_unique<HatSpace>(BuildHatSpace(std::move(mesh), options));
  }
  else
  {
    space = std::make_unique<GridSpace>(BuildGridSpace(std::move(mesh), options));
  }
  const MultiVector load = space->LoadOfValues(f);
  measured.setUp = setUp.Seconds();
  Solve(*space, load, problem, 0, measured);
  return measured;
}

} // namespace

int main(int argc, char** argv)
{
  if (argc < 4)
  {
    std::fprintf(stderr,
      "Usage: mpiexec -n N BenchmarkRanks "
      "poisson|spectrum|hats|hat_spectrum|peers|messages MESH|torus:N DEPTH [core]\n");
    return 2;
  }
  MPI_Init(&argc, &argv);
  try
  {
    const Communicator ranks(MPI_COMM_WORLD);
    const std::string name = argv[1];
    const Problem problem{ name == "spectrum" || name == "hat_spectrum",
      name == "hats" || name == "hat_spectrum" };
    const int depth = std::atoi(argv[3]);
    if (name == "peers")
    {
      PrintPeers(ranks, argv[2], depth);
      return MPI_Finalize();
    }
    if (name == "messages")
    {
      PrintMessages(ranks, argv[2], depth, CycleType::V);
      PrintMessages(ranks, argv[2], depth, CycleType::W);
      return MPI_Finalize();
    }
    const bool isCore = argc > 4;
    const Measured measured =
      isCore ? OnCore(argv[2], depth, problem) : OnRanks(ranks, argv[2], depth, problem);
    double peak = PeakMegabytes();
    ranks.Maximum(&peak, 1);
    if (ranks.Rank() == 0)
    {
      std::printf("| %s of %s | %d | %s | %lld | %d%s | %.2f | %.2f | %.0f | %.0f |\n", argv[1],
        argv[2], depth,
        isCore ? NumberOfThreads(0) > 1 ? "Core" : "Core, one thread"
               : std::to_string(ranks.Size()).c_str(),
        static_cast<long long>(measured.functions), measured.iterations,
        measured.converged ? "" : " (not converged)", measured.setUp, measured.solve,
        measured.before, peak);
    }
  }
  catch (const std::exception& error)
  {
    std::fprintf(stderr, "%s\n", error.what());
    MPI_Abort(MPI_COMM_WORLD, 1); // others may wait for this rank
  }
  return MPI_Finalize();
}
