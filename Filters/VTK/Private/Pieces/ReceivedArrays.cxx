#include "Pieces/ReceivedArrays.h"

#include "Output/InterpolatedArrays.h"
#include "Pieces/DataMessage.h"
#include "Pieces/PieceArrays.h"

#include "vtkCellData.h"
#include "vtkDoubleArray.h"
#include "vtkPointData.h"

#include <algorithm>
#include <numeric>
#include <sstream>

namespace gridfem
{
namespace
{

/// The properties of an array that ranks have to agree on.
struct ArrayKind
{
  std::string name;
  int components;
  int type;
};

bool IsSent(vtkAbstractArray* array, vtkIdType tuples)
{
  const std::string name = array->GetName() ? array->GetName() : "";
  return !name.empty() && name.find('\n') == std::string::npos && CanTravel(array) &&
         array->GetNumberOfTuples() == tuples && name != vtkDataSetAttributes::GhostArrayName();
}

/// Whether an array holds ids of points. Cut points have none.
bool NumbersPoints(vtkDataSetAttributes* arrays, vtkAbstractArray* array)
{
  return vtkPointData::SafeDownCast(arrays) &&
         (array == arrays->GetGlobalIds() || array == arrays->GetPedigreeIds());
}

/// Describes one array per line. The name is last, because it may have blanks.
std::string Describe(vtkDataSetAttributes* arrays, vtkIdType tuples)
{
  std::ostringstream text;
  for (int k = 0; k < arrays->GetNumberOfArrays(); ++k)
  {
    vtkAbstractArray* const array = arrays->GetAbstractArray(k);
    if (IsSent(array, tuples) && !NumbersPoints(arrays, array))
    {
      text << array->GetNumberOfComponents() << ' ' << array->GetDataType() << ' '
           << array->GetName() << '\n';
    }
  }
  return text.str();
}

std::vector<ArrayKind> ReadKinds(const std::string& text)
{
  std::vector<ArrayKind> kinds;
  std::istringstream lines(text);
  for (ArrayKind kind; lines >> kind.components >> kind.type && lines.get() == ' ' &&
                       std::getline(lines, kind.name);)
  {
    kinds.push_back(kind);
  }
  return kinds;
}

/// Returns the arrays that both have. Arrays of numbers may differ in type.
std::vector<ArrayKind> CommonKinds(
  const std::vector<ArrayKind>& kinds, const std::vector<ArrayKind>& others)
{
  std::vector<ArrayKind> common;
  for (ArrayKind kind : kinds)
  {
    const auto other = std::find_if(others.begin(), others.end(),
      [&](const ArrayKind& one)
      {
        return one.name == kind.name && one.components == kind.components &&
               (one.type == VTK_STRING) == (kind.type == VTK_STRING);
      });
    if (other != others.end())
    {
      kind.type = other->type == kind.type ? kind.type : VTK_DOUBLE;
      common.push_back(kind);
    }
  }
  return common;
}

/// Returns the arrays that all ranks with triangles have. Collective.
std::vector<ArrayKind> Agree(const Communicator& ranks, const std::string& own, bool hasTriangles)
{
  const std::vector<Id> lengths =
    ranks.Gather(std::vector<Id>{ hasTriangles ? static_cast<Id>(own.size()) : -1 });
  const std::vector<char> texts = ranks.Gather(std::vector<char>(own.begin(), own.end()));
  std::vector<ArrayKind> common;
  ranks.Together(
    [&]
    {
      bool isFirst = true;
      auto text = texts.begin();
      for (const Id length : lengths)
      {
        if (length >= 0)
        {
          const std::vector<ArrayKind> kinds = ReadKinds(std::string(text, text + length));
          common = isFirst ? kinds : CommonKinds(common, kinds);
          isFirst = false;
          text += length;
        }
      }
    });
  return common;
}

/// Puts the tuples of the arrays into the message.
void PutTuples(vtkDataSetAttributes* from, const std::vector<ArrayKind>& kinds,
  const std::vector<vtkIdType>& tuples, DataMessage& message)
{
  vtkNew<vtkPointData> picked; // of cells as well
  for (const ArrayKind& kind : kinds)
  {
    vtkAbstractArray* const array = from->GetAbstractArray(kind.name.c_str());
    Numbering numbering;
    numbering.Add(array->GetNumberOfTuples());
    vtkSmartPointer<vtkAbstractArray> some = Pick({ array }, numbering, tuples);
    if (some->GetDataType() != kind.type && kind.type == VTK_DOUBLE)
    {
      vtkNew<vtkDoubleArray> numbers;
      numbers->DeepCopy(some);
      some = numbers;
    }
    picked->AddArray(some);
  }
  PassActiveAttributes(from, picked);
  message.PutArrays(picked, static_cast<vtkIdType>(tuples.size()));
}

/// Takes arrays out of the messages of all ranks that have sent any tuples.
/// @param counts  the number of tuples of each rank
/// @param order   the place of each tuple of the result among all received ones
void TakeTuples(std::vector<DataMessage>& messages, const std::vector<Id>& counts,
  const std::vector<ArrayKind>& kinds, const std::vector<vtkIdType>& order,
  vtkDataSetAttributes* to)
{
  std::vector<vtkSmartPointer<vtkPointData>> parts;
  Numbering numbering;
  for (std::size_t rank = 0; rank < messages.size(); ++rank)
  {
    if (counts[rank] > 0)
    {
      parts.push_back(vtkSmartPointer<vtkPointData>::New());
      messages[rank].TakeArrays(parts.back());
      numbering.Add(counts[rank]);
    }
  }
  for (const ArrayKind& kind : kinds)
  {
    ArraysOfPieces arrays;
    for (const auto& part : parts)
    {
      arrays.push_back(part->GetAbstractArray(kind.name.c_str()));
    }
    if (!arrays.empty())
    {
      to->AddArray(Pick(arrays, numbering, order));
    }
  }
  if (!parts.empty())
  {
    PassActiveAttributes(parts.front(), to);
  }
}

std::vector<vtkIdType> CellsOfTriangles(
  const std::vector<Id>& sourceCell, const std::vector<Index>& triangles)
{
  std::vector<vtkIdType> cells;
  cells.reserve(triangles.size());
  for (const Index triangle : triangles)
  {
    cells.push_back(sourceCell[triangle]);
  }
  return cells;
}

std::vector<vtkIdType> Inverse(const std::vector<Index>& places)
{
  std::vector<vtkIdType> inverse(places.size());
  for (std::size_t k = 0; k < places.size(); ++k)
  {
    inverse[places[k]] = static_cast<vtkIdType>(k);
  }
  return inverse;
}

} // namespace

void SendArrays(const Communicator& ranks, const Redistribution& distribution, vtkPolyData* piece,
  const InputMesh& mesh, vtkPointData* atPoints, vtkCellData* onTriangles)
{
  const bool hasTriangles = !mesh.triangles->triangles.empty();
  std::string ofPoints;
  std::string ofCells;
  ranks.Together(
    [&]
    {
      if (hasTriangles)
      {
        ofPoints = Describe(piece->GetPointData(), piece->GetNumberOfPoints());
        ofCells = Describe(piece->GetCellData(), piece->GetNumberOfCells());
      }
    });
  const std::vector<ArrayKind> pointKinds = Agree(ranks, ofPoints, hasTriangles);
  const std::vector<ArrayKind> cellKinds = Agree(ranks, ofCells, hasTriangles);
  std::vector<Bytes> sent(ranks.Size());
  ranks.Together(
    [&]
    {
      for (int rank = 0; rank < ranks.Size(); ++rank)
      {
        const std::vector<Index>& points = distribution.PointsTo(rank);
        const std::vector<Index>& triangles = distribution.TrianglesTo(rank);
        DataMessage message;
        message.Put(static_cast<Id>(points.size()));
        message.Put(static_cast<Id>(triangles.size()));
        if (!triangles.empty())
        {
          PutTuples(piece->GetPointData(), pointKinds, { points.begin(), points.end() }, message);
          PutTuples(
            piece->GetCellData(), cellKinds, CellsOfTriangles(mesh.sourceCell, triangles), message);
        }
        sent[rank] = message.Release();
      }
    });
  sent = ranks.Exchange(sent);
  ranks.Together(
    [&]
    {
      std::vector<DataMessage> messages;
      std::vector<Id> points;
      std::vector<Id> triangles;
      for (Bytes& bytes : sent)
      {
        messages.emplace_back(std::move(bytes));
        points.push_back(messages.back().Take<Id>());
        triangles.push_back(messages.back().Take<Id>());
      }
      TakeTuples(messages, points, pointKinds, Inverse(distribution.PlacesOfPoints()), atPoints);
      const Id count = std::accumulate(triangles.begin(), triangles.end(), Id{ 0 });
      TakeTuples(messages, triangles, cellKinds, Ascending(count), onTriangles);
    });
}

} // namespace gridfem
