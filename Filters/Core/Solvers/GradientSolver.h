// Gradient and Laplacian of a field along a surface, and the parts of a vector field.
#ifndef GridFEM_GradientSolver_h
#define GridFEM_GradientSolver_h

#include "Shape/HodgeDecomposition.h"
#include "Shape/SurfaceDerivatives.h"
#include "Solvers/OptionFields.h"
#include "Solvers/SurfaceFields.h"

#include <memory>
#include <string>
#include <vector>

namespace gridfem
{

/// The stage that splits a vector field.
inline constexpr const char* HodgeStage = "HodgeDecomposition";

class GradientSolver
{
public:
  struct Options
  {
    EquationOptions equation = EndedByAccuracy();
    bool hodgeDecomposition = false; // of vectors; one process has to hold the surface

    template<class Self, class Visit>
    static void ForEach(Self& self, Visit&& visit)
    {
      visit(self.equation);
      visit("HodgeDecomposition", self.hodgeDecomposition, AnyValue());
    }
  };

  struct Input
  {
    GivenField values; // none: the coordinates
  };

  struct Derived
  {
    const char* name; // of the filter's array
    MultiVector atPoints;
    MultiVector onTriangles; // no columns: at points alone
  };

  struct Result
  {
    std::vector<Derived> derivatives; // Gradient, Laplacian; of given vectors Divergence, Curl
    std::vector<Derived> parts;       // only with hodgeDecomposition
    SolveReport report;               // of the solve with the most iterations
    SolutionAccuracy accuracy;        // of the worst solve
    std::vector<std::string> warnings;
  };

  /// The default options of the surface.
  static SurfaceOptions SurfaceDefaults() { return StabilizedSurface(); }

  /// Computes what has changed. Collective. Throws InvalidInput and Aborted.
  const Result& Update(
    Surface& surface, const Input& input, const Options& options, const Job& job);

  /// Runs all steps at once, on a mesh of this process.
  static Result Solve(std::shared_ptr<const TriangleMesh> mesh, const Input& input,
    const Options& options, const SurfaceOptions& surfaceOptions = SurfaceDefaults(),
    const Job& job = {});

private:
  /// The results of a stage besides its fields.
  struct Outcome
  {
    SolveReport report;
    SolutionAccuracy accuracy;
    std::string warning;
  };

  void Derive(const Surface& surface, const Input& input, const StageKey& key,
    const EquationOptions& equation, const Job& job);
  void Decompose(const Surface& surface, const Input& input, const StageKey& key,
    const EquationOptions& equation, const Job& job);

  std::vector<Derived> hiddenParts_; // while hodgeDecomposition is off
  Outcome ofDerivatives_;
  Outcome ofParts_;
  Result result_;
};

} // namespace gridfem

#endif
