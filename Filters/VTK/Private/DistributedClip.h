// Makes the clipped mesh, and the functions on it, of ranks that compute together. Each rank has
// the pieces in its own cells of the octree, wherever their triangles were given.
#ifndef GridFEM_DistributedClip_h
#define GridFEM_DistributedClip_h

#include "DistributedSurface.h"

#include "Grid/Clip.h"

class vtkPolyData;
class vtkUnstructuredGrid;

namespace gridfem
{

/// The clip of this rank. Functions with arguments are collective and called within
/// DistributedSurface::Run. The results of all ranks, in rank order, are the results of one rank on
/// the gathered surface. Each rank has only the points of its pieces, the input's first. Points
/// between two ranks are on both.
class DistributedClip
{
public:
  /// Returns null in a build without MPI.
  static std::unique_ptr<DistributedClip> Make();

  virtual ~DistributedClip() = default;

  /// Reads the pieces of all ranks and clips them.
  /// @param mesh      gets this rank's own triangles
  /// @param progress  of this rank alone
  virtual void Build(DistributedSurface& together, vtkPolyData* piece,
    const SurfaceOptions& options, InputMesh& mesh, const Progress& progress) = 0;

  /// Takes the ranks' pieces of the grid space, with its functions.
  /// @param isClipped  the ranks' pieces are parts of a clip: they stay unchanged on their ranks
  /// and get the tables of the basis
  /// @param mesh       this rank's own triangles
  virtual void Take(const DistributedSurface& together, vtkPolyData* piece, bool isClipped,
    const SurfaceOptions& options, const InputMesh& mesh) = 0;

  /// Returns the clipped mesh of this rank, with the current arrays of the pieces.
  virtual void WriteMesh(
    vtkPolyData* piece, const InputMesh& mesh, int threads, vtkPolyData* output) const = 0;

  /// Writes the functions of a level, as WriteBasisFunctions does: the functions that patches of
  /// this rank have. All ranks know the coarse levels, and the first rank writes all their
  /// functions.
  virtual void WriteFunctions(int level, vtkUnstructuredGrid* output) const = 0;

  /// Adds the point array BasisFunction, a function of a level, to the clipped mesh.
  virtual void AddBasisFunction(int level, Id function, int threads, vtkPolyData* output) const = 0;

  virtual const ClippedMesh& Clipped() const = 0;
  /// The triangles that this rank has received, which its pieces refer to. Their cells are counted
  /// through all ranks as in the gathered surface.
  virtual const InputMesh& Source() const = 0;
  /// The last cell of lower ranks. Null if there is none.
  virtual const MortonKey* CellBefore() const = 0;
  /// The precision of the output's points.
  virtual int Precision() const = 0;
};

} // namespace gridfem

#endif
