#include "Solvers/SolveWarnings.h"

#include "Shape/MovedSurface.h"

#include <algorithm>
#include <sstream>

namespace gridfem
{
namespace
{

std::string HowItEnded(const SolveReport& report)
{
  return "Not converged after " + std::to_string(report.iterations) + " iterations, because " +
         ReasonOf(report) + ".";
}

const char* ReasonOf(FlowEnd end)
{
  switch (end)
  {
    case FlowEnd::Vanished:
      return "the surface has shrunk to nothing. Rescale keeps its size";
    case FlowEnd::VolumeLost:
      return "the surface has lost the volume that was to be kept constant";
    case FlowEnd::Unfit:
      return "the moved surface cannot be clipped again";
    case FlowEnd::Breakdown:
    case FlowEnd::None:
      break;
  }
  return "its equations cannot be solved: the matrix is not positive, or numbers leave their "
         "range. A smaller Time Step may help";
}

/// Why no choice of the depth reaches the wanted error.
const char* ReasonOfError(FunctionKind kind)
{
  return IsRefinedByDepth(kind)
           ? "The depth cannot grow: a given basis fixes it, or the next depth does not fit into "
             "memory."
           : "No Depth changes the error of hat functions: subdivide the mesh, or set Function "
             "Space to Grid.";
}

/// Why an estimated error that is small enough is not enough.
const char* Doubt(double estimated, double wanted)
{
  return estimated <= wanted ? ", but coarser grids do not confirm it" : "";
}

} // namespace

const char* ReasonOf(const SolveReport& report)
{
  switch (report.end)
  {
    case SolveEnd::Converged:
      return "it has converged";
    case SolveEnd::IterationLimit:
      return "Maximum Iterations allows no more";
    case SolveEnd::NotFinite:
      return "the values or gradients contain numbers that are not finite";
    case SolveEnd::Stagnation:
      return "it stagnated: more iterations would not help. On narrow triangles, or pieces far "
             "smaller than the cells, set Normal Stabilization to 1e-2 or apply Clean";
    case SolveEnd::Breakdown:
      break;
  }
  return "it broke down: the system has no solution, or its numbers span too many digits. Hat "
         "functions have such numbers on triangles narrower than 1e-7 of their length";
}

IterationRecord LastRecord(const SolveReport& report)
{
  return report.history.empty() ? IterationRecord{ 0, 0.0, 0.0 } : report.history.back();
}

std::vector<std::string> NotEmpty(std::vector<std::string> sentences)
{
  sentences.erase(std::remove(sentences.begin(), sentences.end(), std::string()), sentences.end());
  return sentences;
}

std::string Joined(const std::vector<std::string>& sentences)
{
  std::string text;
  for (const std::string& sentence : sentences)
  {
    text += (text.empty() || sentence.empty() ? "" : " ") + sentence;
  }
  return text;
}

std::string WarningOf(const SolveReport& report, double tolerance)
{
  const IterationRecord last = LastRecord(report);
  std::ostringstream text;
  text << HowItEnded(report) << " The energy residual is " << last.energy << ", the residual is "
       << last.residual << ", and the Tolerance is " << tolerance << ". The result is kept.";
  return text.str();
}

std::string WarningOf(const SolveReport& report, const SolutionAccuracy& accuracy, double tolerance)
{
  if (report.converged)
  {
    return {};
  }
  if (tolerance > 0.0)
  {
    return WarningOf(report, tolerance);
  }
  std::ostringstream text;
  text << HowItEnded(report) << " The estimated error of the solver is " << accuracy.algebraic
       << " of the solution; the error of the function space is " << accuracy.discretization
       << ". The result is kept.";
  return text.str();
}

std::string PlaceOf(FunctionKind kind, int depth)
{
  return kind == FunctionKind::Hats ? "with the hat functions of this mesh"
                                    : "at Depth " + std::to_string(depth);
}

std::string WarningOfWantedError(double wanted, double estimated, FunctionKind kind)
{
  std::ostringstream text;
  text << "The Wanted Error of " << wanted << " is not reached: the estimated error is "
       << estimated << Doubt(estimated, wanted) << ". " << ReasonOfError(kind)
       << " The result is kept.";
  return text.str();
}

std::string WarningOfAccuracy(double wanted, double estimated, FunctionKind kind, int depth)
{
  std::ostringstream text;
  text << "The wanted Accuracy of " << wanted << " is not reached: at Depth " << depth
       << " the estimated error is up to " << estimated << Doubt(estimated, wanted) << ". "
       << ReasonOfError(kind) << " The result is kept.";
  return text.str();
}

std::string WarningOfConstraints(const ConstrainedSolution& solution)
{
  constexpr double Visible = 1e-3;
  if (solution.relativeMisfit <= Visible)
  {
    return {};
  }
  std::ostringstream text;
  text << "The result misses given values by up to " << solution.misfit
       << ": they contradict each other, or lie too close together for the functions. The result "
          "is the best compromise, by least squares. A larger Depth or hat functions come closer.";
  return text.str();
}

std::vector<std::string> WarningsOf(const ConstrainedSolution& solution, double tolerance)
{
  std::vector<std::string> sentences;
  if (!solution.report.converged)
  {
    sentences.push_back(WarningOf(solution.report, tolerance));
  }
  sentences.push_back(WarningOfConstraints(solution));
  const auto free = std::count(solution.isHeld.begin(), solution.isHeld.end(), 0);
  if (free > 0)
  {
    sentences.push_back(std::to_string(free) + " of " + std::to_string(solution.isHeld.size()) +
                        " connected components have neither a weight nor a constraint. They keep "
                        "the mean of their known values, or become NaN if none is known.");
  }
  return sentences;
}

std::string WarningOf(const PartialField& field)
{
  return field.numberOfIgnoredPoints == 0
           ? std::string()
           : std::to_string(field.numberOfIgnoredPoints) +
               " known points are ignored, because none of their triangles has known values at "
               "all corners. A Constraint Array can hold them.";
}

std::vector<std::string> WarningsOf(const Spectrum& spectrum, int wanted, const std::string& where)
{
  std::vector<std::string> sentences;
  const std::size_t modes = spectrum.eigenvalues.size();
  if (spectrum.truncated)
  {
    sentences.push_back("Only " + std::to_string(modes) + " of the " + std::to_string(wanted) +
                        (spectrum.converged ? " modes exist " : " modes were found ") + where +
                        ".");
  }
  const auto constants = static_cast<std::size_t>(spectrum.numberOfConstants);
  if (modes > 1 && modes <= constants && !spectrum.truncated)
  {
    const std::string components = std::to_string(constants);
    sentences.push_back("All " + std::to_string(modes) + " modes are constants: the surface has " +
                        components + " connected components, each with one constant mode. " +
                        "Choose a Number Of Modes above " + components + ".");
  }
  if (!spectrum.converged)
  {
    const std::vector<double>& residuals = spectrum.residuals;
    std::ostringstream text;
    text << "Not converged after " << spectrum.iterations
         << " iterations: " << spectrum.numberOfConverged << " of " << modes
         << " modes reached the Tolerance. The largest residual is "
         << (residuals.empty() ? 0.0 : *std::max_element(residuals.begin(), residuals.end()))
         << ". The result is kept."
         << (spectrum.truncated ? " Set Normal Stabilization to 1e-6 if parts of the surface are "
                                  "nearly flat, or far smaller than the cells."
                                : "");
    sentences.push_back(text.str());
  }
  return sentences;
}

std::vector<std::string> WarningsOf(const DistanceField& field, double tolerance)
{
  std::vector<std::string> sentences;
  if (field.unreached > 0)
  {
    sentences.push_back(
      "Distances are wrong far from the sources: " + std::to_string(field.unreached) +
      " functions are so far that hardly any heat arrives. Choose a larger Smoothing "
      "or a smaller Depth.");
  }
  if (field.heatOscillates)
  {
    sentences.push_back(
      "The heat is negative in places: the distance may be wrong there and beyond. Choose a larger "
      "Smoothing, such as 2.");
  }
  if (!field.heatConverged)
  {
    sentences.push_back(
      "The heat has not settled everywhere: the direction of the distance may be wrong in places. "
      "Another Depth or Smoothing may help. The result is kept.");
  }
  else if (field.report.end != SolveEnd::Converged)
  {
    sentences.push_back(WarningOf(field.report, tolerance));
  }
  return sentences;
}

std::string WarningOf(const FlowSummary& flow, bool conformalized, const TriangleMesh& mesh)
{
  std::ostringstream text;
  if (flow.end != FlowEnd::None && flow.steps < flow.wanted)
  {
    text << "The flow ends after " << flow.steps << " of " << flow.wanted << " steps, because "
         << ReasonOf(flow.end) << ". The steps so far are kept. ";
  }
  if (flow.unconverged > 0)
  {
    text << flow.unconverged << (flow.unconverged == 1 ? " step has" : " steps have")
         << " not converged to the Tolerance. The result is kept. ";
  }
  if (conformalized && !IsLikeASphere(mesh))
  {
    text << "The surface has a boundary, a handle, or more than one component. The conformalized "
            "flow goes on, but it will not become a sphere. ";
  }
  return text.str();
}

} // namespace gridfem
