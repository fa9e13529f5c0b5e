/**
 * @class   vtkSurfaceFEMAlgorithm
 * @brief   base class of all surface finite element filters
 *
 * Holds the properties that have the same name and meaning in every filter. It also holds the
 * stages, which run again only if something they depend on has changed. The surface lies in a cube
 * of 2^Depth cells per side. The functions are the trilinear B-splines of the grid corners,
 * restricted to the surface.
 *
 * Every filter fails by the same rule:
 * - An input without points gives empty outputs and no message.
 * - An unusable input gives one error message and empty outputs. RequestData returns 0, and the
 *   error code is vtkErrorCode::UnknownError, also if one block of several fails. The pipeline
 *   prints no message of its own.
 * - If the user has not chosen something that the filter needs, the filter warns, and its output is
 *   the input. On several MPI ranks, and with BlocksAsOne, a missing choice is an error.
 * - A solver that does not converge warns, keeps its result, and sets the field array `Converged`
 *   (int, one value) to 0.
 * - An abort gives empty outputs, in all blocks, which are marked as aborted, so that downstream
 *   filters do not run (VTK 9.3 and later). The filter resets AbortExecute, so that the next run,
 *   after a change or for another time, is a full one.
 *
 * Field arrays that report on a run, such as `Converged` or `Misfit`, are of this run. Reports of
 * earlier filters do not pass.
 *
 * Input port 0 takes vtkPolyData with polygons of any size or triangle strips.
 * vtkDataSetSurfaceFilter extracts the surface of any other vtkDataSet. The outputs then lie on
 * this surface and have the arrays `vtkOriginalPointIds` and `vtkOriginalCellIds`. Each leaf of a
 * composite input is a surface by itself. With BlocksAsOne, all leaves are one surface. A leaf that
 * lacks an array of another leaf is passed on unchanged, with a warning. Vertices and lines take no
 * part. Neither do cells that vtkGhostType marks as hidden or as duplicates. The solvers pass these
 * cells on, and the clip leaves them out. Computation is in double precision. Results do not depend
 * on NumberOfThreads.
 *
 * Index 9 of SetInputArrayToProcess chooses the DomainArray, a point or cell array with one
 * component. The filter computes where it is neither 0 nor NaN, as if the rest of the surface were
 * cut away. A cell is inside if its value is, or if all values at its points are. The output of a
 * solver has all points and cells of the input.
 *
 * Points that no polygon inside the domain uses have NaN in all results, and so have cells without
 * an area and cells outside of the domain. Ids are -1 there, and colors stay as in the input. If a
 * filter moves points, these points stay in place and count as points at rest.
 *
 * On several MPI ranks, all ranks compute together if they can. No rank then gathers the surface,
 * which may be larger than one machine, and the field array `Distributed` is 1. This needs welded
 * points and the patch smoother, and excludes BlocksAsOne and a DomainArray. It works in most
 * solvers; the page of each filter gives details. Otherwise, rank 0 gathers the whole surface and
 * computes with its threads, while the other ranks sleep. Ghost cells count once. Points on borders
 * are joined by global point ids, or else by their coordinates with WeldCoincidentPoints. Rank 0
 * also gathers a surface with hanging nodes. Port 0 of each rank is its own input with additional
 * arrays, including borders and ghosts. Outputs with cells of their own, and tables, are on rank 0.
 * Ids of sources, and ids in messages, are ids in the gathered surface. The same ranks have to run
 * the filter together. If one fails, all fail with one message.
 *
 * A solver filter looks for its function space in this order:
 * - on input port 0, if that is the output of vtkConnectivityAwareBasis;
 * - on the optional input port 1, if that is connected. It must be the output of
 *   vtkConnectivityAwareBasis for the mesh of port 0.
 * - Otherwise the filter builds the space itself.
 *
 * Time: outputs have the time steps of the input. A filter requests from its input the time that is
 * requested from its outputs. Some filters have time steps of their own, such as modes. They
 * request one fixed time from their inputs: the last requested time, or else the time of the
 * inputs.
 *
 * Memory: a filter keeps the results of its steps, so that a change repeats only the steps that
 * depend on it. These results are the clipped mesh, its functions, element and level matrices, the
 * hierarchy with its smoothers, and the last result. With ReleaseDataFlagOn it frees them after
 * every run. This takes the least memory, but every change, even of the time step, repeats all
 * steps. Filters that share its basis then read the basis from its arrays.
 */
#ifndef vtkSurfaceFEMAlgorithm_h
#define vtkSurfaceFEMAlgorithm_h

#include "vtkGridFEMFiltersModule.h" // for export macro
#include "vtkPolyDataAlgorithm.h"

#include <memory> // for std::unique_ptr
#include <string> // for std::string
#include <vector> // for std::vector

/// Sets a number that has a range, and gives the range as vtkSetClampMacro does. A number out of
/// range becomes the nearest number in range, and the next run is refused with a message.
#define vtkSetInRangeMacro(name, type, least, most)                                                \
  virtual void Set##name(type value)                                                               \
  {                                                                                                \
    const type low = this->Get##name##MinValue();                                                  \
    const type high = this->Get##name##MaxValue();                                                 \
    const type inside = value < low ? low : value > high ? high : value;                           \
    if (this->NoteRange(#name, double(value), double(low), double(high)) || this->name != inside)  \
    {                                                                                              \
      this->name = inside;                                                                         \
      this->Modified();                                                                            \
    }                                                                                              \
  }                                                                                                \
  virtual type Get##name##MinValue()                                                               \
  {                                                                                                \
    return least;                                                                                  \
  }                                                                                                \
  virtual type Get##name##MaxValue()                                                               \
  {                                                                                                \
    return most;                                                                                   \
  }

namespace gridfem
{
class BlockTables;
class Domain;
class FailureDump;
class FilterState;
class InputBlocks;
class InputTime;
class JoinedBlocks;
class GatheredRanks;
class SelectedPoints;
class SurfaceInput;
} // namespace gridfem

class VTKGRIDFEMFILTERS_EXPORT vtkSurfaceFEMAlgorithm : public vtkPolyDataAlgorithm
{
public:
  vtkTypeMacro(vtkSurfaceFEMAlgorithm, vtkPolyDataAlgorithm);
  void PrintSelf(ostream& os, vtkIndent indent) override;

  ///@{
  /**
   * 2^Depth cells lie along the longest side of the bounding box. 2..14, default 7. With 0, the
   * filter chooses the finest grid, from 6 on, that has no more functions than the surface has
   * points and that fits into memory. 1 counts as 2. The field array `UsedDepth` gives the depth.
   */
  vtkSetInRangeMacro(Depth, int, 0, 14);
  vtkGetMacro(Depth, int);
  ///@}

  ///@{
  /**
   * When on, a function is split if its support meets the surface in several connected pieces. Each
   * piece gets a function, so sheets that are close in space do not interact. Default on.
   */
  vtkSetMacro(ConnectivityAware, bool);
  vtkGetMacro(ConnectivityAware, bool);
  vtkBooleanMacro(ConnectivityAware, bool);
  ///@}

  ///@{
  /**
   * When on, coincident points count as one for connectivity. Meshes from STL files need this.
   * Border points that coincide except for rounding count as one, too. Polygons are divided, for
   * the computation only, at hanging nodes on their sides. Two points count as one up to 1e-6 of
   * the longest side of the bounding box, and up to a thousandth of the shortest side of a triangle
   * there. The output keeps the input's points either way. Default on.
   */
  vtkSetMacro(WeldCoincidentPoints, bool);
  vtkGetMacro(WeldCoincidentPoints, bool);
  vtkBooleanMacro(WeldCoincidentPoints, bool);
  ///@}

  enum FunctionSpaceType
  {
    Grid = 0,
    HatFunctions = 1,
    SmoothGrid = 2
  };
  ///@{
  /**
   * The functions that make up the solution. Only solvers use this property.
   *
   * Grid (default) takes the functions of the grid. Depth determines how fine they are.
   *
   * HatFunctions takes the piecewise linear functions of the mesh itself, with cotangent stiffness
   * and consistent area mass. The result at the points is the result of a direct solver for the
   * same system. The grid only speeds up the iteration. The grid therefore becomes coarser than
   * Depth or a given basis if it would have more functions than the mesh has points. Spectra allow
   * up to four functions for each point, because they take their estimated errors from the grid.
   * The grid keeps its depth if its own solution counts: for distances, for details of stitched
   * colors, or for a wanted accuracy. The field array `UsedDepth` gives the depth.
   *
   * SmoothGrid takes quadratic B-splines of the grid, whose gradients are continuous. Smooth
   * solutions reach the same error at a Depth one to two steps smaller. NormalStabilization is at
   * least 1e-3 and QuadratureDegree at least 6. On several MPI ranks, the surface is gathered on
   * rank 0. Distances, held values and stitched colors refuse these functions.
   */
  vtkSetInRangeMacro(FunctionSpace, int, Grid, SmoothGrid);
  vtkGetMacro(FunctionSpace, int);
  ///@}

  ///@{
  /**
   * Polynomials up to this degree are integrated exactly on every clipped triangle: 2, 4, 6, 10 or
   * 12; default 2 (three points). The filter refuses another degree when it runs.
   */
  vtkSetMacro(QuadratureDegree, int);
  vtkGetMacro(QuadratureDegree, int);
  ///@}

  ///@{
  /**
   * The weight s of the squared normal derivative in the operator on a grid. Functions of the
   * surface have no such derivative. The default of 1e-12 only fixes functions that are zero on
   * flat parts of the surface. With 1e-2, iterations to small tolerances stay few on any surface
   * and for any Depth. The error of the space is then 1.1 to 1.4 times as large on scans and parts,
   * and two to four times on spheres and cubes. 1e-14..1. Hat functions have none.
   */
  vtkSetInRangeMacro(NormalStabilization, double, 1e-14, 1.0);
  vtkGetMacro(NormalStabilization, double);
  ///@}

  ///@{
  /**
   * The solver stops when its error measure has fallen by this factor. Each filter documents its
   * measure. Above 0, below 1.
   */
  vtkSetInRangeMacro(Tolerance, double, 1e-16, 0.999);
  vtkGetMacro(Tolerance, double);
  ///@}

  ///@{
  /**
   * The solver stops after this number of iterations and warns. At least 1. Each filter has its own
   * default.
   */
  vtkSetInRangeMacro(MaximumIterations, int, 1, VTK_INT_MAX);
  vtkGetMacro(MaximumIterations, int);
  ///@}

  ///@{
  /**
   * The number of threads. 0 (default) takes all processors. Results are the same for any number.
   */
  vtkSetInRangeMacro(NumberOfThreads, int, 0, 1024);
  vtkGetMacro(NumberOfThreads, int);
  ///@}

  /// Where solvers compute their cycles.
  enum Devices
  {
    AutomaticDevice = 0, // on an NVIDIA GPU if there is one and the problem gains by it
    CPU = 1,
    GPU = 2 // on an NVIDIA GPU if there is one
  };

  ///@{
  /**
   * Where solvers compute their cycles: AutomaticDevice (default), CPU or GPU. A GPU computes in
   * single precision. The solution meets the same tolerance, but may differ within it. If the GPU
   * cannot compute or fails, the CPU goes on. The field array Device of solvers names the device,
   * and the reason if it is the CPU. MPI ranks that compute together use no GPU.
   */
  vtkSetInRangeMacro(Device, int, AutomaticDevice, GPU);
  vtkGetMacro(Device, int);
  ///@}

  ///@{
  /**
   * When on, the leaves of a composite input are one surface. Leaves are joined at points with the
   * same global ids, or with the same coordinates if WeldCoincidentPoints is on. The filter
   * computes on it once, and every leaf gets its points, cells and results back. Points of several
   * leaves have one result. Field arrays describe the one surface. Outputs with cells of their own,
   * and tables, are in the first leaf.
   *
   * Ids of sources, and ids in messages, count through all leaves. Joined points count once. Only
   * arrays that all leaves have can be chosen. A leaf without a chosen array that others have is
   * passed on unchanged, with a warning.
   *
   * When off (default), every leaf is a surface by itself. The property has no effect on other
   * inputs.
   */
  vtkSetMacro(BlocksAsOne, bool);
  vtkGetMacro(BlocksAsOne, bool);
  vtkBooleanMacro(BlocksAsOne, bool);
  ///@}

  ///@{
  /**
   * The prefix of the names of all point and cell arrays of the results. It keeps the results of
   * several filters apart. Default: empty. Only solvers use it. If an array of the input has the
   * name of a result, it is kept as `name_input`.
   */
  vtkSetStdStringFromCharMacro(ResultPrefix);
  vtkGetCharFromStdStringMacro(ResultPrefix);
  ///@}

  enum ParameterUnitsType
  {
    World = 0,
    UnitArea = 1,
    UnitCube = 2
  };
  ///@{
  /**
   * The length unit of weights and times that are given as properties. World takes the units of the
   * points. UnitArea (default) takes the units of the surface scaled to area 1. UnitCube takes the
   * units of the surface scaled to a longest side of 1. Results are always in world units.
   */
  vtkSetInRangeMacro(ParameterUnits, int, World, UnitCube);
  vtkGetMacro(ParameterUnits, int);
  ///@}

  /**
   * The input of port 1: the basis. A filter without such a port reports an error.
   */
  void SetBasisConnection(vtkAlgorithmOutput* output);

  /**
   * The input of the last port: a selection of points or cells of port 0. A filter that takes no
   * selection reports an error.
   */
  void SetSelectionConnection(vtkAlgorithmOutput* output);

  /**
   * How often this filter has run a stage since it was made. A stage is repeated only if something
   * it depends on has changed. 0 for an unknown stage. Solvers have these stages:
   * - Space: mesh, clipping, patches, levels
   * - System: element matrices, patterns, prolongations
   * - RightHandSide: integrals of the given arrays
   * - Hierarchy: level matrices, smoothers
   * - Solve
   */
  vtkIdType GetNumberOfRuns(const char* stage);

  /**
   * The seconds that the last run of a stage took. 0 if it has not run.
   */
  double GetStageSeconds(const char* stage);

protected:
  vtkSurfaceFEMAlgorithm();
  ~vtkSurfaceFEMAlgorithm() override;

  /**
   * Port 0 is required and takes a surface. Port 1 takes a basis. Later ports take any data set.
   * The port of SetSelectionPort takes a selection.
   */
  int FillInputPortInformation(int port, vtkInformation* info) override;

  /**
   * Makes this port the last one, and lets it take a selection. The constructor of a derived filter
   * calls it.
   */
  void SetSelectionPort(int port);

  /**
   * Evaluates the selection on the surface in use. Collective on a shared surface.
   */
  void ReadSelection(vtkInformationVector** inputs);

  int RequestInformation(
    vtkInformation* request, vtkInformationVector** inputs, vtkInformationVector* outputs) final;
  int RequestUpdateExtent(
    vtkInformation* request, vtkInformationVector** inputs, vtkInformationVector* outputs) final;

  /**
   * The ascending time steps of a filter that shows its own results by time. Empty (default) if the
   * input gives the times. Called again after Compute, which may find other steps.
   */
  virtual std::vector<double> OwnTimeSteps();

  /// The remaining error of the solver may be this part of the error of the function space. With 0
  /// the solver iterates to the Tolerance.
  virtual double WantedAccuracy() const { return 0.0; }

  /**
   * Applies the failure rule around Compute.
   */
  int RequestData(
    vtkInformation* request, vtkInformationVector** inputs, vtkInformationVector* outputs) final;

  /**
   * Computes the outputs from a non-empty input. Throws on unusable input and on abort.
   */
  virtual void Compute(vtkInformationVector** inputs, vtkInformationVector* outputs) = 0;

  /**
   * Whether the filter, with its current properties, needs the whole surface in one process. Then
   * (default) rank 0 gathers the surface. Otherwise Compute runs on all MPI ranks, each with its
   * own piece, which may be null on port 0.
   */
  virtual bool NeedsWholeSurface();

  /**
   * Notes whether a property was given a value out of its range, which the next run refuses.
   * Returns whether the note has changed.
   */
  bool NoteRange(const char* property, double value, double least, double most);

  /**
   * Prints the warnings. Only the first of several MPI ranks prints.
   */
  void Warn(const std::vector<std::string>& warnings);

  /**
   * Whether the results of a run stay for the next run. They stay without ReleaseDataFlag.
   */
  bool KeepsStages();

  /**
   * Frees everything that the next runs could use. A derived filter also frees the stages it keeps
   * itself.
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
  int Device = AutomaticDevice;
  int ParameterUnits = UnitArea;
  bool BlocksAsOne = false;
  std::string ResultPrefix;

  std::unique_ptr<gridfem::FilterState> State;
  std::unique_ptr<gridfem::SelectedPoints> Selection; // null without a port for it

private:
  vtkSurfaceFEMAlgorithm(const vtkSurfaceFEMAlgorithm&) = delete;
  void operator=(const vtkSurfaceFEMAlgorithm&) = delete;

  void BeginBlocks();
  void EndBlocks();
  int RunCompute(vtkInformationVector** inputs, vtkInformationVector* outputs);
  void ComputeAlone(vtkInformationVector** inputs, vtkInformationVector* outputs);
  void ComputeBlock(vtkInformationVector** inputs, vtkInformationVector* outputs);
  void ComputeJoinedBlocks(vtkInformationVector** inputs);
  void ComputeSurface(vtkInformationVector** inputs, vtkInformationVector* outputs);
  void ComputeInside(vtkInformationVector** inputs, vtkInformationVector* outputs);
  void ComputeOnRanks(vtkInformationVector** inputs, vtkInformationVector* outputs);
  bool TryTogether(vtkInformationVector** inputs, vtkInformationVector* outputs);
  void UseSurface(bool isPiece);
  void WriteDepth(vtkInformationVector* outputs);
  bool HasNoPoints(vtkInformationVector** inputs) const;
  const gridfem::JoinedBlocks* JoinedInput() const;
  std::vector<double> TimeSteps();
  void FinishAbort(vtkInformationVector* outputs);

  int SelectionPort = -1;      // none
  bool IsBlockAborted = false; // in this execution
  std::unique_ptr<gridfem::SurfaceInput> Surface;
  std::unique_ptr<gridfem::Domain> Inside;
  std::unique_ptr<gridfem::InputTime> Time;
  std::unique_ptr<gridfem::FailureDump> Dump;
  std::unique_ptr<gridfem::GatheredRanks> Ranked;
  std::unique_ptr<gridfem::InputBlocks> Blocks;
  std::unique_ptr<gridfem::JoinedBlocks> Joined;
  std::unique_ptr<gridfem::BlockTables> Tables;
};

#endif
