/**
 * @class   vtkGeodesicDistance
 * @brief   distance along a surface from the nearest of some points
 *
 * Computes the distance by the heat method (Crane, Weischedel, Wardetzky 2013). Heat spreads from
 * the sources for a short time t. The distance grows in the direction in which the heat falls. The
 * result is the function whose gradient is nearest to these directions. The filter solves two
 * equations. It keeps everything that does not depend on the sources, so a change of the sources
 * repeats only the two solves.
 *
 * The sources are all of the following points together:
 * - the points in SourcePointIds;
 * - the points where the SourceArray is not 0;
 * - the mesh points nearest to the points of input port 2, and to places along its lines that are
 *   at most half a mean edge apart;
 * - the points in the selection of port 3;
 * - with UseSourcePosition, the mesh point nearest to SourcePosition.
 *
 * If none of these is given, the source is the first point of the surface: the one with the
 * smallest id that a polygon uses. If all corners of a triangle are sources, the distance is 0 on
 * the whole triangle. A warning appears if more than half of the points have no distance.
 *
 * With Signed on, distances are from a curve instead, and they are negative inside. The curve is
 * the border of the points or cells whose LabelArray is InsideLabel. If no LabelArray is chosen, it
 * consists of the lines of input port 2, moved to the nearest places of the surface. Lines may come
 * in pieces. They have to divide the surface: each curve is closed or goes from border to border.
 * On each connected component the smaller part is inside. Every part of a curve is a source, not
 * only its points.
 *
 * Input port 0: vtkPolyData with polygons or triangle strips, or the output of
 * vtkConnectivityAwareBasis.
 * Input port 1 (optional): the output of vtkConnectivityAwareBasis for the mesh of port 0.
 * Input port 2 (optional): vtkDataSet whose points and lines are sources, each place at the nearest
 * point of the mesh. A warning tells if points are far from the surface.
 * Input port 3 (optional): vtkSelection of points or cells of port 0. A selected cell selects its
 * points.
 *
 * SetInputArrayToProcess(0, ...) chooses the SourceArray: point data with one component.
 * SetInputArrayToProcess(1, ...) chooses the LabelArray: integers on points or cells.
 *
 * Output port 0 (vtkPolyData): the input with the following arrays.
 * - point data, double: `Distance`, in the unit of the points. It is 0 at sources and negative only
 *   inside a curve. Its absolute value is never below the straight distance through space from the
 *   sources or the curve. It is NaN on a component without a source and at points that no polygon
 *   uses.
 * - point data, vtkIdType, with NearestSource on: `NearestSource`, the id of the nearest source. It
 *   is -1 where no source can be reached.
 * - field data, of the solve for the distance: `Converged`, `Iterations`, `DoublePrecisionSince`,
 *   `Residual`, `ConvergenceFactor`. `Converged` is also 0 if the heat has not settled or does not
 *   reach the whole surface.
 * - field data: `HeatSweeps` (double, 1).
 *
 * Errors are proportional to the size of the functions. They are sqrt(t) / 2 to sqrt(t) near
 * boundaries and where fronts meet, and a small fraction of sqrt(t) elsewhere. Sheets that are
 * closer to each other than a cell do not interact while ConnectivityAware is on.
 *
 * Tolerance (default 1e-4) is on the solve for the distance from its gradient, as in
 * vtkScreenedPoisson. The heat is always solved to the same relative accuracy everywhere.
 * NormalStabilization is 0.1 to 1, 0.1 by default: with a smaller value, functions that are almost
 * zero on the surface give heat of the wrong sign at sharp edges, and distances far too small. The
 * filter uses all shared properties but ParameterUnits.
 *
 * All MPI ranks compute together if the sources are a SourceArray, a selection or the first point.
 * Rank 0 gathers the surface and computes alone with SourcePointIds, Sources, UseSourcePosition,
 * Signed, NearestSource, or a Smoothing of 3.5 or more. SourcePointIds count through the gathered
 * surface.
 */
#ifndef vtkGeodesicDistance_h
#define vtkGeodesicDistance_h

#include "vtkSurfaceFEMAlgorithm.h"

class vtkDataSet;

class VTKGRIDFEMFILTERS_EXPORT vtkGeodesicDistance : public vtkSurfaceFEMAlgorithm
{
public:
  static vtkGeodesicDistance* New();
  vtkTypeMacro(vtkGeodesicDistance, vtkSurfaceFEMAlgorithm);
  void PrintSelf(ostream& os, vtkIndent indent) override;

  ///@{
  /**
   * Points from which distances start, in addition to the sources of the SourceArray, of port 2 and
   * of port 3. None by default. The filter refuses an id that no polygon uses when it runs.
   */
  void AddSourcePointId(vtkIdType id);
  void ClearSourcePointIds();
  vtkIdType GetNumberOfSourcePointIds();
  vtkIdType GetSourcePointId(vtkIdType index);
  ///@}

  ///@{
  /**
   * Whether the mesh point nearest to SourcePosition is a source, in addition to the other sources.
   * Off by default.
   */
  vtkSetMacro(UseSourcePosition, bool);
  vtkGetMacro(UseSourcePosition, bool);
  vtkBooleanMacro(UseSourcePosition, bool);
  ///@}

  ///@{
  /**
   * A place in space, in the unit of the points. The filter refuses a coordinate that is not finite
   * when it runs. Default (0, 0, 0).
   */
  vtkSetVector3Macro(SourcePosition, double);
  vtkGetVector3Macro(SourcePosition, double);
  ///@}

  ///@{
  /**
   * sqrt(t), in units of the mean distance between grid functions that overlap, which is 1.2 cells.
   * A larger value rounds the distance off where fronts meet and takes somewhat longer. A value
   * below 0.9 makes the heat oscillate and the distance wrong; the filter refuses it when it runs.
   * 0.9..1000, default 1.2.
   */
  vtkSetMacro(Smoothing, double);
  vtkGetMacro(Smoothing, double);
  ///@}

  ///@{
  /**
   * Whether to output the point array `NearestSource`. It divides the surface into regions whose
   * points have the same nearest source. The borders of the regions are accurate to a few cells.
   * Off by default.
   */
  vtkSetMacro(NearestSource, bool);
  vtkGetMacro(NearestSource, bool);
  vtkBooleanMacro(NearestSource, bool);
  ///@}

  ///@{
  /**
   * Whether distances are from curves, negative inside. SourcePointIds, SourceArray, a selection,
   * UseSourcePosition and NearestSource need points as sources, so the filter refuses them with
   * Signed. Off by default.
   */
  vtkSetMacro(Signed, bool);
  vtkGetMacro(Signed, bool);
  vtkBooleanMacro(Signed, bool);
  ///@}

  ///@{
  /**
   * The value of LabelArray inside the curve. Default 1.
   */
  vtkSetMacro(InsideLabel, int);
  vtkGetMacro(InsideLabel, int);
  ///@}

  /**
   * Distances need a larger stabilization than other results: 0.1 to 1.
   */
  double GetNormalStabilizationMinValue() override;

  /**
   * The input of port 2: sources of distances.
   */
  void SetSourcesConnection(vtkAlgorithmOutput* output) { this->SetInputConnection(2, output); }

protected:
  vtkGeodesicDistance();
  ~vtkGeodesicDistance() override;

  void Compute(vtkInformationVector** inputs, vtkInformationVector* outputs) override;
  bool NeedsWholeSurface() override;
  void FreeStages() override;

  bool UseSourcePosition = false;
  double SourcePosition[3] = { 0.0, 0.0, 0.0 };
  double Smoothing = 1.2;
  bool NearestSource = false;
  bool Signed = false;
  int InsideLabel = 1;

private:
  vtkGeodesicDistance(const vtkGeodesicDistance&) = delete;
  void operator=(const vtkGeodesicDistance&) = delete;

  void FindSources(vtkDataSet* places);
  void FindCurve(vtkDataSet* lines);
  void Write(vtkPolyData* input, vtkPolyData* output);

  struct Internals;
  std::unique_ptr<Internals> Data;
};

#endif
