#include "Pieces/GatheredOutput.h"

#include "Output/ClippedArrays.h"
#include "Output/InterpolatedArrays.h"
#include "Output/SolverOutput.h"
#include "Pieces/Ranks.h"
#include "Pipeline/Allocation.h"

#include "vtkCellArray.h"
#include "vtkCellData.h"
#include "vtkDataArray.h"
#include "vtkDataObject.h"
#include "vtkDataSetAttributes.h"
#include "vtkFieldData.h"
#include "vtkNew.h"
#include "vtkPointData.h"
#include "vtkPoints.h"
#include "vtkPolyData.h"

#include <algorithm>
#include <limits>
#include <sstream>

namespace gridfem
{
namespace
{

/// Whether the first rank has all of a surface, and no other rank has a part.
bool IsOnFirst(const GatheredSurface& input)
{
  for (std::size_t rank = 1; rank < input.pieces.size(); ++rank)
  {
    if (!input.pieces[rank].points.empty())
    {
      return false;
    }
  }
  return true;
}

bool HasCellsOf(vtkPolyData* output, vtkPolyData* input)
{
  const auto are = [](vtkCellArray* a, vtkCellArray* b)
  {
    const vtkIdType count = b ? b->GetNumberOfCells() : 0;
    return a == b || (count == 0 && (!a || a->GetNumberOfCells() == 0));
  };
  return output && output->GetNumberOfPoints() == input->GetNumberOfPoints() &&
         are(output->GetVerts(), input->GetVerts()) && are(output->GetLines(), input->GetLines()) &&
         are(output->GetPolys(), input->GetPolys()) && are(output->GetStrips(), input->GetStrips());
}

/// Returns the tuples at some places. Missing places have no result.
vtkSmartPointer<vtkAbstractArray> TuplesAt(
  vtkAbstractArray* array, const std::vector<vtkIdType>& places)
{
  const auto picked = MakeLike(array, static_cast<vtkIdType>(places.size()));
  auto* numbers = vtkDataArray::SafeDownCast(picked);
  const double nothing = NumberOfNone(array);
  for (std::size_t k = 0; k < places.size(); ++k)
  {
    const auto tuple = static_cast<vtkIdType>(k);
    if (places[k] >= 0)
    {
      picked->SetTuple(tuple, places[k], array);
    }
    else if (numbers)
    {
      for (int c = 0; c < numbers->GetNumberOfComponents(); ++c)
      {
        numbers->SetComponent(tuple, c, nothing);
      }
    }
  }
  return picked;
}

void PutActive(vtkDataSetAttributes* data, DataMessage& message)
{
  std::vector<std::string> names;
  for (int type = 0; type < vtkDataSetAttributes::NUM_ATTRIBUTES; ++type)
  {
    vtkAbstractArray* active = data->GetAbstractAttribute(type);
    names.emplace_back(active && active->GetName() ? active->GetName() : "");
  }
  message.PutTexts(names);
}

void TakeActive(DataMessage& message, vtkDataSetAttributes* data)
{
  const std::vector<std::string> names = message.TakeTexts();
  for (std::size_t type = 0; type < names.size(); ++type)
  {
    if (!names[type].empty() && data->HasArray(names[type].c_str()))
    {
      data->SetActiveAttribute(names[type].c_str(), static_cast<int>(type));
    }
  }
}

/// Calls body for every array that has a name.
template<class Body>
void ForEachArray(vtkFieldData* data, Body&& body)
{
  for (int k = 0; k < data->GetNumberOfArrays(); ++k)
  {
    vtkAbstractArray* array = data->GetAbstractArray(k);
    if (array->GetName() && CanTravel(array))
    {
      body(array);
    }
  }
}

bool IsNew(vtkAbstractArray* array, vtkFieldData* input)
{
  return input->GetAbstractArray(array->GetName()) != array;
}

/// Puts in the arrays at a rank's own points or cells, and the names of the arrays that the filter
/// removed.
void PutAttributes(vtkDataSetAttributes* output, vtkDataSetAttributes* input,
  const std::vector<vtkIdType>& places, DataMessage& message)
{
  std::vector<std::string> removed;
  ForEachArray(input,
    [&](vtkAbstractArray* array)
    {
      if (!output->HasArray(array->GetName()))
      {
        removed.emplace_back(array->GetName());
      }
    });
  message.PutTexts(removed);
  vtkNew<vtkFieldData> fresh;
  ForEachArray(output,
    [&](vtkAbstractArray* array)
    {
      if (IsNew(array, input))
      {
        fresh->AddArray(TuplesAt(array, places));
      }
    });
  message.PutArrays(fresh, -1);
  PutActive(output, message);
}

void TakeAttributes(DataMessage& message, vtkDataSetAttributes* data)
{
  for (const std::string& name : message.TakeTexts())
  {
    data->RemoveArray(name.c_str());
  }
  message.TakeArrays(data);
  TakeActive(message, data);
}

/// Puts in the field arrays. The input's arrays only go to ranks that have none themselves.
void PutFieldArrays(vtkFieldData* output, vtkFieldData* input, bool hasCells,
  GivenFieldArrays sharing, DataMessage& message)
{
  vtkNew<vtkFieldData> given;
  vtkNew<vtkFieldData> fresh;
  ForEachArray(output,
    [&](vtkAbstractArray* array)
    {
      const bool isFresh = IsNew(array, input);
      if ((hasCells || !IsClipFieldArray(array->GetName())) &&
          (isFresh || sharing == GivenFieldArrays::Shared))
      {
        (isFresh ? fresh : given)->AddArray(array);
      }
    });
  message.PutArrays(given, -1);
  message.PutArrays(fresh, -1);
}

void TakeFieldArrays(DataMessage& message, vtkFieldData* fields)
{
  vtkNew<vtkFieldData> given;
  message.TakeArrays(given);
  AddMissing(given, fields);
  message.TakeArrays(fields);
}

/// Returns the attributes of points, cells or rows, whichever the data object has.
std::vector<vtkDataSetAttributes*> AllAttributesOf(vtkDataObject* data)
{
  std::vector<vtkDataSetAttributes*> all;
  for (const int type : { vtkDataObject::POINT, vtkDataObject::CELL, vtkDataObject::ROW })
  {
    if (vtkDataSetAttributes* attributes = data->GetAttributes(type))
    {
      all.push_back(attributes);
    }
  }
  return all;
}

/// Puts in the names of the arrays, without a tuple. The first rank gets nothing, because it has
/// the arrays.
void PutNames(vtkDataObject* output, const GatheredSurface& input, int rank,
  GivenFieldArrays sharing, DataMessage& message)
{
  message.Put(rank == 0);
  if (rank == 0)
  {
    return;
  }
  for (vtkDataSetAttributes* data : AllAttributesOf(output))
  {
    vtkNew<vtkFieldData> none;
    ForEachArray(data, [&](vtkAbstractArray* array) { none->AddArray(MakeLike(array, 0)); });
    message.PutArrays(none, -1);
    PutActive(data, message);
  }
  PutFieldArrays(output->GetFieldData(), input.whole->GetFieldData(), false, sharing, message);
}

void TakeNames(DataMessage& message, vtkDataObject* output)
{
  const bool hasArrays = message.Take<bool>();
  if (hasArrays)
  {
    return;
  }
  output->Initialize();
  for (vtkDataSetAttributes* data : AllAttributesOf(output))
  {
    message.TakeArrays(data);
    TakeActive(message, data);
  }
  TakeFieldArrays(message, output->GetFieldData());
}

/// Returns the moved points. Points that are missing in the whole stay where they are.
vtkSmartPointer<vtkPoints> MovedPoints(vtkDataArray* coordinates, vtkPoints* own)
{
  for (vtkIdType point = 0; point < coordinates->GetNumberOfTuples(); ++point)
  {
    if (coordinates->GetComponent(point, 0) != coordinates->GetComponent(point, 0))
    {
      coordinates->SetTuple(point, own->GetPoint(point));
    }
  }
  auto points = vtkSmartPointer<vtkPoints>::New();
  points->SetData(coordinates);
  return points;
}

/// The names of the input's field arrays that the filter has kept, one per line.
std::string KeptNames(vtkFieldData* given, vtkFieldData* results)
{
  std::string names;
  ForEachArray(given,
    [&](vtkAbstractArray* array)
    {
      if (results->HasArray(array->GetName()) && !IsClipFieldArray(array->GetName()))
      {
        names += array->GetName() + std::string("\n");
      }
    });
  return names;
}

/// Collective. Puts the arrays that this rank's filter has kept, and that another rank lacks, into
/// the message. Returns whether any rank has such arrays.
bool PutLackingArrays(
  const Ranks& ranks, vtkFieldData* given, vtkFieldData* results, DataMessage& message)
{
  std::string own;
  ranks.Together([&] { own = KeptNames(given, results); });
  const std::vector<std::string> names = ranks.Exchange(own);
  const auto isLacking = [&](const std::string& name)
  {
    return std::any_of(names.begin(), names.end(),
      [&](const std::string& ofRank)
      { return ("\n" + ofRank).find("\n" + name + "\n") == std::string::npos; });
  };
  bool isAnyLacking = false;
  ranks.Together(
    [&]
    {
      const vtkNew<vtkFieldData> wanted;
      std::istringstream lines(own);
      for (std::string name; std::getline(lines, name);)
      {
        if (isLacking(name))
        {
          wanted->AddArray(given->GetAbstractArray(name.c_str()));
        }
      }
      isAnyLacking = wanted->GetNumberOfArrays() > 0;
      message.PutArrays(wanted, -1);
    });
  return ranks.Any(isAnyLacking);
}

/// One message with the field arrays of all messages. The first of several arrays with the same
/// name stays.
Bytes Merged(std::vector<Bytes> messages)
{
  const vtkNew<vtkFieldData> all;
  for (Bytes& bytes : messages)
  {
    const vtkNew<vtkFieldData> ofRank;
    DataMessage message(std::move(bytes));
    message.TakeArrays(ofRank);
    AddMissing(ofRank, all);
  }
  DataMessage merged;
  merged.PutArrays(all, -1);
  return merged.Release();
}

} // namespace

void PutPart(vtkDataObject* output, const GatheredSurface& input, int rank, DataMessage& message,
  GivenFieldArrays given)
{
  auto* surface = vtkPolyData::SafeDownCast(output);
  const bool isDivided = HasCellsOf(surface, input.whole) && !IsOnFirst(input);
  message.Put(isDivided);
  if (!isDivided)
  {
    PutNames(output, input, rank, given, message);
    return;
  }
  const PiecePlaces& places = input.pieces[rank];
  vtkPoints* points = surface->GetPoints();
  const bool isMoved = points->GetData() != input.whole->GetPoints()->GetData();
  message.PutArray(isMoved ? TuplesAt(points->GetData(), places.points) : nullptr);
  PutAttributes(surface->GetPointData(), input.whole->GetPointData(), places.points, message);
  PutAttributes(surface->GetCellData(), input.whole->GetCellData(), places.cells, message);
  PutFieldArrays(
    surface->GetFieldData(), input.whole->GetFieldData(), !places.cells.empty(), given, message);
}

void TakePart(DataMessage& message, vtkPolyData* own, vtkDataObject* output)
{
  const bool isDivided = message.Take<bool>();
  if (!isDivided)
  {
    TakeNames(message, output);
    return;
  }
  auto* surface = vtkPolyData::SafeDownCast(output);
  surface->ShallowCopy(own);
  if (const auto coordinates = message.TakeArray())
  {
    surface->SetPoints(MovedPoints(vtkDataArray::SafeDownCast(coordinates), own->GetPoints()));
  }
  TakeAttributes(message, surface->GetPointData());
  TakeAttributes(message, surface->GetCellData());
  TakeFieldArrays(message, surface->GetFieldData());
  RemoveGivenReports(own, surface);
}

void ShareFieldArrays(vtkDataObject* input, vtkDataObject* output)
{
  const Ranks ranks;
  const vtkNew<vtkFieldData> none;
  vtkFieldData* const given = input ? input->GetFieldData() : none.Get();
  vtkFieldData* const results = output->GetFieldData();
  DataMessage message;
  if (!PutLackingArrays(ranks, given, results, message))
  {
    return;
  }
  std::vector<Bytes> messages = ranks.Gather(message.Release());
  std::vector<Bytes> copies;
  ranks.OnFirst([&] { copies.assign(ranks.Count(), Merged(std::move(messages))); });
  Bytes merged = ranks.Scatter(copies);
  ranks.Together(
    [&]
    {
      const vtkNew<vtkFieldData> ofAll;
      DataMessage taken(std::move(merged));
      taken.TakeArrays(ofAll);
      ForEachArray(given, // arrays that the filter removed stay removed
        [&](vtkAbstractArray* array) { ofAll->RemoveArray(array->GetName()); });
      AddMissing(ofAll, results);
    });
}

} // namespace gridfem
