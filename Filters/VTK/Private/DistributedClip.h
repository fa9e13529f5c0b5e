// The clipped mesh, and the functions on it, of ranks that compute together: each has the pieces in
// its own cells of the octree, wherever their triangles were given.
#ifndef GridFEM_DistributedClip_h
#define GridFEM_DistributedClip_h

#include "DistributedSurface.h"

#include "Grid/Clip.h"

class vtkPolyData;
class vtkUnstructuredGrid;

namespace gridfem
{

/// Functions are collective, but for those without arguments, and called within
/// DistributedSurface::Run. What they make is, one rank after the other, what one rank makes of the
/// gathered surface; but of its points only those are there that pieces have, on every rank the
/// input's first. Points between two ranks are on both.
class DistributedClip
{
public:
  /// Null in a build without MPI.
  static std::unique_ptr<DistributedClip> Make();

  virtual ~DistributedClip() = default;

  /// Reads the pieces of all ranks and clips them.
  /// @param mesh      gets this rank's own triangles
  /// @param progress  of this rank alone
  virtual void Build(DistributedSurface& together, vtkPolyData* piece,
    const SurfaceOptions& options, InputMesh& mesh, const Progress& progress) = 0;

  /// Takes the pieces of the grid space that the ranks have, with its functions.
  /// @param isClipped  the ranks' pieces are parts of a clip: they stay where and as they are, and
  ///                   get the tables of the basis
  /// @param mesh       this rank's own triangles
  virtual void Take(const DistributedSurface& together, vtkPolyData* piece, bool isClipped,
    const SurfaceOptions& options, const InputMesh& mesh) = 0;

  /// The clipped mesh of this rank, with the arrays of the pieces as they are now.
  virtual void WriteMesh(
    vtkPolyData* piece, const InputMesh& mesh, int threads, vtkPolyData* output) const = 0;

  /// The functions of a level, as WriteBasisFunctions does: those that patches of this rank have,
  /// or on the first rank all where the level is a coarse one that all ranks have.
  virtual void WriteFunctions(int level, vtkUnstructuredGrid* output) const = 0;

  /// Adds the point array BasisFunction, a function of a level, to the clipped mesh.
  virtual void AddBasisFunction(int level, Id function, int threads, vtkPolyData* output) const = 0;

  virtual const ClippedMesh& Clipped() const = 0;
  /// What its pieces refer to: the triangles that this rank has received, and the cells that these
  /// come from, counted through all ranks as in the gathered surface.
  virtual const InputMesh& Source() const = 0;
  /// The last cell of lower ranks; null without one.
  virtual const MortonKey* CellBefore() const = 0;
  /// Of the output's points.
  virtual int Precision() const = 0;
};

} // namespace gridfem

#endif
