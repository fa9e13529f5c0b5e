// Fits a function on a surface to values and gradients: the screened Poisson equation.
#ifndef GridFEM_PoissonSolver_h
#define GridFEM_PoissonSolver_h

#include "Solvers/ConstrainedEquation.h"
#include "Solvers/DepthSearch.h"
#include "Solvers/OptionFields.h"
#include "Solvers/PoissonEquation.h"
#include "Solvers/SurfaceFields.h"

#include <memory>
#include <string>
#include <vector>

namespace gridfem
{

/// Minimizes ∫ λ w (u - f)² + |∇u - σ s|² for values f, weights w and gradients s. Values may be
/// unknown, or held exactly at points and on the boundary. [T (3.1); DESIGN §3]
class PoissonSolver
{
public:
  struct Options
  {
    EquationOptions equation = EndedByAccuracy();
    double screeningWeight = 100.0; // λ per squared parameter unit
    double gradientScale = 1.0;     // σ
    bool useValueGradient = false;  // s = ∇f where no gradients are given
    bool fillUnknown = false;       // NaN is an unknown value
    bool boundaryValues = false;    // values on the boundary are held
    double wantedError = 0.0;       // relative; above 0 it chooses the depth

    template<class Self, class Visit>
    static void ForEach(Self& self, Visit&& visit)
    {
      visit(self.equation);
      visit("ScreeningWeight", self.screeningWeight, AtLeast(0.0));
      visit("GradientScale", self.gradientScale, Finite());
      visit("UseValueGradient", self.useValueGradient, AnyValue());
      visit("FillUnknown", self.fillUnknown, AnyValue());
      visit("BoundaryValues", self.boundaryValues, AnyValue());
      visit("WantedError", self.wantedError, Within(0.0, 0.5));
    }
  };

  struct Input
  {
    GivenField values;            // f; none: the coordinates
    GivenField gradients;         // s: three components for each of the values
    GivenField gradientScale;     // a factor on s, one component
    GivenField weights;           // w, one component
    GivenField flux;              // through the boundary, on points, as many components as f
    GivenConstraints constraints; // where the solution has the values exactly
  };

  struct Result
  {
    MultiVector atPoints; // of the solution; NaN where nothing is known
    SolveReport report;
    SolutionAccuracy accuracy;
    bool isAccurate = true; // wantedError is reached; after a search see DepthSearch::IsReached
    bool holdsValues = false;
    double misfit = 0.0; // the largest difference from a held value
    std::vector<std::string> warnings;
  };

  static SurfaceOptions SurfaceDefaults() { return {}; }

  /// Throws InvalidInput and Aborted. Collective.
  const Result& Update(
    Surface& surface, const Input& input, const Options& options, const Job& job);

  /// Solves once on a mesh of this process.
  static Result Solve(std::shared_ptr<const TriangleMesh> mesh, const Input& input,
    const Options& options, const SurfaceOptions& surfaceOptions = SurfaceDefaults(),
    const Job& job = {});

private:
  void SolveAtWantedError(
    Surface& surface, const Input& input, const Options& options, const Progress& progress);
  void SolvePrepared(
    const Surface& surface, const Input& input, const Options& options, const Progress& progress);
  void Report(const Surface& surface, const Input& input, const Options& options, bool isSearched);

  DepthSearch search_;
  StageKey searched_; // all that the depth found depends on
  PoissonEquation equation_;
  ConstrainedEquation constrained_;
  Eigen::RowVectorXd constants_; // that the loads and solutions of both lack
  Result result_;
};

} // namespace gridfem

#endif
