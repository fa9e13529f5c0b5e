// The clipped mesh of a filter's surface, and the functions on it, for the filters that output
// them.
#ifndef GridFEM_ClippedSurface_h
#define GridFEM_ClippedSurface_h

#include "Input/InputMesh.h"

#include "Grid/Clip.h"

class vtkPolyData;
class vtkUnstructuredGrid;

namespace gridfem
{

/// The clip of an InputSurface. The functions with arguments are collective on a shared surface.
/// The clips of all ranks, in rank order, are the clip of the gathered surface.
class ClippedSurface
{
public:
  virtual ~ClippedSurface() = default;

  /// Clips the input of the surface (SpaceStage).
  virtual void UpdateClip(const Progress& progress) = 0;

  /// Clips the input, unless it is a clip already, and makes functions (SpaceStage).
  /// @param isShared  later filters may use the functions that are in memory
  virtual void UpdateBasis(bool isShared, const Progress& progress) = 0;

  /// Writes the clipped mesh, with the current arrays of the input.
  virtual void WriteMesh(vtkPolyData* output) const = 0;

  /// Writes the functions of a level, as WriteBasisFunctions does.
  virtual void WriteFunctions(int level, vtkUnstructuredGrid* output) const = 0;

  /// Adds the point array BasisFunction, a function of a level, to the clipped mesh.
  virtual void AddBasisFunction(int level, Id function, vtkPolyData* output) const = 0;

  virtual const ClippedMesh& Clipped() const = 0;
  /// The triangles that the pieces refer to. Their cells are counted as in the gathered surface.
  virtual const InputMesh& Source() const = 0;
  /// The last cell of lower ranks. Null if there is none.
  virtual const MortonKey* CellBefore() const { return nullptr; }
  /// The precision of the output's points.
  virtual int Precision() const = 0;
};

} // namespace gridfem

#endif
