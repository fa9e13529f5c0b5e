// Flattens a surface: maps it to the plane, for textures and as a map.
#ifndef GridFEM_ParameterizationSolver_h
#define GridFEM_ParameterizationSolver_h

#include "Shape/OpenedSurface.h"
#include "Solvers/OptionFields.h"
#include "Solvers/Surface.h"

#include <memory>
#include <string>
#include <vector>

namespace gridfem
{

/// What a flat map keeps.
enum class MapType
{
  Conformal, // keeps angles
  Isometric, // changes lengths as little as possible
  Circle     // onto a disk, without folds
};

/// Maps every connected component to the plane. A component that is not a disk is opened first (see
/// OpenToDisks). The maps are those of DiskMap and IsometricMap. One process has to hold the
/// surface.
class ParameterizationSolver
{
public:
  static constexpr const char* OpenStage = "Open";

  struct Options
  {
    MapType mapType = MapType::Conformal;
    double holeSize = 0.5; // see OpeningOptions
    int extraCuts = 0;

    template<class Self, class Visit>
    static void ForEach(Self& self, Visit&& visit)
    {
      visit("MapType", self.mapType, Within(0, static_cast<double>(MapType::Circle)));
      visit("HoleSize", self.holeSize, Within(0.0, 1.0));
      visit("ExtraCuts", self.extraCuts, Within(0, 100));
    }
  };

  /// What is known about a flattened component.
  struct Chart
  {
    Topology topology;  // before it was opened
    Id flipped = 0;     // triangles that the map turns over
    double angle = 0.0; // mean of the angle distortion over the area, degrees
    double area = 0.0;  // mean absolute area distortion over the area
    bool hasConverged = true;
    int steps = 0;     // of an isometric map
    double gain = 0.0; // see PlaneMap
  };

  /// The flat surface. Its vertices are in the order of their points. Cuts run between vertices of
  /// one point.
  struct Flat
  {
    MultiVector points;       // two world coordinates for each vertex; charts lie side by side
    MultiVector texture;      // the same in the unit square
    std::vector<Id> vertexOf; // a vertex of each point of the mesh; -1: none
    std::vector<Id> pointOf;  // point of the mesh
    std::vector<std::array<Id, 3>> triangles; // face up, unless flipped
    std::vector<Id> triangleOf;               // ascending: triangle of the mesh
    std::vector<Index> chart;                 // of each triangle
    std::vector<double> angle;                // ChartDistortion, per triangle
    std::vector<double> area;
  };

  struct Result
  {
    Flat flat;
    std::vector<Chart> charts; // in the order of their first triangles
    bool splitsPoints = false; // a point of the mesh has several vertices
    std::vector<std::string> warnings;
  };

  static SurfaceOptions SurfaceDefaults() { return {}; }

  /// Throws InvalidInput and Aborted.
  const Result& Update(Surface& surface, const Options& options, const Job& job = {});

  static Result Solve(std::shared_ptr<const TriangleMesh> mesh, const Options& options,
    const SurfaceOptions& surfaceOptions = SurfaceDefaults(), const Job& job = {});

private:
  void Flatten(const Surface& surface, MapType type, const Job& job);

  std::vector<Disk> disks_;
  Result result_;
};

} // namespace gridfem

#endif
