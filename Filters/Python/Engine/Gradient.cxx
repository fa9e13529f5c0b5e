#include "Given.h"
#include "Problem.h"
#include "SolverProperties.h"

#include "Solvers/GradientSolver.h"

namespace gridfem
{
namespace
{

class GradientProblem : public Problem
{
public:
  explicit GradientProblem(Properties& properties)
  {
    TakeSurfaceOptions(properties, surface_);
    TakeOptions(properties, options_);
  }

  Results Solve(const Given& given, const Progress& progress) const override
  {
    GradientSolver::Result found = GradientSolver::Solve(
      given.mesh, { given.Field("values") }, options_, surface_, { 0, progress });
    Results results;
    for (std::vector<GradientSolver::Derived>* fields : { &found.derivatives, &found.parts })
    {
      for (GradientSolver::Derived& field : *fields)
      {
        results.arrays[field.name] = std::move(field.atPoints);
      }
    }
    results.Warn(found.warnings);
    return results;
  }

private:
  SurfaceOptions surface_ = GradientSolver::SurfaceDefaults();
  GradientSolver::Options options_;
};

} // namespace

std::unique_ptr<Problem> MakeGradient(Properties& properties)
{
  return std::make_unique<GradientProblem>(properties);
}

} // namespace gridfem
