// Joins pieces of a surface: it finds their points and cells that are one.
#ifndef GridFEM_PieceJoiner_h
#define GridFEM_PieceJoiner_h

#include "Pieces/GatheredSurface.h"
#include "Pieces/PieceArrays.h"

#include "Base/Types.h"

#include <array>
#include <utility>

namespace gridfem
{

/// Joins in the constructor; Result returns the result. For one use. All pieces must have points.
/// JoinPieces documents the rules.
class PieceJoiner
{
public:
  /// @param owners  the owners of the pieces, for messages
  PieceJoiner(Pieces pieces, std::vector<std::string> owners, bool weldCoincidentPoints);

  /// The places refer to the pieces given.
  GatheredSurface Result();

private:
  using IdsAndThings = std::vector<std::pair<vtkIdType, vtkIdType>>;

  void FindCopies();
  bool IsCopiedPoint(vtkIdType point) const;
  Vec3 PositionOf(vtkIdType point) const;
  vtkIdType AddPoint(vtkIdType point);
  void JoinPoint(vtkIdType point, vtkIdType place);

  void JoinPointsById(const ArraysOfPieces& ids);
  void RequireSamePlace(vtkIdType point, vtkIdType other, vtkIdType id) const;

  void FindCoincident(bool weldCoincidentPoints);
  vtkIdType LowestAt(vtkIdType point) const;
  vtkIdType FindPlace(vtkIdType point, const std::vector<ArraysOfPieces>& arrays) const;
  vtkIdType FindPlaceOfCopy(vtkIdType point, const std::vector<ArraysOfPieces>& arrays) const;
  void JoinPointsByPlace(const std::vector<ArraysOfPieces>& arrays);

  void JoinCells();
  IdsAndThings CellsOfKind(int kind, const ArraysOfPieces& ids) const;
  template<class Body>
  void ForEachCellThat(bool isCopied, Body&& body) const;
  void FindCopiedCells();

  Pieces pieces_;
  std::vector<std::string> owners_;
  Numbering points_;
  Numbering cells_;
  std::vector<char> isCopiedCell_; // exists only as a ghost
  std::vector<char> isOwnPoint_;   // has a cell that is no copy, or no cell
  std::vector<vtkIdType> lowest_;  // point with the same coordinates, per point; may be empty
  bool isWelded_ = false;
  std::vector<vtkIdType> pointPlace_; // in the whole, per point
  std::vector<vtkIdType> cellPlace_;
  std::vector<vtkIdType> pointSource_; // the point, per place
  std::vector<vtkIdType> cellSource_;
  std::vector<vtkIdType> firstPlace_;  // of points with the same coordinates, by the lowest point
  std::vector<vtkIdType> nextPlace_;   // with the same coordinates, per place
  std::vector<std::size_t> lastPiece_; // that has the point, per place
  std::array<vtkIdType, CellKinds> kindEnd_{};
  std::vector<std::string> partial_;
  vtkNew<vtkPolyData> whole_;
};

} // namespace gridfem

#endif
