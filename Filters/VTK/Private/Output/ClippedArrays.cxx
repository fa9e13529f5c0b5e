#include "Output/ClippedArrays.h"

#include "vtkCellData.h"
#include "vtkFieldData.h"
#include "vtkPolyData.h"

#include <algorithm>
#include <cstring>
#include <iterator>

namespace gridfem
{
namespace
{

constexpr const char* CellArrays[] = { SourceCellIdName, OctreeCellIdName, OctreeCellColorName,
  PatchIdName, PatchColorName };

constexpr const char* FieldArrays[] = { OctreeCellsName, GridOriginName, GridSpacingName,
  GridDepthName, WeldCoincidentPointsName, PatchCellIdName, PatchBasisIdsName,
  NumberOfBasisFunctionsName, ConnectivityAwareName };

template<std::size_t Count>
bool IsAmong(const char* const (&names)[Count], const char* name)
{
  return name && std::any_of(std::begin(names), std::end(names),
                   [name](const char* other) { return std::strcmp(name, other) == 0; });
}

} // namespace

bool IsClipCellArray(const char* name)
{
  return IsAmong(CellArrays, name);
}

bool IsClipFieldArray(const char* name)
{
  return IsAmong(FieldArrays, name);
}

void RemoveClipArrays(vtkPolyData* data)
{
  for (const char* name : CellArrays)
  {
    data->GetCellData()->RemoveArray(name);
  }
  for (const char* name : FieldArrays)
  {
    data->GetFieldData()->RemoveArray(name);
  }
}

bool CarriesClip(vtkPolyData* data)
{
  return data && data->GetFieldData()->HasArray(OctreeCellsName) &&
         data->GetCellData()->HasArray(OctreeCellIdName);
}

bool CarriesBasis(vtkPolyData* data)
{
  return CarriesClip(data) && data->GetFieldData()->HasArray(PatchBasisIdsName) &&
         data->GetCellData()->HasArray(PatchIdName);
}

} // namespace gridfem
