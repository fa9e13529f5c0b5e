#include "Solvers/StitchSolver.h"

#include "Base/Errors.h"
#include "Base/SortEachOnce.h"
#include "Solvers/SolveOnMesh.h"
#include "Solvers/SolveWarnings.h"

#include <algorithm>
#include <cmath>

namespace gridfem
{
namespace
{

constexpr const char* CutStage = "Cut"; // the scans, and a space on each

void RequireInput(const StitchSolver::Input& input)
{
  const GivenField& colors = input.colors;
  if (!colors)
  {
    throw InvalidInput("Choose a Color Array with the colors of the scans.");
  }
  if (colors.components > 4)
  {
    throw InvalidInput("Color Array '" + colors.name + "' has " +
                       std::to_string(colors.components) + " components; colors have 1 to 4.");
  }
  if (!input.labels)
  {
    throw InvalidInput(
      "Choose a Label Array with the number of the scan that each color comes from.");
  }
  if (input.labels.components != 1)
  {
    throw InvalidInput("Label Array '" + input.labels.name + "' must have one component.");
  }
}

std::vector<double> DistinctLabels(const std::string& name, const Field& labels)
{
  const double* begin = labels.values.data();
  std::vector<double> distinct(begin, begin + labels.values.size());
  SortEachOnce(distinct);
  for (const double label : distinct)
  {
    if (label != std::floor(label))
    {
      throw InvalidInput("Label Array '" + name + "' has the value " + std::to_string(label) +
                         "; labels must be integers.");
    }
  }
  return distinct;
}

Index PlaceOf(double label, const std::vector<double>& distinct)
{
  return static_cast<Index>(
    std::lower_bound(distinct.begin(), distinct.end(), label) - distinct.begin());
}

/// A space for the change of the colors, in which the scans are apart.
std::unique_ptr<FiniteElementSpace> SpaceOfDetails(
  const Surface& surface, const TriangleMesh& pieces, const Progress& progress)
{
  SpaceOptions functions = surface.UsedOptions().space;
  functions.connectivityAware = true;
  functions.weldCoincidentPoints = false; // points of two scans stay two
  SpaceChoice choice = surface.UsedOptions().choice;
  choice.kind = FunctionKind::Grid; // the change is smooth
  RequireMemory(pieces, functions.depth, FunctionKind::Grid);
  return BuildSpace(pieces, functions, choice, progress);
}

} // namespace

SurfaceOptions StitchSolver::SurfaceDefaults()
{
  SurfaceOptions surface = StabilizedSurface();
  surface.functionsPerPoint = FunctionsPerPoint({});
  return surface;
}

/// Details are kept on the grid.
double StitchSolver::FunctionsPerPoint(const Options& options)
{
  return options.keepDetails ? AsManyAsWanted : EnoughToPrecondition;
}

const StitchSolver::Result& StitchSolver::Update(
  Surface& surface, const Input& input, const Options& options, const Job& job)
{
  RequireInput(input);
  RequireOptions(options);
  RequireFirstDegree(surface.UsedOptions().choice.kind, "Stitched colors");
  surface.Prepare(job.progress.Part(0.0, 0.35));
  job.Check(0.35);
  this->UpdateCut(surface, input, options, job.Part(0.35, 0.6));
  const std::shared_ptr<const FiniteElementSpace> space = surface.WholeSpace();
  StitchOptions ofStitching;
  static_cast<EquationOptions&>(ofStitching) = options.equation;
  ofStitching.multigrid.threads = surface.Threads();
  ofStitching.blendWidth = options.blendWidth * space->Extent() * space->UnitLength();
  ofStitching.reference = this->Reference(options.referenceLabel);
  StageKey key;
  key.Add(surface.GetStages().Version(CutStage)).Add(KeyOf(input.colors));
  key.Add(KeyOfOptions(options));
  surface.GetStages().Run(SolveStage, key,
    [&]
    {
      StitchedColors stitched =
        StitchColors(*space, surface.Mesh(), cut_, ReadField(surface, input.colors), ofStitching,
          details_.get(), surface.MakeJob(job.progress.Part(0.6, 1.0)));
      result_.values = std::move(stitched.values);
      result_.report = std::move(stitched.report);
      result_.accuracy = stitched.accuracy;
      result_.isReached = space->PointsWithFunctions();
    });
  result_.warnings =
    NotEmpty({ WarningOf(result_.report, result_.accuracy, options.equation.solve.tolerance) });
  return result_;
}

void StitchSolver::UpdateCut(
  const Surface& surface, const Input& input, const Options& options, const Job& job)
{
  StageKey key;
  key.Add(surface.GetStages().Version(SystemStage)).Add(KeyOf(input.labels));
  key.Add(input.colors.association).Add(options.keepDetails);
  surface.GetStages().Run(CutStage, key,
    [&]
    {
      const Field labels = ReadField(surface, input.labels);
      labels_ = DistinctLabels(input.labels.name, labels);
      job.Check(0.0);
      ScanLabels scans;
      scans.association = labels.association;
      for (Id row = 0; row < labels.values.rows(); ++row)
      {
        scans.values.push_back(PlaceOf(labels.values(row, 0), labels_));
      }
      cut_ = CutAtSeams(surface.Mesh(), scans, input.colors.association);
      job.Check(0.1);
      details_.reset();
      if (options.keepDetails && SurfaceArea(cut_.pieces) > 0.0)
      {
        details_ = SpaceOfDetails(surface, cut_.pieces, job.progress.Part(0.1, 1.0));
      }
    });
}

std::optional<Index> StitchSolver::Reference(int label) const
{
  if (label == WholeSurface)
  {
    return std::nullopt;
  }
  if (!std::binary_search(labels_.begin(), labels_.end(), label))
  {
    throw InvalidInput("No scan has the Reference Label " + std::to_string(label) + ".");
  }
  return PlaceOf(label, labels_);
}

StitchSolver::Result StitchSolver::Solve(std::shared_ptr<const TriangleMesh> mesh,
  const Input& input, const Options& options, const SurfaceOptions& surfaceOptions, const Job& job)
{
  return SolveOnMesh(&StitchSolver::result_, std::move(mesh), surfaceOptions, job, input, options);
}

} // namespace gridfem
