#include "Shape/MeanCurvatureFlow.h"

#include "Algebra/ComponentMeans.h"
#include "Base/Errors.h"
#include "Base/Parallel.h"
#include "Base/VectorRows.h"
#include "Equations/PointConstraints.h"
#include "Krylov/PrecisionFallback.h"
#include "Shape/MovedSurface.h"

#include <cmath>
#include <limits>
#include <string>

namespace gridfem
{
namespace
{

/// Fraction of the start's area below which the rest of the shape is rounding.
constexpr double VanishedArea = 1e-20;

void CheckOptions(const FlowOptions& options)
{
  if (!(options.timeStep > 0.0) || std::isinf(options.timeStep))
  {
    throw InvalidInput(
      "The time step is " + std::to_string(options.timeStep) + "; it must be a positive number.");
  }
  if (options.conformalized && options.rebuild)
  {
    throw InvalidInput("The conformalized flow keeps the stiffness matrix of the start. It cannot "
                       "rebuild the functions in every step.");
  }
}

void CheckBoundary(const FlowOptions& options)
{
  if (!options.fixed.edges.empty() &&
      (options.conformalized || options.rescaling != Rescaling::None))
  {
    throw InvalidInput("A fixed boundary cannot be combined with the conformalized flow or with "
                       "rescaling, because both move the whole surface.");
  }
}

/// Sets x = center + scale (x - center) in each row.
void ScaleAbout(const Vec3& center, double scale, MultiVector& positions, int threads)
{
  ParallelRanges(positions.rows(), threads,
    [&](Id begin, Id end)
    {
      for (Id i = begin; i < end; ++i)
      {
        SetRow(positions, i, center + scale * (RowOf(positions, i) - center));
      }
    });
}

bool IsBroken(const StepSolution& solution)
{
  return solution.report.end == SolveEnd::Breakdown || solution.report.end == SolveEnd::NotFinite ||
         !solution.embedding.allFinite();
}

/// Solves one step. The start is the embedding plus the displacement from the coarser levels. Its
/// distance from the result tells the error.
void SolveStep(const FiniteElementSpace& space, const Multigrid& multigrid, const MultiVector& b,
  const SolveOptions& options, const Projection& project, const Job& job, StepSolution& solution)
{
  const MultiVector before = solution.embedding;
  const LinearOperator A = OperatorOf(multigrid);
  MultiVector rest;
  A.residual(before, b, rest);
  project.residual(rest);
  MultiVector way;
  MultiVector lastStep;
  multigrid.NestedIteration(rest, way, &lastStep);
  project.solution(way);
  if (way.allFinite())
  {
    solution.embedding += way;
  }
  const AccuracyWatch watch(space, solution.embedding, lastStep, 0.0, job.threads);
  solution.report = SolveWithFallback(IterationType::ConjugateGradients, A,
    CycleWithFallback(multigrid), b, solution.embedding, options, project, job.progress);
  // Errors of all coordinates are relative to the length of the displacement, so the orientation of
  // the surface does not matter.
  const Columns squares = space.SquaredNorms(solution.embedding - before, job.threads);
  const Columns length = Columns::Constant(squares.size(), std::sqrt(squares.max(0.0).sum()));
  solution.accuracy = watch.Result(solution.embedding, length,
    Eigen::RowVectorXd::Constant(squares.size(), 1.0 / space.UnitLength()), ErrorOrder::Observed);
}

/// A step that was not made.
FlowStep Stopped(FlowEnd end)
{
  FlowStep step;
  step.end = end;
  return step;
}

FlowStep Describe(const SurfaceSize& size)
{
  FlowStep step;
  step.area = size.area;
  step.volume = size.volume;
  step.sphericity = size.Sphericity();
  return step;
}

} // namespace

MeanCurvatureFlow::MeanCurvatureFlow(std::shared_ptr<const FiniteElementSpace> space,
  std::shared_ptr<const TriangleMesh> mesh, FlowOptions options)
  : start_(std::move(space)), mesh_(std::move(mesh)), options_(std::move(options)),
    moves_(start_->PointsWithFunctions())
{
  CheckOptions(options_);
  CheckBoundary(options_);
  for (const Id point : options_.fixed.points)
  {
    moves_.at(point) = 0;
  }
  const int threads = options_.multigrid.threads;
  oriented_ = Orient(*mesh_, true, threads);
  const SurfaceSize size = this->Size(mesh_->points, threads);
  startArea_ = size.area;
  startVolume_ = size.volume;
  if (options_.rescaling == Rescaling::ConstantVolume &&
      !(std::abs(startVolume_) > 1e-9 * std::pow(startArea_, 1.5)))
  {
    throw InvalidInput("The surface encloses no volume, so its volume cannot be kept constant.");
  }
  this->GoToStart();
}

void MeanCurvatureFlow::GoToStart()
{
  step_ = 0;
  shape_ = MultiVector();
}

void MeanCurvatureFlow::GoTo(int step, MultiVector shape)
{
  step_ = step;
  shape_ = std::move(shape);
}

/// Points that a new space has lost, because their triangles have no area left, stay where they
/// are.
std::vector<Vec3> MeanCurvatureFlow::WorldPoints(
  const FiniteElementSpace& space, const MultiVector& embedding, const Job& job) const
{
  const MultiVector position = space.ValuesAtPoints(embedding, job);
  const bool isNew = options_.rebuild != nullptr;
  const std::vector<char> isReached = isNew ? space.PointsWithFunctions() : std::vector<char>();
  std::vector<Vec3> points = isNew ? this->Points(job) : mesh_->points;
  ParallelRanges(static_cast<Id>(points.size()), job.threads,
    [&](Id begin, Id end)
    {
      for (Id k = begin; k < end; ++k)
      {
        if (moves_[k] && (!isNew || isReached[k]))
        {
          points[k] = space.Origin() + space.UnitLength() * RowOf(position, k);
        }
      }
    });
  return points;
}

std::vector<Vec3> MeanCurvatureFlow::Points(const Job& job) const
{
  if (step_ == 0)
  {
    return mesh_->points;
  }
  if (!options_.rebuild)
  {
    return this->WorldPoints(*start_, shape_, job);
  }
  std::vector<Vec3> points(mesh_->points.size());
  for (Id k = 0; k < shape_.rows(); ++k)
  {
    points[k] = moves_[k] ? Vec3(start_->Origin() + start_->UnitLength() * RowOf(shape_, k))
                          : mesh_->points[k];
  }
  return points;
}

/// Prepares functions and metric for the next step. moving_ stays empty if no new functions can be
/// made.
/// @return  number of singular samples
Id MeanCurvatureFlow::Prepare(MultiVector& embedding, const Job& job)
{
  if (options_.rebuild)
  {
    multigrid_.reset(); // frees their memory first
    boundary_.reset();
    moving_.reset();
    mass_ = {};
  }
  if (step_ == 0)
  {
    moving_ = start_->Copy(); // its own metric, because the metric of its embedding is rounded
    embedding = moving_->EmbeddingOfMesh(job);
    return 0;
  }
  if (options_.rebuild)
  {
    try
    {
      moving_ = options_.rebuild({ this->Points(job), mesh_->triangles }, job);
    }
    catch (const InvalidInput&)
    {
      return 0;
    }
    embedding = moving_->EmbeddingOfMesh(job);
    return 0;
  }
  if (!moving_)
  {
    moving_ = start_->Copy();
  }
  embedding = shape_;
  return moving_->SetMetric(
    embedding, job, options_.conformalized ? ElementParts::Mass : ElementParts::Both);
}

void MeanCurvatureFlow::FillMatrix(
  std::size_t level, double timeStep, SparseMatrix& matrix, const Job& job)
{
  moving_->FillMatrix(level, 1.0, timeStep, matrix, job);
  if (boundary_)
  {
    boundary_->Penalty().AddTo(level, 1.0, matrix, job.threads);
  }
}

void MeanCurvatureFlow::UpdateBoundary(double timeStep, int threads)
{
  if (!boundary_ && !options_.fixed.edges.empty())
  {
    boundary_ =
      std::make_unique<HeldBoundary>(*moving_, *mesh_, options_.fixed.edges, timeStep, threads);
  }
}

void MeanCurvatureFlow::UpdateHierarchy(double timeStep, const Job& job)
{
  if (!multigrid_)
  {
    std::vector<MultigridLevel> levels = BuildMultigridLevels(
      *moving_, 1.0, timeStep, options_.multigrid, job.progress.Part(0.0, 0.5));
    for (std::size_t level = 0; boundary_ && level < levels.size(); ++level)
    {
      this->FillMatrix(level, timeStep, levels[level].A, job.threads);
    }
    multigrid_ = std::make_unique<Multigrid>(std::move(levels), options_.multigrid);
    job.Check(1.0);
    return;
  }
  try
  {
    multigrid_->Update([&](std::size_t level, SparseMatrix& matrix)
      { this->FillMatrix(level, timeStep, matrix, job.threads); });
  }
  catch (...)
  {
    multigrid_.reset(); // half of it is new
    throw;
  }
}

/// Solves (M + δL) X⁺ = M X, with the terms of a fixed boundary if there is one. Otherwise
/// constants keep their means. The constants are left out in both cases, so that the tolerance
/// applies to the shape and not to its distance from the origin.
StepSolution MeanCurvatureFlow::Solve(const MultiVector& embedding, const Job& job) const
{
  const Components components = moving_->ComponentsOf(0, job.threads);
  const ComponentMeans means(
    components.ofFunction, moving_->Integrals(), components.count, job.threads);
  std::vector<char> isHeld(components.count, 0);
  if (boundary_)
  {
    isHeld = HeldComponents(*moving_, 0.0, boundary_->Penalty().Rows(), components);
  }
  const Projection project{ [&](MultiVector& x)
    { means.AddConstants(-MeansOfFree(isHeld, means.OfFunction(x)), x); },
    [&](MultiVector& b)
    { means.SubtractIntegrals(MeansOfFree(isHeld, means.OfIntegrals(b)), b); } };

  const MultiVector mean = means.OfFunction(embedding);
  StepSolution solution;
  solution.embedding = embedding;
  means.AddConstants(-mean, solution.embedding);
  MultiVector b;
  Multiply(mass_, solution.embedding, b, job.threads);
  if (boundary_)
  {
    b += boundary_->Load(
      this->Points(job.threads), mesh_->triangles, embedding - solution.embedding, job.threads);
  }
  project.residual(b);
  // A coordinate is constant if the surface lies in a plane of the grid. Only functions that vanish
  // on the surface are then left of it, and no iteration could solve for them.
  constexpr double Rounding = 1e-12; // of the size of the surface
  const Columns squares = moving_->SquaredNorms(solution.embedding, job.threads).max(0.0);
  for (Id c = 0; c < b.cols(); ++c)
  {
    if (squares[c] <= Rounding * Rounding * squares.sum())
    {
      solution.embedding.col(c).setZero();
      b.col(c).setZero();
    }
  }
  SolveStep(*moving_, *multigrid_, b, options_.solve, project, job, solution);
  means.AddConstants(mean, solution.embedding);
  return solution;
}

/// The factor that keeps the area or the volume; none if the volume is lost.
std::optional<double> MeanCurvatureFlow::ScaleOf(double area, double volume) const
{
  switch (options_.rescaling)
  {
    case Rescaling::ConstantArea:
      return std::sqrt(startArea_ / area);
    case Rescaling::ConstantVolume:
      return volume / startVolume_ > 1e-30 ? std::make_optional(std::cbrt(startVolume_ / volume))
                                           : std::nullopt;
    case Rescaling::None:
      break;
  }
  return 1.0;
}

SurfaceSize MeanCurvatureFlow::Size(const std::vector<Vec3>& points, int threads) const
{
  return SizeOf(points, oriented_.TrianglesOf(*mesh_), threads);
}

FlowStep MeanCurvatureFlow::Start(const Job& job) const
{
  FlowStep start = Describe(this->Size(mesh_->points, job.threads));
  start.accuracy.discretization = 0.0; // the start is the input
  start.accuracy.largest = 0.0;
  start.accuracy.isTrusted = true;
  return start;
}

FlowStep MeanCurvatureFlow::Advance(const Job& job)
{
  MultiVector embedding;
  job.Check(0.0);
  const Id lockedSamples = this->Prepare(embedding, job.Part(0.0, 0.3));
  if (!moving_)
  {
    return Stopped(FlowEnd::Unfit);
  }
  const double timeStep =
    options_.timeStep * std::pow(start_->UnitLength() / moving_->UnitLength(), 2);
  moving_->FillMatrix(0, 1.0, 0.0, mass_, job.threads);
  this->UpdateBoundary(timeStep, job.threads);
  this->UpdateHierarchy(timeStep, job.Part(0.3, 0.6));
  job.Check(0.6);
  StepSolution solution = this->Solve(embedding, job.Part(0.6, 1.0));
  std::vector<Vec3> points;
  FlowStep done = this->Rescale(embedding, solution, points, job.threads);
  if (done.end != FlowEnd::None)
  {
    return done;
  }
  job.Check(1.0);

  this->Keep(points, std::move(solution.embedding));
  done.step = ++step_;
  done.time = step_ * options_.timeStep;
  done.iterations = solution.report.iterations;
  done.where = solution.report.where;
  done.lockedSamples = lockedSamples;
  done.converged = solution.report.converged;
  done.accuracy = solution.accuracy;
  return done;
}

/// Judges the shape that a step leads to, and rescales it if the options ask for it.
/// @param before  the embedding before the step
/// @param points  receives the places of the mesh's points
FlowStep MeanCurvatureFlow::Rescale(
  const MultiVector& before, StepSolution& solution, std::vector<Vec3>& points, int threads) const
{
  if (IsBroken(solution))
  {
    return Stopped(FlowEnd::Breakdown);
  }
  const auto place = [&](const MultiVector& embedding)
  {
    points = this->WorldPoints(*moving_, embedding, threads);
    return this->Size(points, threads);
  };
  // Every step of the flow reduces the area. A step that has not converged and adds area is
  // invalid.
  const bool mayGrow = solution.report.converged || options_.conformalized;
  const double bound = mayGrow ? std::numeric_limits<double>::infinity() : place(before).area;
  SurfaceSize size = place(solution.embedding);
  if (!(size.area > VanishedArea * startArea_))
  {
    return Stopped(FlowEnd::Vanished);
  }
  if (size.area > bound)
  {
    return Stopped(FlowEnd::Breakdown);
  }
  const std::optional<double> scale = this->ScaleOf(size.area, size.volume);
  if (!scale)
  {
    return Stopped(FlowEnd::VolumeLost);
  }
  if (options_.rescaling != Rescaling::None)
  {
    const Vec3 center = (size.centroid - moving_->Origin()) / moving_->UnitLength();
    ScaleAbout(center, *scale, solution.embedding, threads);
    size = place(solution.embedding);
  }
  return Describe(size);
}

/// Keeps the shape for the next step.
void MeanCurvatureFlow::Keep(const std::vector<Vec3>& points, MultiVector embedding)
{
  if (!options_.rebuild)
  {
    shape_ = std::move(embedding);
    return;
  }
  shape_.resize(static_cast<Id>(points.size()), 3);
  for (Id k = 0; k < shape_.rows(); ++k)
  {
    SetRow(shape_, k, (points[k] - start_->Origin()) / start_->UnitLength());
  }
}

} // namespace gridfem
