/**
 * @class   vtkFunctionalMap
 * @brief   the place on a reference surface that corresponds to each point
 *
 * Maps a surface to a reference of about the same shape, such as another pose, another scan or
 * another mesh of it. The map comes from the eigenfunctions of both surfaces, so it does not depend
 * on their positions, and hardly on bending. It grows from few modes to all. The arrays of the
 * reference arrive at the points of the surface.
 *
 * Both surfaces need one connected component. A surface whose halves are alike has a second map,
 * which mirrors it. The filter takes the map that keeps the sides. This needs triangles that face
 * alike on both surfaces, for example outward. Landmarks help with shapes that are less alike, and
 * decide between maps of symmetric shapes. A warning tells if the surfaces match in several ways,
 * or not at all.
 *
 * A surface that comes with ten or more modes of vtkLaplaceSpectrum (AllModes) uses them. The
 * filter computes the modes of the other surfaces.
 *
 * Input port 0: vtkPolyData with polygons or triangle strips, or the output of
 * vtkConnectivityAwareBasis.
 * Input port 1 (optional): the output of vtkConnectivityAwareBasis for the mesh of port 0.
 * Input port 2: the reference, any data set with a surface. Without it, the filter warns, and its
 * output is the input.
 *
 * Output port 0 (vtkPolyData): the input with the following arrays. Points that no polygon uses
 * have NaN, or -1.
 * - point data: the arrays of the reference, at the corresponding places. Real numbers and colors
 *   are linear on its triangles, other values come from the nearest corner.
 * - point data, double: `ReferencePlace` (3), the corresponding place on the reference, in the unit
 *   of its points; `Mismatch`, how much the modes differ there: 0 for surfaces that differ only by
 *   bending, about 1 for unrelated surfaces.
 * - point data: `ReferenceCorners` (vtkIdType, 3), the points of the reference around this place,
 *   and `ReferenceWeights` (double, 3), their weights.
 * - point data, unsigned char: `MatchingColors` (3), a color for each place on the reference.
 * - field data: `MeanMismatch` (double, 1), the root of the mean square; `FunctionalMap` (double,
 *   modes × modes), the matrix that takes the shares of modes on the reference to shares of modes
 *   on the surface; `Converged` (int, 1), whether all computed modes have converged.
 *
 * Output port 1 (vtkPolyData): the surface of the reference with `MatchingColors`.
 *
 * Tolerance is the relative error of the eigenvalues. The filter uses all shared properties but
 * ParameterUnits, for both surfaces. On several MPI ranks the surfaces are gathered.
 */
#ifndef vtkFunctionalMap_h
#define vtkFunctionalMap_h

#include "vtkSurfaceFEMAlgorithm.h"

class VTKGRIDFEMFILTERS_EXPORT vtkFunctionalMap : public vtkSurfaceFEMAlgorithm
{
public:
  static vtkFunctionalMap* New();
  vtkTypeMacro(vtkFunctionalMap, vtkSurfaceFEMAlgorithm);
  void PrintSelf(ostream& os, vtkIndent indent) override;

  ///@{
  /**
   * The number of modes of both surfaces. 10..100000, default 100. The last group of equal
   * eigenvalues is complete. Not used for a surface that comes with modes.
   */
  vtkSetInRangeMacro(NumberOfModes, int, 10, 100000);
  vtkGetMacro(NumberOfModes, int);
  ///@}

  ///@{
  /**
   * Pairs of points that correspond: the id of a point in port 0, and of a point of the reference's
   * surface. Empty by default. The filter refuses a point that no polygon uses when it runs.
   */
  void AddLandmark(vtkIdType point, vtkIdType referencePoint);
  void ClearLandmarks();
  int GetNumberOfLandmarks();
  ///@}

  /**
   * The input of port 2: the reference.
   */
  void SetReferenceConnection(vtkAlgorithmOutput* output);

protected:
  vtkFunctionalMap();
  ~vtkFunctionalMap() override;

  void Compute(vtkInformationVector** inputs, vtkInformationVector* outputs) override;
  void FreeStages() override;

  int NumberOfModes = 100;

private:
  vtkFunctionalMap(const vtkFunctionalMap&) = delete;
  void operator=(const vtkFunctionalMap&) = delete;

  void Write(vtkPolyData* input, vtkPolyData* reference, vtkInformationVector* outputs);

  struct Internals;
  std::unique_ptr<Internals> Data;
};

#endif
