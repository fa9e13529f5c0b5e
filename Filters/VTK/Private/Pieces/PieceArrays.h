// Shows the pieces of a surface that ranks or blocks hold as one list of points, one of cells, and
// the arrays that all of them have.
#ifndef GridFEM_PieceArrays_h
#define GridFEM_PieceArrays_h

#include "Input/CellCorners.h"

#include "vtkCellArray.h"
#include "vtkIdList.h"
#include "vtkNew.h"
#include "vtkPolyData.h"
#include "vtkSmartPointer.h"
#include "vtkType.h"

#include <array>
#include <string>
#include <vector>

class vtkAbstractArray;
class vtkDataSetAttributes;
class vtkUnsignedCharArray;

namespace gridfem
{

using Pieces = std::vector<vtkSmartPointer<vtkPolyData>>;

/// The kinds of cells. The ids of a piece's cells follow each other in this order.
constexpr int CellKinds = 4;

std::array<vtkCellArray*, CellKinds> CellsOf(vtkPolyData* piece);

/// Calls body(cell, ids of its points, their number) for all cells.
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
      GetCorners(cells, k, size, ids, storage);
      body(cell, ids, size);
    }
  }
}

/// Returns the numbers 0, 1, 2 ... below `count`.
std::vector<vtkIdType> Ascending(vtkIdType count);

/// Point data or cell data.
using AttributesOf = vtkDataSetAttributes* (*)(vtkPolyData*);
vtkDataSetAttributes* PointDataOf(vtkPolyData* piece);
vtkDataSetAttributes* CellDataOf(vtkPolyData* piece);

/// Returns the ghost flags. Null if there are none.
vtkUnsignedCharArray* GhostsOf(vtkDataSetAttributes* data, vtkIdType tuples);

/// Numbers the points, or cells, of all pieces. The numbers of piece p are first[p] .. first[p +
/// 1].
struct Numbering
{
  std::vector<vtkIdType> first{ 0 };

  void Add(vtkIdType count) { first.push_back(first.back() + count); }
  vtkIdType Count() const { return first.back(); }
  std::size_t PieceOf(vtkIdType thing) const;
};

/// The arrays of one name, one for each piece.
using ArraysOfPieces = std::vector<vtkAbstractArray*>;

/// Returns the global ids of points or of cells. Empty unless all pieces have them.
ArraysOfPieces GlobalIds(const Pieces& pieces, AttributesOf attributesOf);

/// Returns the arrays that all pieces have, with as many components and a tuple for each thing.
/// Leaves out ghost flags.
/// @param owners   the owners of the pieces, such as "rank 3"
/// @param partial  gets "'name' (rank 3)" for each of the other arrays
std::vector<ArraysOfPieces> CommonArrays(const Pieces& pieces, AttributesOf attributesOf,
  const Numbering& numbering, const std::vector<std::string>& owners,
  std::vector<std::string>& partial);

/// Whether two things have the same values in all arrays. Ids that name an earlier place are not
/// compared, because they differ between ranks for the same point.
bool HaveSameValues(const std::vector<ArraysOfPieces>& arrays, const Numbering& numbering,
  vtkIdType thing, vtkIdType other);

/// Returns the tuples of things in the given order. They are double if the arrays have different
/// types.
vtkSmartPointer<vtkAbstractArray> Pick(
  const ArraysOfPieces& arrays, const Numbering& numbering, const std::vector<vtkIdType>& things);

} // namespace gridfem

#endif
