#include "GatheredSurface.h"

#include "DataMessage.h"

#include "Base/Errors.h"
#include "Grid/TriangleMesh.h"

#include "vtkCellArray.h"
#include "vtkCellData.h"
#include "vtkDataArray.h"
#include "vtkIdList.h"
#include "vtkNew.h"
#include "vtkPointData.h"
#include "vtkPoints.h"
#include "vtkPolyData.h"
#include "vtkStringArray.h"
#include "vtkUnsignedCharArray.h"

#include <algorithm>
#include <array>
#include <map>
#include <numeric>

namespace gridfem
{
namespace
{

using Pieces = std::vector<vtkSmartPointer<vtkPolyData>>;

constexpr int Kinds = 4; // of cells; their ids follow each other in this order

std::array<vtkCellArray*, Kinds> CellsOf(vtkPolyData* piece)
{
  return { piece->GetVerts(), piece->GetLines(), piece->GetPolys(), piece->GetStrips() };
}

vtkUnsignedCharArray* GhostsOf(vtkDataSetAttributes* data, vtkIdType tuples)
{
  auto* ghosts = vtkArrayDownCast<vtkUnsignedCharArray>(
    data->GetAbstractArray(vtkDataSetAttributes::GhostArrayName()));
  return ghosts && ghosts->GetNumberOfTuples() == tuples ? ghosts : nullptr;
}

/// Calls body(cell, ids, size) for all cells.
template<class Body>
void ForEachCell(vtkPolyData* piece, Body&& body)
{
  vtkIdType cell = 0;
  vtkNew<vtkIdList> storage;
  for (vtkCellArray* cells : CellsOf(piece))
  {
    const vtkIdType count = cells ? cells->GetNumberOfCells() : 0;
    for (vtkIdType k = 0; k < count; ++k, ++cell)
    {
      vtkIdType size = 0;
      const vtkIdType* ids = nullptr;
      cells->GetCellAtId(k, size, ids, storage);
      body(cell, ids, size);
    }
  }
}

/// Things of all pieces under one number: those of piece p are first[p] .. first[p + 1].
struct Numbering
{
  std::vector<vtkIdType> first{ 0 };

  void Add(vtkIdType count) { first.push_back(first.back() + count); }
  vtkIdType Count() const { return first.back(); }
  std::size_t PieceOf(vtkIdType thing) const
  {
    return std::upper_bound(first.begin(), first.end(), thing) - first.begin() - 1;
  }
};

vtkDataSetAttributes* PointsOf(vtkPolyData* piece)
{
  return piece->GetPointData();
}

vtkDataSetAttributes* CellDataOf(vtkPolyData* piece)
{
  return piece->GetCellData();
}

using Attributes = vtkDataSetAttributes* (*)(vtkPolyData*);

/// The arrays of one name, of all pieces.
using ArraysOfPieces = std::vector<vtkAbstractArray*>;

/// Ids that tell where a point or cell was before: they differ between ranks for the same point.
bool NamesAnOrigin(const std::string& name)
{
  return name == "vtkProcessId" || name == "ProcessId" || name == "vtkOriginalPointIds" ||
         name == "vtkOriginalCellIds";
}

bool IsNumeric(vtkAbstractArray* array)
{
  return vtkDataArray::SafeDownCast(array) != nullptr;
}

/// The global ids of points or cells of all pieces; empty unless all have them.
ArraysOfPieces GlobalIds(const Pieces& pieces, Attributes attributesOf)
{
  ArraysOfPieces ids;
  for (const auto& piece : pieces)
  {
    vtkDataArray* own = attributesOf(piece)->GetGlobalIds();
    const bool isWhole = own && own->GetNumberOfComponents() == 1;
    if (!isWhole)
    {
      return {};
    }
    ids.push_back(own);
  }
  return ids;
}

vtkIdType IdAt(vtkAbstractArray* ids, vtkIdType tuple)
{
  // Through doubles they would be exact up to 2^53 only.
  return ids->GetVariantValue(tuple).ToLongLong();
}

/// The arrays that all pieces have; what is left out is told of.
class CommonArrays
{
public:
  CommonArrays(const Pieces& pieces, const std::vector<int>& ranks, Attributes attributesOf,
    const Numbering& numbering, std::vector<std::string>& partial)
  {
    std::vector<std::string> names;
    for (const auto& piece : pieces)
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
    for (const std::string& name : names)
    {
      this->Add(name, pieces, ranks, attributesOf, numbering, partial);
    }
  }

  const std::vector<ArraysOfPieces>& Get() const { return arrays_; }

private:
  void Add(const std::string& name, const Pieces& pieces, const std::vector<int>& ranks,
    Attributes attributesOf, const Numbering& numbering, std::vector<std::string>& partial)
  {
    ArraysOfPieces arrays;
    for (std::size_t p = 0; p < pieces.size(); ++p)
    {
      vtkAbstractArray* array = attributesOf(pieces[p])->GetAbstractArray(name.c_str());
      const bool fits = array && CanTravel(array) &&
                        array->GetNumberOfTuples() == numbering.first[p + 1] - numbering.first[p];
      const bool isAlike =
        fits &&
        (arrays.empty() || (IsNumeric(array) == IsNumeric(arrays[0]) &&
                             array->GetNumberOfComponents() == arrays[0]->GetNumberOfComponents()));
      if (!isAlike)
      {
        partial.push_back("'" + name + "' (rank " + std::to_string(ranks[p]) + ")");
        return;
      }
      arrays.push_back(array);
    }
    arrays_.push_back(std::move(arrays));
  }

  std::vector<ArraysOfPieces> arrays_;
};

bool AreEqual(vtkAbstractArray* a, vtkIdType atA, vtkAbstractArray* b, vtkIdType atB)
{
  auto* ours = vtkDataArray::SafeDownCast(a);
  auto* theirs = vtkDataArray::SafeDownCast(b);
  for (int c = 0; c < a->GetNumberOfComponents(); ++c)
  {
    if (ours)
    {
      const double value = ours->GetComponent(atA, c);
      const double other = theirs->GetComponent(atB, c);
      if (value != other && !(value != value && other != other)) // both may be NaN
      {
        return false;
      }
    }
    else if (a->GetVariantValue(atA * a->GetNumberOfComponents() + c) !=
             b->GetVariantValue(atB * b->GetNumberOfComponents() + c))
    {
      return false;
    }
  }
  return true;
}

/// Of the type of all, or double.
vtkSmartPointer<vtkAbstractArray> NewArrayLike(const ArraysOfPieces& arrays)
{
  const int type = arrays[0]->GetDataType();
  const bool isOne = std::all_of(arrays.begin(), arrays.end(),
    [=](vtkAbstractArray* array) { return array->GetDataType() == type && type != VTK_BIT; });
  vtkSmartPointer<vtkAbstractArray> array;
  array.TakeReference(
    vtkAbstractArray::CreateArray(isOne || !IsNumeric(arrays[0]) ? type : VTK_DOUBLE));
  array->SetName(arrays[0]->GetName());
  array->SetNumberOfComponents(arrays[0]->GetNumberOfComponents());
  array->CopyComponentNames(arrays[0]);
  return array;
}

/// The tuples of things of the pieces, in a new order.
/// @param sources  numbers of things
vtkSmartPointer<vtkAbstractArray> Pick(
  const ArraysOfPieces& arrays, const Numbering& numbering, const std::vector<vtkIdType>& sources)
{
  vtkSmartPointer<vtkAbstractArray> picked = NewArrayLike(arrays);
  picked->SetNumberOfTuples(static_cast<vtkIdType>(sources.size()));
  for (std::size_t k = 0; k < sources.size(); ++k)
  {
    const std::size_t piece = numbering.PieceOf(sources[k]);
    picked->SetTuple(static_cast<vtkIdType>(k), sources[k] - numbering.first[piece], arrays[piece]);
  }
  return picked;
}

/// Joins pieces that all have points.
class Joiner
{
public:
  Joiner(Pieces pieces, std::vector<int> ranks, bool weldCoincidentPoints)
    : pieces_(std::move(pieces)), ranks_(std::move(ranks))
  {
    for (vtkPolyData* piece : pieces_)
    {
      points_.Add(piece->GetNumberOfPoints());
      cells_.Add(piece->GetNumberOfCells());
    }
    this->FindDuplicates();
    const CommonArrays ofPoints(pieces_, ranks_, &PointsOf, points_, partial_);
    const CommonArrays ofCells(pieces_, ranks_, &CellDataOf, cells_, partial_);
    const ArraysOfPieces ids = GlobalIds(pieces_, &PointsOf);
    pointPlace_.assign(points_.Count(), -1);
    cellPlace_.assign(cells_.Count(), -1);
    if (!ids.empty())
    {
      this->JoinPointsById(ids);
    }
    else
    {
      this->FindCoincident(weldCoincidentPoints);
      this->JoinPointsByPlace(ofPoints.Get());
    }
    this->JoinCells();
    this->FindGhostCells();
    this->Write(ofPoints.Get(), ofCells.Get());
  }

  GatheredSurface Result()
  {
    GatheredSurface result;
    result.whole = whole_;
    result.partialArrays = std::move(partial_);
    for (std::size_t p = 0; p < pieces_.size(); ++p)
    {
      const auto point = pointPlace_.begin();
      const auto cell = cellPlace_.begin();
      result.pieces.push_back({ { point + points_.first[p], point + points_.first[p + 1] },
        { cell + cells_.first[p], cell + cells_.first[p + 1] } });
    }
    return result;
  }

private:
  /// Which cells and points are only there as copies of those of another rank.
  void FindDuplicates()
  {
    isCopiedCell_.assign(cells_.Count(), 0);
    isOwnPoint_.assign(points_.Count(), 0);
    std::vector<char> isUsed(points_.Count(), 0);
    for (std::size_t p = 0; p < pieces_.size(); ++p)
    {
      auto* ghosts = GhostsOf(pieces_[p]->GetCellData(), cells_.first[p + 1] - cells_.first[p]);
      ForEachCell(pieces_[p],
        [&](vtkIdType cell, const vtkIdType* ids, vtkIdType size)
        {
          const bool isCopied =
            ghosts && (ghosts->GetValue(cell) & vtkDataSetAttributes::DUPLICATECELL) != 0;
          isCopiedCell_[cells_.first[p] + cell] = isCopied;
          for (vtkIdType k = 0; k < size; ++k)
          {
            isUsed[points_.first[p] + ids[k]] = 1;
            isOwnPoint_[points_.first[p] + ids[k]] |= !isCopied;
          }
        });
    }
    for (std::size_t point = 0; point < isUsed.size(); ++point)
    {
      isOwnPoint_[point] |= !isUsed[point];
    }
  }

  /// Whether a rank says itself that a point is another rank's.
  bool IsCopiedPoint(vtkIdType point) const
  {
    const std::size_t p = points_.PieceOf(point);
    auto* ghosts = GhostsOf(pieces_[p]->GetPointData(), points_.first[p + 1] - points_.first[p]);
    return ghosts &&
           (ghosts->GetValue(point - points_.first[p]) & vtkDataSetAttributes::DUPLICATEPOINT) != 0;
  }

  Vec3 PositionOf(vtkIdType point) const
  {
    const std::size_t p = points_.PieceOf(point);
    Vec3 position;
    pieces_[p]->GetPoint(point - points_.first[p], position.data());
    return position;
  }

  vtkIdType AddPoint(vtkIdType point)
  {
    pointSource_.push_back(point);
    return pointPlace_[point] = static_cast<vtkIdType>(pointSource_.size()) - 1;
  }

  /// A point that another rank has already. Its values are those of the rank that owns it.
  void JoinPoint(vtkIdType point, vtkIdType place)
  {
    pointPlace_[point] = place;
    if (this->IsCopiedPoint(pointSource_[place]) && !this->IsCopiedPoint(point))
    {
      pointSource_[place] = point;
    }
  }

  void JoinPointsById(const ArraysOfPieces& ids)
  {
    std::vector<std::pair<vtkIdType, vtkIdType>> sorted; // id, point
    for (vtkIdType point = 0; point < points_.Count(); ++point)
    {
      const std::size_t p = points_.PieceOf(point);
      sorted.emplace_back(IdAt(ids[p], point - points_.first[p]), point);
    }
    std::sort(sorted.begin(), sorted.end());
    for (auto begin = sorted.begin(); begin != sorted.end();)
    {
      const auto end = std::find_if(
        begin, sorted.end(), [&](const auto& entry) { return entry.first != begin->first; });
      vtkIdType place = -1;
      for (auto entry = begin; entry != end; ++entry)
      {
        this->RequireSamePlace(begin->second, entry->second, begin->first);
        if (isOwnPoint_[entry->second] && place < 0)
        {
          place = this->AddPoint(entry->second);
        }
        else if (isOwnPoint_[entry->second])
        {
          this->JoinPoint(entry->second, place);
        }
      }
      std::for_each(begin, end, [&](const auto& entry) { pointPlace_[entry.second] = place; });
      begin = end;
    }
  }

  void RequireSamePlace(vtkIdType point, vtkIdType other, vtkIdType id) const
  {
    const Vec3 here = this->PositionOf(point);
    const Vec3 there = this->PositionOf(other);
    if (here != there && !here.hasNaN())
    {
      throw InvalidInput(
        "The global point id " + std::to_string(id) + " stands for a point on rank " +
        std::to_string(ranks_[points_.PieceOf(point)]) + " and for one at another place on rank " +
        std::to_string(ranks_[points_.PieceOf(other)]) +
        ". Remove the wrong ids, for example with Pass Arrays.");
    }
  }

  /// The lowest point with the same coordinates as a point, where anybody asks.
  void FindCoincident(bool weldCoincidentPoints)
  {
    isWelded_ = weldCoincidentPoints;
    const bool hasCopies =
      std::any_of(isCopiedCell_.begin(), isCopiedCell_.end(), [](char is) { return is; });
    if (!weldCoincidentPoints && !hasCopies)
    {
      return;
    }
    std::vector<Vec3> positions(points_.Count());
    std::vector<char> isNumber(points_.Count());
    for (vtkIdType point = 0; point < points_.Count(); ++point)
    {
      positions[point] = this->PositionOf(point);
      isNumber[point] = !positions[point].hasNaN();
    }
    const Array<Index> lowest = WeldCoincidentPoints(positions, isNumber);
    coincident_.assign(lowest.begin(), lowest.end());
  }

  bool HaveSameValues(
    const std::vector<ArraysOfPieces>& arrays, vtkIdType point, vtkIdType other) const
  {
    const std::size_t p = points_.PieceOf(point);
    const std::size_t q = points_.PieceOf(other);
    return std::all_of(arrays.begin(), arrays.end(),
      [&](const ArraysOfPieces& array)
      {
        return NamesAnOrigin(array[0]->GetName()) ||
               AreEqual(array[p], point - points_.first[p], array[q], other - points_.first[q]);
      });
  }

  void JoinPointsByPlace(const std::vector<ArraysOfPieces>& arrays)
  {
    std::map<vtkIdType, std::vector<vtkIdType>> shared; // places, by the lowest point of each
    std::vector<vtkIdType> firstPlace(points_.Count(), -1);
    std::vector<std::size_t> lastPiece; // that has the point, per place
    const auto findPlace = [&](vtkIdType point, bool mayBeOwn)
    {
      const vtkIdType lowest = coincident_.empty() ? point : coincident_[point];
      std::vector<vtkIdType> places;
      if (firstPlace[lowest] >= 0)
      {
        places.push_back(firstPlace[lowest]);
      }
      const auto more = shared.find(lowest);
      if (more != shared.end())
      {
        places.insert(places.end(), more->second.begin(), more->second.end());
      }
      const auto found = std::find_if(places.begin(), places.end(),
        [&](vtkIdType place)
        {
          return (mayBeOwn || lastPiece[place] != points_.PieceOf(point)) &&
                 this->HaveSameValues(arrays, pointSource_[place], point);
        });
      // A copy of a cell may lack arrays' right values; its place is known all the same.
      const vtkIdType other = mayBeOwn && !places.empty() ? places.front() : -1;
      return found != places.end() ? *found : other;
    };
    for (vtkIdType point = 0; point < points_.Count(); ++point)
    {
      if (!isOwnPoint_[point])
      {
        continue;
      }
      const vtkIdType place = isWelded_ ? findPlace(point, false) : -1;
      if (place >= 0)
      {
        this->JoinPoint(point, place);
        lastPiece[place] = points_.PieceOf(point);
        continue;
      }
      const vtkIdType added = this->AddPoint(point);
      lastPiece.push_back(points_.PieceOf(point));
      vtkIdType& first = firstPlace[coincident_.empty() ? point : coincident_[point]];
      if (first < 0)
      {
        first = added;
      }
      else
      {
        shared[coincident_[point]].push_back(added);
      }
    }
    for (vtkIdType point = 0; point < points_.Count(); ++point)
    {
      if (!isOwnPoint_[point])
      {
        pointPlace_[point] = findPlace(point, true);
      }
    }
  }

  /// Of the cells that are no copies: kind after kind, each sorted by global ids where there are
  /// some.
  void JoinCells()
  {
    const ArraysOfPieces ids = GlobalIds(pieces_, &CellDataOf);
    for (int kind = 0; kind < Kinds; ++kind)
    {
      std::vector<std::pair<vtkIdType, vtkIdType>> sorted; // id, cell
      for (std::size_t p = 0; p < pieces_.size(); ++p)
      {
        const auto kinds = CellsOf(pieces_[p]);
        vtkIdType begin = cells_.first[p];
        for (int before = 0; before < kind; ++before)
        {
          begin += kinds[before] ? kinds[before]->GetNumberOfCells() : 0;
        }
        const vtkIdType count = kinds[kind] ? kinds[kind]->GetNumberOfCells() : 0;
        for (vtkIdType cell = begin; cell < begin + count; ++cell)
        {
          if (!isCopiedCell_[cell])
          {
            sorted.emplace_back(ids.empty() ? 0 : IdAt(ids[p], cell - cells_.first[p]), cell);
          }
        }
      }
      std::sort(sorted.begin(), sorted.end());
      for (const auto& entry : sorted)
      {
        cellPlace_[entry.second] = static_cast<vtkIdType>(cellSource_.size());
        cellSource_.push_back(entry.second);
      }
      kindEnd_[kind] = static_cast<vtkIdType>(cellSource_.size());
    }
  }

  /// What the points of a cell have in common with those of its copy.
  std::vector<vtkIdType> Signature(std::size_t p, const vtkIdType* ids, vtkIdType size) const
  {
    std::vector<vtkIdType> signature(size);
    for (vtkIdType k = 0; k < size; ++k)
    {
      const vtkIdType point = points_.first[p] + ids[k];
      signature[k] = coincident_.empty() ? pointPlace_[point] : coincident_[point];
    }
    std::sort(signature.begin(), signature.end());
    return signature;
  }

  /// Copies have the place of the cell that they are copies of.
  void FindGhostCells()
  {
    if (std::none_of(isCopiedCell_.begin(), isCopiedCell_.end(), [](char is) { return is; }))
    {
      return;
    }
    std::map<std::vector<vtkIdType>, vtkIdType> places;
    std::vector<char> isAsked(points_.Count(), 0); // only of cells around which somebody asks
    const auto isNear = [&](const std::vector<vtkIdType>& signature)
    {
      return std::all_of(signature.begin(), signature.end(),
        [&](vtkIdType point) { return point >= 0 && isAsked[point]; });
    };
    for (const int round : { 0, 1, 2 })
    {
      for (std::size_t p = 0; p < pieces_.size(); ++p)
      {
        ForEachCell(pieces_[p],
          [&](vtkIdType local, const vtkIdType* ids, vtkIdType size)
          {
            const vtkIdType cell = cells_.first[p] + local;
            if (static_cast<bool>(isCopiedCell_[cell]) != (round != 1) || (round == 1 && size == 0))
            {
              return;
            }
            const std::vector<vtkIdType> signature = this->Signature(p, ids, size);
            if (round == 0)
            {
              std::for_each(signature.begin(), signature.end(),
                [&](vtkIdType point)
                {
                  if (point >= 0)
                  {
                    isAsked[point] = 1;
                  }
                });
            }
            else if (round == 1 && isNear(signature))
            {
              places.emplace(signature, cellPlace_[cell]);
            }
            else if (round == 2)
            {
              const auto found = places.find(signature);
              cellPlace_[cell] = found == places.end() ? -1 : found->second;
            }
          });
      }
    }
  }

  void WriteCells()
  {
    // Corners by the number of their cell, to be copied in the order of the places.
    std::vector<vtkIdType> begin(cells_.Count() + 1, 0);
    std::vector<vtkIdType> corners;
    for (std::size_t p = 0; p < pieces_.size(); ++p)
    {
      ForEachCell(pieces_[p],
        [&](vtkIdType cell, const vtkIdType* ids, vtkIdType size)
        {
          for (vtkIdType k = 0; k < size; ++k)
          {
            corners.push_back(pointPlace_[points_.first[p] + ids[k]]);
          }
          begin[cells_.first[p] + cell + 1] = static_cast<vtkIdType>(corners.size());
        });
    }
    std::array<vtkSmartPointer<vtkCellArray>, Kinds> kinds;
    vtkIdType place = 0;
    for (int kind = 0; kind < Kinds; ++kind)
    {
      kinds[kind] = vtkSmartPointer<vtkCellArray>::New();
      for (; place < kindEnd_[kind]; ++place)
      {
        const vtkIdType cell = cellSource_[place];
        kinds[kind]->InsertNextCell(begin[cell + 1] - begin[cell], corners.data() + begin[cell]);
      }
    }
    whole_->SetVerts(kinds[0]);
    whole_->SetLines(kinds[1]);
    whole_->SetPolys(kinds[2]);
    whole_->SetStrips(kinds[3]);
  }

  void WriteArrays(const std::vector<ArraysOfPieces>& arrays, const Numbering& numbering,
    const std::vector<vtkIdType>& sources, Attributes attributesOf)
  {
    vtkDataSetAttributes* data = attributesOf(whole_);
    for (const ArraysOfPieces& array : arrays)
    {
      data->AddArray(Pick(array, numbering, sources));
    }
    vtkDataSetAttributes* first = attributesOf(pieces_.front());
    for (int type = 0; type < vtkDataSetAttributes::NUM_ATTRIBUTES; ++type)
    {
      vtkAbstractArray* active = first->GetAbstractAttribute(type);
      if (active && active->GetName() && data->HasArray(active->GetName()))
      {
        data->SetActiveAttribute(active->GetName(), type);
      }
    }
  }

  /// Cells that are hidden stay, and stay hidden.
  void WriteHiddenCells()
  {
    vtkNew<vtkUnsignedCharArray> hidden;
    hidden->SetName(vtkDataSetAttributes::GhostArrayName());
    bool isAny = false;
    for (const vtkIdType cell : cellSource_)
    {
      const std::size_t p = cells_.PieceOf(cell);
      auto* ghosts = GhostsOf(pieces_[p]->GetCellData(), cells_.first[p + 1] - cells_.first[p]);
      hidden->InsertNextValue(ghosts ? ghosts->GetValue(cell - cells_.first[p]) : 0);
      isAny = isAny || hidden->GetValue(hidden->GetMaxId()) != 0;
    }
    if (isAny)
    {
      whole_->GetCellData()->AddArray(hidden);
    }
  }

  void Write(
    const std::vector<ArraysOfPieces>& ofPoints, const std::vector<ArraysOfPieces>& ofCells)
  {
    ArraysOfPieces coordinates;
    for (vtkPolyData* piece : pieces_)
    {
      coordinates.push_back(piece->GetPoints()->GetData());
    }
    vtkNew<vtkPoints> points;
    points->SetData(vtkDataArray::SafeDownCast(Pick(coordinates, points_, pointSource_).Get()));
    whole_->SetPoints(points);
    this->WriteCells();
    this->WriteArrays(ofPoints, points_, pointSource_, &PointsOf);
    this->WriteArrays(ofCells, cells_, cellSource_, &CellDataOf);
    this->WriteHiddenCells();
  }

  Pieces pieces_;
  std::vector<int> ranks_; // of the pieces
  Numbering points_;
  Numbering cells_;
  std::vector<char> isCopiedCell_;
  std::vector<char> isOwnPoint_;      // of a cell that is no copy, or of none
  std::vector<vtkIdType> coincident_; // may be empty
  bool isWelded_ = false;
  std::vector<vtkIdType> pointPlace_; // in the whole
  std::vector<vtkIdType> cellPlace_;
  std::vector<vtkIdType> pointSource_; // per point of the whole
  std::vector<vtkIdType> cellSource_;
  std::array<vtkIdType, Kinds> kindEnd_{};
  std::vector<std::string> partial_;
  vtkNew<vtkPolyData> whole_;
};

bool HaveSameArrays(vtkFieldData* a, vtkFieldData* b)
{
  bool areSame = a->GetNumberOfArrays() == b->GetNumberOfArrays();
  for (int k = 0; areSame && k < a->GetNumberOfArrays(); ++k)
  {
    areSame = HaveSameContents(a->GetAbstractArray(k), b->GetAbstractArray(k));
  }
  return areSame;
}

bool HaveSameCells(vtkCellArray* a, vtkCellArray* b)
{
  const vtkIdType ours = a ? a->GetNumberOfCells() : 0;
  const vtkIdType theirs = b ? b->GetNumberOfCells() : 0;
  return ours == theirs &&
         (ours == 0 || (HaveSameContents(a->GetOffsetsArray(), b->GetOffsetsArray()) &&
                         HaveSameContents(a->GetConnectivityArray(), b->GetConnectivityArray())));
}

bool AreSamePiece(vtkPolyData* a, vtkPolyData* b)
{
  const auto ours = CellsOf(a);
  const auto theirs = CellsOf(b);
  for (int kind = 0; kind < Kinds; ++kind)
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

std::vector<vtkIdType> Ascending(vtkIdType count)
{
  std::vector<vtkIdType> places(count);
  std::iota(places.begin(), places.end(), 0);
  return places;
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

/// Adds field arrays whose names are not there yet.
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

} // namespace

GatheredSurface JoinPieces(const Pieces& pieces, bool weldCoincidentPoints)
{
  const auto count = static_cast<int>(pieces.size());
  Pieces distinct;
  std::vector<int> ranks;            // of the distinct pieces
  std::vector<int> which(count, -1); // of the distinct pieces, per rank
  for (int rank = 0; rank < count; ++rank)
  {
    if (pieces[rank]->GetNumberOfPoints() == 0)
    {
      continue;
    }
    const auto same = std::find_if(distinct.begin(), distinct.end(),
      [&](vtkPolyData* other) { return AreSamePiece(other, pieces[rank]); });
    which[rank] = static_cast<int>(same - distinct.begin());
    if (same == distinct.end())
    {
      distinct.push_back(pieces[rank]);
      ranks.push_back(rank);
    }
  }
  GatheredSurface joined;
  if (distinct.size() < 2)
  {
    joined = OnlyPiece(distinct.empty() ? pieces.front() : distinct.front());
  }
  else
  {
    joined = Joiner(distinct, ranks, weldCoincidentPoints).Result();
  }
  std::vector<PiecePlaces> places(count);
  for (int rank = 0; rank < count; ++rank)
  {
    if (which[rank] >= 0)
    {
      places[rank] = joined.pieces[which[rank]];
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
