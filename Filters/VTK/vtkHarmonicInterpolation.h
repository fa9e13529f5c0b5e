/**
 * @class   vtkHarmonicInterpolation
 * @brief   spread values from a few points over a whole surface
 *
 * Finds the smoothest function on the surface that has the given values at some points. A harmonic
 * function stays between the values and has a peak at an isolated point. It is linear along an edge
 * between two known points. A biharmonic function is smooth at the points and may overshoot.
 *
 * Input port 0: vtkPolyData with polygons or triangle strips, or the output of
 * vtkConnectivityAwareBasis.
 * Input port 1 (optional): the output of vtkConnectivityAwareBasis for the mesh of port 0.
 * Input port 2 (optional, `Values`): any data set with points, such as extracted selections or
 * probes. Its values count at the nearest point of the surface that a polygon uses.
 * Input port 3 (optional): vtkSelection of points or cells of port 0. A selected cell selects its
 * points.
 *
 * Arrays have any number of components. SetInputArrayToProcess chooses them:
 * - index 0, `ValueArray`: point data of port 0. A tuple with a NaN is unknown. If none is chosen,
 *   the filter takes the only point array that has a NaN at some points and values at others, or
 *   else the KnownValues.
 * - index 1, `MaskArray` (optional): point data of port 0, one component. Values are known where it
 *   is neither 0 nor NaN. With a mask or a selection, only masked and selected points have known
 *   values.
 * - index 2 (optional): point data of port 2, if port 2 is connected. If none is chosen, the filter
 *   takes the array of port 2 with the name of ValueArray, or the active scalars if ValueArray is
 *   not chosen either. The MaskArray and the selection are not used then.
 *
 * If one point has several values, the filter takes their mean, and warns if they differ.
 *
 * Output port 0 (vtkPolyData): the input with the following arrays.
 * - point data: `Interpolated`, with the components of the values. It is of bytes if they are
 *   colors (three or four bytes), float if they are float, else double. It is NaN on connected
 *   components without any value. The filter warns once about such components.
 * - field data: `Misfit` (double, 1), the largest difference from a given value.
 * - field data: `Converged`, `Iterations`, `DoublePrecisionSince`, `Residual`, `ConvergenceFactor`.
 * - field data: `DiscretizationError`, `LargestDiscretizationError`, `AlgebraicError` and
 *   `TrustedEstimate` of vtkPoissonAlgorithm. They are NaN for biharmonic functions of more than
 *   256 points.
 *
 * Tolerance (default 1e-6) is on the energy residual, as in vtkScreenedPoisson. Harmonic functions
 * meet all values. Different values may be too close together for the functions. In this case the
 * filter corrects the points within a cell around them on the mesh. Biharmonic functions meet
 * values to 1e-7 of their range wherever they can follow them. NormalStabilization is 1e-2 and
 * MaximumIterations 200 by default. The filter uses all shared properties but ParameterUnits.
 */
#ifndef vtkHarmonicInterpolation_h
#define vtkHarmonicInterpolation_h

#include "vtkSurfaceFEMAlgorithm.h"

class vtkDataSet;

namespace gridfem
{
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
   * Harmonic (default) minimizes the integral of the squared gradient. Biharmonic minimizes the
   * integral of the squared Laplacian. It costs a solve and a vector for each point, up to 256
   * points. More points cost about fifty to a hundred solves in all, no matter how many points
   * there are.
   */
  vtkSetInRangeMacro(Smoothness, int, Harmonic, Biharmonic);
  vtkGetMacro(Smoothness, int);
  ///@}

  ///@{
  /**
   * A table of known values with one component: the id of a point in port 0, a whole number, and
   * its value. The filter uses the table if there is neither an array to take nor an input on port
   * 2. It leaves out points that are not on the surface, and warns about them. Empty by default.
   */
  void AddKnownValue(double point, double value);
  void ClearKnownValues();
  int GetNumberOfKnownValues();
  ///@}

  ///@{
  /**
   * Further arrays that are interpolated together with the ValueArray, at the same known points.
   * They are point data. The result of each has the name of the array before its name, as in
   * `Thickness_Interpolated`. All errors, and all other numbers in the field data, are then the
   * worst of all arrays. None by default.
   */
  void AddFurtherArray(const char* name);
  void ClearFurtherArrays();
  ///@}

  /**
   * The input of port 2: points with values.
   */
  void SetValuesConnection(vtkAlgorithmOutput* output) { this->SetInputConnection(2, output); }

protected:
  vtkHarmonicInterpolation();
  ~vtkHarmonicInterpolation() override;

  void Compute(vtkInformationVector** inputs, vtkInformationVector* outputs) override;
  void FreeStages() override;

  int Smoothness = Harmonic;

private:
  vtkHarmonicInterpolation(const vtkHarmonicInterpolation&) = delete;
  void operator=(const vtkHarmonicInterpolation&) = delete;

  gridfem::GivenConstraints FindValues(vtkPolyData* input, vtkDataSet* places);
  gridfem::GivenConstraints ReadTable();

  struct Internals;
  std::unique_ptr<Internals> Data;
};

#endif
