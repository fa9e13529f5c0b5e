#include "Solvers/ParameterizationSolver.h"

#include "Shape/ChartLayout.h"
#include "Shape/DiskMap.h"
#include "Solvers/LocalSurface.h"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <utility>

namespace gridfem
{
namespace
{

using Chart = ParameterizationSolver::Chart;
using Flat = ParameterizationSolver::Flat;

/// Scales a map so that its area is that of the surface.
void KeepArea(const Disk& disk, const std::vector<SideLengths>& sides, MultiVector& plane)
{
  double area = 0.0;
  for (std::size_t t = 0; t < sides.size(); ++t)
  {
    area += disk.triangleOf[t] < 0 ? 0.0 : sides[t].Area();
  }
  const double flat = AreaInPlane(disk, plane);
  if (flat > 0.0)
  {
    plane *= std::sqrt(area / flat);
  }
}

MultiVector FlattenDisk(DiskMap& map, const Disk& disk, FlatMap kind, const Job& job)
{
  if (kind == FlatMap::Circle)
  {
    MultiVector plane = map.ToCircle(job);
    KeepArea(disk, map.Sides(), plane);
    return plane;
  }
  const bool isIsometric = kind == FlatMap::Isometric;
  MultiVector plane = map.Conformal(job.Part(0.0, isIsometric ? 0.2 : 1.0));
  KeepArea(disk, map.Sides(), plane);
  return isIsometric ? map.Isometric(std::move(plane), job.Part(0.2, 1.0)) : plane;
}

/// Notes a vertex for each point of the mesh, also for points that coincide. Returns whether a
/// point has several.
bool NoteVertices(
  const TriangleMesh& mesh, const Disk& disk, const std::vector<Id>& vertexOf, Flat& flat)
{
  bool hasSeveral = false;
  for (std::size_t t = 0; t < disk.triangles.size(); ++t)
  {
    for (int k = 0; k < 3 && disk.triangleOf[t] >= 0; ++k)
    {
      const int own = disk.isTurned[t] && k > 0 ? 3 - k : k;
      const Id vertex = vertexOf[disk.triangles[t][k]];
      Id& known = flat.vertexOf[mesh.triangles[disk.triangleOf[t]][own]];
      hasSeveral = hasSeveral || (known >= 0 && known != vertex);
      known = vertex;
    }
  }
  return hasSeveral;
}

/// Appends the triangles of a chart, and measures it.
void AddTriangles(const Disk& disk, const std::vector<SideLengths>& sides, const MultiVector& plane,
  const std::vector<Id>& vertexOf, Index number, Chart& chart, Flat& flat)
{
  const std::vector<ChartDistortion> distortions = MeasureDistortion(disk, sides, plane);
  double total = 0.0;
  for (std::size_t t = 0; t < disk.triangles.size(); ++t)
  {
    if (disk.triangleOf[t] < 0)
    {
      continue; // of a hole
    }
    const auto& c = disk.triangles[t];
    flat.triangles.push_back({ vertexOf[c[0]], vertexOf[c[1]], vertexOf[c[2]] });
    flat.triangleOf.push_back(disk.triangleOf[t]);
    flat.chart.push_back(number);
    const ChartDistortion& distortion = distortions[t];
    flat.angle.push_back(distortion.angle);
    flat.area.push_back(distortion.area);
    flat.isTurned.push_back(distortion.isTurned ? 1 : 0);
    const double area = sides[t].Area();
    chart.turned += distortion.isTurned ? 1 : 0;
    chart.angle += area * distortion.angle;
    chart.area += area * std::abs(distortion.area);
    total += area;
  }
  chart.angle /= total;
  chart.area /= total;
}

template<class Value>
void Reorder(const std::vector<std::size_t>& order, std::vector<Value>& values)
{
  std::vector<Value> sorted;
  sorted.reserve(order.size());
  for (const std::size_t k : order)
  {
    sorted.push_back(values[k]);
  }
  values = std::move(sorted);
}

std::vector<std::size_t> OrderOf(const std::vector<Id>& keys)
{
  std::vector<std::size_t> order(keys.size());
  std::iota(order.begin(), order.end(), 0);
  std::stable_sort(
    order.begin(), order.end(), [&](std::size_t a, std::size_t b) { return keys[a] < keys[b]; });
  return order;
}

/// Sorts triangles as in the mesh, and vertices by their points.
void SortLikeMesh(Flat& flat)
{
  const std::vector<std::size_t> triangles = OrderOf(flat.triangleOf);
  Reorder(triangles, flat.triangles);
  Reorder(triangles, flat.chart);
  Reorder(triangles, flat.angle);
  Reorder(triangles, flat.area);
  Reorder(triangles, flat.isTurned);
  Reorder(triangles, flat.triangleOf);
  const std::vector<std::size_t> vertices = OrderOf(flat.pointOf);
  Reorder(vertices, flat.pointOf);
  std::vector<Id> numberOf(vertices.size());
  MultiVector points(flat.points.rows(), 2);
  for (std::size_t k = 0; k < vertices.size(); ++k)
  {
    numberOf[vertices[k]] = static_cast<Id>(k);
    points.row(static_cast<Id>(k)) = flat.points.row(static_cast<Id>(vertices[k]));
  }
  flat.points = std::move(points);
  for (Id& vertex : flat.vertexOf)
  {
    vertex = vertex < 0 ? vertex : numberOf[vertex];
  }
  for (auto& corners : flat.triangles)
  {
    for (Id& corner : corners)
    {
      corner = numberOf[corner];
    }
  }
}

std::vector<std::string> WarningsOfTurned(const std::vector<Chart>& charts, Id triangles)
{
  Id turned = 0;
  for (const Chart& chart : charts)
  {
    turned += chart.turned;
  }
  if (turned == 0)
  {
    return {};
  }
  return { std::to_string(turned) + " of " + std::to_string(triangles) +
           " triangles are turned over in the flat map. Their Angle Distortion is 180. Extra Cuts "
           "toward thin parts, or the Map Type Circle, can avoid it." };
}

} // namespace

void ParameterizationSolver::Flatten(const TriangleMesh& mesh, FlatMap kind, const Job& job)
{
  result_ = {};
  Flat& flat = result_.flat;
  flat.vertexOf.assign(mesh.points.size(), -1);
  std::vector<MultiVector> planes;
  std::vector<std::vector<Id>> vertexOf;
  double done = 0.0;
  for (const Disk& disk : disks_)
  {
    constexpr double ShareOfMaps = 0.8; // of the time
    const double share = static_cast<double>(disk.triangles.size()) /
                         static_cast<double>(mesh.triangles.size()); // with those of filled holes
    const double next = std::min(done + ShareOfMaps * share, ShareOfMaps);
    DiskMap map(disk);
    planes.push_back(FlattenDisk(map, disk, kind, job.Part(done, next)));
    done = next;
    vertexOf.emplace_back(disk.points.size(), -1);
    for (std::size_t v = 0; v < disk.points.size(); ++v)
    {
      if (disk.pointOf[v] >= 0)
      {
        vertexOf.back()[v] = static_cast<Id>(flat.pointOf.size());
        flat.pointOf.push_back(disk.pointOf[v]);
      }
    }
    result_.splitsPoints = NoteVertices(mesh, disk, vertexOf.back(), flat) || result_.splitsPoints;
    Chart chart;
    chart.topology = disk.topology;
    AddTriangles(disk, map.Sides(), planes.back(), vertexOf.back(),
      static_cast<Index>(result_.charts.size()), chart, flat);
    result_.charts.push_back(chart);
  }
  job.Check(0.85);
  ArrangeCharts(planes);
  flat.points.resize(static_cast<Id>(flat.pointOf.size()), 2);
  for (std::size_t k = 0; k < planes.size(); ++k)
  {
    for (std::size_t v = 0; v < vertexOf[k].size(); ++v)
    {
      if (vertexOf[k][v] >= 0)
      {
        flat.points.row(vertexOf[k][v]) = planes[k].row(static_cast<Id>(v));
      }
    }
  }
  job.Check(0.9);
  SortLikeMesh(flat);
  flat.texture = flat.points / flat.points.maxCoeff();
  result_.warnings = WarningsOfTurned(result_.charts, static_cast<Id>(flat.triangles.size()));
}

const ParameterizationSolver::Result& ParameterizationSolver::Update(
  Surface& surface, const Options& options, const Job& job)
{
  RequireOptions(options);
  surface.PrepareMesh(job.progress.Part(0.0, 0.1));
  Stages& stages = surface.GetStages();
  OpeningOptions opening;
  opening.holeSize = options.holeSize;
  opening.extraCuts = options.extraCuts;
  opening.weldCoincidentPoints = surface.UsedOptions().space.weldCoincidentPoints;
  const Job work = surface.MakeJob(job.progress);
  StageKey key;
  key.Add(stages.Version(MeshStage)).Add(opening.weldCoincidentPoints);
  key.Add(opening.holeSize).Add(opening.extraCuts);
  stages.Run(
    OpenStage, key, [&] { disks_ = OpenToDisks(surface.Mesh(), opening, work.Part(0.1, 0.2)); });
  key = {};
  key.Add(stages.Version(OpenStage)).Add(options.mapType);
  stages.Run(SolveStage, key,
    [&]
    { this->Flatten(surface.Mesh(), static_cast<FlatMap>(options.mapType), work.Part(0.2, 1.0)); });
  job.Check(1.0);
  return result_;
}

ParameterizationSolver::Result ParameterizationSolver::Solve(
  std::shared_ptr<const TriangleMesh> mesh, const Options& options,
  const SurfaceOptions& surfaceOptions, const Job& job)
{
  Stages stages;
  LocalSurface surface(stages, std::move(mesh), surfaceOptions);
  ParameterizationSolver solver;
  solver.Update(surface, options, job);
  return std::move(solver.result_);
}

} // namespace gridfem
