// The filter Clip To Octree, from vtkPolyData to vtkPolyData, against the clip of Core: the cost of
// reading, checking and writing arrays of VTK.
#include "Grid/Clip.h"
#include "Measure.h"
#include "SetupCost.h"

#include "vtkCellArray.h"
#include "vtkClipToOctree.h"
#include "vtkNew.h"
#include "vtkPoints.h"
#include "vtkPolyData.h"
#include "vtkSmartPointer.h"

#include <algorithm>
#include <cstdio>
#include <limits>

namespace
{

using namespace gridfem;
using namespace gridfem::benchmarks;

constexpr int Repetitions = 5;
constexpr int Depth = 8;

/// Points in single precision, as readers of meshes give them; `mesh` gets the same places.
vtkSmartPointer<vtkPolyData> ToPolyData(TriangleMesh& mesh)
{
  vtkNew<vtkPoints> points;
  points->SetDataTypeToFloat();
  for (Vec3& point : mesh.points)
  {
    point = point.cast<float>().cast<double>();
    points->InsertNextPoint(point.data());
  }
  vtkNew<vtkCellArray> polys;
  for (const auto& triangle : mesh.triangles)
  {
    polys->InsertNextCell({ triangle[0], triangle[1], triangle[2] });
  }
  auto data = vtkSmartPointer<vtkPolyData>::New();
  data->SetPoints(points);
  data->SetPolys(polys);
  return data;
}

double CoreSeconds(const TriangleMesh& mesh)
{
  ClipOptions options;
  options.depth = Depth;
  const Stopwatch watch;
  const ClippedMesh clipped = Clip(mesh, options);
  return watch.Seconds();
}

double FilterSeconds(vtkPolyData* data, int level)
{
  vtkNew<vtkClipToOctree> filter; // a new one, so that nothing is kept from the last run
  filter->SetDepth(Depth);
  filter->SetLevel(level);
  filter->SetInputData(data);
  const Stopwatch watch;
  filter->Update();
  return watch.Seconds();
}

} // namespace

int main()
{
  NamedMesh surface = RockerArm(3);
  const auto data = ToPolyData(surface.mesh);
  double core = std::numeric_limits<double>::infinity();
  double filter = core;
  for (int k = 0; k < Repetitions; ++k)
  {
    core = std::min(core, CoreSeconds(surface.mesh));
    filter = std::min(filter, FilterSeconds(data, Depth));
  }
  std::printf("\nClip To Octree on %s, %zu vertices, depth %d; best of %d runs, all threads\n",
    surface.name.c_str(), surface.mesh.points.size(), Depth, Repetitions);
  const Table table({ "what", "s" });
  table.Row({ "core clip", Text("%.3f", core) });
  table.Row({ "filter, with its arrays", Text("%.3f", filter) });
  PrintAtMost("clip_to_octree_over_core", filter / core, 1.5);
}
