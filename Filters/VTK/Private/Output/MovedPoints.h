// Moves the points of a mesh and removes the arrays that no longer fit.
#ifndef GridFEM_MovedPoints_h
#define GridFEM_MovedPoints_h

class vtkDataArray;
class vtkPolyData;

namespace gridfem
{

/// Gives the mesh other places for its points. Removes the arrays that belong to the shape: the
/// active normals and tangents of points and cells, the clip, the basis and the modes.
void MovePoints(vtkPolyData* data, vtkDataArray* coordinates);

} // namespace gridfem

#endif
