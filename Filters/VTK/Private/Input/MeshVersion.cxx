#include "Input/MeshVersion.h"

#include "Pipeline/InputSurface.h"

#include "vtkPolyData.h"

namespace gridfem
{
namespace
{

bool HasSameContents(vtkPolyData* data, const InputMesh& last, int threads)
{
  if (!last.triangles ||
      data->GetNumberOfPoints() != static_cast<Id>(last.triangles->points.size()))
  {
    return false;
  }
  const InputMesh mesh = ReadInputMesh(data, last.isWelded, threads);
  return mesh.sourceCell == last.sourceCell && mesh.triangles->points == last.triangles->points &&
         mesh.triangles->triangles == last.triangles->triangles;
}

} // namespace

std::int64_t MeshVersion::Of(vtkPolyData* data, const InputMesh& last, int threads)
{
  StageKey arrays;
  AddMesh(arrays, data);
  if (!(arrays == arrays_))
  {
    version_ += HasSameContents(data, last, threads) ? 0 : 1;
    arrays_ = arrays;
  }
  return version_;
}

} // namespace gridfem
