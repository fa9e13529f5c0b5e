#include "Pieces/PieceJoiner.h"

#include "Base/Errors.h"
#include "Grid/TriangleMesh.h"
#include "Pieces/JoinedPieces.h"

#include "vtkCellData.h"
#include "vtkDataArray.h"
#include "vtkPointData.h"
#include "vtkPoints.h"
#include "vtkUnsignedCharArray.h"

#include <algorithm>
#include <map>

namespace gridfem
{
namespace
{

/// The largest number of points at one place that are compared with another. More are no mesh and
/// would take quadratic time. In this case they stay apart, as on one rank.
constexpr int MostCompared = 64;

/// Reads the id exactly. A double would lose digits beyond 2^53.
vtkIdType IdAt(vtkAbstractArray* ids, vtkIdType tuple)
{
  return ids->GetVariantValue(tuple).ToLongLong();
}

} // namespace

PieceJoiner::PieceJoiner(Pieces pieces, std::vector<std::string> owners, bool weldCoincidentPoints)
  : pieces_(std::move(pieces)), owners_(std::move(owners))
{
  ArraysOfPieces coordinates;
  for (vtkPolyData* piece : pieces_)
  {
    points_.Add(piece->GetNumberOfPoints());
    cells_.Add(piece->GetNumberOfCells());
    coordinates.push_back(piece->GetPoints()->GetData());
  }
  this->FindCopies();
  const auto ofPoints = CommonArrays(pieces_, &PointDataOf, points_, owners_, partial_);
  const auto ofCells = CommonArrays(pieces_, &CellDataOf, cells_, owners_, partial_);
  pointPlace_.assign(points_.Count(), -1);
  cellPlace_.assign(cells_.Count(), -1);
  const ArraysOfPieces ids = GlobalIds(pieces_, &PointDataOf);
  if (!ids.empty())
  {
    this->JoinPointsById(ids);
  }
  else
  {
    this->FindCoincident(weldCoincidentPoints);
    this->JoinPointsByPlace(ofPoints);
  }
  this->JoinCells();
  this->FindCopiedCells();

  vtkNew<vtkPoints> points;
  points->SetData(vtkDataArray::SafeDownCast(Pick(coordinates, points_, pointSource_)));
  whole_->SetPoints(points);
  WriteJoinedCells(pieces_, points_, pointPlace_, cellSource_, kindEnd_, whole_);
  WriteJoinedArrays(pieces_, ofPoints, points_, pointSource_, &PointDataOf, whole_);
  WriteJoinedArrays(pieces_, ofCells, cells_, cellSource_, &CellDataOf, whole_);
  WriteHiddenCells(pieces_, cells_, cellSource_, whole_);
}

GatheredSurface PieceJoiner::Result()
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

/// Finds the cells and points that are only copies of cells and points of another rank.
void PieceJoiner::FindCopies()
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

/// Whether a rank marks a point as another rank's.
bool PieceJoiner::IsCopiedPoint(vtkIdType point) const
{
  const std::size_t p = points_.PieceOf(point);
  auto* ghosts = GhostsOf(pieces_[p]->GetPointData(), points_.first[p + 1] - points_.first[p]);
  return ghosts &&
         (ghosts->GetValue(point - points_.first[p]) & vtkDataSetAttributes::DUPLICATEPOINT) != 0;
}

Vec3 PieceJoiner::PositionOf(vtkIdType point) const
{
  const std::size_t p = points_.PieceOf(point);
  Vec3 position;
  pieces_[p]->GetPoint(point - points_.first[p], position.data());
  return position;
}

vtkIdType PieceJoiner::AddPoint(vtkIdType point)
{
  pointSource_.push_back(point);
  return pointPlace_[point] = static_cast<vtkIdType>(pointSource_.size()) - 1;
}

/// Joins a point with a point that another rank already has. Its values come from the rank that
/// owns it.
void PieceJoiner::JoinPoint(vtkIdType point, vtkIdType place)
{
  pointPlace_[point] = place;
  if (this->IsCopiedPoint(pointSource_[place]) && !this->IsCopiedPoint(point))
  {
    pointSource_[place] = point;
  }
}

void PieceJoiner::JoinPointsById(const ArraysOfPieces& ids)
{
  IdsAndThings sorted;
  sorted.reserve(points_.Count());
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

void PieceJoiner::RequireSamePlace(vtkIdType point, vtkIdType other, vtkIdType id) const
{
  const Vec3 here = this->PositionOf(point);
  const Vec3 there = this->PositionOf(other);
  if (here != there && !here.hasNaN())
  {
    throw InvalidInput("The global point id " + std::to_string(id) + " belongs to a point of " +
                       owners_[points_.PieceOf(point)] + " and to a point elsewhere of " +
                       owners_[points_.PieceOf(other)] +
                       ". Remove the wrong ids, for example with Pass Arrays.");
  }
}

/// Finds the points that have the same coordinates, if joining needs them.
void PieceJoiner::FindCoincident(bool weldCoincidentPoints)
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
  lowest_.assign(lowest.begin(), lowest.end());
}

vtkIdType PieceJoiner::LowestAt(vtkIdType point) const
{
  return lowest_.empty() ? point : lowest_[point];
}

/// Returns the place of the same point of an earlier piece. -1 if there is none.
vtkIdType PieceJoiner::FindPlace(vtkIdType point, const std::vector<ArraysOfPieces>& arrays) const
{
  const std::size_t piece = points_.PieceOf(point);
  vtkIdType place = firstPlace_[this->LowestAt(point)];
  for (int k = 0; place >= 0 && k < MostCompared; ++k, place = nextPlace_[place])
  {
    if (lastPiece_[place] != piece && HaveSameValues(arrays, points_, pointSource_[place], point))
    {
      return place;
    }
  }
  return -1;
}

/// Returns the place of the copied point. Another point at the same place is better than none.
vtkIdType PieceJoiner::FindPlaceOfCopy(
  vtkIdType point, const std::vector<ArraysOfPieces>& arrays) const
{
  const vtkIdType first = firstPlace_[this->LowestAt(point)];
  vtkIdType place = first;
  for (int k = 0; place >= 0 && k < MostCompared; ++k, place = nextPlace_[place])
  {
    if (HaveSameValues(arrays, points_, pointSource_[place], point))
    {
      return place;
    }
  }
  return first;
}

void PieceJoiner::JoinPointsByPlace(const std::vector<ArraysOfPieces>& arrays)
{
  firstPlace_.assign(points_.Count(), -1);
  std::vector<vtkIdType> lastPlace(points_.Count(), -1);
  for (vtkIdType point = 0; point < points_.Count(); ++point)
  {
    if (!isOwnPoint_[point])
    {
      continue;
    }
    const vtkIdType place = isWelded_ ? this->FindPlace(point, arrays) : -1;
    if (place >= 0)
    {
      this->JoinPoint(point, place);
      lastPiece_[place] = points_.PieceOf(point);
      continue;
    }
    const vtkIdType added = this->AddPoint(point);
    lastPiece_.push_back(points_.PieceOf(point));
    nextPlace_.push_back(-1);
    const vtkIdType lowest = this->LowestAt(point);
    (firstPlace_[lowest] < 0 ? firstPlace_[lowest] : nextPlace_[lastPlace[lowest]]) = added;
    lastPlace[lowest] = added;
  }
  for (vtkIdType point = 0; point < points_.Count(); ++point)
  {
    if (!isOwnPoint_[point])
    {
      pointPlace_[point] = this->FindPlaceOfCopy(point, arrays);
    }
  }
}

/// Returns the cells of a kind that are no copies, with their global ids, or 0.
PieceJoiner::IdsAndThings PieceJoiner::CellsOfKind(int kind, const ArraysOfPieces& ids) const
{
  IdsAndThings cells;
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
        cells.emplace_back(ids.empty() ? 0 : IdAt(ids[p], cell - cells_.first[p]), cell);
      }
    }
  }
  return cells;
}

void PieceJoiner::JoinCells()
{
  const ArraysOfPieces ids = GlobalIds(pieces_, &CellDataOf);
  for (int kind = 0; kind < CellKinds; ++kind)
  {
    IdsAndThings sorted = this->CellsOfKind(kind, ids);
    std::sort(sorted.begin(), sorted.end());
    for (const auto& entry : sorted)
    {
      cellPlace_[entry.second] = static_cast<vtkIdType>(cellSource_.size());
      cellSource_.push_back(entry.second);
    }
    kindEnd_[kind] = static_cast<vtkIdType>(cellSource_.size());
  }
}

/// Calls body(cell, places) with the places that the points of the cell, and of its copies, have in
/// common.
template<class Body>
void PieceJoiner::ForEachCellThat(bool isCopied, Body&& body) const
{
  std::vector<vtkIdType> corners;
  for (std::size_t p = 0; p < pieces_.size(); ++p)
  {
    ForEachCell(pieces_[p],
      [&](vtkIdType cell, const vtkIdType* ids, vtkIdType size)
      {
        if (static_cast<bool>(isCopiedCell_[cells_.first[p] + cell]) != isCopied)
        {
          return;
        }
        corners.clear();
        for (vtkIdType k = 0; k < size; ++k)
        {
          const vtkIdType point = points_.first[p] + ids[k];
          corners.push_back(lowest_.empty() ? pointPlace_[point] : lowest_[point]);
        }
        std::sort(corners.begin(), corners.end());
        body(cells_.first[p] + cell, corners);
      });
  }
}

/// Gives copies the place of the cell that they copy.
void PieceJoiner::FindCopiedCells()
{
  using Corners = std::vector<vtkIdType>;
  std::vector<char> isOfCopy(points_.Count(), 0); // of their corners
  this->ForEachCellThat(true,
    [&](vtkIdType, const Corners& corners)
    {
      for (const vtkIdType corner : corners)
      {
        if (corner >= 0)
        {
          isOfCopy[corner] = 1;
        }
      }
    });
  std::map<Corners, vtkIdType> places;
  this->ForEachCellThat(false,
    [&](vtkIdType cell, const Corners& corners)
    {
      if (std::all_of(corners.begin(), corners.end(),
            [&](vtkIdType corner) { return corner >= 0 && isOfCopy[corner]; }))
      {
        places.emplace(corners, cellPlace_[cell]);
      }
    });
  this->ForEachCellThat(true,
    [&](vtkIdType cell, const Corners& corners)
    {
      const auto found = places.find(corners);
      cellPlace_[cell] = found == places.end() ? -1 : found->second;
    });
}

} // namespace gridfem
