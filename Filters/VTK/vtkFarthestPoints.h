/**
 * @class   vtkFarthestPoints
 * @brief   points spread evenly over a surface, and the region of each
 *
 * Each point is the one that is farthest along the surface from all points before it. So every
 * point of the surface is nearly as near to one of them as with the best choice of as many points:
 * within a factor of two. A connected component gets a point before any gets a second one. Points
 * are found one after the other, each with a solution of vtkGeodesicDistance; a larger
 * NumberOfPoints continues from those that are there.
 *
 * Input port 0: vtkPolyData with polygons or triangle strips, or the output of
 * vtkConnectivityAwareBasis. Input port 1 (optional): the output of vtkConnectivityAwareBasis for
 * the mesh of port 0.
 *
 * Output port 0 (vtkPolyData): the input with
 * - point data, double: `Distance` from the nearest of the points, in the unit of the points. It is
 *   NaN at points that no polygon uses.
 * - point data, vtkIdType: `NearestPoint`, the id of the nearest of the points. It is -1 where
 *   Distance is NaN.
 * - field data: `FarthestPoints` (vtkIdType), the ids in the order in which they were found. There
 *   are fewer than NumberOfPoints where the surface has fewer points.
 * - field data: `Radius` (double, 1), the largest Distance
 *
 * Tolerance, NormalStabilization and MaximumIterations have the defaults of vtkGeodesicDistance,
 * and so errors have the same size. All shared properties but ParameterUnits are used. Several
 * ranks of MPI gather the surface.
 */
#ifndef vtkFarthestPoints_h
#define vtkFarthestPoints_h

#include "vtkSurfaceFEMAlgorithm.h"

class VTKGRIDFEMFILTERS_EXPORT vtkFarthestPoints : public vtkSurfaceFEMAlgorithm
{
public:
  static vtkFarthestPoints* New();
  vtkTypeMacro(vtkFarthestPoints, vtkSurfaceFEMAlgorithm);
  void PrintSelf(ostream& os, vtkIndent indent) override;

  ///@{
  /**
   * How many points there are. 1..100000, default 10.
   */
  vtkSetClampMacro(NumberOfPoints, int, 1, 100000);
  vtkGetMacro(NumberOfPoints, int);
  ///@}

  ///@{
  /**
   * The id of the first point; -1 (default) takes the first point of the first polygon. An id that
   * is no point of a polygon is refused when the filter runs.
   */
  vtkSetClampMacro(FirstPointId, int, -1, VTK_INT_MAX);
  vtkGetMacro(FirstPointId, int);
  ///@}

  /**
   * The input of port 1: the basis.
   */
  void SetBasisConnection(vtkAlgorithmOutput* output) { this->SetInputConnection(1, output); }

protected:
  vtkFarthestPoints();
  ~vtkFarthestPoints() override;

  void Compute(vtkInformationVector** inputs, vtkInformationVector* outputs) override;
  void FreeStages() override;

  int NumberOfPoints = 10;
  int FirstPointId = -1;

private:
  vtkFarthestPoints(const vtkFarthestPoints&) = delete;
  void operator=(const vtkFarthestPoints&) = delete;

  struct Internals;
  std::unique_ptr<Internals> Data;
};

#endif
