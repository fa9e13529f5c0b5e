/**
 * @class   vtkStitchColors
 * @brief   make one colouring of the colours of several scans
 *
 * Scans of one surface differ in exposure, so that their colours jump where they meet. The result
 * has the gradients that the colours have inside the scans, and no jumps: a Poisson equation for
 * all components at once.
 *
 * Input port 0: vtkPolyData with polygons or triangle strips, or the output of
 * vtkConnectivityAwareBasis. Input port 1 (optional): the output of vtkConnectivityAwareBasis for
 * the mesh of port 0.
 *
 * Arrays, as point or cell data of input port 0, chosen by SetInputArrayToProcess:
 * - index 0, `ColorArray`: 1 to 4 components of any numeric type. Where none is chosen, the only
 *   array of bytes with three or four components.
 * - index 1, `LabelArray`: one component, integers: the scan. Points with one label may be
 *   anywhere. Where none is chosen, the only other array of an integer type with 2 to
 *   1,000 values, each of them there twice in the mean, that is no ids, ghosts or cells of a clip.
 *
 * Output port 0 (vtkPolyData): the input with
 * - point or cell data, as ColorArray: `StitchedColors`, same type and components. Integers are
 *   rounded and stay in the range of their type; numbers with a point that lie in 0..1 stay there.
 *   Points and cells that no polygon uses keep their colour.
 * - field data: `Converged`, `Iterations`, `DoublePrecisionSince`, `Residual`, `ConvergenceFactor`
 *   and the estimated errors of vtkPoissonAlgorithm: those of the function that KeepDetails adds
 *   details to
 *
 * Colours at points are linear on triangles; triangles that touch two scans are seams, whose
 * gradients are left out. Scans whose borders coincide without sharing points are stitched as well
 * (WeldCoincidentPoints); with ConnectivityAware off, a grid stitches across gaps narrower than a
 * cell, too, but sheets that lie as close then feel each other.
 *
 * NormalStabilization is 1e-2 by default. All shared properties but ParameterUnits are used.
 */
#ifndef vtkStitchColors_h
#define vtkStitchColors_h

#include "vtkPoissonAlgorithm.h"

class VTKGRIDFEMFILTERS_EXPORT vtkStitchColors : public vtkPoissonAlgorithm
{
public:
  static vtkStitchColors* New();
  vtkTypeMacro(vtkStitchColors, vtkPoissonAlgorithm);
  void PrintSelf(ostream& os, vtkIndent indent) override;

  ///@{
  /**
   * Gradients leave a constant open. -1 (default): every connected component keeps its mean colour.
   * Any other label: the scan with this label keeps its own; components without it as before.
   */
  vtkSetMacro(ReferenceLabel, int);
  vtkGetMacro(ReferenceLabel, int);
  ///@}

  ///@{
  /**
   * When on (default), details finer than the functions stay as they are: what stitching changes is
   * added to the colours, smoothed over two cells inside each scan. When off, the result is the
   * function itself.
   */
  vtkSetMacro(KeepDetails, bool);
  vtkGetMacro(KeepDetails, bool);
  vtkBooleanMacro(KeepDetails, bool);
  ///@}

  ///@{
  /**
   * How far along the surface from a seam gradients are kept in part: none at the seam, all from
   * here on. For scans whose colours are poor near their borders. A part of the longest side of the
   * surface, 0..1; 0 (default): all up to the seam.
   */
  vtkSetClampMacro(BlendWidth, double, 0.0, 1.0);
  vtkGetMacro(BlendWidth, double);
  ///@}

  /**
   * The input of port 1: the basis.
   */
  void SetBasisConnection(vtkAlgorithmOutput* output) { this->SetInputConnection(1, output); }

protected:
  vtkStitchColors();
  ~vtkStitchColors() override;

  void Compute(vtkInformationVector** inputs, vtkInformationVector* outputs) override;
  void FreeStages() override;

  int ReferenceLabel = -1;
  bool KeepDetails = true;
  double BlendWidth = 0.0;

private:
  vtkStitchColors(const vtkStitchColors&) = delete;
  void operator=(const vtkStitchColors&) = delete;

  struct Internals;
  std::unique_ptr<Internals> Data;
};

#endif
