/**
 * @class   vtkHarmonicInterpolation
 * @brief   spread values from a few points over a whole surface
 *
 * From values at some points to the smoothest function on the surface that has them: harmonic,
 * which stays between the values and has a peak at a lonely point, or biharmonic, which is smooth
 * there.
 *
 * Input port 0: vtkPolyData with polygons or triangle strips, or the output of
 * vtkConnectivityAwareBasis. Input port 1 (optional): the output of vtkConnectivityAwareBasis for
 * the mesh of port 0. Input port 2 (optional, `Values`): any data set with points, such as
 * extracted selections or probes, whose values count at the nearest point of the surface that a
 * polygon uses. Input port 3 (optional): vtkSelection of points or cells of port 0; a cell takes
 * its points.
 *
 * Arrays, chosen by SetInputArrayToProcess, with any number of components:
 * - index 0, `ValueArray`: point data of port 0. A tuple with a NaN is unknown. Where none is
 *   chosen and only one point array has a NaN for some points and values for others, it is that.
 * - index 1, `MaskArray` (optional): point data of port 0, one component. With it or a selection,
 *   values are known where it is neither 0 nor NaN and at selected points, and nowhere else.
 * - index 2 (optional): point data of port 2, where that is connected. Without it the array there
 *   with the name of ValueArray, or the active scalars when none is chosen. MaskArray and
 *   the selection are not used then.
 * Several values at one point are met in the mean, and the filter warns when they differ.
 *
 * Output port 0 (vtkPolyData): the input with
 * - point data: `Interpolated`, components as the values; float where they are float, else double.
 *   NaN on connected components of the surface without any value, of which the filter warns once,
 *   and at points that no polygon uses.
 * - field data: `Misfit` (double, 1): the largest difference from a given value; `Converged`,
 *   `Iterations`, `DoublePrecisionSince`, `Residual`, `ConvergenceFactor`; `DiscretizationError`,
 *   `LargestDiscretizationError`, `AlgebraicError` and `TrustedEstimate` of vtkPoissonAlgorithm,
 *   not numbers for biharmonic functions of more than 256 points
 *
 * Tolerance (default 1e-6) is on the energy residual, as in vtkScreenedPoisson; values are met to
 * 1e-7 of their range wherever the functions can meet them. NormalStabilization is 1e-2 and
 * MaximumIterations 200 by default. All shared properties but ParameterUnits are used.
 */
#ifndef vtkHarmonicInterpolation_h
#define vtkHarmonicInterpolation_h

#include "vtkSurfaceFEMAlgorithm.h"

class vtkDataSet;

namespace gridfem
{
class SelectedPoints;
struct GivenConstraints;
} // namespace gridfem

class VTKGRIDFEMFILTERS_EXPORT vtkHarmonicInterpolation : public vtkSurfaceFEMAlgorithm
{
public:
  static vtkHarmonicInterpolation* New();
  vtkTypeMacro(vtkHarmonicInterpolation, vtkSurfaceFEMAlgorithm);
  void PrintSelf(ostream& os, vtkIndent indent) override;

  enum SmoothnessType
  {
    Harmonic = 0,
    Biharmonic = 1
  };
  ///@{
  /**
   * Harmonic (default): the least integral of the squared gradient.
   * Biharmonic: the least integral of the squared Laplacian. Up to 256 points cost a solve and a
   * vector each, more of them some fifty to a hundred solves, however many they are.
   */
  vtkSetClampMacro(Smoothness, int, Harmonic, Biharmonic);
  vtkGetMacro(Smoothness, int);
  ///@}

  /**
   * The input of port 1: the basis.
   */
  void SetBasisConnection(vtkAlgorithmOutput* output) { this->SetInputConnection(1, output); }

  /**
   * The input of port 2: points with values.
   */
  void SetValuesConnection(vtkAlgorithmOutput* output) { this->SetInputConnection(2, output); }

  /**
   * The input of port 3: a selection of the points whose values are known.
   */
  void SetSelectionConnection(vtkAlgorithmOutput* output) { this->SetInputConnection(3, output); }

protected:
  vtkHarmonicInterpolation();
  ~vtkHarmonicInterpolation() override;

  int FillInputPortInformation(int port, vtkInformation* info) override;
  void Compute(vtkInformationVector** inputs, vtkInformationVector* outputs) override;
  void FreeStages() override;

  int Smoothness = Harmonic;

private:
  vtkHarmonicInterpolation(const vtkHarmonicInterpolation&) = delete;
  void operator=(const vtkHarmonicInterpolation&) = delete;

  gridfem::GivenConstraints FindValues(vtkPolyData* input, vtkDataSet* places);

  struct Internals;
  std::unique_ptr<Internals> Data;
  std::unique_ptr<gridfem::SelectedPoints> Selection;
};

#endif
