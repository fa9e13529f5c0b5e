// Lets patterns grow, waves run and concentrations drift over a surface, frame by frame.
#ifndef GridFEM_DynamicsSolver_h
#define GridFEM_DynamicsSolver_h

#include "Equations/Evolution.h"
#include "Equations/Reactions.h"
#include "Solvers/GivenField.h"
#include "Solvers/OptionFields.h"
#include "Solvers/Surface.h"

#include <limits>
#include <memory>
#include <string>
#include <vector>

namespace gridfem
{

/// What happens on the surface. See Reactions.h, DampedWave and ReactionDiffusion.
enum class DynamicsModel
{
  TuringSpots = 0,
  GrayScott = 1,
  FitzHughNagumo = 2,
  AllenCahn = 3,
  Wave = 4,      // u'' + Damping u' = Δu
  Transport = 5, // u' + div(u w) = Diffusivity Δu with a given velocity w
  Custom = 6     // u' = Diffusivity Δu + R(u, v) and v' = DiffusivityV Δv + S(u, v), or u alone
};

/// Reactions of one or two species, or none.
struct GivenReactions
{
  explicit operator bool() const { return species > 0; }

  int species = 0; // 0: none are given
  StageKey version;
  ReactionRates rates;
};

/// Solves an equation in time from a given or a random start. It keeps the frames: more frames of
/// the same length continue from the last one. One process has to hold the surface.
class DynamicsSolver
{
public:
  struct Options
  {
    EquationOptions equation = EndedByTolerance(1e-4);
    DynamicsModel model = DynamicsModel::TuringSpots;
    double patternLength = 0.1; // of spots, waves or the first bump; parameter units, above 0
    int numberOfSteps = 20;     // frames after the start
    /// Time between two frames; 0: a time in which the pattern changes visibly, 1 for Custom. The
    /// solver makes as many steps in between as are needed. The unit is that of the reactions. A
    /// wave needs one unit of time for one parameter unit of length.
    double timeStep = 0.0;
    int seed = 1;
    double feed = 0.037;  // of Gray-Scott
    double kill = 0.06;   // of Gray-Scott
    double damping = 0.0; // of the wave, per unit of time
    /// The diffusivity of Transport, above 0, and of u with Custom; squared parameter units per
    /// time.
    double diffusivity = 1e-4;
    double diffusivityV = 4e-3; // of v with Custom; squared parameter units per time

    template<class Self, class Visit>
    static void ForEach(Self& self, Visit&& visit)
    {
      visit(self.equation);
      visit("Model", self.model, Within(0, 6));
      visit("PatternLength", self.patternLength, AtLeast(0.0));
      visit("NumberOfSteps", self.numberOfSteps, Within(1, 100000));
      visit("TimeStep", self.timeStep, AtLeast(0.0));
      visit("Seed", self.seed, Within(0, std::numeric_limits<int>::max()));
      visit("Feed", self.feed, Within(0.0, 1.0));
      visit("Kill", self.kill, Within(0.0, 1.0));
      visit("Damping", self.damping, AtLeast(0.0));
      visit("Diffusivity", self.diffusivity, AtLeast(0.0));
      visit("DiffusivityV", self.diffusivityV, AtLeast(0.0));
    }
  };

  struct Input
  {
    /// Values at time 0: a component for each of the first species. The others are at rest.
    GivenField start;
    /// Points that are disturbed at time 0, where no start is given. Their values do not count.
    GivenConstraints disturbed;
    GivenField velocity;      // of the transport, world units of length per time; three components
    GivenReactions reactions; // of Custom
  };

  struct Frame
  {
    MultiVector atPoints; // u and, where there are two, v; of a wave v = u'
    SolveReport report;   // of the worst solve since the frame before
    /// The largest of Evolution::ExtrapolationErrors since the start, beside the largest value.
    double extrapolationError;
    Columns integral; // of each column over the surface, in squared world units
    double energy;    // Evolution::Energy in squared world units; NaN unless of a wave
  };

  struct Result
  {
    std::vector<Frame> frames;         // the first is the start
    double timeStep = 0.0;             // from frame to frame
    std::vector<std::string> warnings; // about all frames; from Solve also about the last one
  };

  /// The default options of the surface. The grid is coarse, because ten functions resolve a
  /// pattern.
  static SurfaceOptions SurfaceDefaults();

  /// Makes the frames that are missing. After an abort the frames so far are kept. Throws
  /// InvalidInput and Aborted.
  const Result& Update(
    Surface& surface, const Input& input, const Options& options, const Job& job = {});

  /// The warnings about a frame of the last update, from 0. Empty if there are none.
  std::vector<std::string> Warnings(int frame) const;

  /// Makes all frames.
  static Result Solve(std::shared_ptr<const TriangleMesh> mesh, const Input& input,
    const Options& options, const SurfaceOptions& surfaceOptions = SurfaceDefaults(),
    const Job& job = {});

private:
  void UpdateEquation(
    const Surface& surface, const Input& input, const Options& options, const Job& job);
  void BuildEquation(
    const Surface& surface, const Input& input, const Options& options, const Job& job);
  void UpdateStart(
    const Surface& surface, const Input& input, const Options& options, const Job& job);
  void MakeFrames(
    const Surface& surface, const Input& input, const Options& options, const Job& job);
  Frame NextFrame(
    const Surface& surface, const Input& input, const Options& options, const Job& job);
  void MakeSubsteps(const Job& job);
  Frame FrameNow(const Surface& surface) const;

  std::unique_ptr<Evolution> equation_; // null: it has to be made with shorter steps
  int refinement_ = 1;                  // of the usual steps
  int substeps_ = 1;                    // from frame to frame
  MultiVector start_;
  SolveReport startReport_; // of the worse of its solves
  StageKey ofFrames_;
  MultiVector frameStart_;   // the coefficients of the last frame
  int substepsMade_ = 0;     // since the last frame; more than 0 after an abort
  SolveReport report_;       // of the worst of them
  Columns errors_;           // the largest extrapolation errors of these
  Columns largestOfFrame_;   // the largest values since the start, with these
  Columns largest_;          // the largest values from the start to the last frame
  Columns errorsSinceStart_; // the largest ones to the last frame
  double tolerance_ = 0.0;   // of the last update
  bool isCustom_ = false;    // in the last update
  Result result_;
};

} // namespace gridfem

#endif
