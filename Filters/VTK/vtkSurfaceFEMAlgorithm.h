/**
 * @class   vtkSurfaceFEMAlgorithm
 * @brief   what all surface finite element filters share
 *
 * The surface is laid into a cube of 2^Depth cells per side; the functions are the trilinear
 * B-splines of the grid corners, restricted to the surface. This class holds the properties that
 * have the same name and meaning in every filter, the stages that are run again only when what they
 * depend on has changed, and the rule by which every filter fails:
 *
 * - An input without points gives empty outputs, silently.
 * - An unusable input gives one error message, empty outputs, and RequestData returns 0; the error
 *   code is vtkErrorCode::UnknownError then, and the pipeline prints nothing of its own.
 * - A solver that does not converge warns, keeps its result, and sets the field array `Converged`
 *   (int, one value) to 0.
 * - An abort gives empty outputs, which are marked as aborted, so that filters behind do not run
 *   (VTK 9.3 and later). The filter switches AbortExecute off again, so that the next run, after a
 *   change, is a full one.
 *
 * Input port 0 takes vtkPolyData with polygons of any size or triangle strips. Of any other
 * vtkDataSet the surface is taken, by vtkDataSetSurfaceFilter: outputs lie on it, with the arrays
 * `vtkOriginalPointIds` and `vtkOriginalCellIds`. A composite input is taken leaf by leaf, each as
 * a surface by itself, or all leaves as one surface with BlocksAsOne; a leaf that lacks an array
 * which another one has is passed on as it is, with a warning. Vertices, lines, and cells that
 * vtkGhostType marks as hidden or as duplicates take no part; the solvers pass them on, the clip
 * leaves them out. Computation is in double precision. Results do not depend on NumberOfThreads.
 *
 * On several MPI ranks all compute where they can, and none gathers the surface, which may be
 * larger than one machine: the field array `Distributed` is 1 then. They can on welded points, with
 * the patch smoother, without BlocksAsOne, and in most solvers, as the page of each filter says.
 * Where they cannot, the surface is gathered on rank 0, which computes with its threads and has to
 * hold all of it; the others sleep. Ghost cells count once, and points on borders are joined by
 * global point ids, or else by their coordinates with WeldCoincidentPoints. Port 0 is each rank's
 * own input plus arrays, borders and ghosts included; outputs with cells of their own, and tables,
 * are on rank 0. Ids, such as those of sources and in messages, count through the gathered surface.
 * The same ranks have to run the filter together. When one fails, all do, with one message.
 *
 * A solver filter finds its function space in this order: on input port 0, when that is the output
 * of vtkConnectivityAwareBasis; on the optional input port 1, when that is connected, which must be
 * the output of vtkConnectivityAwareBasis for the mesh of port 0; else it builds the space itself.
 *
 * Time: outputs have the time steps of the input, and the input is asked for the time that they are
 * asked for. A filter with time steps of its own, such as modes, has these instead, and asks its
 * inputs for one fixed time: the one they were asked for last, else the one they have.
 *
 * Memory: a filter keeps the results of its steps, so that a change repeats only the steps that
 * depend on it. It holds the clipped mesh, its functions, element and level matrices, the hierarchy
 * with its smoothers, and the last result. With ReleaseDataFlagOn it frees them after every run:
 * least memory, but every change, of the time step as well, repeats all steps. Filters that share
 * its basis then read the basis from its arrays.
 */
#ifndef vtkSurfaceFEMAlgorithm_h
#define vtkSurfaceFEMAlgorithm_h

#include "vtkGridFEMFiltersModule.h" // for export macro
#include "vtkPolyDataAlgorithm.h"

#include <memory> // for std::unique_ptr
#include <string> // for std::string
#include <vector> // for std::vector

namespace gridfem
{
class BlockTables;
class FailureDump;
class InputBlocks;
class InputTime;
class JoinedBlocks;
class RankedSurface;
class SurfaceInput;
class SurfaceSolverState;
} // namespace gridfem

class VTKGRIDFEMFILTERS_EXPORT vtkSurfaceFEMAlgorithm : public vtkPolyDataAlgorithm
{
public:
  vtkTypeMacro(vtkSurfaceFEMAlgorithm, vtkPolyDataAlgorithm);
  void PrintSelf(ostream& os, vtkIndent indent) override;

  ///@{
  /**
   * 2^Depth cells lie along the longest side of the bounding box. 2..14, default 7; 0: automatic,
   * the finest grid with no more functions than the surface has points, from 6 on, that fits into
   * memory. 1 is refused when the filter runs. The field array `UsedDepth` says which.
   */
  vtkSetClampMacro(Depth, int, 0, 14);
  vtkGetMacro(Depth, int);
  ///@}

  ///@{
  /**
   * When on, a function whose support meets the surface in several connected pieces is split, one
   * function per piece, so that sheets that are close in space do not feel each other. Default on.
   */
  vtkSetMacro(ConnectivityAware, bool);
  vtkGetMacro(ConnectivityAware, bool);
  vtkBooleanMacro(ConnectivityAware, bool);
  ///@}

  ///@{
  /**
   * When on, coincident points count as one for connectivity, as they have to in meshes from STL
   * files. The output keeps the input's points either way. Default on.
   */
  vtkSetMacro(WeldCoincidentPoints, bool);
  vtkGetMacro(WeldCoincidentPoints, bool);
  vtkBooleanMacro(WeldCoincidentPoints, bool);
  ///@}

  enum FunctionSpaceType
  {
    Grid = 0,
    HatFunctions = 1
  };
  ///@{
  /**
   * What solutions are made of. Grid (default): the functions of the grid, of which Depth says how
   * fine they are. HatFunctions: the piecewise linear functions of the mesh itself, with cotangent
   * stiffness and consistent area mass; the result at the points is that of a direct solver for the
   * same system, and the grid only speeds up the iteration. So it is coarser than Depth, or a basis
   * that is given, asks for where it would have more functions than the mesh has points; for
   * spectra, which take their estimated errors from it, more than four for each; not where its own
   * solution counts: for distances, for details of stitched colours, for a wanted accuracy.
   * The field array `UsedDepth` says how fine it is. Only the solvers use it.
   */
  vtkSetClampMacro(FunctionSpace, int, Grid, HatFunctions);
  vtkGetMacro(FunctionSpace, int);
  ///@}

  ///@{
  /**
   * Polynomials up to this degree are integrated exactly on every clipped triangle: 2, 4, 6, 10 or
   * 12; default 2 (three points). Another degree is refused when the filter runs.
   */
  vtkSetMacro(QuadratureDegree, int);
  vtkGetMacro(QuadratureDegree, int);
  ///@}

  ///@{
  /**
   * The weight s of the squared normal derivative in the operator on a grid, which no function of
   * the surface has. The default of 1e-12 only makes functions known that hide in flat parts of the
   * surface. With 1e-2 iterations to small tolerances stay few on any surface and for any Depth,
   * for an error of the space that is 1.1 to 1.4 times as large on scans and parts, two to four
   * times on spheres and cubes. 1e-14..1. Hat functions have none.
   */
  vtkSetClampMacro(NormalStabilization, double, 1e-14, 1.0);
  vtkGetMacro(NormalStabilization, double);
  ///@}

  ///@{
  /**
   * The solver stops when its error measure has fallen by this factor. What is measured is said by
   * the filter. Above 0, below 1.
   */
  vtkSetClampMacro(Tolerance, double, 1e-16, 0.999);
  vtkGetMacro(Tolerance, double);
  ///@}

  ///@{
  /**
   * The solver stops after this number of iterations and warns. At least 1; the filter says
   * the default.
   */
  vtkSetClampMacro(MaximumIterations, int, 1, VTK_INT_MAX);
  vtkGetMacro(MaximumIterations, int);
  ///@}

  ///@{
  /**
   * Threads to use; 0 (default) takes all processors. Results are the same for any number.
   */
  vtkSetClampMacro(NumberOfThreads, int, 0, 1024);
  vtkGetMacro(NumberOfThreads, int);
  ///@}

  ///@{
  /**
   * When on, the leaves of a composite input are one surface, joined at points with the same
   * coordinates as WeldCoincidentPoints says, or the same global ids. It is computed on once, and
   * every leaf gets its points, cells and results back; points of several leaves have one result.
   * Field arrays are those of the one surface; outputs with cells of their own, and tables, are in
   * the first leaf. Ids, such as those of sources and in messages, count through all leaves, points
   * that are joined once. Only arrays that all leaves have can be chosen; leaves without a chosen
   * one that others have are passed on as they are, with a warning. When off (default), every leaf
   * is a surface by itself. Without effect on other inputs.
   */
  vtkSetMacro(BlocksAsOne, bool);
  vtkGetMacro(BlocksAsOne, bool);
  vtkBooleanMacro(BlocksAsOne, bool);
  ///@}

  enum ParameterUnitsType
  {
    World = 0,
    UnitArea = 1,
    UnitCube = 2
  };
  ///@{
  /**
   * The length unit of weights and times that are given as properties: World takes the units of the
   * points, UnitArea (default) those of the surface scaled to area 1, UnitCube those of the surface
   * scaled to a longest side of 1. Results are always in world units.
   */
  vtkSetClampMacro(ParameterUnits, int, World, UnitCube);
  vtkGetMacro(ParameterUnits, int);
  ///@}

  /**
   * How often this filter has run a stage since it was made; a stage is repeated only when
   * something it depends on has changed. The stages of solvers are Space (mesh, clipping, patches,
   * levels), System (element matrices, patterns, prolongations), RightHandSide (integrals of the
   * given arrays), Hierarchy (level matrices, smoothers) and Solve. 0 for an unknown stage.
   */
  vtkIdType GetNumberOfRuns(const char* stage);

  /**
   * Seconds the last run of a stage took; 0 when it has not run.
   */
  double GetStageSeconds(const char* stage);

protected:
  vtkSurfaceFEMAlgorithm();
  ~vtkSurfaceFEMAlgorithm() override;

  int FillInputPortInformation(int port, vtkInformation* info) override;

  int RequestInformation(
    vtkInformation* request, vtkInformationVector** inputs, vtkInformationVector* outputs) final;
  int RequestUpdateExtent(
    vtkInformation* request, vtkInformationVector** inputs, vtkInformationVector* outputs) final;

  /**
   * The time steps, ascending, of a filter that shows something of its own by time; empty (default)
   * where the times are those of the input. Asked again after Compute, which may find other steps.
   */
  virtual std::vector<double> OwnTimeSteps();

  /// The part of the error of the function space that the solver may leave; 0: to the Tolerance.
  virtual double WantedAccuracy() const { return 0.0; }

  /**
   * Applies the failure rule around Compute.
   */
  int RequestData(
    vtkInformation* request, vtkInformationVector** inputs, vtkInformationVector* outputs) final;

  /**
   * What the filter does with a non-empty input. Throws on unusable input and on abort.
   */
  virtual void Compute(vtkInformationVector** inputs, vtkInformationVector* outputs) = 0;

  /**
   * Whether the filter, as it is set, needs the whole surface in one process. Where it does not,
   * Compute runs on all MPI ranks, each with its own piece, which may be null on port 0. Default
   * true: rank 0 gathers the surface.
   */
  virtual bool NeedsWholeSurface();

  /**
   * Prints the warnings, on the first of several MPI ranks.
   */
  void Warn(const std::vector<std::string>& warnings);

  /**
   * Called on every one of several MPI ranks, with its own piece, before the surface is gathered.
   * Returns, the same on all, whether they have filled their outputs together, so that nothing is
   * gathered. Collective. By default there is no such way.
   */
  virtual bool ComputeTogether(vtkInformationVector** inputs, vtkInformationVector* outputs);

  /**
   * Whether the results of a run stay for the next one: without ReleaseDataFlag.
   */
  bool KeepsStages();

  /**
   * The blocks that the surface is joined of; null when it is not.
   */
  const gridfem::JoinedBlocks* JoinedInput() const;

  /**
   * Frees all that was made for the next runs. A filter adds what it keeps itself.
   */
  virtual void FreeStages();

  int Depth = 7;
  bool ConnectivityAware = true;
  bool WeldCoincidentPoints = true;
  int FunctionSpace = Grid;
  int QuadratureDegree = 2;
  double NormalStabilization = 1e-12;
  double Tolerance = 1e-8;
  int MaximumIterations = 100;
  int NumberOfThreads = 0;
  int ParameterUnits = UnitArea;
  bool BlocksAsOne = false;

  std::unique_ptr<gridfem::SurfaceSolverState> State;

private:
  vtkSurfaceFEMAlgorithm(const vtkSurfaceFEMAlgorithm&) = delete;
  void operator=(const vtkSurfaceFEMAlgorithm&) = delete;

  int RunCompute(vtkInformationVector** inputs, vtkInformationVector* outputs);
  void ComputeAlone(vtkInformationVector** inputs, vtkInformationVector* outputs);
  void ComputeBlock(vtkInformationVector** inputs, vtkInformationVector* outputs);
  void ComputeJoinedBlocks(vtkInformationVector** inputs);
  void ComputeSurface(vtkInformationVector** inputs, vtkInformationVector* outputs);
  void ComputeOnRanks(vtkInformationVector** inputs, vtkInformationVector* outputs);
  bool TryTogether(vtkInformationVector** inputs, vtkInformationVector* outputs);
  bool HasNoPoints(vtkInformationVector** inputs) const;
  std::vector<double> TimeSteps();
  void FinishAbort(vtkInformationVector* outputs);

  std::unique_ptr<gridfem::SurfaceInput> Surface;
  std::unique_ptr<gridfem::InputTime> Time;
  std::unique_ptr<gridfem::FailureDump> Dump;
  std::unique_ptr<gridfem::RankedSurface> Ranked;
  std::unique_ptr<gridfem::InputBlocks> Blocks;
  std::unique_ptr<gridfem::JoinedBlocks> Joined;
  std::unique_ptr<gridfem::BlockTables> Tables;
};

#endif
