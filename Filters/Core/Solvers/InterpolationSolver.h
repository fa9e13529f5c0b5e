// Finds the smoothest function on a surface with given values at some of its points.
#ifndef GridFEM_InterpolationSolver_h
#define GridFEM_InterpolationSolver_h

#include "Equations/HarmonicInterpolation.h"
#include "Solvers/GivenField.h"
#include "Solvers/OptionFields.h"
#include "Solvers/Surface.h"

namespace gridfem
{

/// Needs a surface that one process holds.
class InterpolationSolver
{
public:
  struct Options
  {
    EquationOptions equation = EndedByTolerance(1e-6);
    Smoothness smoothness = Smoothness::Harmonic;

    template<class Self, class Visit>
    static void ForEach(Self& self, Visit&& visit)
    {
      visit(self.equation);
      visit("Smoothness", self.smoothness, Within(0, 1));
    }
  };

  struct Input
  {
    /// The known values. They are found in every update, and other values repeat the solve. Their
    /// version does not count. Throws InvalidInput if no value is known.
    GivenConstraints values;
  };

  struct Result
  {
    MultiVector atPoints; // NaN on components without a value, and where no function reaches
    SolveReport report;
    SolutionAccuracy accuracy; // unknown for biharmonic functions of many points
    double misfit = 0.0;       // the largest difference from a given value that functions reach
    std::vector<std::string> warnings;
  };

  static SurfaceOptions SurfaceDefaults() { return StabilizedSurface(); }

  const Result& Update(
    Surface& surface, const Input& input, const Options& options, const Job& job = {});

  static Result Solve(std::shared_ptr<const TriangleMesh> mesh, const Input& input,
    const Options& options, const SurfaceOptions& surfaceOptions = SurfaceDefaults(),
    const Job& job = {});

private:
  void TakeValues(const Surface& surface, PointValues given);
  ConstrainedSolution SolveOnce(const Surface& surface, const HeldValues& held,
    const Options& options, const Progress& progress) const;
  ConstrainedSolution Interpolate(
    const Surface& surface, const Options& options, const Progress& progress);
  ConstrainedSolution InterpolateBetween(
    const Surface& surface, const Options& options, const Progress& progress);
  void Take(ConstrainedSolution solution, const Surface& surface, const Options& options);

  PointValues given_;
  Eigen::RowVectorXd constants_; // that the given values and the solution lack
  int version_ = 0;              // of the given values
  Result result_;
};

} // namespace gridfem

#endif
