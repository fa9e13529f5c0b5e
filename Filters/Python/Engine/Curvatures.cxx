#include "Given.h"
#include "Problem.h"
#include "SolverProperties.h"

#include "Solvers/CurvatureSolver.h"

namespace gridfem
{
namespace
{

class CurvaturesProblem : public Problem
{
public:
  explicit CurvaturesProblem(Properties& properties)
  {
    TakeSurfaceOptions(properties, surface_);
    TakeOptions(properties, options_);
  }

  Results Solve(const Given& given, const Progress& progress) const override
  {
    CurvatureSolver::Result found =
      CurvatureSolver::Solve(given.mesh, options_, surface_, { 0, progress });
    Results results;
    for (std::size_t k = 0; k < CurvatureSolver::Numbers.size(); ++k)
    {
      results.arrays[CurvatureSolver::Numbers[k]] = found.numbers.col(static_cast<Id>(k));
    }
    results.arrays["MinimumCurvatureDirection"] = std::move(found.minimumDirection);
    results.arrays["MaximumCurvatureDirection"] = std::move(found.maximumDirection);
    results.Warn(found.warnings);
    return results;
  }

private:
  SurfaceOptions surface_ = CurvatureSolver::SurfaceDefaults();
  CurvatureSolver::Options options_;
};

} // namespace

std::unique_ptr<Problem> MakeCurvatures(Properties& properties)
{
  return std::make_unique<CurvaturesProblem>(properties);
}

} // namespace gridfem
