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
/// @param before     of a part of a clipped mesh the last cell before its own, whose ancestors are
///                   left to who has it; null: none
void WriteOctreeCells(const ClippedMesh& clipped, int level, int precision, int threads,
  vtkUnstructuredGrid* output, const MortonKey* before = nullptr);

/// The points of the rule on every clipped triangle as vertices with the point arrays Weight (world
/// area) and SourceCellId.
void WriteQuadraturePoints(const InputMesh& mesh, const ClippedMesh& clipped,
  const QuadratureRule& rule, int precision, int threads, vtkPolyData* output);

/// A level, or a part of one, and what is shown of its functions.
struct ShownLevel
{
  const PatchLevel* level = nullptr;
  Id firstPatch = 0;         // the number of the level's first one
  std::vector<Id> function;  // the number of every function
  std::vector<double> area;  // of the patches that a function touches, world units
  std::vector<Id> component; // of every function
};

/// World area of the surface in every patch of the finest level.
std::vector<double> PatchAreas(const GridFunctions& space);

/// What is shown of a level; of a part of the surface what its patches say.
/// @param levels      finest first, as long as the result is used
/// @param areas       of the patches of the finest level
/// @param components  of its functions
ShownLevel DescribeLevel(const std::vector<PatchLevel>& levels, const std::vector<double>& areas,
  const std::vector<Index>& components, std::size_t level);

/// The patches of a level as voxels whose points are the basis functions: point arrays BasisId,
/// SupportArea, Component; cell arrays PatchId, Level.
void WriteBasisFunctions(
  const Grid& grid, const ShownLevel& shown, int precision, vtkUnstructuredGrid* output);

constexpr const char* BasisFunctionName = "BasisFunction"; // point data

/// Throws InvalidInput unless a level with so many functions has this one.
void RequireBasisFunction(int depth, Id functions, Id function);

/// The coefficients, on the finest level, of one function of a level. Throws InvalidInput when
/// there is no function with this id.
MultiVector BasisFunctionCoefficients(
  const std::vector<PatchLevel>& levels, int level, Id function);

/// The place of the level of this depth; of the finest for a greater one.
std::size_t LevelOfDepth(const std::vector<PatchLevel>& levels, int depth);

} // namespace gridfem

#endif
