/**
 * @class   vtkGeodesicDistance
 * @brief   distance along a surface from the nearest of some points
 *
 * The heat method (Crane, Weischedel, Wardetzky 2013): heat spreads from the sources for a short
 * time t, the direction in which it falls is that in which the distance grows, and the distance is
 * the function whose gradient is nearest to these directions. Two equations are solved; all but the
 * sources is kept, so that other sources cost the solutions alone.
 *
 * Sources are the points in SourcePointIds, those where the SourceArray is not 0, those nearest to
 * the points of input port 2, and those that the selection of port 3 takes, all together. When none
 * of the four is given, the first point of the first polygon is the source. A triangle whose
 * corners are all sources is at distance 0 as a whole.
 *
 * With Signed on, distances are from a curve instead, negative inside: from the border of the
 * points or cells whose LabelArray is InsideLabel, or, when no LabelArray is chosen, from the lines
 * of input port 2, moved to the nearest places of the surface. Lines may come in pieces, and have
 * to divide the surface: closed, or from border to border. On each connected component the smaller
 * part is inside. Every part of a curve is a source, not its points.
 *
 * Input port 0: vtkPolyData with polygons or triangle strips, or the output of
 * vtkConnectivityAwareBasis. Input port 1 (optional): the output of vtkConnectivityAwareBasis for
 * the mesh of port 0. Input port 2 (optional): vtkDataSet whose points are sources, each at the
 * nearest point of the mesh. Input port 3 (optional): vtkSelection of points or cells of port 0; a
 * cell takes its points. The SourceArray is chosen by SetInputArrayToProcess(0, ...): point
 * data with one component. The LabelArray is SetInputArrayToProcess(1, ...): integers on points or
 * cells.
 *
 * Output port 0 (vtkPolyData): the input with
 * - point data, double: `Distance`, in the unit of the points; 0 at sources, never negative but
 *   inside a curve. Points that cannot be reached have NaN: those on a component without a source,
 *   and those that no polygon uses.
 * - point data, vtkIdType, with NearestSource on: `NearestSource`, the id of the source that the
 *   distance is from; -1 where there is none
 * - field data: `Converged`, `Iterations`, `DoublePrecisionSince`, `Residual`, `ConvergenceFactor`
 *   of the solution of the distance, `HeatSweeps` (double, 1)
 *
 * Errors fall with the size of the functions, in proportion. They are sqrt(t) / 2 to sqrt(t) where
 * fronts meet, and near boundaries; a small fraction of that elsewhere. Sheets nearer to each other
 * than a cell do not feel each other as long as ConnectivityAware is on.
 *
 * Tolerance (default 1e-4) is that of the distance from its gradient, as in vtkScreenedPoisson; the
 * heat is always solved to the same relative accuracy everywhere. NormalStabilization is 0.1 by
 * default: with less, functions that hide in the surface spoil small numbers. All shared properties
 * but ParameterUnits are used.
 *
 * All ranks of MPI compute together from the points of a SourceArray and of a selection, or from
 * the first one. SourcePointIds, which count through the gathered surface, Sources, Signed,
 * NearestSource and a Smoothing of 3.5 or more are left to rank 0.
 */
#ifndef vtkGeodesicDistance_h
#define vtkGeodesicDistance_h

#include "vtkSurfaceFEMAlgorithm.h"

class vtkDataSet;

namespace gridfem
{
class SelectedPoints;
} // namespace gridfem

class VTKGRIDFEMFILTERS_EXPORT vtkGeodesicDistance : public vtkSurfaceFEMAlgorithm
{
public:
  static vtkGeodesicDistance* New();
  vtkTypeMacro(vtkGeodesicDistance, vtkSurfaceFEMAlgorithm);
  void PrintSelf(ostream& os, vtkIndent indent) override;

  ///@{
  /**
   * Points that distances start from, besides those of the SourceArray and of port 2. None by
   * default. An id that is no point of a polygon is refused when the filter runs.
   */
  void AddSourcePointId(vtkIdType id);
  void ClearSourcePointIds();
  vtkIdType GetNumberOfSourcePointIds();
  vtkIdType GetSourcePointId(vtkIdType index);
  ///@}

  ///@{
  /**
   * sqrt(t) in mean distances between functions of the grid that overlap, which is 1.2 cells. More
   * rounds the distance off where fronts meet, and takes somewhat longer; much less makes the heat
   * oscillate. 0.5..1000, default 1.75.
   */
  vtkSetClampMacro(Smoothing, double, 0.5, 1000.0);
  vtkGetMacro(Smoothing, double);
  ///@}

  ///@{
  /**
   * Whether the point array `NearestSource` is put out: regions whose points have the same nearest
   * source. Their borders are right to some cells. Off by default.
   */
  vtkSetMacro(NearestSource, bool);
  vtkGetMacro(NearestSource, bool);
  vtkBooleanMacro(NearestSource, bool);
  ///@}

  ///@{
  /**
   * Whether distances are from curves, negative inside. SourcePointIds, SourceArray, a selection
   * and NearestSource are of points and are refused then. Off by default.
   */
  vtkSetMacro(Signed, bool);
  vtkGetMacro(Signed, bool);
  vtkBooleanMacro(Signed, bool);
  ///@}

  ///@{
  /**
   * The label of what is inside, with a LabelArray. Default 1.
   */
  vtkSetMacro(InsideLabel, int);
  vtkGetMacro(InsideLabel, int);
  ///@}

  /**
   * The input of port 1: the basis.
   */
  void SetBasisConnection(vtkAlgorithmOutput* output) { this->SetInputConnection(1, output); }

  /**
   * The input of port 2: sources of distances.
   */
  void SetSourcesConnection(vtkAlgorithmOutput* output) { this->SetInputConnection(2, output); }

  /**
   * The input of port 3: a selection of sources.
   */
  void SetSelectionConnection(vtkAlgorithmOutput* output) { this->SetInputConnection(3, output); }

protected:
  vtkGeodesicDistance();
  ~vtkGeodesicDistance() override;

  int FillInputPortInformation(int port, vtkInformation* info) override;
  void Compute(vtkInformationVector** inputs, vtkInformationVector* outputs) override;
  bool NeedsWholeSurface() override;
  void FreeStages() override;

  double Smoothing = 1.75;
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
  std::unique_ptr<gridfem::SelectedPoints> Selection;
};

#endif
