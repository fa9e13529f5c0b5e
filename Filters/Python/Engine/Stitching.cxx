#include "Problem.h"

#include "Base/Errors.h"
#include "Problems/Requirements.h"
#include "Problems/SolveWarnings.h"
#include "Problems/Stitching.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace gridfem
{
namespace
{

/// Which scan each label stands for: their places among the distinct ones, ascending.
struct Scans
{
  explicit Scans(const Field& labels) : numbers{ labels.association, {} }
  {
    const double* begin = labels.values.data();
    distinct.assign(begin, begin + labels.values.size());
    std::sort(distinct.begin(), distinct.end());
    distinct.erase(std::unique(distinct.begin(), distinct.end()), distinct.end());
    for (const double label : distinct)
    {
      if (label != std::floor(label))
      {
        throw InvalidInput("LabelArray 'labels' has the value " + std::to_string(label) +
                           "; labels must be integers.");
      }
    }
    for (Id row = 0; row < labels.values.rows(); ++row)
    {
      numbers.values.push_back(this->NumberOf(labels.values(row, 0)));
    }
  }

  Index NumberOf(double label) const
  {
    return static_cast<Index>(
      std::lower_bound(distinct.begin(), distinct.end(), label) - distinct.begin());
  }

  std::vector<double> distinct;
  ScanLabels numbers;
};

class StitchingProblem : public Problem
{
public:
  explicit StitchingProblem(Properties& properties)
    : options_(properties, { 0.0, 200, 1e-2 }),
      referenceLabel_(properties.Integer("ReferenceLabel", WholeSurface, -Largest, Largest)),
      keepsDetails_(properties.Switch("KeepDetails", true)),
      blendWidth_(properties.Number("BlendWidth", 0.0, 0.0, 1.0))
  {
    // Details are kept on the grid.
    options_.functionsPerPoint = keepsDetails_ ? AsManyAsWanted : EnoughToPrecondition;
  }

  Results Solve(const Given& given, const Progress& progress) const override
  {
    Check(given);
    const EngineSurface surface(given, options_, progress.Part(0.0, 0.35));
    const Field colors = given.FieldOf("colors");
    const Scans scans(given.FieldOf("labels"));
    const ScanCut cut = CutAtSeams(surface.Mesh(), scans.numbers, colors.association);
    const std::unique_ptr<FiniteElementSpace> details =
      this->SpaceOfDetails(surface.options, cut, progress.Part(0.35, 0.6));
    StitchOptions options{ options_,
      blendWidth_ * surface.space->Extent() * surface.space->UnitLength(), {} };
    if (referenceLabel_ != WholeSurface)
    {
      options.reference = scans.NumberOf(referenceLabel_);
      if (!std::binary_search(scans.distinct.begin(), scans.distinct.end(), referenceLabel_))
      {
        throw InvalidInput(
          "There is no scan with the ReferenceLabel " + std::to_string(referenceLabel_) + ".");
      }
    }
    const StitchedColors stitched = StitchColors(*surface.space, surface.Mesh(), cut, colors,
      options, details.get(), surface.MakeJob(progress.Part(0.6, 0.95)));
    Results results;
    results.arrays["StitchedColors"] = colors.association == FieldAssociation::Points
                                         ? KeepUnsolved(surface, given, stitched.values)
                                         : given.MeansOnCells(stitched.values);
    results.Warn(WarningOf(stitched.report, stitched.accuracy, options_.solve.tolerance));
    return results;
  }

private:
  static constexpr int Largest = std::numeric_limits<int>::max();
  static constexpr int WholeSurface = -1; // as ReferenceLabel

  static void Check(const Given& given)
  {
    const Id components = given.arrays.at("colors").values.cols();
    if (components < 1 || components > 4)
    {
      throw InvalidInput("ColorArray 'colors' has " + std::to_string(components) +
                         " components; colours have 1 to 4.");
    }
    if (given.arrays.at("labels").values.cols() != 1)
    {
      throw InvalidInput("LabelArray 'labels' must have one component.");
    }
  }

  std::unique_ptr<FiniteElementSpace> SpaceOfDetails(
    const EngineOptions& options, const ScanCut& cut, const Progress& progress) const
  {
    if (!keepsDetails_ || !(SurfaceArea(cut.pieces) > 0.0))
    {
      return nullptr;
    }
    SpaceOptions functions = options.functions;
    functions.connectivityAware = true;
    functions.weldCoincidentPoints = false; // points of two scans stay two
    SpaceChoice choice = options.choice;
    choice.kind = FunctionKind::Grid; // the change is smooth
    RequireMemory(cut.pieces, functions.depth);
    return BuildSpace(cut.pieces, functions, choice, progress);
  }

  static MultiVector KeepUnsolved(
    const EngineSurface& surface, const Given& given, MultiVector values)
  {
    surface.KeepUnsolved(given.arrays.at("colors").values, values);
    return values;
  }

  EngineOptions options_;
  int referenceLabel_;
  bool keepsDetails_;
  double blendWidth_;
};

} // namespace

std::unique_ptr<Problem> MakeStitching(Properties& properties)
{
  return std::make_unique<StitchingProblem>(properties);
}

} // namespace gridfem
