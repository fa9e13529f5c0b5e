/**
 * @class   vtkParameterization
 * @brief   flattens a surface: texture coordinates, and the surface as a map
 *
 * Maps a surface to the plane. Each connected component becomes a chart of its own. A component
 * that is not a disk is opened first: small holes are filled for the computation, and the surface
 * is cut along edges. Cuts run around handles, between long loops of the boundary, and across a
 * surface that is nearly closed. Two charts never overlap. One chart may overlap itself unless the
 * map is a circle.
 *
 * MapType determines what the map keeps. Conformal (default) keeps angles, and the scale along the
 * boundary (Sawhney and Crane 2017, Boundary First Flattening). Isometric changes lengths as little
 * as possible (symmetric Dirichlet energy, Smith and Schaefer 2015). Circle maps every component
 * onto a disk, without folds (Tutte 1963).
 *
 * Input port 0: vtkPolyData with polygons or triangle strips.
 *
 * Output port 0 (vtkPolyData): the input with the following arrays.
 * - cell data, double: `AngleDistortion`, the largest change of the angle between two directions,
 *   degrees. 180 at triangles that the map flips: they face down.
 * - cell data, double: `AreaDistortion`, the binary logarithm of the change of area. 0 means no
 *   change, 1 the double area. Areas are relative to a map with the area of the surface.
 * - cell data, vtkIdType: `ChartId`, the number of the component.
 * - point data, float: `TCoords`, active texture coordinates in the unit square, NaN at points that
 *   no polygon uses. They are missing if a point has several places in the map: on a cut, where a
 *   one-sided surface is opened, and where three sheets meet.
 * - field data, one number per chart: `EulerCharacteristic` and `BoundaryLoops` of the component as
 *   it was given, `FlippedTriangles` (all vtkIdType), and two means over the area, of absolute
 *   values: `MeanAngleDistortion` and `MeanAreaDistortion` (double). The filter warns about flipped
 *   triangles.
 * - field data: `Converged` (int, 1), and `Iterations` (int, 1) of the isometric map that took
 *   most. Other maps need no iterations. If a map has not converged, the filter warns and keeps it.
 *
 * Output port 1 (vtkPolyData): the flat triangles, beside the surface, with the arrays of the input
 * and of port 0. `TCoords` are always there. Points on cuts are there twice.
 * - point data, double: `SurfacePosition` (3 components), the place on the surface.
 * - point data, vtkIdType: `SurfacePoint`, the id of the point in the input.
 *
 * The filter needs no functions. It uses only WeldCoincidentPoints, NumberOfThreads, BlocksAsOne
 * and the DomainArray of the shared properties. On several MPI ranks the surface is gathered, and
 * port 1 is on rank 0.
 */
#ifndef vtkParameterization_h
#define vtkParameterization_h

#include "vtkSurfaceFEMAlgorithm.h"

class VTKGRIDFEMFILTERS_EXPORT vtkParameterization : public vtkSurfaceFEMAlgorithm
{
public:
  static vtkParameterization* New();
  vtkTypeMacro(vtkParameterization, vtkSurfaceFEMAlgorithm);
  void PrintSelf(ostream& os, vtkIndent indent) override;

  enum MapTypeType
  {
    Conformal = 0,
    Isometric = 1,
    Circle = 2
  };
  ///@{
  /**
   * What the map keeps. Default Conformal.
   */
  vtkSetInRangeMacro(MapType, int, Conformal, Circle);
  vtkGetMacro(MapType, int);
  ///@}

  ///@{
  /**
   * A boundary loop counts as a hole if it is at most this fraction of the longest one, or of a
   * tenth of the circle around the area. Holes are filled for the computation only. Longer loops
   * are connected by cuts. 0..1, default 0.5.
   */
  vtkSetInRangeMacro(HoleSize, double, 0.0, 1.0);
  vtkGetMacro(HoleSize, double);
  ///@}

  ///@{
  /**
   * The number of cuts toward the points farthest from all cuts and boundaries. They lower the
   * distortion of areas. A surface always gets eight or more if its boundary is at most half as
   * long as a circle around its area. Three quarters are enough if other cuts belong to the
   * boundary. 0..100, default 0.
   */
  vtkSetInRangeMacro(ExtraCuts, int, 0, 100);
  vtkGetMacro(ExtraCuts, int);
  ///@}

protected:
  vtkParameterization();
  ~vtkParameterization() override;

  void Compute(vtkInformationVector** inputs, vtkInformationVector* outputs) override;
  void FreeStages() override;

  int MapType = Conformal;
  double HoleSize = 0.5;
  int ExtraCuts = 0;

private:
  vtkParameterization(const vtkParameterization&) = delete;
  void operator=(const vtkParameterization&) = delete;

  struct Internals;
  std::unique_ptr<Internals> Data;
};

#endif
