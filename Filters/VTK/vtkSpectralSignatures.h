/**
 * @class   vtkSpectralSignatures
 * @brief   signatures, distances and filters from the eigenfunctions of a surface
 *
 * Computes signatures of every point, distances from chosen points, frequency filters, and a
 * fingerprint of the shape. All are sums over the modes of vtkLaplaceSpectrum. λ is the eigenvalue
 * of the mode φ:
 *
 * - Heat kernel signature: area Σ exp(-λ t) φ(x)² for NumberOfScales times t. The times lie between
 *   4 ln 10 / λ of the last mode and 4 ln 10 / λ of the first mode that is not constant. Small
 *   times show details, large times show the whole shape.
 * - Wave kernel signature: the mean of area φ(x)² over bands of log λ.
 * - Biharmonic distance: √(Σ (φ(x) - φ(y))² / λ²), from every point to the nearest source.
 * - Diffusion distance: √(area Σ exp(-2 λ t) (φ(x) - φ(y))²) with t = DiffusionTime, from every
 *   point to the nearest source.
 * - Surrogates: random arrays with the energy of a point array in each group of modes. Constant
 *   modes stay; the groups after them have 3, 5, 7, ... modes, as on a sphere. They are samples for
 *   tests of a hypothesis that needs maps as smooth as the given one.
 * - Low, high and band pass: the part of a point array, or of the shape itself, that consists of
 *   some of the modes. The function and the modes are linear on every triangle, and their products
 *   are integrated exactly.
 * - Shape-DNA: area λ, the same for a scaled shape.
 *
 * Input port 0: vtkPolyData with polygons or triangle strips.
 * Input port 1 (optional): the output of vtkConnectivityAwareBasis for the mesh of port 0.
 * Input port 2 (optional): any vtkDataSet, for example an extracted selection. The mesh points
 * nearest to its points, and to places along its lines, are sources.
 *
 * If port 0 carries the output of vtkLaplaceSpectrum with AllModes on, the filter takes these modes
 * and solves nothing. Such an input has the field array `Eigenvalues` and the point arrays
 * `Mode000`, `Mode001`, ... NumberOfModes, the basis and the solver's properties are not used then.
 *
 * Otherwise the filter computes the modes as vtkLaplaceSpectrum does. It completes the last group
 * of equal eigenvalues, because signatures and distances need whole groups. It recognizes modes of
 * another mesh, because the integral of a squared mode is not 1 or its Rayleigh quotient is not the
 * eigenvalue. The filter then warns, leaves these modes out and computes new modes.
 *
 * Output port 0 (vtkPolyData): the input with the following arrays.
 * - point data, in the precision of the points (double when they are integers):
 *   `HeatKernelSignature` and `WaveKernelSignature` (NumberOfScales components; no unit).
 * - point data, in the same precision: `Signature`, the heat kernel signature at its middle scale.
 * - point data, with sources: `BiharmonicDistance` (1 component, world length). It is NaN on
 *   components of the surface without a source.
 * - point data, with sources: `DiffusionDistance` (1 component, no unit).
 * - point data, with another FilterType: `Filtered`, with the components of the array. It is of
 * bytes if the array holds colors, float if it is float, else double. If the coordinates are
 * filtered, the points move to their filtered places. The output then has `Displacement` and
 *   `NormalDisplacement`, and normals follow. The clip, basis and modes belong to the old shape and
 *   are left out.
 * - point data, with the FilterType Surrogates: `Surrogate000`, `Surrogate001`, ..., with the
 *   components of the array, float if the array is float, else double.
 * - field data, one tuple per scale: `HeatTimes` (double, world length squared) and `WaveEnergies`
 *   (double, logarithms of eigenvalues in world units).
 * - field data: `Converged` (int, 1), if modes were computed.
 *
 * Output port 1 (vtkTable) has a row per mode with `Mode` (int), `Eigenvalue` and `ShapeDNA`
 * (double). With a FilterType it also has the following columns, with the components of the values:
 * - `Coefficient` (double): the share of the mode in the values.
 * - `RemainingError` (double): the root of the integral of the squared error of the best sum of the
 *   modes up to the row, relative to this number after the constant modes. If no mode is constant,
 *   it is relative to the values themselves.
 *
 * SetInputArrayToProcess(0, ...) chooses the `ValueArray` to filter: a point array with any number
 * of components. Without it the filter takes the coordinates, and makes no surrogates. It uses all
 * shared properties. DiffusionTime is in the squared unit of length of ParameterUnits.
 *
 * All MPI ranks compute together, also with the modes of the input. Rank 0 computes alone if there
 * are sources of distances or if coordinates are filtered.
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
   * The smallest number of modes to compute if the input has none. The filter adds modes to
   * complete the last group of equal eigenvalues. 2..100000, default 100.
   */
  vtkSetInRangeMacro(NumberOfModes, int, 2, 100000);
  vtkGetMacro(NumberOfModes, int);
  ///@}

  ///@{
  /**
   * The number of components of each signature: the times of the heat kernel, and the bands of the
   * wave kernel. 1..1000, default 16.
   */
  vtkSetInRangeMacro(NumberOfScales, int, 1, 1000);
  vtkGetMacro(NumberOfScales, int);
  ///@}

  ///@{
  /**
   * Points from which distances start, in addition to the sources of port 2. None by default. The
   * filter refuses an id that no polygon uses when it runs.
   */
  void AddSourcePointId(vtkIdType id);
  void ClearSourcePointIds();
  vtkIdType GetNumberOfSourcePointIds();
  vtkIdType GetSourcePointId(vtkIdType index);
  ///@}

  ///@{
  /**
   * The time of the diffusion distance, in the squared unit of length of ParameterUnits. Features
   * smaller than about its square root are blurred. 0 or more, default 0.01. The filter refuses a
   * negative value when it runs.
   */
  vtkSetMacro(DiffusionTime, double);
  vtkGetMacro(DiffusionTime, double);
  ///@}

  enum FilterTypes
  {
    NoFilter = 0,
    LowPass = 1,
    HighPass = 2,
    BandPass = 3,
    Surrogates = 4
  };
  ///@{
  /**
   * The modes of the ValueArray that are kept.
   * - NoFilter (default): nothing is filtered.
   * - LowPass: keep modes 0..LastMode.
   * - HighPass: remove modes 0..FirstMode - 1 and keep the rest, including the part that no mode
   *   describes.
   * - BandPass: keep modes FirstMode..LastMode.
   * - Surrogates: make random arrays of all modes. They need a ValueArray.
   */
  vtkSetInRangeMacro(FilterType, int, NoFilter, Surrogates);
  vtkGetMacro(FilterType, int);
  ///@}

  ///@{
  /**
   * The first mode that passes, for HighPass and BandPass. 0 or more, default 1: without the mean.
   */
  vtkSetInRangeMacro(FirstMode, int, 0, VTK_INT_MAX);
  vtkGetMacro(FirstMode, int);
  ///@}

  ///@{
  /**
   * The last mode that passes, for LowPass and BandPass. A larger number means the last existing
   * mode. 0 or more, default 20.
   */
  vtkSetInRangeMacro(LastMode, int, 0, VTK_INT_MAX);
  vtkGetMacro(LastMode, int);
  ///@}

  ///@{
  /**
   * The number of random arrays with the FilterType Surrogates. 1..10000, default 10.
   */
  vtkSetInRangeMacro(NumberOfSurrogates, int, 1, 10000);
  vtkGetMacro(NumberOfSurrogates, int);
  ///@}

  ///@{
  /**
   * Another seed gives other surrogates. The same seed gives the same ones on any number of
   * threads. 0 or more, default 1.
   */
  vtkSetInRangeMacro(Seed, int, 0, VTK_INT_MAX);
  vtkGetMacro(Seed, int);
  ///@}

  /**
   * The input of port 2: sources of distances.
   */
  void SetSourcesConnection(vtkAlgorithmOutput* output) { this->SetInputConnection(2, output); }

protected:
  vtkSpectralSignatures();
  ~vtkSpectralSignatures() override;

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
  int NumberOfSurrogates = 10;
  int Seed = 1;

private:
  vtkSpectralSignatures(const vtkSpectralSignatures&) = delete;
  void operator=(const vtkSpectralSignatures&) = delete;

  void Solve(vtkDataSet* sources);
  void FindValues();
  void Write(vtkPolyData* input, vtkPolyData* output);
  void WriteFiltered(vtkPolyData* input, vtkPolyData* output);

  struct Internals;
  std::unique_ptr<Internals> Data;
};

#endif
