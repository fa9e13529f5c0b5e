#include "Solvers/ParameterizationSolver.h"

#include "Shape/ChartLayout.h"
#include "Shape/DiskMap.h"
#include "Shape/IsometricMap.h"
#include "Solvers/SolveOnMesh.h"

#include <algorithm>
#include <cmath>
#include <iomanip>
#include <numeric>
#include <sstream>
#include <utility>

namespace gridfem
{
namespace
{

using Chart = ParameterizationSolver::Chart;
using Flat = ParameterizationSolver::Flat;

PlaneMap FlattenDisk(DiskMap& map, const Disk& disk, MapType type, const Job& job)
{
  if (type == MapType::Circle)
  {
    return { map.ToCircle(job) };
  }
  if (type == MapType::Conformal)
  {
    return { map.Conformal(job) };
  }
  MultiVector start = map.Conformal(job.Part(0.0, 0.1));
  if (map.HasFlipped(start))
  {
    MultiVector circle = map.ToCircle(job.Part(0.1, 0.2));
    start = map.HasFlipped(circle) ? std::move(start) : std::move(circle);
  }
  return MapIsometrically(disk, map.Sides(), std::move(start), job.Part(0.2, 1.0));
}

/// Adds the vertices of a disk that are points of the mesh. Returns their numbers, -1 at others.
std::vector<Id> AddVertices(const Disk& disk, Flat& flat)
{
  std::vector<Id> vertexOf(disk.points.size(), -1);
  for (std::size_t v = 0; v < disk.points.size(); ++v)
  {
    if (disk.pointOf[v] >= 0)
    {
      vertexOf[v] = static_cast<Id>(flat.pointOf.size());
      flat.pointOf.push_back(disk.pointOf[v]);
    }
  }
  return vertexOf;
}

/// Places the vertices of all disks as their maps do.
void PlaceVertices(
  const std::vector<MultiVector>& planes, const std::vector<std::vector<Id>>& vertexOf, Flat& flat)
{
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

/// Gives points without a vertex the vertex at their place. Triangles that are left out have such
/// points. Returns whether such a place has several vertices.
bool NoteVerticesAtPlaces(const TriangleMesh& mesh, int threads, Flat& flat)
{
  const std::vector<char> isUsed = UsedPoints(mesh, threads);
  bool lacksVertex = false;
  for (std::size_t point = 0; point < isUsed.size(); ++point)
  {
    lacksVertex = lacksVertex || (isUsed[point] && flat.vertexOf[point] < 0);
  }
  if (!lacksVertex)
  {
    return false;
  }
  const Array<Index> place = WeldCoincidentPoints(mesh.points, isUsed, threads);
  std::vector<Id> vertexAt(mesh.points.size(), -1);
  std::vector<char> hasSeveral(mesh.points.size(), 0);
  for (std::size_t point = 0; point < isUsed.size(); ++point)
  {
    if (flat.vertexOf[point] >= 0)
    {
      Id& known = vertexAt[place[point]];
      hasSeveral[place[point]] |= known >= 0 && known != flat.vertexOf[point] ? 1 : 0;
      known = flat.vertexOf[point];
    }
  }
  bool isUncertain = false;
  for (std::size_t point = 0; point < isUsed.size(); ++point)
  {
    if (isUsed[point] && flat.vertexOf[point] < 0)
    {
      flat.vertexOf[point] = vertexAt[place[point]];
      isUncertain = isUncertain || hasSeveral[place[point]];
    }
  }
  return isUncertain;
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
    const double area = sides[t].Area();
    chart.flipped += distortion.isFlipped ? 1 : 0;
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

std::vector<std::string> WarningsOf(const std::vector<Chart>& charts, Id triangles)
{
  Id flipped = 0;
  Id unsettled = 0;
  int steps = 0;
  double gain = 0.0;
  for (const Chart& chart : charts)
  {
    flipped += chart.flipped;
    unsettled += chart.hasConverged ? 0 : 1;
    steps = chart.hasConverged ? steps : std::max(steps, chart.steps);
    gain = chart.hasConverged || std::isnan(chart.gain) ? gain : std::max(gain, chart.gain);
  }
  std::vector<std::string> warnings;
  if (unsettled > 0)
  {
    std::ostringstream text;
    text << std::setprecision(2) << "The isometric map of " << unsettled << " of " << charts.size()
         << " charts has not converged after " << steps << " steps. ";
    if (gain > 0.0)
    {
      text << "Another step would lower its energy by " << 100.0 * gain << " %. ";
    }
    text << "The result is kept. Raise Extra Cuts.";
    warnings.push_back(text.str());
  }
  if (flipped > 0)
  {
    warnings.push_back(
      std::to_string(flipped) + " of " + std::to_string(triangles) +
      " triangles are flipped in the flat map. Their Angle Distortion is 180. Raise Extra Cuts, or "
      "set Map Type to Circle.");
  }
  return warnings;
}

} // namespace

void ParameterizationSolver::Flatten(const Surface& surface, MapType type, const Job& job)
{
  const TriangleMesh& mesh = surface.Mesh();
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
    PlaneMap plane = FlattenDisk(map, disk, type, job.Part(done, next));
    done = next;
    vertexOf.push_back(AddVertices(disk, flat));
    result_.splitsPoints = NoteVertices(mesh, disk, vertexOf.back(), flat) || result_.splitsPoints;
    Chart chart;
    chart.topology = disk.topology;
    chart.hasConverged = plane.hasConverged;
    chart.steps = plane.steps;
    chart.gain = plane.gain;
    AddTriangles(disk, map.Sides(), plane.plane, vertexOf.back(),
      static_cast<Index>(result_.charts.size()), chart, flat);
    result_.charts.push_back(chart);
    planes.push_back(std::move(plane.plane));
  }
  if (surface.UsedOptions().space.weldCoincidentPoints)
  {
    result_.splitsPoints = NoteVerticesAtPlaces(mesh, job.threads, flat) || result_.splitsPoints;
  }
  job.Check(0.85);
  ArrangeCharts(planes);
  PlaceVertices(planes, vertexOf, flat);
  job.Check(0.9);
  SortLikeMesh(flat);
  flat.texture = flat.points / flat.points.maxCoeff();
  result_.warnings = WarningsOf(result_.charts, static_cast<Id>(flat.triangles.size()));
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
  key.Add(stages.Version(OpenStage)).Add(static_cast<int>(options.mapType));
  stages.Run(
    SolveStage, key, [&] { this->Flatten(surface, options.mapType, work.Part(0.2, 1.0)); });
  job.Check(1.0);
  return result_;
}

ParameterizationSolver::Result ParameterizationSolver::Solve(
  std::shared_ptr<const TriangleMesh> mesh, const Options& options,
  const SurfaceOptions& surfaceOptions, const Job& job)
{
  return SolveOnMesh(
    &ParameterizationSolver::result_, std::move(mesh), surfaceOptions, job, options);
}

} // namespace gridfem
