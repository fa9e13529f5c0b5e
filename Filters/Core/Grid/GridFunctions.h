// A mesh in its grid with the nested function spaces on it: what every solver starts from.
#ifndef GridFEM_GridFunctions_h
#define GridFEM_GridFunctions_h

#include "Base/Job.h"
#include "Grid/Clip.h"
#include "Grid/PatchLevel.h"

#include <vector>

namespace gridfem
{

/// What pieces are linked decides what is connected.
struct SpaceOptions : ClipOptions
{
  bool connectivityAware = true; // one function per connected component of a support
};

/// A piece that another process has, of a triangle that has pieces here, too.
struct PieceElsewhere
{
  MortonKey cell;
  Index triangle;
};

struct GridFunctions
{
  FunctionSupport support = FunctionSupport::ConnectivityAware;
  ClippedMesh clipped;            // without its links
  Array<Index> piecePatch;        // per piece: patch of the finest level
  std::vector<PatchLevel> levels; // finest first, down to depth 0
  Array<Index> pointPatch;        // per input point: a patch that contains it; -1 if unused
  std::vector<Index> component;   // per finest function
  Index numberOfComponents = 0;
  bool isPart = false;                   // other processes have the rest of the surface
  std::vector<PieceElsewhere> elsewhere; // near the pieces here

  const Grid& GetGrid() const { return clipped.grid; }
  const PatchLevel& Finest() const { return levels.front(); }
};

/// Clip, patches and levels in one go.
GridFunctions BuildGridFunctions(
  const TriangleMesh& mesh, const SpaceOptions& options, const Progress& progress = {});

/// The same on a mesh that is clipped already.
GridFunctions BuildGridFunctions(ClippedMesh clipped, FunctionSupport support, const Job& job = {});

/// The same from stored tables: patches and functions are taken as they are. `clipped.links` must
/// be filled (FindLinks finds them in a mesh that was read from a file), `finest.cell` and
/// `finest.dof` too. Throws InvalidInput when the tables do not fit together.
GridFunctions RestoreGridFunctions(ClippedMesh clipped, Array<Index> piecePatch, PatchLevel finest,
  FunctionSupport support, const Progress& progress = {});

/// Fills `component` and `numberOfComponents` from the patches of the finest level.
void FindComponents(GridFunctions& space, int threads = 0);

/// For each of the first `points` points of the clipped mesh the patch it is given to: the best
/// (PatchChoice) of the pieces around it that have an area, or of all where none has; -1 for points
/// without a piece. A piece without area may belong to a patch in another cell, whose functions say
/// nothing at the point. Where points are welded, those of patches without area get that of a point
/// at the same place.
Array<Index> FindPointPatches(const ClippedMesh& clipped, const Array<Index>& piecePatch,
  Id numberOfPatches, Id points, int threads = 0);

/// Pieces that share an edge (two point ids, after `pointClass` if it is not empty), for a clipped
/// mesh that comes without links.
Array<Link> FindLinks(
  const ClippedMesh& clipped, const Array<Index>& pointClass, const Progress& progress = {});

} // namespace gridfem

#endif
