// Computes the principal curvatures of a surface and the numbers that follow from them, with or
// without smoothing.
#ifndef GridFEM_CurvatureSolver_h
#define GridFEM_CurvatureSolver_h

#include "Shape/PrincipalCurvatures.h"
#include "Solvers/OptionFields.h"
#include "Solvers/Surface.h"

#include <array>
#include <memory>
#include <string>
#include <vector>

namespace gridfem
{

/// Computes the principal curvatures of a surface from start to end, as one part of a solver.
/// @param surface  has an up-to-date mesh; with smoothing also functions, which one process holds
/// @param smoothingScale  length in parameter units; 0: the normals are not smoothed
/// @param report   describes the smoothing
PrincipalCurvatures CurvaturesOf(const Surface& surface, double smoothingScale,
  const EquationOptions& equation, CurvatureReport& report, const Job& job);

class CurvatureSolver
{
public:
  struct Options
  {
    EquationOptions equation = EndedByTolerance(1e-4);
    double smoothingScale = 0.0; // of the normals: length in parameter units; 0: none

    template<class Self, class Visit>
    static void ForEach(Self& self, Visit&& visit)
    {
      visit(self.equation);
      visit("SmoothingScale", self.smoothingScale, AtLeast(0.0));
    }
  };

  /// Names of the columns of Result::numbers.
  static constexpr std::array<const char*, 6> Numbers = { "MinimumCurvature", "MaximumCurvature",
    "MeanCurvature", "GaussianCurvature", "ShapeIndex", "Bending" };

  struct Result
  {
    MultiVector numbers; // per point; units of PrincipalCurvatures, ShapeIndex and BendingOf
    MultiVector minimumDirection; // points x 3, unit vectors
    MultiVector maximumDirection;
    bool isSmoothed = false;
    SolveReport report; // of the smoothing
    Id turned = 0;      // triangles that faced against their component and count as turned round
    std::vector<std::string> warnings;
  };

  /// The default options of the surface.
  static SurfaceOptions SurfaceDefaults() { return StabilizedSurface(); }

  /// Fits again if the mesh or a relevant option has changed. Without smoothing, the surface makes
  /// no functions. Throws InvalidInput and Aborted.
  const Result& Update(Surface& surface, const Options& options, const Job& job);

  /// Runs all steps at once, on a mesh of this process.
  static Result Solve(std::shared_ptr<const TriangleMesh> mesh, const Options& options,
    const SurfaceOptions& surfaceOptions = SurfaceDefaults(), const Job& job = {});

private:
  void Fit(const Surface& surface, const Options& options, const Job& job);

  Result result_;
};

} // namespace gridfem

#endif
