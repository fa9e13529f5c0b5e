#include "Solvers/DynamicsStart.h"

#include "Base/Errors.h"
#include "Base/NormalNumbers.h"
#include "Base/Parallel.h"
#include "Equations/HeatDiffusion.h"
#include "Solvers/DynamicsEquation.h"
#include "Solvers/SurfaceFields.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>

namespace gridfem
{
namespace
{

struct SpaceWave
{
  Vec3 vector; // wave vector
  double ofCosine;
  double ofSine;
};

std::vector<SpaceWave> RandomWaves(double wavelength, std::uint64_t seed, std::uint64_t series)
{
  constexpr int Count = 64;
  const NormalNumbers numbers(seed, series);
  std::vector<SpaceWave> waves;
  for (std::uint64_t k = 0; k < Count; ++k)
  {
    const std::array<double, 2> a = numbers.Pair(3 * k);
    const std::array<double, 2> b = numbers.Pair(3 * k + 1);
    const std::array<double, 2> c = numbers.Pair(3 * k + 2);
    const double relative = 0.5 + (double(k) + 0.5) / Count;
    waves.push_back(
      { Vec3(a[0], a[1], b[0]).normalized() * (relative * 2.0 * double(EIGEN_PI) / wavelength),
        c[0] / std::sqrt(double(Count)), c[1] / std::sqrt(double(Count)) });
  }
  return waves;
}

/// Returns two columns of smooth noise at the points of a mesh, with mean 0 and variance 1. Each is
/// a sum of waves in space with random directions and lengths about `wavelength`.
MultiVector SmoothNoise(
  const TriangleMesh& mesh, double wavelength, std::uint64_t seed, const Job& job)
{
  const std::array<std::vector<SpaceWave>, 2> waves = { RandomWaves(wavelength, seed, 0),
    RandomWaves(wavelength, seed, 1) };
  const Vec3 origin = BoundsOf(mesh.points, UsedPoints(mesh, job.threads), job.threads).low;
  MultiVector noise = MultiVector::Zero(static_cast<Id>(mesh.points.size()), 2);
  ParallelRanges(
    noise.rows(), job.threads,
    [&](Id begin, Id end)
    {
      for (Id point = begin; point < end; ++point)
      {
        const Vec3 place = mesh.points[point] - origin;
        for (int c = 0; c < 2; ++c)
        {
          for (const SpaceWave& wave : waves[c])
          {
            const double phase = wave.vector.dot(place);
            noise(point, c) += wave.ofCosine * std::cos(phase) + wave.ofSine * std::sin(phase);
          }
        }
      }
    },
    DefaultBlockSize, job.progress);
  return noise;
}

/// A point that a function reaches.
Id SomePoint(const Surface& surface, std::uint64_t seed)
{
  const std::vector<char> isReached = surface.PointsWithFunctions();
  std::vector<Id> reached;
  for (std::size_t point = 0; point < isReached.size(); ++point)
  {
    if (isReached[point])
    {
      reached.push_back(static_cast<Id>(point));
    }
  }
  return reached[NormalNumbers::Mixed(seed) % reached.size()];
}

/// Lets heat spread from points along the surface, and scales it to a largest value of 1. The heat
/// of one point is half as high at the distance width / 2.
/// @param report  gets the report of the heat
Eigen::VectorXd BumpAround(const Surface& surface, const std::vector<Id>& points, double width,
  SolveReport& report, const Job& job)
{
  if (points.empty())
  {
    throw InvalidInput("The selection has no point of a polygon, so it disturbs nothing.");
  }
  const SurfaceSpace& space = surface.Space();
  Field marked;
  marked.values.setZero(static_cast<Id>(surface.Mesh().points.size()), 1);
  for (const Id point : points)
  {
    marked.values(point, 0) = 1.0;
  }
  DiffusionOptions options{ EndedByTolerance(ToleranceOfSteps) };
  options.multigrid.threads = job.threads;
  options.timeStep = std::pow(width / space.UnitLength(), 2) / (16.0 * std::log(2.0));
  HeatDiffusion heat(std::make_shared<const HeatEquation>(
                       surface.SharedSpace(), options, HeldRows{}, job.Part(0.0, 0.5)),
    space.LoadOfValues(marked, job));
  report = heat.Advance(job.Part(0.5, 1.0));
  const Eigen::VectorXd bump = space.ValuesAtPoints(heat.Coefficients(), job).cwiseMax(0.0);
  const double largest = bump.maxCoeff();
  return largest > 0.0 ? Eigen::VectorXd(bump / largest) : bump;
}

/// The given start at points. Unknowns without a component are at rest.
Field CompletedStart(const Surface& surface, const DynamicsSolver::Input& input,
  const DynamicsSolver::Options& options)
{
  Field field = ReadField(surface, input.start);
  const Id given = field.values.cols();
  const std::vector<double> rest = IsReaction(options.model)
                                     ? SystemOf(options, input.reactions).rest
                                     : std::vector<double>(2, 0.0);
  field.values.conservativeResize(Eigen::NoChange, NumberOfUnknowns(options, input.reactions));
  for (Id c = given; c < field.values.cols(); ++c)
  {
    field.values.col(c).setConstant(rest[static_cast<std::size_t>(c)]);
  }
  return field;
}

/// The system at rest where the bump is 0, and disturbed where it is 1. A wave has height 1.
void Disturb(const Eigen::VectorXd& bump, const DynamicsSolver::Input& input,
  const DynamicsSolver::Options& options, MultiVector& values)
{
  if (!IsReaction(options.model))
  {
    values.col(0) = bump;
    return;
  }
  const ReactionSystem system = SystemOf(options, input.reactions);
  for (Id point = 0; point < values.rows(); ++point)
  {
    system.startOfDisturbance(bump[point], values.row(point).data());
  }
}

} // namespace

Field StartField(const Surface& surface, const DynamicsSolver::Input& input,
  const DynamicsSolver::Options& options, SolveReport& report, const Job& job)
{
  report = SolveReport::Solved();
  if (input.start)
  {
    return CompletedStart(surface, input, options);
  }
  const TriangleMesh& mesh = surface.Mesh();
  const double length = surface.LengthInWorldUnits(options.patternLength);
  const auto seed = static_cast<std::uint64_t>(options.seed);
  Field field;
  field.values.setZero(
    static_cast<Id>(mesh.points.size()), NumberOfUnknowns(options, input.reactions));
  if (input.disturbed)
  {
    Disturb(BumpAround(surface, input.disturbed.find().points, length, report, job), input, options,
      field.values);
    return field;
  }
  if (!IsReaction(options.model))
  {
    Disturb(BumpAround(surface, { SomePoint(surface, seed) }, length, report, job), input, options,
      field.values);
    return field;
  }
  const ReactionSystem system = SystemOf(options, input.reactions);
  // Longer noise could leave the whole surface in one state, without an edge between two states.
  const double wavelength = std::min(length * system.noiseLength, 0.5 * std::sqrt(surface.Area()));
  const MultiVector noise = SmoothNoise(mesh, wavelength, seed, job);
  for (Id point = 0; point < noise.rows(); ++point)
  {
    system.startOfNoise(noise.row(point).data(), field.values.row(point).data());
  }
  return field;
}

} // namespace gridfem
