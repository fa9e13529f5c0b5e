// Computes the mean-curvature flow of a surface. It keeps some of the steps, so that any step can
// be shown again.
#ifndef GridFEM_FlowSolver_h
#define GridFEM_FlowSolver_h

#include "Shape/MeanCurvatureFlow.h"
#include "Solvers/OptionFields.h"
#include "Solvers/Surface.h"

#include <limits>
#include <map>
#include <memory>
#include <string>
#include <vector>

namespace gridfem
{

/// The stage that makes one more step, or makes one again.
inline constexpr const char* StepStage = "Step";

/// Continues from the last step if more steps of the same length are asked for. Fewer steps compute
/// nothing. A caller holds a MemoryReuse over an update.
class FlowSolver
{
public:
  enum class Rescale
  {
    Automatic = 0, // ConstantArea if conformalized, else None
    None = 1,
    ConstantArea = 2,
    ConstantVolume = 3
  };

  struct Options
  {
    EquationOptions equation = OfStep();
    double timeStep = 5e-5; // squared parameter units, above 0
    int numberOfSteps = 10;
    bool conformalized = false; // keep the stiffness of the start
    bool trackMetric = true;    // else the moved mesh is clipped again in each step
    bool fixedBoundary = false;
    Rescale rescale = Rescale::Automatic;

    template<class Self, class Visit>
    static void ForEach(Self& self, Visit&& visit)
    {
      visit(self.equation);
      visit("TimeStep", self.timeStep, Finite());
      visit("NumberOfSteps", self.numberOfSteps, Within(1, 100000));
      visit("Conformalized", self.conformalized, AnyValue());
      visit("TrackMetric", self.trackMetric, AnyValue());
      visit("FixedBoundary", self.fixedBoundary, AnyValue());
      visit("Rescale", self.rescale, Within(0, 3));
    }
  };

  struct Step : FlowStep // time in squared world units
  {
    double quasiConformalError = 1.0; // mean over the surface
    double seconds = 0.0;
  };

  struct Result
  {
    std::vector<Step> steps;           // the start and the steps made, at most as many as wanted
    std::vector<std::string> warnings; // about the steps that this update has made
  };

  static SurfaceOptions SurfaceDefaults() { return {}; }

  /// @param cacheBytes  memory for the shapes of kept steps; the last shape is always kept
  explicit FlowSolver(double cacheBytes = 1e9) : cacheBytes_(cacheBytes) {}

  /// Makes the steps that are missing. After an abort the steps so far are kept. Throws
  /// InvalidInput and Aborted.
  const Result& Update(Surface& surface, const Options& options, const Job& job);

  /// The points of the mesh at a step of the last result. A step that is not kept is made again
  /// from the nearest kept step before it. The bits do not depend on which steps are kept.
  std::vector<Vec3> PointsAt(int step, const Surface& surface, const Progress& progress = {});

  /// Whether all wanted steps were made, and all steps up to this one have converged.
  bool HasConverged(int step) const;

  /// Runs all steps on a mesh of this process.
  /// @param points  receives the points after the last step
  static Result Solve(std::shared_ptr<const TriangleMesh> mesh, const Options& options,
    std::vector<Vec3>& points, const SurfaceOptions& surfaceOptions = SurfaceDefaults(),
    const Job& job = {});

private:
  static EquationOptions OfStep();

  void Restart(const Surface& surface, const Options& options);
  bool MakeSteps(const Surface& surface, const Progress& progress);
  void ReturnTo(int step);
  FlowStep Advance(const Surface& surface, const Progress& progress);
  Step Measured(const FlowStep& made, const Surface& surface) const;
  void Keep();
  void KeepBudget();
  std::string Warning(const Surface& surface, bool conformalized) const;

  const double cacheBytes_;
  int wanted_ = 0; // number of steps
  std::unique_ptr<MeanCurvatureFlow> flow_;
  std::vector<Step> made_; // the start and all steps made
  FlowEnd end_ = FlowEnd::None;
  std::map<int, MultiVector> kept_; // shapes; the last step always has one
  int stride_ = 1;                  // of the steps that are kept
  std::int64_t advances_ = 0;
  Result result_;
};

} // namespace gridfem

#endif
