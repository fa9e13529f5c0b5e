// Names of the arrays with which a clipped mesh and its basis travel as vtkPolyData. [DESIGN §4]
#ifndef GridFEM_ClippedArrays_h
#define GridFEM_ClippedArrays_h

#include "Grid/GridFunctions.h"
#include "Input/InputMesh.h"

class vtkPolyData;

namespace gridfem
{

constexpr const char* SourceCellIdName = "SourceCellId"; // cell data
constexpr const char* OctreeCellIdName = "OctreeCellId";
constexpr const char* OctreeCellColorName = "OctreeCellColor"; // for the eye
constexpr const char* PatchIdName = "PatchId";
constexpr const char* PatchColorName = "PatchColor"; // for the eye

constexpr const char* OctreeCellsName = "OctreeCells"; // field data
constexpr const char* GridOriginName = "GridOrigin";
constexpr const char* GridSpacingName = "GridSpacing";
constexpr const char* GridDepthName = "GridDepth";
constexpr const char* PatchCellIdName = "PatchCellId";
constexpr const char* PatchBasisIdsName = "PatchBasisIds";
constexpr const char* NumberOfBasisFunctionsName = "NumberOfBasisFunctions";
// These two make the coarse levels the same after reading back.
constexpr const char* ConnectivityAwareName = "ConnectivityAware";
constexpr const char* WeldCoincidentPointsName = "WeldCoincidentPoints";

/// Whether a cell array, or a field array, of this name (may be null) is one of a clip or a basis.
bool IsClipCellArray(const char* name);
bool IsClipFieldArray(const char* name);

/// Removes the arrays of the clip and of the basis.
void RemoveClipArrays(vtkPolyData* data);

/// Whether the vtkPolyData is the output of Clip To Octree (or of the basis filter).
bool CarriesClip(vtkPolyData* data);

/// Whether the vtkPolyData is the output of the basis filter.
bool CarriesBasis(vtkPolyData* data);

} // namespace gridfem

#endif
