#include "Solvers/DynamicsSolver.h"

#include "Base/Errors.h"
#include "Equations/L2Projection.h"
#include "Grid/TriangleArea.h"
#include "Solvers/DynamicsEquation.h"
#include "Solvers/DynamicsStart.h"
#include "Solvers/LocalSurface.h"
#include "Solvers/SolveWarnings.h"

#include <algorithm>
#include <cmath>
#include <sstream>
#include <utility>

namespace gridfem
{
namespace
{

using Model = DynamicsModel;

void RequireInput(const DynamicsSolver::Input& input, const DynamicsSolver::Options& options)
{
  RequireOptions(options);
  if (options.patternLength == 0.0)
  {
    throw InvalidInput("Pattern Length is 0. It must be above 0.");
  }
  if (options.model == Model::Custom && !input.reactions)
  {
    throw InvalidInput("The Model Custom needs a formula for Reaction U.");
  }
  const Id unknowns = NumberOfUnknowns(options, input.reactions);
  if (input.start.components > unknowns)
  {
    throw InvalidInput("Start Array '" + input.start.name + "' has " +
                       std::to_string(input.start.components) + " components for " +
                       std::to_string(unknowns) + " unknowns of this Model.");
  }
  if (options.model != Model::Transport)
  {
    return;
  }
  if (options.diffusivity == 0.0)
  {
    throw InvalidInput("Diffusivity is 0. It must be above 0.");
  }
  if (input.velocity.components != 3)
  {
    throw InvalidInput(input.velocity
                         ? "Velocity Array '" + input.velocity.name + "' has " +
                             std::to_string(input.velocity.components) + " components instead of 3."
                         : "Transport needs a Velocity Array with 3 components.");
  }
}

/// The side of a regular triangle with the area of the triangle at a random place of the surface.
double UsualSide(const TriangleMesh& mesh)
{
  double sum = 0.0;
  double squares = 0.0;
  for (std::size_t t = 0; t < mesh.triangles.size(); ++t)
  {
    const double area = AreaOf(mesh, static_cast<Id>(t));
    sum += area;
    squares += area * area;
  }
  return sum > 0.0 ? std::sqrt(4.0 / std::sqrt(3.0) * squares / sum) : 0.0;
}

/// Points show a pattern that is three sides of a triangle long.
std::vector<std::string> WarningsOfPatterns(
  const Surface& surface, const DynamicsSolver::Options& options, const GivenReactions& reactions)
{
  const double length = surface.LengthInWorldUnits(options.patternLength);
  const double needed = FunctionsOfPattern(options, reactions);
  const double spacing = std::sqrt(surface.Area() / double(surface.Space().NumberOfFunctions(0)));
  const double side = UsualSide(surface.Mesh());
  std::ostringstream text;
  if (length < needed * spacing)
  {
    text << "The Pattern Length is only " << length / spacing << " times the distance between "
         << "functions, so the grid distorts patterns of this length. A larger Depth, or a finer "
            "mesh with hat functions, resolves it.";
  }
  else if (length < 3.0 * side)
  {
    text << "The Pattern Length is only " << length / side << " times the side of a triangle, so "
         << "the points do not show all of such a pattern. They do on a subdivided mesh.";
  }
  return NotEmpty({ text.str() });
}

/// The largest error of a step that is accepted. The steps of named models are known to be good.
double AllowedError(bool isCustom)
{
  return isCustom ? 0.02 : 0.05;
}

void KeepLarger(const Columns& values, Columns& kept)
{
  kept = kept.size() == 0 ? values : Columns(kept.max(values));
}

/// Returns the largest error beside the largest value, of all unknowns.
double LargestRatio(const Columns& errors, const Columns& values)
{
  double largest = 0.0;
  for (Id c = 0; c < errors.size(); ++c)
  {
    largest = errors[c] > 0.0 ? std::fmax(largest, errors[c] / values[c]) : largest;
  }
  return largest;
}

} // namespace

SurfaceOptions DynamicsSolver::SurfaceDefaults()
{
  SurfaceOptions options = StabilizedSurface();
  options.space.depth = 6;
  return options;
}

const DynamicsSolver::Result& DynamicsSolver::Update(
  Surface& surface, const Input& input, const Options& options, const Job& job)
{
  RequireInput(input, options);
  surface.Prepare(job.progress.Part(0.0, 0.2));
  RequireFirstDegree(surface.UsedOptions().choice.kind, "Patterns and waves");
  tolerance_ = options.equation.solve.tolerance;
  isCustom_ = options.model == Model::Custom;
  this->UpdateEquation(surface, input, options, surface.MakeJob(job.progress.Part(0.2, 0.3)));
  this->UpdateStart(surface, input, options, surface.MakeJob(job.progress.Part(0.3, 0.35)));
  this->MakeFrames(surface, input, options, surface.MakeJob(job.progress.Part(0.35, 1.0)));
  job.Check(1.0);
  return result_;
}

void DynamicsSolver::UpdateEquation(
  const Surface& surface, const Input& input, const Options& options, const Job& job)
{
  Options counted = options;
  counted.numberOfSteps = 1; // more frames continue
  counted.seed = 0;          // it belongs to the start
  StageKey key = KeyOfOptions(counted);
  key.Add(surface.GetStages().Version(SystemStage)).Add(surface.LengthInWorldUnits(1.0));
  if (options.model == Model::Transport)
  {
    key.Add(KeyOf(input.velocity));
  }
  if (options.model == Model::Custom)
  {
    key.Add(input.reactions.version).Add(KeyOf(input.start)); // they determine the step
  }
  surface.GetStages().Run(HierarchyStage, key,
    [&]
    {
      result_.frames.clear();
      frameStart_ = {};
      refinement_ = 1;
      this->BuildEquation(surface, input, options, job);
      result_.warnings = WarningsOfPatterns(surface, options, input.reactions);
    });
}

void DynamicsSolver::BuildEquation(
  const Surface& surface, const Input& input, const Options& options, const Job& job)
{
  equation_.reset(); // frees its memory first
  substepsMade_ = 0;
  MadeEquation made = MakeEquation(surface, input, options, refinement_, job);
  if (frameStart_.rows() > 0)
  {
    made.equation->Start(frameStart_);
  }
  equation_ = std::move(made.equation);
  substeps_ = made.substeps;
  result_.timeStep = made.frame;
}

void DynamicsSolver::UpdateStart(
  const Surface& surface, const Input& input, const Options& options, const Job& job)
{
  StageKey key;
  key.Add(surface.GetStages().Version(SystemStage)).Add(options.model);
  key.Add(NumberOfUnknowns(options, input.reactions));
  key.Add(surface.LengthInWorldUnits(options.patternLength));
  key.Add(KeyOf(input.start)).Add(KeyOf(input.disturbed)).Add(options.seed);
  surface.GetStages().Run(RightHandSideStage, key,
    [&]
    {
      EquationOptions equation = EndedByTolerance(1e-6);
      equation.multigrid.threads = job.threads;
      L2Projection projection(surface.Space(), equation, job.Part(0.0, 0.3));
      SolveReport ofBump;
      const Field field = StartField(surface, input, options, ofBump, job.Part(0.3, 0.6));
      start_ = projection.Solve(surface.Space().LoadOfValues(field, job), {}, job.Part(0.6, 1.0));
      startReport_ = projection.report;
      KeepWorse(std::move(ofBump), startReport_);
    });
}

/// Goes on to the next frame, or until values have left the range of numbers. After an abort it
/// goes on from the last substep.
void DynamicsSolver::MakeSubsteps(const Job& job)
{
  if (substepsMade_ == 0)
  {
    report_ = SolveReport::Solved();
    errors_ = Columns();
    largestOfFrame_ = largest_;
  }
  for (; substepsMade_ < substeps_ && report_.end != SolveEnd::NotFinite; ++substepsMade_)
  {
    const double share = 1.0 / substeps_;
    KeepWorse(
      equation_->Advance(job.Part(share * substepsMade_, share * (substepsMade_ + 1))), report_);
    KeepLarger(equation_->ExtrapolationErrors(), errors_);
    KeepLarger(equation_->LargestValues(), largestOfFrame_);
  }
}

/// Makes the frame again with half the steps while they are too long.
DynamicsSolver::Frame DynamicsSolver::NextFrame(
  const Surface& surface, const Input& input, const Options& options, const Job& job)
{
  constexpr int FinestRefinement = 16;
  for (;;)
  {
    if (!equation_)
    {
      this->BuildEquation(surface, input, options, job.Part(0.0, 0.0));
    }
    this->MakeSubsteps(job);
    const bool isGood = LargestRatio(errors_, largestOfFrame_) <= AllowedError(isCustom_) &&
                        report_.end != SolveEnd::NotFinite;
    if (isGood || refinement_ == FinestRefinement)
    {
      break;
    }
    refinement_ *= 2;
    equation_.reset();
  }
  frameStart_ = equation_->Coefficients();
  substepsMade_ = 0;
  largest_ = largestOfFrame_;
  KeepLarger(errors_, errorsSinceStart_);
  return this->FrameNow(surface);
}

DynamicsSolver::Frame DynamicsSolver::FrameNow(const Surface& surface) const
{
  const MultiVector& coefficients = equation_->Coefficients();
  const double area = std::pow(surface.Space().UnitLength(), 2);
  const std::vector<double>& integrals = surface.Space().Integrals();
  const Eigen::Map<const Eigen::VectorXd> weights(
    integrals.data(), static_cast<Id>(integrals.size()));
  Frame frame;
  frame.atPoints = surface.ValuesAtPoints(coefficients);
  frame.report = report_;
  frame.extrapolationError = LargestRatio(errorsSinceStart_, largest_);
  frame.integral = area * (coefficients.transpose() * weights).array();
  frame.energy = area * equation_->Energy(surface.MakeJob({}));
  return frame;
}

void DynamicsSolver::MakeFrames(
  const Surface& surface, const Input& input, const Options& options, const Job& job)
{
  Stages& stages = surface.GetStages();
  std::vector<Frame>& frames = result_.frames;
  StageKey key;
  key.Add(stages.Version(RightHandSideStage)).Add(stages.Version(HierarchyStage));
  if (frames.empty() || key != ofFrames_)
  {
    frames.clear();
    ofFrames_ = key;
    frameStart_ = start_;
    largest_ = Columns();
    report_ = startReport_;
    errorsSinceStart_ = Columns();
    if (refinement_ > 1 || !equation_)
    {
      refinement_ = 1;
      this->BuildEquation(surface, input, options, job.Part(0.0, 0.1));
    }
    else
    {
      equation_->Start(start_);
      substepsMade_ = 0;
    }
    frames.push_back(this->FrameNow(surface));
  }
  const auto wanted = static_cast<std::size_t>(options.numberOfSteps) + 1;
  surface.Require({ double(wanted - std::min(wanted, frames.size())) *
                      double(frames.front().atPoints.size()) * sizeof(double),
    "Number Of Steps " + std::to_string(options.numberOfSteps), "Choose fewer steps." });
  const std::size_t first = frames.size();
  const double share = 1.0 / std::max<double>(1.0, double(wanted) - double(first));
  while (frames.size() < wanted)
  {
    const double done = share * double(frames.size() - first);
    StageKey ofFrame = key;
    ofFrame.Add(static_cast<std::int64_t>(frames.size()));
    stages.Run(SolveStage, ofFrame,
      [&] {
        frames.push_back(this->NextFrame(surface, input, options, job.Part(done, done + share)));
      });
  }
}

std::vector<std::string> DynamicsSolver::Warnings(int frame) const
{
  std::vector<std::string> warnings = result_.warnings;
  const Frame& shown = result_.frames.at(static_cast<std::size_t>(frame));
  const SolveReport& report = shown.report;
  if (report.end == SolveEnd::NotFinite)
  {
    warnings.emplace_back(
      isCustom_ ? "The values have left the range of numbers. A reaction grows without "
                  "end, is undefined for some values, such as sqrt(u) for u below 0, or "
                  "needs a shorter Time Step."
                : "The values have left the range of numbers. Reactions this fast need "
                  "a shorter Time Step, or another start.");
    return warnings;
  }
  if (!report.converged)
  {
    warnings.push_back(WarningOf(report, tolerance_));
  }
  if (shown.extrapolationError > AllowedError(isCustom_))
  {
    std::ostringstream text;
    text << "Reactions or transport change so fast that a step of the solver was wrong by "
         << 100.0 * shown.extrapolationError << " % of the largest value. A shorter Time Step is "
         << "more exact.";
    warnings.push_back(text.str());
  }
  return warnings;
}

DynamicsSolver::Result DynamicsSolver::Solve(std::shared_ptr<const TriangleMesh> mesh,
  const Input& input, const Options& options, const SurfaceOptions& surfaceOptions, const Job& job)
{
  Stages stages;
  LocalSurface surface(stages, std::move(mesh), surfaceOptions);
  DynamicsSolver solver;
  solver.Update(surface, input, options, job);
  solver.result_.warnings = solver.Warnings(options.numberOfSteps);
  return std::move(solver.result_);
}

} // namespace gridfem
