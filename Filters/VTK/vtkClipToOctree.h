/**
 * @class   vtkClipToOctree
 * @brief   cut a surface along the cells of an octree
 *
 * Lays the surface into a cube of 2^Depth cells per side and cuts every polygon along the cell
 * faces. Every triangle of the output lies in one cell. All surface finite element filters
 * integrate on such a mesh. The output is also an input of vtkConnectivityAwareBasis.
 *
 * Input: vtkPolyData with polygons of any size, concave ones too, or triangle strips. Vertices and
 * lines are left out.
 *
 * Output port 0 (vtkPolyData) is the clipped mesh, made of triangles. The input's points come
 * first, in the same order and precision (double when they are integers). The cut points follow.
 * Points of a seam that coincide except for rounding are at one place.
 * - point data: the input's arrays. Real numbers are interpolated to double. Colors (unsigned char,
 *   3 or 4 components) are interpolated and rounded. Other integers and text come from the nearest
 *   corner. Global and pedigree ids are left out, because a cut point has none.
 * - cell data: the input's arrays.
 * - cell data: `SourceCellId` (vtkIdType, 1) is the input's cell.
 * - cell data: `OctreeCellId` (vtkIdType, 1) is an index into `OctreeCells`.
 * - cell data: `OctreeCellColor` (signed char, 1) is 0 to 7. Cells that touch have different
 *   colors, so that you can tell them apart by eye.
 * - field data: the input's arrays.
 * - field data: `OctreeCells` (int, 3) is the (i,j,k) of every cell, in Morton order.
 * - field data: `GridOrigin` (double, 3) is the lowest corner of the cube, `GridSpacing` (double,
 *   1) is the side of a cell, and `GridDepth` (int, 1) is Depth.
 * - field data: `WeldCoincidentPoints` (int, 1) is the property.
 *
 * Output port 1 (vtkPolyData) holds the quadrature points, one vertex each, if
 * GenerateQuadraturePoints asks for them.
 * - point data: `Weight` (double, 1) is the surface area that the point stands for.
 * - point data: `SourceCellId` (vtkIdType, 1) is the input's cell.
 *
 * Output port 2 (vtkUnstructuredGrid) is the octree: a voxel for every cell that holds surface.
 * - cell data: `Level` (int, 1) is 0 for the whole cube and Depth for the finest level.
 *
 * The filter uses the shared properties Depth, WeldCoincidentPoints, NumberOfThreads and
 * QuadratureDegree. QuadratureDegree changes only output port 1.
 *
 * On several MPI ranks, each rank outputs the triangles in its own cells of the octree. Their
 * polygons may come from other ranks. In rank order, the ranks together output the triangles that
 * one rank would output. Each rank has only the points that its triangles use: the input's points
 * first, in another order. `OctreeCells` lists the cells of all ranks, on each rank. Only arrays
 * that the pieces of all ranks have are output.
 */
#ifndef vtkClipToOctree_h
#define vtkClipToOctree_h

#include "vtkSurfaceFEMAlgorithm.h"

class VTKGRIDFEMFILTERS_EXPORT vtkClipToOctree : public vtkSurfaceFEMAlgorithm
{
public:
  static vtkClipToOctree* New();
  vtkTypeMacro(vtkClipToOctree, vtkSurfaceFEMAlgorithm);
  void PrintSelf(ostream& os, vtkIndent indent) override;

  ///@{
  /**
   * The level that output port 2 shows. The range is -1..14: -1 shows all levels, and a level
   * beyond Depth shows the finest. Default 14: the finest.
   */
  vtkSetInRangeMacro(Level, int, -1, 14);
  vtkGetMacro(Level, int);
  ///@}

  enum QuadraturePointsType
  {
    QuadraturePointsOff = 0,
    QuadraturePointsOn = 1,
    QuadraturePointsAutomatic = 2
  };
  ///@{
  /**
   * Whether output port 1 has the quadrature points. Every clipped triangle has at least three
   * points, so they take several times the memory of the clipped mesh. Off leaves the port empty.
   * Automatic (default) fills it if there are at most a million points.
   */
  vtkSetInRangeMacro(GenerateQuadraturePoints, int, QuadraturePointsOff, QuadraturePointsAutomatic);
  vtkGetMacro(GenerateQuadraturePoints, int);
  vtkBooleanMacro(GenerateQuadraturePoints, int);
  ///@}

protected:
  vtkClipToOctree();
  ~vtkClipToOctree() override;

  int FillOutputPortInformation(int port, vtkInformation* info) override;
  void Compute(vtkInformationVector** inputs, vtkInformationVector* outputs) override;
  bool NeedsWholeSurface() override;

  int GenerateQuadraturePoints = QuadraturePointsAutomatic;
  int Level = 14;

private:
  vtkClipToOctree(const vtkClipToOctree&) = delete;
  void operator=(const vtkClipToOctree&) = delete;

  bool WantsQuadraturePoints(double triangles) const;
};

#endif
