#include "MovedMeshWriter.h"

#include "ClippedArrays.h"
#include "Problems/MovedSurface.h"
#include "SolverOutput.h"

#include "vtkCellData.h"
#include "vtkDataArray.h"
#include "vtkFieldData.h"
#include "vtkNew.h"
#include "vtkPointData.h"
#include "vtkPoints.h"
#include "vtkPolyData.h"

#include <string>

namespace gridfem
{
namespace
{

MultiVector Rows(const std::vector<Vec3>& vectors)
{
  MultiVector rows(static_cast<Id>(vectors.size()), 3);
  for (std::size_t k = 0; k < vectors.size(); ++k)
  {
    for (int axis = 0; axis < 3; ++axis)
    {
      rows(static_cast<Id>(k), axis) = vectors[k][axis];
    }
  }
  return rows;
}

void AddNumbers(
  const char* name, const std::vector<double>& values, int dataType, vtkPolyData* output)
{
  const Eigen::Map<const Eigen::VectorXd> column(
    values.data(), static_cast<Eigen::Index>(values.size()));
  output->GetPointData()->AddArray(MakePointArray(name, column, dataType));
}

void RemoveStaleArrays(vtkPolyData* output)
{
  for (const char* name : { OctreeCellIdName, PatchIdName })
  {
    output->GetCellData()->RemoveArray(name);
  }
  for (const char* name : { OctreeCellsName, GridOriginName, GridSpacingName, GridDepthName,
         PatchCellIdName, PatchBasisIdsName, NumberOfBasisFunctionsName, ConnectivityAwareName,
         WeldCoincidentPointsName, "Eigenvalues", "UsedDepth" })
  {
    output->GetFieldData()->RemoveArray(name);
  }
  if (vtkDataArray* normals = output->GetCellData()->GetNormals())
  {
    output->GetCellData()->RemoveArray(normals->GetName());
  }
}

/// On the side of the surface where the given ones are.
void ReplaceNormals(
  const TriangleMesh& mesh, const std::vector<Vec3>& points, int threads, vtkPolyData* output)
{
  vtkDataArray* given = output->GetPointData()->GetNormals();
  if (!given)
  {
    return;
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
  const MultiVector normals = sign * Rows(NormalsAtPoints(points, mesh.triangles, threads));
  output->GetPointData()->SetNormals(MakePointArray(name.c_str(), normals, given->GetDataType()));
}

} // namespace

void MoveMesh(const TriangleMesh& mesh, const std::vector<Vec3>& points, int dataType, int threads,
  vtkPolyData* output)
{
  RemoveStaleArrays(output);
  ReplaceNormals(mesh, points, threads, output);
  const MultiVector positions = Rows(points);
  vtkNew<vtkPoints> moved;
  moved->SetData(MakePointArray("Points", positions, dataType));
  output->SetPoints(moved);
  output->GetPointData()->AddArray(
    MakePointArray("Displacement", positions - Rows(mesh.points), dataType));
  const MapDistortion map = DistortionOf(mesh, points, threads);
  AddNumbers("ConformalFactor", MeansAtPoints(mesh, map.areaRatio, 1.0, threads), dataType, output);
  AddNumbers(
    "QuasiConformalError", MeansAtPoints(mesh, map.stretchRatio, 1.0, threads), dataType, output);
}

} // namespace gridfem
