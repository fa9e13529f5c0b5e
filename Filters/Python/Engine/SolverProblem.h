// The frame of a problem that one of Core's solvers solves.
#ifndef GridFEM_SolverProblem_h
#define GridFEM_SolverProblem_h

#include "Problem.h"
#include "SolverProperties.h"

namespace gridfem
{

/// Turns given arrays into the arrays of a solver's result.
template<class Solver>
using SolveGiven = Results (*)(const Given& given, const SurfaceOptions& surface,
  const typename Solver::Options& options, const Job& job);

template<class Solver>
class SolverProblem : public Problem
{
public:
  SolverProblem(Properties& properties, const SurfaceOptions& defaults,
    SolveGiven<Solver> solveGiven, double leastStabilization)
    : surface_(defaults), solveGiven_(solveGiven)
  {
    TakeSurfaceOptions(properties, surface_, leastStabilization);
    TakeOptions(properties, options_);
  }

  Results Solve(const Given& given, const Progress& progress) const override
  {
    return solveGiven_(given, surface_, options_, { 0, progress });
  }

private:
  SurfaceOptions surface_;
  typename Solver::Options options_;
  SolveGiven<Solver> solveGiven_;
};

/// Makes the problem. Its options are the given properties, or else the defaults.
template<class Solver>
std::unique_ptr<Problem> MakeSolverProblem(Properties& properties, const SurfaceOptions& defaults,
  SolveGiven<Solver> solveGiven, double leastStabilization = LeastStabilization)
{
  return std::make_unique<SolverProblem<Solver>>(
    properties, defaults, solveGiven, leastStabilization);
}

} // namespace gridfem

#endif
