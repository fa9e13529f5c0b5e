// Time and memory of everything that comes before a solve, and the meshes it is measured on.
#ifndef GridFEM_Benchmarks_SetupCost_h
#define GridFEM_Benchmarks_SetupCost_h

#include "Grid/TriangleMesh.h"

#include <array>
#include <string>

namespace gridfem::benchmarks
{

struct NamedMesh
{
  std::string name;
  TriangleMesh mesh;
};

/// One of the real meshes, every triangle cut into four `subdivisions` times. Throws when it is
/// absent.
NamedMesh RealMesh(const std::string& name, const std::string& file, int subdivisions = 0);

/// The rocker arm (20,088 triangles), every triangle cut into four `subdivisions` times.
NamedMesh RockerArm(int subdivisions);

constexpr int SetupStages = 4;
constexpr std::array<const char*, SetupStages> SetupStageNames = { "Clip", "BuildFunctionSpace",
  "BuildLevelOperators", "BuildMultigrid" };

struct StageCost
{
  double seconds = 0.0;
  double held = 0.0; // growth in bytes from before the first stage to after this stage
  double peak = 0.0; // the same for the most there were during the stage
};

struct SetupCost
{
  std::array<StageCost, SetupStages> stages;
  double before = 0.0; // bytes in memory before the first stage: program and mesh
  double clippedTriangles = 0.0;
  double pieces = 0.0;
  double patches = 0.0;
  double functions = 0.0;

  double Seconds() const;
  double Peak() const; // the largest of the stages
};

/// Runs Clip, BuildFunctionSpace, BuildLevelOperators and BuildMultigrid with default options,
/// except for these. The memory is correct only directly after ReleaseFreeMemory. The time is
/// shorter without this call: memory that the system has to provide again took 0.4 of 2.5 s.
SetupCost MeasureSetup(const TriangleMesh& mesh, int depth, int threads);

} // namespace gridfem::benchmarks

#endif
