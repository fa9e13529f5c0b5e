#include "Pieces/GatheredSurface.h"

#include "Input/InputValidation.h"
#include "Pieces/DataMessage.h"
#include "Pieces/PieceJoiner.h"
#include "Pipeline/InputSurface.h"

#include "vtkCellArray.h"
#include "vtkCellData.h"
#include "vtkDataArray.h"
#include "vtkFieldData.h"
#include "vtkPointData.h"
#include "vtkPoints.h"

#include <algorithm>

namespace gridfem
{
namespace
{

bool HaveSameArrays(vtkFieldData* a, vtkFieldData* b)
{
  bool areSame = a->GetNumberOfArrays() == b->GetNumberOfArrays();
  for (int k = 0; areSame && k < a->GetNumberOfArrays(); ++k)
  {
    areSame = HaveSameContents(a->GetAbstractArray(k), b->GetAbstractArray(k));
  }
  return areSame;
}

bool AreSamePiece(vtkPolyData* a, vtkPolyData* b)
{
  const auto ours = CellsOf(a);
  const auto theirs = CellsOf(b);
  for (int kind = 0; kind < CellKinds; ++kind)
  {
    if (!HaveSameCells(ours[kind], theirs[kind]))
    {
      return false;
    }
  }
  return HaveSameContents(a->GetPoints()->GetData(), b->GetPoints()->GetData()) &&
         HaveSameArrays(a->GetPointData(), b->GetPointData()) &&
         HaveSameArrays(a->GetCellData(), b->GetCellData());
}

GatheredSurface OnlyPiece(vtkPolyData* piece)
{
  GatheredSurface result;
  result.whole = vtkSmartPointer<vtkPolyData>::New();
  result.whole->ShallowCopy(piece);
  result.pieces.push_back(
    { Ascending(piece->GetNumberOfPoints()), Ascending(piece->GetNumberOfCells()) });
  return result;
}

void KeepUnchanged(vtkFieldData* last, vtkFieldData* data)
{
  for (int k = 0; k < data->GetNumberOfArrays(); ++k)
  {
    vtkAbstractArray* array = data->GetAbstractArray(k);
    vtkAbstractArray* before =
      array->GetName() ? last->GetAbstractArray(array->GetName()) : nullptr;
    if (before && HaveSameContents(before, array))
    {
      data->AddArray(before);
    }
  }
}

void AddArrays(StageKey& key, vtkFieldData* data)
{
  for (int k = 0; k < data->GetNumberOfArrays(); ++k)
  {
    key.Add(data->GetAbstractArray(k));
  }
  auto* attributes = vtkDataSetAttributes::SafeDownCast(data);
  for (int type = 0; attributes && type < vtkDataSetAttributes::NUM_ATTRIBUTES; ++type)
  {
    key.Add(attributes->GetAbstractAttribute(type));
  }
}

} // namespace

void AddSurface(StageKey& key, vtkPolyData* surface)
{
  AddMesh(key, surface);
  key.Add(surface->GetVerts()).Add(surface->GetLines());
  AddArrays(key, surface->GetPointData());
  AddArrays(key, surface->GetCellData());
  AddArrays(key, surface->GetFieldData());
}

void RequireGoodCells(vtkPolyData* surface, const char* whole)
{
  RequireSoundCells(surface);
  ForEachCell(surface, [&](vtkIdType cell, const vtkIdType* ids, vtkIdType size)
    { RequireCorners(cell, size, ids, surface->GetNumberOfPoints(), whole); });
}

GatheredSurface JoinPieces(
  const Pieces& pieces, const std::vector<std::string>& owners, bool weldCoincidentPoints)
{
  const auto count = static_cast<int>(pieces.size());
  Pieces distinct;
  std::vector<std::string> owned;    // owners of the distinct pieces
  std::vector<int> which(count, -1); // distinct piece of each owner
  for (int owner = 0; owner < count; ++owner)
  {
    if (pieces[owner]->GetNumberOfPoints() == 0)
    {
      continue;
    }
    const auto same = std::find_if(distinct.begin(), distinct.end(),
      [&](vtkPolyData* other) { return AreSamePiece(other, pieces[owner]); });
    which[owner] = static_cast<int>(same - distinct.begin());
    if (same == distinct.end())
    {
      distinct.push_back(pieces[owner]);
      owned.push_back(owners[owner]);
    }
  }
  GatheredSurface joined;
  if (distinct.size() < 2)
  {
    joined = OnlyPiece(distinct.empty() ? pieces.front() : distinct.front());
  }
  else
  {
    joined = PieceJoiner(distinct, owned, weldCoincidentPoints).Result();
  }
  std::vector<PiecePlaces> places(count);
  for (int owner = 0; owner < count; ++owner)
  {
    if (which[owner] >= 0)
    {
      places[owner] = joined.pieces[which[owner]];
    }
  }
  joined.pieces = std::move(places);
  for (vtkPolyData* piece : distinct)
  {
    AddMissing(piece->GetFieldData(), joined.whole->GetFieldData());
  }
  for (vtkPolyData* piece : pieces)
  {
    AddMissing(piece->GetFieldData(), joined.whole->GetFieldData());
  }
  return joined;
}

void AddMissing(vtkFieldData* from, vtkFieldData* to)
{
  for (int k = 0; k < from->GetNumberOfArrays(); ++k)
  {
    vtkAbstractArray* array = from->GetAbstractArray(k);
    if (array->GetName() && !to->HasArray(array->GetName()))
    {
      to->AddArray(array);
    }
  }
}

void ThrowWithPartialArrays(const InvalidInput& error, const GatheredSurface& surface)
{
  const std::string text = error.what();
  std::string names;
  for (const std::string& name : surface.partialArrays)
  {
    const std::string array = name.substr(0, name.find("' (") + 1);
    names += text.find(array) == std::string::npos ? "" : (names.empty() ? "" : ", ") + name;
  }
  throw InvalidInput(
    names.empty() ? text : text + " A piece of the surface lacks this array: " + names + ".");
}

void KeepUnchanged(vtkPolyData* last, vtkPolyData* surface)
{
  if (last->GetPoints() && surface->GetPoints() &&
      HaveSameContents(last->GetPoints()->GetData(), surface->GetPoints()->GetData()))
  {
    surface->SetPoints(last->GetPoints());
  }
  if (HaveSameCells(last->GetVerts(), surface->GetVerts()))
  {
    surface->SetVerts(last->GetVerts());
  }
  if (HaveSameCells(last->GetLines(), surface->GetLines()))
  {
    surface->SetLines(last->GetLines());
  }
  if (HaveSameCells(last->GetPolys(), surface->GetPolys()))
  {
    surface->SetPolys(last->GetPolys());
  }
  if (HaveSameCells(last->GetStrips(), surface->GetStrips()))
  {
    surface->SetStrips(last->GetStrips());
  }
  KeepUnchanged(last->GetPointData(), surface->GetPointData());
  KeepUnchanged(last->GetCellData(), surface->GetCellData());
  KeepUnchanged(last->GetFieldData(), surface->GetFieldData());
}

} // namespace gridfem
