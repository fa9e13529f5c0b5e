/**
 * @class   vtkSurfaceDynamics
 * @brief   let patterns grow, waves run and concentrations drift over a surface
 *
 * Solves one of several equations in time on the surface, from a given or a random start. Every
 * frame is a time step of the output. The Model chooses the equations:
 * - TuringSpots: du/dt = D Δu + 0.1 - u + u²v and dv/dt = 40 D Δv + 0.9 - u²v. Spots grow.
 * - GrayScott: du/dt = D Δu - uv² + F (1 - u) and dv/dt = D/2 Δv + uv² - (F + k) v, with Feed F and
 *   Kill k. Spots, stripes or waves.
 * - FitzHughNagumo: du/dt = D Δu + u - u³/3 - v and dv/dt = 0.08 (u + 0.7 - v/2). Spiral waves.
 * - AllenCahn: du/dt = D Δu + u - u³. Two phases, whose fronts move by their curvature.
 * - Wave: d²u/dt² + Damping du/dt = Δu, with v = du/dt.
 * - Transport: du/dt + div(u w) = Diffusivity Δu with the velocity w of VelocityArray.
 * - Custom: du/dt = Diffusivity Δu + ReactionU and dv/dt = DiffusivityV Δv + ReactionV. The
 *   reactions are formulas of u and v. Without a formula for v there is u alone.
 *
 * PatternLength determines D: it is about the distance between two spots, stripes or waves. Custom
 * has diffusivities instead. Steps in time are of second order. Linear terms are implicit,
 * reactions and transport explicit. Nothing flows over boundaries.
 *
 * Input port 0: vtkPolyData with polygons or triangle strips, or the output of
 * vtkConnectivityAwareBasis.
 * Input port 1 (optional): the output of vtkConnectivityAwareBasis for the mesh of port 0.
 * Input port 2 (optional): vtkSelection of points or cells of port 0, where the surface is
 * disturbed at time 0.
 *
 * SetInputArrayToProcess chooses the arrays:
 * - index 0: the start, point or cell data. The first component is u, an optional second one is v.
 *   Without it the start is a disturbance of the selection. Without a selection it is noise, or one
 *   bump for Wave and Transport.
 * - index 1: the velocity of Transport, point or cell data with three components, in world length
 *   per time.
 *
 * Output port 0 (vtkPolyData): the input with the following arrays.
 * - point data: `U` and, unless the Model has one unknown, `V` (double, 1).
 * - field data: `Step` (int, 1), `Time` (double, 1), `Integral` (double, one component for each of
 *   u and v; squared world length) and, for Wave, `Energy` (double, 1). `Energy` includes a small
 *   term of |∇v|², which belongs to the mass of the scheme.
 * - field data, of all solves since the step before: `Converged`, `Iterations`,
 *   `DoublePrecisionSince`, `Residual` and `ConvergenceFactor`.
 *
 * Time: the steps are the time steps 0 .. NumberOfSteps. A request without a time gets the last
 * step. Steps are computed once and kept. A later step continues from the last one.
 *
 * The filter uses all shared properties except Accuracy and TrackMetric. By default Depth
 * is 6, Tolerance 1e-4 and NormalStabilization 1e-2. SmoothGrid functions are refused.
 * PatternLength and diffusivities are in the unit of length of ParameterUnits. On several MPI ranks
 * the surface is gathered.
 */
#ifndef vtkSurfaceDynamics_h
#define vtkSurfaceDynamics_h

#include "vtkSurfaceFEMAlgorithm.h"

#include <string>

class VTKGRIDFEMFILTERS_EXPORT vtkSurfaceDynamics : public vtkSurfaceFEMAlgorithm
{
public:
  static vtkSurfaceDynamics* New();
  vtkTypeMacro(vtkSurfaceDynamics, vtkSurfaceFEMAlgorithm);
  void PrintSelf(ostream& os, vtkIndent indent) override;

  enum ModelType
  {
    TuringSpots = 0,
    GrayScott = 1,
    FitzHughNagumo = 2,
    AllenCahn = 3,
    Wave = 4,
    Transport = 5,
    Custom = 6
  };
  ///@{
  /**
   * The equations. Default TuringSpots.
   */
  vtkSetInRangeMacro(Model, int, TuringSpots, Custom);
  vtkGetMacro(Model, int);
  ///@}

  ///@{
  /**
   * About the distance between two spots, stripes or waves, or the width of the first bump, in the
   * unit of length of ParameterUnits. Above 0, default 0.1.
   */
  vtkSetMacro(PatternLength, double);
  vtkGetMacro(PatternLength, double);
  ///@}

  ///@{
  /**
   * The number of time steps of the output after the start. 1..100000, default 20.
   */
  vtkSetInRangeMacro(NumberOfSteps, int, 1, 100000);
  vtkGetMacro(NumberOfSteps, int);
  ///@}

  ///@{
  /**
   * The time between two steps of the output, in the unit of the equations. A wave travels one unit
   * of length of ParameterUnits in one unit of time. 0 (default): a time in which the pattern
   * changes visibly; for Custom 1, or a hundred steps of the solver if that is shorter. The solver
   * makes as many steps in between as are needed.
   */
  vtkSetMacro(TimeStep, double);
  vtkGetMacro(TimeStep, double);
  ///@}

  ///@{
  /**
   * The seed of a random start. 0 or more, default 1.
   */
  vtkSetInRangeMacro(Seed, int, 0, VTK_INT_MAX);
  vtkGetMacro(Seed, int);
  ///@}

  ///@{
  /**
   * The feed rate F and the kill rate k of GrayScott. 0 or more, default 0.037 and 0.06.
   */
  vtkSetMacro(Feed, double);
  vtkGetMacro(Feed, double);
  vtkSetMacro(Kill, double);
  vtkGetMacro(Kill, double);
  ///@}

  ///@{
  /**
   * The damping of Wave, per unit of time. 0 or more, default 0.
   */
  vtkSetMacro(Damping, double);
  vtkGetMacro(Damping, double);
  ///@}

  ///@{
  /**
   * The diffusivity of Transport, and of u with Custom, in the squared unit of length of
   * ParameterUnits per time. Above 0 for Transport, else 0 or more. Default 1e-4.
   */
  vtkSetMacro(Diffusivity, double);
  vtkGetMacro(Diffusivity, double);
  ///@}

  ///@{
  /**
   * The diffusivity of v with Custom. 0 or more, default 4e-3.
   */
  vtkSetMacro(DiffusivityV, double);
  vtkGetMacro(DiffusivityV, double);
  ///@}

  ///@{
  /**
   * The reactions of Custom: formulas of u and v for vtkExprTkFunctionParser. An empty ReactionV
   * means that there is u alone. The default, 0.1 - u + u^2*v and 0.9 - u^2*v, grows spots. Without
   * an array or a selection, u and v start from noise between 0 and 1.
   */
  vtkSetStdStringFromCharMacro(ReactionU);
  vtkGetCharFromStdStringMacro(ReactionU);
  vtkSetStdStringFromCharMacro(ReactionV);
  vtkGetCharFromStdStringMacro(ReactionV);
  ///@}

protected:
  vtkSurfaceDynamics();
  ~vtkSurfaceDynamics() override;

  std::vector<double> OwnTimeSteps() override;
  void Compute(vtkInformationVector** inputs, vtkInformationVector* outputs) override;
  void FreeStages() override;

  int Model = TuringSpots;
  double PatternLength = 0.1;
  int NumberOfSteps = 20;
  double TimeStep = 0.0;
  int Seed = 1;
  double Feed = 0.037;
  double Kill = 0.06;
  double Damping = 0.0;
  double Diffusivity = 1e-4;
  double DiffusivityV = 4e-3;
  std::string ReactionU = "0.1 - u + u^2*v";
  std::string ReactionV = "0.9 - u^2*v";

private:
  vtkSurfaceDynamics(const vtkSurfaceDynamics&) = delete;
  void operator=(const vtkSurfaceDynamics&) = delete;

  void WriteStep(int shown, vtkPolyData* input, vtkPolyData* output);

  struct Internals;
  std::unique_ptr<Internals> Data;
};

#endif
