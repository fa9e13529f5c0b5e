// A mesh in its grid with nested function spaces. Every solver starts from this.
#ifndef GridFEM_GridFunctions_h
#define GridFEM_GridFunctions_h

#include "Base/Job.h"
#include "Grid/Clip.h"
#include "Grid/PatchLevel.h"

#include <vector>

namespace gridfem
{

/// Options of a function space. The links that ClipOptions asks for decide which pieces are
/// connected.
struct SpaceOptions : ClipOptions
{
  bool connectivityAware = true; // one function per connected component of a support
};

/// A piece held by another process. Its triangle also has pieces here.
struct PieceElsewhere
{
  MortonKey cell;
  Index triangle;
};

struct GridFunctions
{
  FunctionSupport support = FunctionSupport::ConnectivityAware;
  ClippedMesh clipped;            // its links are removed
  Array<Index> piecePatch;        // the patch of each piece on the finest level
  std::vector<PatchLevel> levels; // finest first, down to depth 0
  Array<Index> pointPatch;        // a patch that contains each input point; -1 if unused
  std::vector<Index> component;   // the component of each function of the finest level
  Index numberOfComponents = 0;
  bool isPart = false;                   // other processes have the rest of the surface
  std::vector<PieceElsewhere> elsewhere; // pieces near the pieces of this process

  const Grid& GetGrid() const { return clipped.grid; }
  const PatchLevel& Finest() const { return levels.front(); }
};

/// Clips the mesh and builds patches and levels.
GridFunctions BuildGridFunctions(
  const TriangleMesh& mesh, const SpaceOptions& options, const Progress& progress = {});

/// Builds patches and levels on a mesh that is already clipped.
GridFunctions BuildGridFunctions(ClippedMesh clipped, FunctionSupport support, const Job& job = {});

/// Builds the levels from stored tables, without changing patches and functions. `clipped.links`,
/// `finest.cell` and `finest.dof` must be filled; FindLinks computes the links of a mesh read from
/// a file. Throws InvalidInput when the tables do not fit together.
GridFunctions RestoreGridFunctions(ClippedMesh clipped, Array<Index> piecePatch, PatchLevel finest,
  FunctionSupport support, const Progress& progress = {});

/// Computes `component` and `numberOfComponents` from the patches of the finest level.
void FindComponents(GridFunctions& space, int threads = 0);

/// Returns a patch for each of the first `points` points of the clipped mesh, or -1 for a point
/// without a piece. It takes the best patch (see PatchChoice) among the pieces with area around the
/// point, or among all pieces if none has area. Pieces without area come last, because they may
/// belong to a patch in another cell, whose functions say nothing about the point. If points are
/// welded, a point whose patch has no area gets the patch of a coincident point.
Array<Index> FindPointPatches(const ClippedMesh& clipped, const Array<Index>& piecePatch,
  Id numberOfPatches, Id points, int threads = 0);

/// Returns links between pieces that share an edge, for a clipped mesh without links. An edge is a
/// pair of point ids, mapped through `pointClass` unless it is empty.
Array<Link> FindLinks(
  const ClippedMesh& clipped, const Array<Index>& pointClass, const Progress& progress = {});

} // namespace gridfem

#endif
