/**
 * @class   vtkConnectivityAwareBasis
 * @brief   build the basis functions of a surface, one per connected piece of a support
 *
 * Groups the clipped triangles of every octree cell to connected patches and gives every patch its
 * eight trilinear basis functions. Functions of a grid corner whose support meets the surface in
 * several connected pieces are split, unless ConnectivityAware is off. The output of port 0 can be
 * the input of any number of solver filters, which then share one basis.
 *
 * Input: the output of vtkClipToOctree, whose grid is taken, or any vtkPolyData with polygons,
 * which is clipped first.
 *
 * Output port 0 (vtkPolyData), the clipped mesh with all arrays of vtkClipToOctree, and
 * - cell data: `PatchId` (vtkIdType, 1): index into `PatchBasisIds`; `PatchColor` (signed char, 1):
 *   0 to 7, and 8 to 15 on all patches of an octree cell but its first; not the same where patches
 *   of two cells touch
 * - field data: `PatchCellId` (vtkIdType, 1) and `PatchBasisIds` (vtkIdType, 8): a patch's octree
 *   cell and its eight functions, corner order x fastest; `NumberOfBasisFunctions` (int, 1);
 *   `ConnectivityAware` (int, 1): the property
 * - point data: `BasisFunction` (double, 1), the function BasisId, when that is not negative
 *
 * Output port 1 (vtkUnstructuredGrid), the basis of one level: a voxel for every patch, whose
 * points are the functions (split functions are coincident points).
 * - point data: `BasisId` (vtkIdType, 1); `SupportArea` (double, 1): area of the patches that the
 *   function touches; `Component` (vtkIdType, 1): the connected component it lives on
 * - cell data: `PatchId` (vtkIdType, 1), `Level` (int, 1)
 *
 * Used shared properties: Depth (of a mesh that is not clipped yet), ConnectivityAware,
 * WeldCoincidentPoints (of a mesh that is clipped as well, whatever the clip was made with),
 * NumberOfThreads.
 *
 * On several MPI ranks each puts out the triangles in its own cells of the octree, wherever their
 * polygons came from. One rank after the other, they are the triangles of one rank. The tables of
 * the basis are whole on all, and so are coarse levels, whose functions are shown on the first
 * rank. Arrays are those that the pieces of all ranks have. Triangles that were clipped before, by
 * all ranks or by one, stay on the ranks that have them.
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
   * The level that output port 1 shows and that BasisId counts in: 0 is the whole cube; a level
   * beyond Depth means the finest. 0..14, default 14: the finest.
   */
  vtkSetClampMacro(Level, int, 0, 14);
  vtkGetMacro(Level, int);
  ///@}

  ///@{
  /**
   * The function of Level to evaluate as the point array `BasisFunction` of output port 0; -1 for
   * none. Default -1.
   */
  vtkSetClampMacro(BasisId, vtkIdType, -1, VTK_ID_MAX);
  vtkGetMacro(BasisId, vtkIdType);
  ///@}

protected:
  vtkConnectivityAwareBasis();
  ~vtkConnectivityAwareBasis() override;

  int FillOutputPortInformation(int port, vtkInformation* info) override;
  void Compute(vtkInformationVector** inputs, vtkInformationVector* outputs) override;
  bool ComputeTogether(vtkInformationVector** inputs, vtkInformationVector* outputs) override;
  void FreeStages() override;

  int Level = 14;
  vtkIdType BasisId = -1;

private:
  vtkConnectivityAwareBasis(const vtkConnectivityAwareBasis&) = delete;
  void operator=(const vtkConnectivityAwareBasis&) = delete;

  void UpdateBasis(vtkPolyData* input);
  void ReadClip(vtkPolyData* input);
  void AddBasisFunction(vtkPolyData* output);

  struct Internals;
  std::unique_ptr<Internals> Data;
};

#endif
