/**
 * @class   vtkGeodesicPaths
 * @brief   shortest paths along a surface between some of its points
 *
 * Connects points by the shortest lines on the surface, exactly on its triangles (see `Shortest`
 * below). A search through points and midpoints of edges finds a first path. The path is pulled
 * tight until no line nearby is shorter. A search by windows (Chen and Han 1990, Xin and Wang 2009)
 * then looks for a shorter path everywhere.
 *
 * PathType determines the connections. ToNearestSource (default) leads a path from the nearest
 * source to each target. InOrder leads from each point to the next: the sources first, then the
 * targets. Closed also leads from the last point to the first. AllPairs connects each point with
 * all that come later in this order; the array Length then holds the matrix of their distances.
 *
 * The sources are the points in SourcePointIds and the points where the SourceArray is not 0. The
 * targets are the points in TargetPointIds, the points where the TargetArray is not 0, and the
 * points in the selection of port 1. The filter chooses missing points. If there are several
 * targets and no source, the first target becomes the source. If there is no point at all, the
 * source is the first point of the surface. If the source or the target is still missing, it is the
 * point farthest from the others.
 *
 * Input port 0: vtkPolyData with polygons or triangle strips.
 * Input port 1 (optional): vtkSelection of points or cells of port 0. A selected cell selects its
 * points.
 *
 * SetInputArrayToProcess(0, ...) chooses the SourceArray, SetInputArrayToProcess(1, ...) the
 * TargetArray. Both are point data with one component.
 *
 * Output port 0 (vtkPolyData): the input with the following arrays.
 * - cell data, vtkIdType: `PathId`, the number of the first path through the cell; -1: none.
 * - field data, vtkIdType: `UnreachedTargets`, the ids of targets on another connected component,
 *   to which no path leads. The filter warns about them.
 *
 * Output port 1 (vtkPolyData): a polyline for each path, from its source to its target, with the
 * point arrays of the input and with the following arrays.
 * - point data, double: `ArcLength`, the length of the path up to the point, in the unit of points.
 * - point data, vtkIdType: `CellId`, the cell of the input in which the path runs from the previous
 *   point to this one. `CornerIds` (3 components) are points of the input at the corners of a
 *   triangle in this cell.
 * - point data, double: `CornerWeights` (3 components), at least 0, sum 1. The point is the mean of
 *   the corners with these weights.
 * - cell data: `Length` (double), `SourceId` and `TargetId` (vtkIdType).
 * - cell data, int: `Shortest`, 1 if no path on the surface is shorter. It is 0 if the search
 *   needed more than 4 million windows, which happens on very large meshes, with a warning. Even
 *   then, no path nearby is shorter.
 *
 * The filter needs no functions. It uses only WeldCoincidentPoints, NumberOfThreads, BlocksAsOne
 * and the DomainArray of the shared properties. On several MPI ranks the surface is gathered, and
 * port 1 is on rank 0.
 */
#ifndef vtkGeodesicPaths_h
#define vtkGeodesicPaths_h

#include "vtkSurfaceFEMAlgorithm.h"

class VTKGRIDFEMFILTERS_EXPORT vtkGeodesicPaths : public vtkSurfaceFEMAlgorithm
{
public:
  static vtkGeodesicPaths* New();
  vtkTypeMacro(vtkGeodesicPaths, vtkSurfaceFEMAlgorithm);
  void PrintSelf(ostream& os, vtkIndent indent) override;

  ///@{
  /**
   * Points at which paths start. None by default. The filter refuses an id that no polygon uses
   * when it runs.
   */
  void AddSourcePointId(vtkIdType id);
  void ClearSourcePointIds();
  vtkIdType GetNumberOfSourcePointIds();
  vtkIdType GetSourcePointId(vtkIdType index);
  ///@}

  ///@{
  /**
   * Points at which paths end. None by default. The filter refuses an id that no polygon uses when
   * it runs.
   */
  void AddTargetPointId(vtkIdType id);
  void ClearTargetPointIds();
  vtkIdType GetNumberOfTargetPointIds();
  vtkIdType GetTargetPointId(vtkIdType index);
  ///@}

  enum PathTypeType
  {
    ToNearestSource = 0,
    InOrder = 1,
    Closed = 2,
    AllPairs = 3
  };
  ///@{
  /**
   * The rule by which points are connected. Default ToNearestSource.
   */
  vtkSetInRangeMacro(PathType, int, ToNearestSource, AllPairs);
  vtkGetMacro(PathType, int);
  ///@}

protected:
  vtkGeodesicPaths();
  ~vtkGeodesicPaths() override;

  void Compute(vtkInformationVector** inputs, vtkInformationVector* outputs) override;
  void FreeStages() override;

  int PathType = ToNearestSource;

private:
  vtkGeodesicPaths(const vtkGeodesicPaths&) = delete;
  void operator=(const vtkGeodesicPaths&) = delete;

  struct Internals;
  std::unique_ptr<Internals> Data;
};

#endif
