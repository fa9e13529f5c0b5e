// Sharpens or smooths a surface, or an array on it, also by its curvature and within a selection.
#ifndef GridFEM_DetailSolver_h
#define GridFEM_DetailSolver_h

#include "Shape/SurfaceDetail.h"
#include "Solvers/OptionFields.h"
#include "Solvers/PoissonEquation.h"
#include "Solvers/SurfaceFields.h"

#include <memory>
#include <optional>
#include <string>
#include <vector>

namespace gridfem
{

/// Multiplies details smaller than about 1 / sqrt(ScreeningWeight) by a scale. One process holds
/// the surface. [T §5.2]
class DetailSolver
{
public:
  struct Options
  {
    EquationOptions equation = EndedByTolerance(1e-4);
    double detailScale = 2.0;        // within the selection, or everywhere without one
    double outsideScale = 1.0;       // outside the selection
    double transitionWidth = 0.02;   // between them: length in parameter units
    double screeningWeight = 3000.0; // per squared parameter unit
    CurvatureTransfer transferFunction = CurvatureTransfer::Isotropic;
    double anisotropy = 5.0;       // factor of lengths along directions of large curvature
    double smoothingScale = 0.005; // of the curvatures: length in parameter units
    bool keepVolume = false;

    template<class Self, class Visit>
    static void ForEach(Self& self, Visit&& visit)
    {
      visit(self.equation);
      visit("DetailScale", self.detailScale, Finite());
      visit("OutsideScale", self.outsideScale, Finite());
      visit("TransitionWidth", self.transitionWidth, AtLeast(0.0));
      visit("ScreeningWeight", self.screeningWeight, AtLeast(0.0));
      visit("TransferFunction", self.transferFunction, Within(0, 4));
      visit("Anisotropy", self.anisotropy, Within(1e-3, 1e3));
      visit("SmoothingScale", self.smoothingScale, AtLeast(0.0));
      visit("KeepVolume", self.keepVolume, AnyValue());
    }
  };

  struct Input
  {
    GivenField values; // on points; none: the shape of the surface
    GivenField scale;  // a factor on the scales, one component
    bool hasSelection = false;
    std::vector<char> selected; // per point
    StageKey selection;         // version of the selection
    TransferFunction custom;    // the curve of CurvatureTransfer::Custom
    StageKey curve;             // version of the curve
  };

  struct Result
  {
    MultiVector change;       // of the values or coordinates at points
    std::vector<Vec3> points; // the moved points; only for the shape
    MultiVector selected;     // per point: 1 in the selection, falling to 0; no rows without one
    bool isWeighted = false;  // by curvatures
    double usualCurvature = 0.0;
    SolveReport report;
    SolutionAccuracy accuracy; // of the change
    std::vector<std::string> warnings;
  };

  /// The default options of the surface.
  static SurfaceOptions SurfaceDefaults() { return StabilizedSurface(); }

  /// Computes the change. Other scales repeat no stage. Throws InvalidInput and Aborted.
  const Result& Update(
    Surface& surface, const Input& input, const Options& options, const Job& job);

  /// Runs all steps at once, on a mesh of this process.
  static Result Solve(std::shared_ptr<const TriangleMesh> mesh, const Input& input,
    const Options& options, const SurfaceOptions& surfaceOptions = SurfaceDefaults(),
    const Job& job = {});

private:
  void UpdateMetric(const Surface& surface, const Options& options, const Job& job);
  void UpdateWeights(
    const Surface& surface, const Input& input, const Options& options, const Job& job);
  void UpdateSignal(
    const Surface& surface, const Input& input, const Options& options, const Job& job);
  PoissonLoad Integrate(
    const Surface& surface, const Input& input, const Options& options, const Job& job);
  void SolveBlocks(
    const Surface& surface, const Input& input, const Options& options, const Job& job);
  const FiniteElementSpace& MetricSpace() const; // in the metric that the curvatures give
  MultiVector ChangeAtPoints(const Options& options, int threads) const;
  MultiVector ScaleAtPoints(const TriangleMesh& mesh, const Options& options, int threads) const;
  SolutionAccuracy AccuracyOfChange(const Options& options) const;
  void Report(const Surface& surface, const Input& input, const Options& options);

  TriangleCurvatures curvatures_;
  SolveReport smoothing_;  // of their normals
  MultiVector onElements_; // curvatures
  std::shared_ptr<const FiniteElementSpace> space_;
  std::unique_ptr<FiniteElementSpace> weighted_;

  SignalInSpace signal_;
  std::optional<Field> scale_;
  std::optional<Field> fade_; // of the selection
  /// The load has blocks of columns: one for the scale 1, one for the scale array, and one for the
  /// product of fade and array. A solution with fewer blocks is a start for more.
  PoissonEquation equation_;
  Result result_;
};

} // namespace gridfem

#endif
