// Writes the octree, its quadrature points and its basis functions as data for display.
#ifndef GridFEM_OctreeOutput_h
#define GridFEM_OctreeOutput_h

#include "Grid/GridFunctions.h"
#include "Input/InputMesh.h"
#include "Integrals/QuadratureRule.h"

class vtkPolyData;
class vtkUnstructuredGrid;

namespace gridfem
{

/// Returns the cells that contain surface as voxels with the cell array Level.
/// @param level      the depth of the level: 0 is the whole cube, the grid's depth the finest; -1
/// for all levels, finest first
/// @param precision  VTK_FLOAT or VTK_DOUBLE
/// @param before     for a part of a clipped mesh, the last cell before its own, whose owner writes
/// its ancestors; null: none
void WriteOctreeCells(const ClippedMesh& clipped, int level, int precision, int threads,
  vtkUnstructuredGrid* output, const MortonKey* before = nullptr);

/// Returns the points of the rule on every clipped triangle as vertices with the point arrays
/// Weight (world area) and SourceCellId.
void WriteQuadraturePoints(const InputMesh& mesh, const ClippedMesh& clipped,
  const QuadratureRule& rule, int precision, int threads, vtkPolyData* output);

/// A level, or a part of one, with the numbers shown of its functions.
struct ShownLevel
{
  const PatchLevel* level = nullptr;
  Id firstPatch = 0;         // the number of the level's first patch
  std::vector<Id> function;  // the number of every function
  std::vector<double> area;  // of the patches that a function touches, world units
  std::vector<Id> component; // of every function
};

/// Returns the world area of the surface in every patch of the finest level.
std::vector<double> PatchAreas(const GridFunctions& space);

/// Returns the numbers shown of a level, or of the patches of a part of the surface.
/// @param levels      finest first; must live as long as the result is used
/// @param areas       the areas of the patches of the finest level
/// @param components  the components of its functions
ShownLevel DescribeLevel(const std::vector<PatchLevel>& levels, const std::vector<double>& areas,
  const std::vector<Index>& components, std::size_t level);

/// Returns the patches of a level as voxels whose points are the basis functions. The point arrays
/// are BasisId, SupportArea and Component. The cell arrays are PatchId and Level.
void WriteBasisFunctions(
  const Grid& grid, const ShownLevel& shown, int precision, vtkUnstructuredGrid* output);

constexpr const char* BasisFunctionName = "BasisFunction"; // point data

/// Throws InvalidInput unless a level with so many functions has this one.
void RequireBasisFunction(int depth, Id functions, Id function);

/// Returns the coefficients, on the finest level, of one function of a level. Throws InvalidInput
/// if there is no function with this id.
MultiVector BasisFunctionCoefficients(
  const std::vector<PatchLevel>& levels, int level, Id function);

/// Returns the place of the level of this depth. A greater depth means the finest.
std::size_t LevelOfDepth(const std::vector<PatchLevel>& levels, int depth);

} // namespace gridfem

#endif
