// One surface from the pieces that ranks, or blocks of composite data, hold of it.
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

/// Where the points and cells of a piece are in the whole; -1 for those that are not there.
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

/// Adds all that is joined of a surface.
void AddSurface(StageKey& key, vtkPolyData* surface);

/// Throws InvalidInput for a cell of a point that is not there.
void RequireGoodCells(vtkPolyData* surface);

/// Joins pieces, one for each owner, a rank or a block, empty ones as well:
/// - Cells that vtkGhostType marks as duplicates are left out, and their points; they are found
///   again among the others, so that they get the values of those.
/// - Points with the same global id are one. Without global ids on every piece and when
///   `weldCoincidentPoints`, a point of one owner and one of another are one when they have the
///   same coordinates and the same values in all arrays. Points of the same owner stay apart.
/// - Points and cells are sorted by their global ids, so that the bits of a result do not depend on
///   the distribution; without such ids they follow each other as the owners do.
/// - Arrays are those that all pieces with points have; of different types, they become double.
///   Field arrays are those of the first owner that has them.
/// - A piece that is the same as that of an earlier owner, bit by bit, counts once.
/// - The only piece with points is taken as it is, with its arrays.
/// @param owners  what messages call them, such as "rank 3"
/// Throws InvalidInput when two points with the same global id have different coordinates.
GatheredSurface JoinPieces(const std::vector<vtkSmartPointer<vtkPolyData>>& pieces,
  const std::vector<std::string>& owners, bool weldCoincidentPoints);

/// Adds field arrays whose names are not there yet.
void AddMissing(vtkFieldData* from, vtkFieldData* to);

/// Throws the error again, with the arrays that some pieces lack: the likely reason for one that
/// does not exist.
[[noreturn]] void ThrowWithPartialArrays(const InvalidInput& error, const GatheredSurface& surface);

/// Takes over the points, cells and arrays of the last surface that are the same in the new one, so
/// that stages made from them need not run again.
void KeepUnchanged(vtkPolyData* last, vtkPolyData* surface);

} // namespace gridfem

#endif
