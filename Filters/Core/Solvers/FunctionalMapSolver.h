// Finds the place on a reference surface that corresponds to each point of a surface.
#ifndef GridFEM_FunctionalMapSolver_h
#define GridFEM_FunctionalMapSolver_h

#include "Base/Errors.h"
#include "Solvers/SurfaceModes.h"
#include "Spectrum/FunctionalMap.h"

#include <memory>
#include <string>
#include <vector>

namespace gridfem
{

/// Maps a surface to a reference by the modes of both (FindFunctionalMap). Both surfaces have one
/// connected component and about the same shape, up to bending. One process has to hold them.
class FunctionalMapSolver
{
public:
  static SurfaceOptions SurfaceDefaults() { return SpectrumSolver::SurfaceDefaults(); }

  struct Options
  {
    EquationOptions equation = EquationOfModes();
    int numberOfModes = 100;

    template<class Self, class Visit>
    static void ForEach(Self& self, Visit&& visit)
    {
      visit(self.equation);
      visit("NumberOfModes", self.numberOfModes, Within(FewestModesOfMap, 100000));
    }
  };

  struct Input
  {
    GivenModes modes;          // of the surface; none: they are computed
    GivenModes referenceModes; // of the reference
    std::vector<Landmark> landmarks;
    SpectrumSolver::Announcement announce;
  };

  struct Result
  {
    FunctionalMap map;
    bool isConverged = true;
    std::string where; // the device of the cycles; empty if modes are given
    std::vector<std::string> warnings;
  };

  /// Runs a body, and names the reference in its errors.
  template<class Body>
  static void OfReference(Body&& body)
  {
    try
    {
      body();
    }
    catch (const InvalidInput& error)
    {
      throw InvalidInput("Reference: " + std::string(error.what()));
    }
  }

  /// Computes the map. Surfaces with given modes need no preparation. Each surface has stages of
  /// its own. Throws InvalidInput, also if a surface has several components, and Aborted.
  const Result& Update(Surface& surface, Surface& reference, const Input& input,
    const Options& options, const Job& job);

  /// Does the same once for two meshes with the same options.
  static Result Solve(std::shared_ptr<const TriangleMesh> mesh,
    std::shared_ptr<const TriangleMesh> reference, const Input& input, const Options& options,
    const SurfaceOptions& surfaceOptions = SurfaceDefaults(), const Job& job = {});

private:
  void FindMap(const Input& input, const Job& job);
  void Judge();

  SurfaceModes modes_;
  SurfaceModes ofReference_;
  Result result_;
};

} // namespace gridfem

#endif
