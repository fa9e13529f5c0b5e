/**
 * @class   vtkStitchColors
 * @brief   merge the colors of several scans into one coloring
 *
 * Scans of one surface differ in exposure, so their colors jump where they meet. The result has the
 * gradients of the colors inside the scans, and no jumps. The filter solves one Poisson equation
 * for all components at once.
 *
 * Input port 0: vtkPolyData with polygons or triangle strips, or the output of
 * vtkConnectivityAwareBasis.
 * Input port 1 (optional): the output of vtkConnectivityAwareBasis for the mesh of port 0.
 *
 * Arrays are point or cell data of input port 0. SetInputArrayToProcess chooses them:
 * - index 0, `ColorArray`: 1 to 4 components of any numeric type. If none is chosen, the filter
 *   takes the only array of bytes with three or four components.
 * - index 1, `LabelArray`: one component, integers, the number of the scan. Points with the same
 *   label may be anywhere. If none is chosen, the filter takes the only other array of an integer
 *   type with 2 to 1,000 values that each appear at least twice on average. It ignores ids, ghosts
 *   and the cells of a clip.
 *
 * Output port 0 (vtkPolyData): the input with the following arrays.
 * - point or cell data, as ColorArray: `StitchedColors`, with the same type and components.
 *   Integers are rounded and stay in the range of their type. Real numbers that lie in 0..1 stay
 *   there. Points and cells that no polygon uses keep their color.
 * - field data: `Converged`, `Iterations`, `DoublePrecisionSince`, `Residual`, `ConvergenceFactor`
 *   and the estimated errors of vtkPoissonAlgorithm. They describe the function before KeepDetails
 *   adds details.
 *
 * Colors at points are linear on triangles. Triangles that touch two scans are seams, whose
 * gradients are left out. Scans whose borders coincide without sharing points are stitched as well
 * (WeldCoincidentPoints). With ConnectivityAware off, a grid also stitches across gaps narrower
 * than a cell, but then sheets that are equally close interact.
 *
 * NormalStabilization is 1e-2 by default. The filter uses all shared properties but ParameterUnits.
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
   * The scan that keeps its mean color, because gradients determine colors only up to a constant.
   * -1 (default): every connected component keeps its mean color. Any other label: the scan with
   * this label keeps its own mean. Components without the label keep theirs.
   */
  vtkSetMacro(ReferenceLabel, int);
  vtkGetMacro(ReferenceLabel, int);
  ///@}

  ///@{
  /**
   * When on (default), details finer than the functions stay as they are. The filter adds only the
   * change to the colors, smoothed over two cells inside each scan. When off, the result is the
   * function itself.
   */
  vtkSetMacro(KeepDetails, bool);
  vtkGetMacro(KeepDetails, bool);
  vtkBooleanMacro(KeepDetails, bool);
  ///@}

  ///@{
  /**
   * The distance from a seam along the surface within which gradients count only in part: not at
   * all at the seam, fully from this distance on. Use it for scans whose colors are poor near their
   * borders. A part of the longest side of the surface, 0..1; 0 (default) counts all gradients
   * fully up to the seam.
   */
  vtkSetInRangeMacro(BlendWidth, double, 0.0, 1.0);
  vtkGetMacro(BlendWidth, double);
  ///@}

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
