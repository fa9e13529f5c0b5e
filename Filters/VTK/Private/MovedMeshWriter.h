// A mesh whose points have moved as vtkPolyData, with what the motion has done to it.
#ifndef GridFEM_MovedMeshWriter_h
#define GridFEM_MovedMeshWriter_h

#include "Grid/TriangleMesh.h"

#include <vector>

class vtkPolyData;

namespace gridfem
{

/// Gives a copy of the input its new points, and the point arrays Displacement and
/// NormalDisplacement (along the normals of the input). Active normals at points become those of
/// the new surface; normals at cells and the arrays of clip, basis and spectrum, which belong to
/// the input, go. The active scalars are NormalDisplacement.
/// @param mesh      the triangles of the input
/// @param dataType  of the points and the arrays: VTK_FLOAT or VTK_DOUBLE
void MoveSurface(const TriangleMesh& mesh, const std::vector<Vec3>& points, int dataType,
  int threads, vtkPolyData* output);

/// The same for places in rows of three.
void MoveSurface(const TriangleMesh& mesh, const MultiVector& places, int dataType, int threads,
  vtkPolyData* output);

/// The same for points of a flow, with ConformalFactor and QuasiConformalError in place of
/// NormalDisplacement.
void MoveMesh(const TriangleMesh& mesh, const std::vector<Vec3>& points, int dataType, int threads,
  vtkPolyData* output);

} // namespace gridfem

#endif
