// Writes a mesh whose points have moved as vtkPolyData, with measures of the motion.
#ifndef GridFEM_MovedMeshWriter_h
#define GridFEM_MovedMeshWriter_h

#include "Grid/TriangleMesh.h"

#include <vector>

class vtkPolyData;

namespace gridfem
{

/// Gives a copy of the input its new points, and the point arrays Displacement and
/// NormalDisplacement (along the normals of the input). The active scalars are NormalDisplacement.
/// Active normals at points become the normals of the new surface. Normals at cells and the arrays
/// of clip, basis and spectrum belong to the input and are removed.
/// @param mesh      the triangles of the input
/// @param dataType  the type of the points and the arrays: VTK_FLOAT or VTK_DOUBLE
void MoveSurface(const TriangleMesh& mesh, const std::vector<Vec3>& points, int dataType,
  int threads, vtkPolyData* output);

/// Does the same for places in rows of three.
void MoveSurface(const TriangleMesh& mesh, const MultiVector& places, int dataType, int threads,
  vtkPolyData* output);

/// Does the same for points of a flow, with ConformalFactor and QuasiConformalError in place of
/// NormalDisplacement.
void MoveMesh(const TriangleMesh& mesh, const std::vector<Vec3>& points, int dataType, int threads,
  vtkPolyData* output);

} // namespace gridfem

#endif
