/**
 * @class   vtkFarthestPoints
 * @brief   points spread evenly over a surface, and the region of each
 *
 * Finds points one after the other. Each new point is the farthest, along the surface, from all
 * points before it. If distances were exact, the largest distance to a found point would be at most
 * twice the largest distance of the best choice of equally many points. Every connected component
 * gets a point before any component gets a second one. A warning tells if there are too few points
 * for all components. Each point takes one solution of vtkGeodesicDistance. A larger NumberOfPoints
 * continues from the points found before.
 *
 * Input port 0: vtkPolyData with polygons or triangle strips, or the output of
 * vtkConnectivityAwareBasis.
 * Input port 1 (optional): the output of vtkConnectivityAwareBasis for the mesh of port 0.
 *
 * Output port 0 (vtkPolyData): the input with the following arrays.
 * - point data, double: `Distance` from the nearest found point, in the unit of the points. It is
 *   NaN at points that no polygon uses, and on components without a found point.
 * - point data, vtkIdType: `NearestPoint`, the id of the nearest found point. It is -1 where
 *   Distance is NaN.
 * - field data: `FarthestPoints` (vtkIdType), the ids in the order in which they were found. There
 *   are fewer than NumberOfPoints if the surface has fewer points.
 * - field data: `Radius` (double, 1), the largest Distance.
 * - field data: the report of the worst of the distances, as in vtkGeodesicDistance: `Converged`
 * and the like.
 *
 * Tolerance, NormalStabilization and MaximumIterations have the defaults of vtkGeodesicDistance, so
 * errors have the same size. The filter uses all shared properties but ParameterUnits. On several
 * MPI ranks the surface is gathered.
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
   * The number of points to find. 1..100000, default 10.
   */
  vtkSetInRangeMacro(NumberOfPoints, int, 1, 100000);
  vtkGetMacro(NumberOfPoints, int);
  ///@}

  ///@{
  /**
   * The id of the first point. -1 (default) takes the first point of the surface. The filter
   * refuses an id that no polygon uses when it runs.
   */
  vtkSetInRangeMacro(FirstPointId, int, -1, VTK_INT_MAX);
  vtkGetMacro(FirstPointId, int);
  ///@}

  /**
   * Distances need a larger stabilization than other results: 0.1 to 1.
   */
  double GetNormalStabilizationMinValue() override;

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
