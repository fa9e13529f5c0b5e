// The pieces of a surface that ranks or blocks hold, seen as one list of points, one of cells, and
// the arrays that all of them have.
#ifndef GridFEM_PieceArrays_h
#define GridFEM_PieceArrays_h

#include "CellCorners.h"

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

/// Kinds of cells; the ids of a piece's cells follow each other in this order.
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

/// Point data or cell data.
using AttributesOf = vtkDataSetAttributes* (*)(vtkPolyData*);
vtkDataSetAttributes* PointDataOf(vtkPolyData* piece);
vtkDataSetAttributes* CellDataOf(vtkPolyData* piece);

/// The ghost flags; null without.
vtkUnsignedCharArray* GhostsOf(vtkDataSetAttributes* data, vtkIdType tuples);

/// Points, or cells, of all pieces under one number: those of piece p are first[p] .. first[p + 1].
struct Numbering
{
  std::vector<vtkIdType> first{ 0 };

  void Add(vtkIdType count) { first.push_back(first.back() + count); }
  vtkIdType Count() const { return first.back(); }
  std::size_t PieceOf(vtkIdType thing) const;
};

/// The arrays of one name, one of each piece.
using ArraysOfPieces = std::vector<vtkAbstractArray*>;

/// The global ids of points or of cells; empty unless all pieces have them.
ArraysOfPieces GlobalIds(const Pieces& pieces, AttributesOf attributesOf);

/// The arrays that all pieces have with as many components and with a tuple for each thing; none
/// are ghost flags.
/// @param owners   of the pieces, such as "rank 3"
/// @param partial  gets "'name' (rank 3)" for each of the others
std::vector<ArraysOfPieces> CommonArrays(const Pieces& pieces, AttributesOf attributesOf,
  const Numbering& numbering, const std::vector<std::string>& owners,
  std::vector<std::string>& partial);

/// Whether two things have the same values in all arrays. Ids that tell where something was before
/// are not compared: they differ between ranks for the same point.
bool HaveSameValues(const std::vector<ArraysOfPieces>& arrays, const Numbering& numbering,
  vtkIdType thing, vtkIdType other);

/// The tuples of things in the given order; double where the arrays are of different types.
vtkSmartPointer<vtkAbstractArray> Pick(
  const ArraysOfPieces& arrays, const Numbering& numbering, const std::vector<vtkIdType>& things);

} // namespace gridfem

#endif
