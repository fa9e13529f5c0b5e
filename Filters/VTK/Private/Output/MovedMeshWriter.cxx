#include "Output/MovedMeshWriter.h"

#include "Base/VectorRows.h"
#include "Grid/OrientedMesh.h"
#include "Output/MovedPoints.h"
#include "Output/SolverOutput.h"
#include "Shape/MovedSurface.h"

#include "vtkDataArray.h"
#include "vtkPointData.h"
#include "vtkPolyData.h"

#include <string>

namespace gridfem
{
namespace
{

void AddNumbers(
  const char* name, const std::vector<double>& values, int dataType, vtkPolyData* output)
{
  output->GetPointData()->AddArray(MakePointArray(name, values, dataType));
}

/// Returns normals that replace the active normals at points, on the same side of the surface. Null
/// if there are none.
vtkSmartPointer<vtkDataArray> MovedNormals(
  const TriangleMesh& mesh, const std::vector<Vec3>& points, int threads, vtkPolyData* data)
{
  vtkDataArray* given = data->GetPointData()->GetNormals();
  // VTK keeps normals active if an array of their name with another shape replaces them.
  if (!given || given->GetNumberOfComponents() != 3 ||
      given->GetNumberOfTuples() != static_cast<vtkIdType>(points.size()))
  {
    return nullptr;
  }
  const std::vector<Vec3> before = NormalsAtPoints(mesh.points, mesh.triangles, threads);
  double agreement = 0.0;
  for (std::size_t k = 0; k < before.size(); ++k)
  {
    const double* normal = given->GetTuple3(static_cast<vtkIdType>(k));
    agreement += before[k].dot(Vec3(normal[0], normal[1], normal[2]));
  }
  const double sign = agreement < 0.0 ? -1.0 : 1.0;
  const std::string name = given->GetName() ? given->GetName() : "Normals";
  const MultiVector normals = sign * RowsOf(NormalsAtPoints(points, mesh.triangles, threads));
  return MakePointArray(name.c_str(), normals, given->GetDataType());
}

/// Writes new points, normals and Displacement.
void Move(const TriangleMesh& mesh, const std::vector<Vec3>& points, int dataType, int threads,
  vtkPolyData* output)
{
  const vtkSmartPointer<vtkDataArray> normals = MovedNormals(mesh, points, threads, output);
  const MultiVector positions = RowsOf(points);
  MovePoints(output, MakePointArray("Points", positions, dataType));
  if (normals)
  {
    output->GetPointData()->SetNormals(normals);
  }
  output->GetPointData()->AddArray(
    MakePointArray("Displacement", positions - RowsOf(mesh.points), dataType));
}

} // namespace

void MoveSurface(const TriangleMesh& mesh, const std::vector<Vec3>& points, int dataType,
  int threads, vtkPolyData* output)
{
  Move(mesh, points, dataType, threads, output);
  const OrientedMesh oriented = Orient(mesh, true, threads);
  const std::vector<Vec3> normals =
    NormalsAtPoints(mesh.points, oriented.TrianglesOf(mesh), threads);
  std::vector<double> along(points.size());
  for (std::size_t k = 0; k < points.size(); ++k)
  {
    const Id at = oriented.PointWithTriangle(static_cast<Id>(k));
    along[k] = normals[at].dot(points[k] - mesh.points[k]);
  }
  AddNumbers("NormalDisplacement", along, dataType, output);
  output->GetPointData()->SetActiveScalars("NormalDisplacement");
}

void MoveSurface(const TriangleMesh& mesh, const MultiVector& places, int dataType, int threads,
  vtkPolyData* output)
{
  MoveSurface(mesh, VectorsOf(places), dataType, threads, output);
}

void MoveMesh(const TriangleMesh& mesh, const std::vector<Vec3>& points, int dataType, int threads,
  vtkPolyData* output)
{
  Move(mesh, points, dataType, threads, output);
  const MapDistortion map = DistortionOf(mesh, points, threads);
  AddNumbers("ConformalFactor", MeansAtPoints(mesh, map.areaRatio, 1.0, threads), dataType, output);
  AddNumbers(
    "QuasiConformalError", MeansAtPoints(mesh, map.stretchRatio, 1.0, threads), dataType, output);
}

} // namespace gridfem
