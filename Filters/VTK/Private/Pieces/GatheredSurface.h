// Makes one surface from the pieces that ranks, or blocks of composite data, hold of it.
#ifndef GridFEM_GatheredSurface_h
#define GridFEM_GatheredSurface_h

#include "Base/Errors.h"
#include "Solvers/Stages.h"

#include "vtkSmartPointer.h"
#include "vtkType.h"

#include <string>
#include <vector>

class vtkFieldData;
class vtkPolyData;

namespace gridfem
{

/// The places of a piece's points and cells in the whole. -1 for points and cells that are missing
/// there.
struct PiecePlaces
{
  std::vector<vtkIdType> points;
  std::vector<vtkIdType> cells;
};

struct GatheredSurface
{
  vtkSmartPointer<vtkPolyData> whole;
  std::vector<PiecePlaces> pieces;        // of every owner
  std::vector<std::string> partialArrays; // "'name' (rank 3)": left out, because that one lacks it
};

/// Adds everything that is joined of a surface to a key.
void AddSurface(StageKey& key, vtkPolyData* surface);

/// Throws InvalidInput for a cell with a point that does not exist.
/// @param whole  has the points: "mesh" or "piece"
void RequireGoodCells(vtkPolyData* surface, const char* whole);

/// Joins pieces, one for each owner, a rank or a block. Empty pieces may be among them.
/// - Cells that vtkGhostType marks as duplicates are left out, with their points. They are found
///   again among the other cells, so that they get the values of these cells.
/// - Points with the same global id are one. If some piece lacks global ids and
///   `weldCoincidentPoints` is on, points of two owners are one if they agree in coordinates and in
///   all arrays. Points of the same owner stay apart.
/// - Points and cells are sorted by their global ids, so that the bits of a result do not depend on
///   the distribution. Without such ids they have the order of the owners.
/// - Only arrays that all pieces with points have are joined. Arrays of different types become
///   double. Field arrays come from the first owner that has them.
/// - A piece that equals an earlier owner's piece, bit by bit, counts once.
/// - If only one piece has points, it is taken unchanged, with its arrays.
/// @param owners  the names of the owners in messages, such as "rank 3"
/// Throws InvalidInput if two points with the same global id have different coordinates.
GatheredSurface JoinPieces(const std::vector<vtkSmartPointer<vtkPolyData>>& pieces,
  const std::vector<std::string>& owners, bool weldCoincidentPoints);

/// Adds field arrays whose names are new.
void AddMissing(vtkFieldData* from, vtkFieldData* to);

/// Throws the error again, and names the arrays that some pieces lack. They are the likely reason
/// if a chosen array does not exist.
[[noreturn]] void ThrowWithPartialArrays(const InvalidInput& error, const GatheredSurface& surface);

/// Takes over the points, cells and arrays of the last surface that are unchanged. Stages made from
/// them need not run again.
void KeepUnchanged(vtkPolyData* last, vtkPolyData* surface);

} // namespace gridfem

#endif
