#include "Pieces/JoinedPieces.h"

#include "Pipeline/Allocation.h"

#include "vtkCellData.h"
#include "vtkUnsignedCharArray.h"

namespace gridfem
{

void WriteJoinedCells(const Pieces& pieces, const Numbering& points,
  const std::vector<vtkIdType>& pointPlace, const std::vector<vtkIdType>& cellSource,
  const std::array<vtkIdType, CellKinds>& kindEnd, vtkPolyData* whole)
{
  std::vector<vtkIdType> begin{ 0 }; // of the corners of a cell
  std::vector<vtkIdType> corners;
  for (std::size_t p = 0; p < pieces.size(); ++p)
  {
    ForEachCell(pieces[p],
      [&](vtkIdType, const vtkIdType* ids, vtkIdType size)
      {
        for (vtkIdType k = 0; k < size; ++k)
        {
          corners.push_back(pointPlace[points.first[p] + ids[k]]);
        }
        begin.push_back(static_cast<vtkIdType>(corners.size()));
      });
  }
  std::array<vtkSmartPointer<vtkCellArray>, CellKinds> kinds;
  vtkIdType place = 0;
  for (int kind = 0; kind < CellKinds; ++kind)
  {
    kinds[kind] = vtkSmartPointer<vtkCellArray>::New();
    vtkIdType size = 0;
    for (vtkIdType k = place; k < kindEnd[kind]; ++k)
    {
      size += begin[cellSource[k] + 1] - begin[cellSource[k]];
    }
    ReserveCells(kinds[kind], kindEnd[kind] - place, size);
    for (; place < kindEnd[kind]; ++place)
    {
      const vtkIdType cell = cellSource[place];
      kinds[kind]->InsertNextCell(begin[cell + 1] - begin[cell], corners.data() + begin[cell]);
    }
  }
  whole->SetVerts(kinds[0]);
  whole->SetLines(kinds[1]);
  whole->SetPolys(kinds[2]);
  whole->SetStrips(kinds[3]);
}

void WriteJoinedArrays(const Pieces& pieces, const std::vector<ArraysOfPieces>& arrays,
  const Numbering& numbering, const std::vector<vtkIdType>& sources, AttributesOf attributesOf,
  vtkPolyData* whole)
{
  vtkDataSetAttributes* data = attributesOf(whole);
  for (const ArraysOfPieces& array : arrays)
  {
    data->AddArray(Pick(array, numbering, sources));
  }
  vtkDataSetAttributes* first = attributesOf(pieces.front());
  for (int type = 0; type < vtkDataSetAttributes::NUM_ATTRIBUTES; ++type)
  {
    vtkAbstractArray* active = first->GetAbstractAttribute(type);
    if (active && active->GetName() && data->HasArray(active->GetName()))
    {
      data->SetActiveAttribute(active->GetName(), type);
    }
  }
}

void WriteHiddenCells(const Pieces& pieces, const Numbering& cells,
  const std::vector<vtkIdType>& sources, vtkPolyData* whole)
{
  auto hidden = NewArray<vtkUnsignedCharArray>(
    vtkDataSetAttributes::GhostArrayName(), static_cast<vtkIdType>(sources.size()));
  unsigned char* next = hidden->GetPointer(0);
  bool isAny = false;
  for (const vtkIdType cell : sources)
  {
    const std::size_t p = cells.PieceOf(cell);
    auto* ghosts = GhostsOf(pieces[p]->GetCellData(), cells.first[p + 1] - cells.first[p]);
    const unsigned char flag = ghosts ? ghosts->GetValue(cell - cells.first[p]) : 0;
    *next++ = flag;
    isAny = isAny || flag != 0;
  }
  if (isAny)
  {
    whole->GetCellData()->AddArray(hidden);
  }
}

} // namespace gridfem
