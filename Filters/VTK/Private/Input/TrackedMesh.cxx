#include "Input/TrackedMesh.h"

#include "Pieces/DataMessage.h"
#include "Pipeline/PipelineTime.h"

#include "vtkCellArray.h"
#include "vtkCellData.h"
#include "vtkDataArray.h"
#include "vtkPoints.h"
#include "vtkPolyData.h"

namespace gridfem
{
namespace
{

std::array<vtkIdType, 3> CountsOf(vtkPolyData* data)
{
  return { data->GetNumberOfPoints(), data->GetNumberOfVerts(), data->GetNumberOfLines() };
}

vtkAbstractArray* GhostArrayOf(vtkPolyData* data)
{
  return data->GetCellData()->GetAbstractArray(vtkDataSetAttributes::GhostArrayName());
}

} // namespace

TrackedMesh::TrackedMesh() = default;
TrackedMesh::~TrackedMesh() = default;

void TrackedMesh::Refer(vtkPolyData* data, std::int64_t version)
{
  this->Stop();
  version_ = version;
  for (int kind = 0; kind < 2; ++kind)
  {
    vtkCellArray* given = kind == 0 ? data->GetPolys() : data->GetStrips();
    cells_[kind] = vtkSmartPointer<vtkCellArray>::New(); // later changes of the data stay out
    if (given && given->GetNumberOfCells() > 0)
    {
      cells_[kind]->ShallowCopy(given);
    }
  }
  ghosts_ = GhostArrayOf(data);
  counts_ = CountsOf(data);
  time_ = TimeOf(data);
}

bool TrackedMesh::HasCellsOf(vtkPolyData* data) const
{
  return counts_ == CountsOf(data) && HaveSameCells(cells_[0], data->GetPolys()) &&
         HaveSameCells(cells_[1], data->GetStrips()) &&
         HaveSameContents(ghosts_, GhostArrayOf(data));
}

bool TrackedMesh::Follow(vtkPolyData* data, const InputMesh& reference)
{
  if (!reference.triangles || !this->HasCellsOf(data))
  {
    this->Stop();
    return false;
  }
  std::vector<Vec3> points = ReadPointsLike(reference, data);
  if (points == reference.triangles->points)
  {
    this->Stop();
    return true;
  }
  if (metric_ && points == moved_.triangles->points)
  {
    return true;
  }
  const auto moved = std::make_shared<const TriangleMesh>(
    TriangleMesh{ std::move(points), reference.triangles->triangles });
  std::optional<TriangleMetric> metric = MetricOfMotion(*reference.triangles, *moved);
  this->Stop();
  if (metric)
  {
    moved_ = { moved, reference.sourceCell, reference.isWelded, reference.moved };
    metric_ = std::make_shared<const TriangleMetric>(std::move(*metric));
    ++motion_;
  }
  return metric_ != nullptr;
}

void TrackedMesh::Stop()
{
  moved_ = {};
  metric_.reset();
}

} // namespace gridfem
