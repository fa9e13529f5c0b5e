// Mean-curvature flow of a filter's surface: its steps, of which some are kept, so that any of them
// can be shown again.
#ifndef GridFEM_SurfaceFlow_h
#define GridFEM_SurfaceFlow_h

#include "SurfaceSolverState.h"

#include "Problems/MeanCurvatureFlow.h"

#include <map>
#include <memory>
#include <string>
#include <vector>

namespace gridfem
{

/// The stage that makes one more step, or makes one again.
inline constexpr const char* StepStage = "Step";

struct FlowRequest
{
  double timeStep = 5e-5; // squared length of the parameter units
  int numberOfSteps = 10;
  bool conformalized = false;
  bool trackMetric = true;
  bool fixedBoundary = false;
  Rescaling rescaling = Rescaling::None;
  double keptBytes = 1e9; // for steps that are kept
};

/// A row of the table.
struct FlowRow : FlowStep
{
  double quasiConformalError = 1.0; // mean over the surface
  double seconds = 0.0;
};

/// All methods throw InvalidInput and Aborted; after an abort the steps so far are kept.
class SurfaceFlow
{
public:
  /// Makes the steps that are missing up to the wanted number. The space has to be up to date.
  /// @return  whether a step was made or the flow has ended
  bool Update(SurfaceSolverState& state, const FlowRequest& request, const Progress& progress);

  /// The start and the steps made, as many as are wanted.
  std::vector<FlowRow> Rows() const;

  /// The points of the mesh at a step of the rows; from the nearest kept step before it where it is
  /// not kept itself. The same bits whichever are kept.
  std::vector<Vec3> PointsAt(int step, SurfaceSolverState& state, const Progress& progress);

  /// What to warn of; empty when all is well.
  std::string Warning(const SurfaceSolverState& state) const;

private:
  void Restart(SurfaceSolverState& state);
  void ReturnTo(int step);
  FlowStep Advance(SurfaceSolverState& state, const Progress& progress);
  void Keep();
  void KeepBudget();

  FlowRequest request_;
  std::unique_ptr<MeanCurvatureFlow> flow_;
  std::vector<FlowRow> rows_;
  FlowEnd end_ = FlowEnd::None;
  std::map<int, MultiVector> kept_; // shapes; the last step's is always there
  int stride_ = 1;                  // of the steps that are kept
  std::int64_t advances_ = 0;
};

} // namespace gridfem

#endif
