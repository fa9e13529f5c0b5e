// The octree, its quadrature points and its basis functions as data that can be looked at.
#ifndef GridFEM_OctreeOutput_h
#define GridFEM_OctreeOutput_h

#include "Grid/GridFunctions.h"
#include "InputMesh.h"
#include "Integrals/QuadratureRule.h"

class vtkPolyData;
class vtkUnstructuredGrid;

namespace gridfem
{

/// Cells that contain surface as voxels with the cell array Level.
/// @param level      the depth of the level: 0 is the whole cube, the grid's depth the finest;
///                   -1 for all levels, finest first
/// @param precision  VTK_FLOAT or VTK_DOUBLE
void WriteOctreeCells(
  const ClippedMesh& clipped, int level, int precision, int threads, vtkUnstructuredGrid* output);

/// The points of the rule on every clipped triangle as vertices with the point arrays Weight (world
/// area) and SourceCellId.
void WriteQuadraturePoints(const InputMesh& mesh, const ClippedMesh& clipped,
  const QuadratureRule& rule, int precision, int threads, vtkPolyData* output);

/// The patches of a level as voxels whose points are the basis functions: point arrays BasisId,
/// SupportArea (world area of the patches a function touches), Component; cell arrays PatchId,
/// Level.
void WriteBasisFunctions(
  const GridFunctions& space, int level, int precision, vtkUnstructuredGrid* output);

/// The coefficients, on the finest level, of one function of a level. Throws InvalidInput when
/// there is no function with this id.
MultiVector BasisFunctionCoefficients(const GridFunctions& space, int level, Id function);

/// The level of this depth; the finest for a greater one.
const PatchLevel& LevelOfDepth(const GridFunctions& space, int depth);

} // namespace gridfem

#endif
