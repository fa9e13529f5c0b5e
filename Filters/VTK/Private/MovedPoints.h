// What a mesh keeps of its arrays when its points move.
#ifndef GridFEM_MovedPoints_h
#define GridFEM_MovedPoints_h

class vtkDataArray;
class vtkPolyData;

namespace gridfem
{

/// Gives the mesh other places for its points. Arrays that belong to the shape go: the active
/// normals and tangents of points and cells, the clip, the basis and the modes.
/// @param coordinates  3 components, a tuple per point
void MovePoints(vtkPolyData* data, vtkDataArray* coordinates);

} // namespace gridfem

#endif
