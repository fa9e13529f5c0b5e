/**
 * @class   vtkSpectralSignatures
 * @brief   what the eigenfunctions of a surface tell about its points and its shape
 *
 * Signatures of every point, distances from chosen points, frequency filters, and a fingerprint of
 * the shape, all as sums over the modes of Laplace Spectrum:
 *
 * - Heat kernel signature: area * sum exp(-l t) p(x)^2, with the eigenvalue l and the mode p, for
 *   NumberOfScales times t between 4 ln 10 / l of the last mode and 4 ln 10 / l of the first one
 *   that is not constant. Small times see details, large ones the whole shape.
 * - Wave kernel signature: the mean of area * p(x)^2 over bands of log l.
 * - Biharmonic distance: sqrt(sum (p(x) - p(y))^2 / l^2). Diffusion distance: sqrt(area * sum
 *   exp(-2 l t) (p(x) - p(y))^2) with t = DiffusionTime. From every point to the nearest source.
 * - Low, high and band pass: the sum of the shares of a point array, or of the shape itself, in
 * some of the modes. Function and modes are taken as linear on every triangle, and their products
 * are integrated exactly.
 * - Shape-DNA: area * l, the same for a scaled shape.
 *
 * Input port 0: vtkPolyData with polygons or triangle strips. When it carries the output of Laplace
 * Spectrum with AllModes on (the field array `Eigenvalues` and the point arrays `Mode000`,
 * `Mode001`, ...), these modes are taken, and nothing is solved; NumberOfModes, the basis and the
 * solver's properties are not used then. Else the modes are computed as Laplace Spectrum does; the
 * last group of equal eigenvalues is completed, because signatures and distances need whole groups.
 * Modes that are not of this mesh are recognised (the integral of a squared mode is not 1, or its
 * Rayleigh quotient not the eigenvalue): a warning says so, they are left out and computed anew.
 * Input port 1 (optional): the output of vtkConnectivityAwareBasis for the mesh of port 0. Input
 * port 2 (optional): any vtkDataSet, for example an extracted selection; the mesh points nearest to
 * its points are sources.
 *
 * Output port 0 (vtkPolyData): the input with
 * - point data, in the precision of the points (double when they are integers):
 *   `HeatKernelSignature` and `WaveKernelSignature` (NumberOfScales components; no unit), and the
 *   first at its middle scale as `Signature`;
 *   with sources `BiharmonicDistance` (1 component, world length; NaN on components of the surface
 *   without a source) and `DiffusionDistance` (1 component, no unit). Points that no polygon uses
 *   get 0, and NaN for the biharmonic distance.
 * - point data, with a FilterType: `Filtered` (the components of the array; float if that is float,
 *   else double; points that no polygon uses keep their value). When the coordinates are filtered,
 * the points move to their filtered places: `Displacement` and `NormalDisplacement` are added,
 * normals follow, and clip, basis and modes, which belong to the old shape, are left out.
 * - field data: `HeatTimes` (double, world length squared), `WaveEnergies` (double, logarithms of
 *   eigenvalues in world units), one tuple per scale; `Converged` (int, 1) when modes were computed
 *
 * Output port 1 (vtkTable): a row per mode with `Mode` (int), `Eigenvalue` and `ShapeDNA` (double).
 *
 * Arrays: SetInputArrayToProcess index 0, `ValueArray`: a point array with any number of components
 * to be filtered; without it the coordinates. All shared properties are used; ParameterUnits is the
 * unit of DiffusionTime, as squared length.
 *
 * All ranks of MPI compute together, also with the modes of the input. Sources of distances, and
 * coordinates that are filtered, are left to rank 0.
 */
#ifndef vtkSpectralSignatures_h
#define vtkSpectralSignatures_h

#include "vtkSurfaceFEMAlgorithm.h"

class vtkDataSet;
class vtkTable;

class VTKGRIDFEMFILTERS_EXPORT vtkSpectralSignatures : public vtkSurfaceFEMAlgorithm
{
public:
  static vtkSpectralSignatures* New();
  vtkTypeMacro(vtkSpectralSignatures, vtkSurfaceFEMAlgorithm);
  void PrintSelf(ostream& os, vtkIndent indent) override;

  ///@{
  /**
   * How many modes to compute when the input has none; at least, a group of equal eigenvalues is
   * not cut. 2..100000, default 100.
   */
  vtkSetClampMacro(NumberOfModes, int, 2, 100000);
  vtkGetMacro(NumberOfModes, int);
  ///@}

  ///@{
  /**
   * Times of the heat kernel signature, and bands of the wave kernel signature. 1..1000, default
   * 16.
   */
  vtkSetClampMacro(NumberOfScales, int, 1, 1000);
  vtkGetMacro(NumberOfScales, int);
  ///@}

  ///@{
  /**
   * Points that distances are measured from, besides those of port 2. None by default. An id that
   * is no point of a polygon is refused when the filter runs.
   */
  void AddSourcePointId(vtkIdType id);
  void ClearSourcePointIds();
  vtkIdType GetNumberOfSourcePointIds();
  vtkIdType GetSourcePointId(vtkIdType index);
  ///@}

  ///@{
  /**
   * The time of the diffusion distance, squared length of ParameterUnits: features smaller than
   * about its root are blurred. 0 or more, default 0.01. A negative one is refused when the filter
   * runs.
   */
  vtkSetMacro(DiffusionTime, double);
  vtkGetMacro(DiffusionTime, double);
  ///@}

  enum FilterTypes
  {
    NoFilter = 0,
    LowPass = 1,
    HighPass = 2,
    BandPass = 3
  };
  ///@{
  /**
   * What becomes of the ValueArray: nothing (NoFilter, default); modes 0..LastMode are kept
   * (LowPass); modes 0..FirstMode - 1 are taken away, and all the rest is kept, also what none of
   * the modes shows (HighPass); modes FirstMode..LastMode are kept (BandPass).
   */
  vtkSetClampMacro(FilterType, int, NoFilter, BandPass);
  vtkGetMacro(FilterType, int);
  ///@}

  ///@{
  /**
   * The first mode that passes, for HighPass and BandPass. 0 or more, default 1: without the mean.
   */
  vtkSetClampMacro(FirstMode, int, 0, VTK_INT_MAX);
  vtkGetMacro(FirstMode, int);
  ///@}

  ///@{
  /**
   * The last mode that passes, for LowPass and BandPass; beyond the last mode there is: that one. 0
   * or more, default 20.
   */
  vtkSetClampMacro(LastMode, int, 0, VTK_INT_MAX);
  vtkGetMacro(LastMode, int);
  ///@}

  /**
   * The input of port 1: the basis.
   */
  void SetBasisConnection(vtkAlgorithmOutput* output) { this->SetInputConnection(1, output); }

  /**
   * The input of port 2: sources of distances.
   */
  void SetSourcesConnection(vtkAlgorithmOutput* output) { this->SetInputConnection(2, output); }

protected:
  vtkSpectralSignatures();
  ~vtkSpectralSignatures() override;

  int FillInputPortInformation(int port, vtkInformation* info) override;
  int FillOutputPortInformation(int port, vtkInformation* info) override;
  bool NeedsWholeSurface() override;
  void Compute(vtkInformationVector** inputs, vtkInformationVector* outputs) override;
  void FreeStages() override;

  int NumberOfModes = 100;
  int NumberOfScales = 16;
  double DiffusionTime = 0.01;
  int FilterType = NoFilter;
  int FirstMode = 1;
  int LastMode = 20;

private:
  vtkSpectralSignatures(const vtkSpectralSignatures&) = delete;
  void operator=(const vtkSpectralSignatures&) = delete;

  void Solve(vtkDataSet* sources);
  void FindValues();
  void Write(vtkPolyData* input, vtkPolyData* output);
  void WriteSignatures(int precision, vtkPolyData* output);
  void WriteDistances(int precision, vtkPolyData* output);
  void WriteFiltered(vtkPolyData* input, vtkPolyData* output);
  void WriteTable(vtkTable* table);

  struct Internals;
  std::unique_ptr<Internals> Data;
};

#endif
