// The modes of a surface at its points: those that come with the mesh, or those of SpectrumSolver.
#ifndef GridFEM_SurfaceModes_h
#define GridFEM_SurfaceModes_h

#include "Solvers/SpectrumSolver.h"
#include "Spectrum/SpectralDescriptors.h"

#include <memory>
#include <string>
#include <vector>

namespace gridfem
{

/// Modes on the points of a mesh, or none.
struct GivenModes
{
  explicit operator bool() const { return modes != nullptr; }

  std::shared_ptr<const TriangleMesh> mesh; // of this process
  std::shared_ptr<const PointModes> modes;
  StageKey version; // another one for each content
};

/// The stage that finds the modes at the points.
constexpr const char* ModesStage = "Modes";

class SurfaceModes
{
public:
  /// Takes the given modes, or computes modes: the last group of equal eigenvalues is complete.
  /// Given modes need no preparation of the surface. Collective. Throws InvalidInput and Aborted.
  void Update(Surface& surface, const GivenModes& given, const SpectrumSolver::Options& options,
    const SpectrumSolver::Announcement& announce, const Progress& progress);

  const PointModes& Modes() const { return *modes_; }
  const std::shared_ptr<const PointModes>& SharedModes() const { return modes_; }

  /// The mesh of the points: that of given modes, or that of the surface.
  const TriangleMesh& Mesh() const { return *mesh_; }

  /// A flag for each point: the modes have a value there. Modes are 0 elsewhere.
  const std::vector<char>& IsReached() const { return isReached_; }

  /// How many modes are constants, one for each component. 0 if they are 0 on a boundary.
  Index NumberOfConstants() const { return constants_; }

  /// Throws InvalidInput if all computed modes are constants and more modes exist. The message says
  /// how many modes it takes.
  void RequireNonConstant() const;

  ///@{ Of the computation; as after a good one if modes are given.
  bool IsConverged() const { return isConverged_; }
  const std::string& Device() const { return device_; } // empty if modes are given
  const std::vector<std::string>& Warnings() const { return warnings_; }
  ///@}

private:
  void Compute(Surface& surface, const SpectrumSolver::Options& options,
    const SpectrumSolver::Announcement& announce, const Progress& progress);

  SpectrumSolver spectrum_;
  std::shared_ptr<const PointModes> modes_;
  std::shared_ptr<const TriangleMesh> mesh_;
  std::vector<char> isReached_;
  Index constants_ = 0;
  bool areAllConstants_ = false; // and more modes exist
  bool isConverged_ = true;
  std::string device_;
  std::vector<std::string> warnings_;
};

/// The progress of work that each process does on its own points. On a shared surface it is silent,
/// because all processes report together.
Progress OfOwnPoints(const Surface& surface, const Progress& progress);

} // namespace gridfem

#endif
