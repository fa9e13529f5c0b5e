#include "Pieces/PieceArrays.h"

#include "Pieces/DataMessage.h"
#include "Pipeline/Allocation.h"

#include "vtkCellData.h"
#include "vtkDataArray.h"
#include "vtkPointData.h"
#include "vtkUnsignedCharArray.h"

#include <algorithm>
#include <numeric>

namespace gridfem
{
namespace
{

bool NamesAnOrigin(const std::string& name)
{
  return name == "vtkProcessId" || name == "ProcessId" || name == "vtkOriginalPointIds" ||
         name == "vtkOriginalCellIds";
}

bool IsNumeric(vtkAbstractArray* array)
{
  return vtkDataArray::SafeDownCast(array) != nullptr;
}

std::vector<std::string> NamesOf(const Pieces& pieces, AttributesOf attributesOf)
{
  std::vector<std::string> names;
  for (vtkPolyData* piece : pieces)
  {
    vtkDataSetAttributes* data = attributesOf(piece);
    for (int k = 0; k < data->GetNumberOfArrays(); ++k)
    {
      const char* name = data->GetAbstractArray(k)->GetName();
      if (name && std::string(name) != vtkDataSetAttributes::GhostArrayName() &&
          std::find(names.begin(), names.end(), name) == names.end())
      {
        names.emplace_back(name);
      }
    }
  }
  return names;
}

bool AreAlike(vtkAbstractArray* a, vtkAbstractArray* b)
{
  return IsNumeric(a) == IsNumeric(b) && a->GetNumberOfComponents() == b->GetNumberOfComponents();
}

bool HaveSameNumbers(vtkDataArray* a, vtkIdType atA, vtkDataArray* b, vtkIdType atB)
{
  for (int c = 0; c < a->GetNumberOfComponents(); ++c)
  {
    const double value = a->GetComponent(atA, c);
    const double other = b->GetComponent(atB, c);
    const bool areBothUnknown = value != value && other != other; // NaN
    if (value != other && !areBothUnknown)
    {
      return false;
    }
  }
  return true;
}

bool HaveSameTuples(vtkAbstractArray* a, vtkIdType atA, vtkAbstractArray* b, vtkIdType atB)
{
  if (vtkDataArray* numbers = vtkDataArray::SafeDownCast(a))
  {
    return HaveSameNumbers(numbers, atA, vtkDataArray::SafeDownCast(b), atB);
  }
  const int components = a->GetNumberOfComponents();
  for (int c = 0; c < components; ++c)
  {
    if (a->GetVariantValue(atA * components + c) != b->GetVariantValue(atB * components + c))
    {
      return false;
    }
  }
  return true;
}

/// Returns an array of the common type, or of double.
vtkSmartPointer<vtkAbstractArray> NewArrayLike(const ArraysOfPieces& arrays)
{
  const int type = arrays[0]->GetDataType();
  const bool isOneType = std::all_of(arrays.begin(), arrays.end(),
    [=](vtkAbstractArray* array) { return array->GetDataType() == type && type != VTK_BIT; });
  vtkSmartPointer<vtkAbstractArray> array;
  array.TakeReference(
    vtkAbstractArray::CreateArray(isOneType || !IsNumeric(arrays[0]) ? type : VTK_DOUBLE));
  array->SetName(arrays[0]->GetName());
  array->SetNumberOfComponents(arrays[0]->GetNumberOfComponents());
  array->CopyComponentNames(arrays[0]);
  return array;
}

} // namespace

std::array<vtkCellArray*, CellKinds> CellsOf(vtkPolyData* piece)
{
  return { piece->GetVerts(), piece->GetLines(), piece->GetPolys(), piece->GetStrips() };
}

std::vector<vtkIdType> Ascending(vtkIdType count)
{
  std::vector<vtkIdType> places(count);
  std::iota(places.begin(), places.end(), 0);
  return places;
}

vtkDataSetAttributes* PointDataOf(vtkPolyData* piece)
{
  return piece->GetPointData();
}

vtkDataSetAttributes* CellDataOf(vtkPolyData* piece)
{
  return piece->GetCellData();
}

vtkUnsignedCharArray* GhostsOf(vtkDataSetAttributes* data, vtkIdType tuples)
{
  auto* ghosts = vtkArrayDownCast<vtkUnsignedCharArray>(
    data->GetAbstractArray(vtkDataSetAttributes::GhostArrayName()));
  return ghosts && ghosts->GetNumberOfTuples() == tuples ? ghosts : nullptr;
}

std::size_t Numbering::PieceOf(vtkIdType thing) const
{
  return std::upper_bound(first.begin(), first.end(), thing) - first.begin() - 1;
}

ArraysOfPieces GlobalIds(const Pieces& pieces, AttributesOf attributesOf)
{
  ArraysOfPieces ids;
  for (vtkPolyData* piece : pieces)
  {
    vtkDataArray* own = attributesOf(piece)->GetGlobalIds();
    const vtkIdType count = attributesOf(piece) == piece->GetPointData()
                              ? piece->GetNumberOfPoints()
                              : piece->GetNumberOfCells();
    if (!own || own->GetNumberOfComponents() != 1 || own->GetNumberOfTuples() != count)
    {
      return {};
    }
    ids.push_back(own);
  }
  return ids;
}

std::vector<ArraysOfPieces> CommonArrays(const Pieces& pieces, AttributesOf attributesOf,
  const Numbering& numbering, const std::vector<std::string>& owners,
  std::vector<std::string>& partial)
{
  std::vector<ArraysOfPieces> common;
  for (const std::string& name : NamesOf(pieces, attributesOf))
  {
    ArraysOfPieces arrays;
    for (std::size_t p = 0; p < pieces.size() && arrays.size() == p; ++p)
    {
      vtkAbstractArray* array = attributesOf(pieces[p])->GetAbstractArray(name.c_str());
      if (array && CanTravel(array) &&
          array->GetNumberOfTuples() == numbering.first[p + 1] - numbering.first[p] &&
          (arrays.empty() || AreAlike(array, arrays[0])))
      {
        arrays.push_back(array);
      }
      else
      {
        partial.push_back("'" + name + "' (" + owners[p] + ")");
      }
    }
    if (arrays.size() == pieces.size())
    {
      common.push_back(std::move(arrays));
    }
  }
  return common;
}

bool HaveSameValues(const std::vector<ArraysOfPieces>& arrays, const Numbering& numbering,
  vtkIdType thing, vtkIdType other)
{
  const std::size_t p = numbering.PieceOf(thing);
  const std::size_t q = numbering.PieceOf(other);
  return std::all_of(arrays.begin(), arrays.end(),
    [&](const ArraysOfPieces& array)
    {
      return NamesAnOrigin(array[0]->GetName()) ||
             HaveSameTuples(
               array[p], thing - numbering.first[p], array[q], other - numbering.first[q]);
    });
}

vtkSmartPointer<vtkAbstractArray> Pick(
  const ArraysOfPieces& arrays, const Numbering& numbering, const std::vector<vtkIdType>& things)
{
  vtkSmartPointer<vtkAbstractArray> picked = NewArrayLike(arrays);
  SetTuples(picked, static_cast<vtkIdType>(things.size()));
  for (std::size_t k = 0; k < things.size(); ++k)
  {
    const std::size_t piece = numbering.PieceOf(things[k]);
    picked->SetTuple(static_cast<vtkIdType>(k), things[k] - numbering.first[piece], arrays[piece]);
  }
  return picked;
}

} // namespace gridfem
