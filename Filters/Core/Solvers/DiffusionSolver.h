// Spreads heat from a given field over a surface, in equal time steps.
#ifndef GridFEM_DiffusionSolver_h
#define GridFEM_DiffusionSolver_h

#include "Equations/HeatDiffusion.h"
#include "Solvers/OptionFields.h"
#include "Solvers/SurfaceFields.h"

#include <memory>
#include <optional>
#include <string>
#include <vector>

namespace gridfem
{

/// What states how far heat spreads.
enum class DiffusionAmount
{
  Time = 0,
  FullWidth = 1, // of the kernel at half of its maximum
  Sigma = 2      // standard deviation of the kernel along each direction
};

///@{ The diffusion time after which the heat of a point is a Gaussian of this width on a plane, in
/// squared units of the width. Without boundaries, smoothing by two widths is smoothing by the root
/// of the sum of their squares.
double TimeOfFullWidth(double fullWidth); // t = FWHM² / (16 ln 2)
double TimeOfSigma(double sigma);         // t = sigma² / 2
///@}

/// Solves the heat equation du/dt = Δu + s. It keeps the steps: more steps of the same length
/// continue from the last one. Values that change on the same surface, as from frame to frame of a
/// series, repeat neither functions nor hierarchy. Many components are solved a few at a time.
/// For 64 components or more, the matrix is factored (HeatEquation). The estimated errors are then
/// the errors of the first eight components.
class DiffusionSolver
{
public:
  struct Options
  {
    EquationOptions equation = EndedByAccuracy();
    DiffusionAmount amount = DiffusionAmount::Time; // which of the next three counts
    double diffusionTime = 0.001;                   // squared parameter units, above 0
    double fullWidth = 6.0;                         // world units, above 0
    double sigma = 2.5;                             // world units, above 0
    int numberOfSteps = 1;
    bool boundaryValues = false; // values on the boundary stay

    template<class Self, class Visit>
    static void ForEach(Self& self, Visit&& visit)
    {
      visit(self.equation);
      visit("Amount", self.amount, Within(0, 2));
      visit("DiffusionTime", self.diffusionTime, AtLeast(0.0));
      visit("FWHM", self.fullWidth, AtLeast(0.0));
      visit("Sigma", self.sigma, AtLeast(0.0));
      visit("NumberOfSteps", self.numberOfSteps, Within(1, 10000));
      visit("BoundaryValues", self.boundaryValues, AnyValue());
    }
  };

  struct Input
  {
    GivenField values;            // at time 0; none: the coordinates
    GivenField source;            // added per unit of time, as many components
    GivenConstraints constraints; // where the values stay
  };

  struct Step
  {
    MultiVector atPoints;
    SolveReport report;
    SolutionAccuracy accuracy;
    ConstrainedSolution met; // how the held values are met; isHeld is empty without any
  };

  struct Result
  {
    std::vector<Step> steps;  // the first is step 1
    double stepLength = 0.0;  // squared world units
    EquationOptions equation; // with the tolerance that was used
    std::string warning;      // about the input; empty: none
  };

  /// The default options of the surface.
  static SurfaceOptions SurfaceDefaults() { return StabilizedSurface(); }

  /// Makes the steps that are missing. After an abort the steps so far are kept. Collective. Throws
  /// InvalidInput and Aborted.
  const Result& Update(
    Surface& surface, const Input& input, const Options& options, const Job& job);

  /// The warnings about a step of the last update, from 1. Empty if there are none.
  std::vector<std::string> Warnings(int step) const;

  /// Runs all steps on a mesh of this process.
  static Result Solve(std::shared_ptr<const TriangleMesh> mesh, const Input& input,
    const Options& options, const SurfaceOptions& surfaceOptions = SurfaceDefaults(),
    const Job& job = {});

private:
  void UpdateLoads(
    const Surface& surface, const Input& input, const Options& options, const Job& job);
  void UpdateHierarchy(const Surface& surface, const Options& options, const Job& job);
  void MakeSteps(const Surface& surface, const Options& options, const Job& job);
  Step MakeStep(const Surface& surface, bool goesOn, const Job& job);
  HeatDiffusion PanelAtStart(Id first, Id count, HeatSolves solves) const;

  Eigen::RowVectorXd constants_; // that the start, held values and solutions lack
  MultiVector start_;
  MultiVector sources_;
  HeldValues held_;
  std::int64_t heldPlaces_ = 0; // changes with the places of held values
  std::shared_ptr<const HeatEquation> equation_;
  std::vector<HeatDiffusion> panels_;    // after the last step; none if it cannot be continued
  std::optional<HeatDiffusion> watched_; // some columns by iteration, beside panels by the factor
  StageKey ofSteps_;
  Result result_;
};

} // namespace gridfem

#endif
