/**
 * @class   vtkClipToOctree
 * @brief   cut a surface along the cells of an octree
 *
 * Lays the surface into a cube of 2^Depth cells per side and cuts every polygon along the cell
 * faces, so that every triangle of the output lies in one cell. All surface finite element filters
 * integrate on this mesh; the output is also the input of vtkConnectivityAwareBasis.
 *
 * Input: vtkPolyData with polygons of any size, concave ones too, or triangle strips. Vertices and
 * lines are left out.
 *
 * Output port 0 (vtkPolyData), the clipped mesh: triangles; the input's points first, in the same
 * order and precision (double when they are integers), then the cut points.
 * - point data: the input's arrays; real numbers interpolated to double, colours (unsigned char, 3
 *   or 4) interpolated and rounded, other integers and text from the nearest corner; global and
 *   pedigree ids are left out, because a cut point has none
 * - cell data: the input's arrays; `SourceCellId` (vtkIdType, 1): the input's cell; `OctreeCellId`
 *   (vtkIdType, 1): index into `OctreeCells`; `OctreeCellColor` (signed char, 1): 0 to 7, not the
 *   same for two cells that touch, to tell them apart by eye
 * - field data: the input's arrays; `OctreeCells` (int, 3): (i,j,k) of every cell, in Morton order;
 *   `GridOrigin` (double, 3), `GridSpacing` (double, 1), `GridDepth` (int, 1): the cube's lowest
 *   corner, the side of a cell, Depth; `WeldCoincidentPoints` (int, 1): the property
 *
 * Output port 1 (vtkPolyData), as GenerateQuadraturePoints says: the quadrature points, one vertex
 * each, with the point arrays `Weight` (double, 1), the surface area it stands for, and
 * `SourceCellId` (vtkIdType, 1).
 *
 * Output port 2 (vtkUnstructuredGrid), the octree: a voxel for every cell that holds surface, with
 * the cell array `Level` (int, 1): 0 is the whole cube, Depth the finest level.
 *
 * Used shared properties: Depth, WeldCoincidentPoints, QuadratureDegree (changes only output port
 * 1), NumberOfThreads.
 *
 * On several MPI ranks each puts out the triangles in its own cells of the octree, wherever their
 * polygons came from. One rank after the other, they are the triangles of one rank. Points are
 * those that triangles use: the input's first, in another order. `OctreeCells` are those of all
 * ranks on each. Arrays are those that the pieces of all ranks have.
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
   * The level that output port 2 shows: 0..14, where a level beyond Depth means the finest, or -1
   * for all levels. Default 14: the finest.
   */
  vtkSetClampMacro(Level, int, -1, 14);
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
   * Whether output port 1 has the quadrature points: three and more for every clipped triangle,
   * several times the memory of the clipped mesh. Off: it is empty. Automatic (default): it has
   * them where they are at most a million.
   */
  vtkSetClampMacro(GenerateQuadraturePoints, int, QuadraturePointsOff, QuadraturePointsAutomatic);
  vtkGetMacro(GenerateQuadraturePoints, int);
  vtkBooleanMacro(GenerateQuadraturePoints, int);
  ///@}

protected:
  vtkClipToOctree();
  ~vtkClipToOctree() override;

  int FillOutputPortInformation(int port, vtkInformation* info) override;
  void Compute(vtkInformationVector** inputs, vtkInformationVector* outputs) override;
  bool ComputeTogether(vtkInformationVector** inputs, vtkInformationVector* outputs) override;
  void FreeStages() override;

  int GenerateQuadraturePoints = QuadraturePointsAutomatic;
  int Level = 14;

private:
  vtkClipToOctree(const vtkClipToOctree&) = delete;
  void operator=(const vtkClipToOctree&) = delete;

  bool WantsQuadraturePoints(double triangles) const;
  void ClipTogether(vtkPolyData* piece, int threads);

  struct Internals;
  std::unique_ptr<Internals> Data;
};

#endif
