/**
 * @class   vtkConnectivityAwareBasis
 * @brief   build the basis functions of a surface, one per connected piece of a support
 *
 * Groups the clipped triangles of every octree cell into connected patches and gives every patch
 * its eight trilinear basis functions. If the support of a function meets the surface in several
 * connected pieces, the function is split into one per piece, unless ConnectivityAware is off. The
 * output of port 0 can be the input of any number of solver filters, which then share one basis.
 *
 * Input: the output of vtkClipToOctree, or any vtkPolyData with polygons. The filter takes the grid
 * of a clipped mesh and clips any other input first.
 *
 * Output port 0 (vtkPolyData) is the clipped mesh with all arrays of vtkClipToOctree and the
 * following arrays.
 * - cell data: `PatchId` (vtkIdType, 1) is an index into `PatchBasisIds`.
 * - cell data: `PatchColor` (signed char, 1) differs where patches of two cells touch. The first
 *   patch of an octree cell has 0 to 7, the cell's other patches have 8 to 15.
 * - field data: `PatchCellId` (vtkIdType, 1) is the octree cell of a patch.
 * - field data: `PatchBasisIds` (vtkIdType, 8) lists the eight functions of a patch, corner order x
 *   fastest.
 * - field data: `NumberOfBasisFunctions` (int, 1); `ConnectivityAware` (int, 1), the property.
 * - point data: `BasisFunction` (double, 1) is the function BasisId, if BasisId is not negative.
 *
 * Output port 1 (vtkUnstructuredGrid) is the basis of one level: a voxel for every patch. Its
 * points are the functions. Split functions are coincident points.
 * - point data: `BasisId` (vtkIdType, 1) is the id of the function.
 * - point data: `SupportArea` (double, 1) is the area of the patches that the function touches.
 * - point data: `Component` (vtkIdType, 1) is the connected component on which the function lives.
 * - cell data: `PatchId` (vtkIdType, 1), `Level` (int, 1).
 *
 * The filter uses the shared properties Depth, ConnectivityAware, WeldCoincidentPoints and
 * NumberOfThreads. Depth has no effect on a clipped mesh. WeldCoincidentPoints also applies to a
 * clipped mesh, and replaces the value with which the clip was made.
 *
 * On several MPI ranks, each rank outputs the triangles in its own cells of the octree. Their
 * polygons may come from other ranks. In rank order, the ranks together output the triangles that
 * one rank would output. Every rank has the whole tables of the basis, coarse levels included. The
 * first rank shows the functions of coarse levels. Only arrays that the pieces of all ranks have
 * are output. Triangles that were clipped before, by all ranks or by one, stay on their ranks.
 */
#ifndef vtkConnectivityAwareBasis_h
#define vtkConnectivityAwareBasis_h

#include "vtkSurfaceFEMAlgorithm.h"

class VTKGRIDFEMFILTERS_EXPORT vtkConnectivityAwareBasis : public vtkSurfaceFEMAlgorithm
{
public:
  static vtkConnectivityAwareBasis* New();
  vtkTypeMacro(vtkConnectivityAwareBasis, vtkSurfaceFEMAlgorithm);
  void PrintSelf(ostream& os, vtkIndent indent) override;

  ///@{
  /**
   * The level that output port 1 shows and that BasisId refers to. 0 is the whole cube, and a level
   * beyond Depth means the finest. 0..14, default 14: the finest.
   */
  vtkSetInRangeMacro(Level, int, 0, 14);
  vtkGetMacro(Level, int);
  ///@}

  ///@{
  /**
   * The function of Level to evaluate as the point array `BasisFunction` of output port 0. -1
   * (default) evaluates none.
   */
  vtkSetInRangeMacro(BasisId, vtkIdType, -1, VTK_ID_MAX);
  vtkGetMacro(BasisId, vtkIdType);
  ///@}

protected:
  vtkConnectivityAwareBasis();
  ~vtkConnectivityAwareBasis() override;

  int FillOutputPortInformation(int port, vtkInformation* info) override;
  void Compute(vtkInformationVector** inputs, vtkInformationVector* outputs) override;
  bool NeedsWholeSurface() override;

  int Level = 14;
  vtkIdType BasisId = -1;

private:
  vtkConnectivityAwareBasis(const vtkConnectivityAwareBasis&) = delete;
  void operator=(const vtkConnectivityAwareBasis&) = delete;
};

#endif
