// The frame of a problem that one of Core's solvers solves.
#ifndef GridFEM_SolverProblem_h
#define GridFEM_SolverProblem_h

#include "Problem.h"
#include "SolverProperties.h"

namespace gridfem
{

/// Turns given arrays into the arrays of a solver's result.
template<class Solver>
using SolveGiven = Results(const Given& given, const SurfaceOptions& surface,
  const typename Solver::Options& options, const Job& job);

/// The least NormalStabilization.
template<class Solver>
inline constexpr double LeastStabilization = 1e-14;

/// Makes the problem. Its options are the given properties, or else the defaults.
template<class Solver, SolveGiven<Solver>* Solve>
Problem MakeSolverProblem(Properties& properties)
{
  SurfaceOptions surface = Solver::SurfaceDefaults();
  TakeSurfaceOptions(properties, surface, LeastStabilization<Solver>);
  typename Solver::Options options;
  TakeOptions(properties, options);
  return [surface, options](const Given& given, const Progress& progress) {
    return Solve(given, surface, options, { 0, progress });
  };
}

} // namespace gridfem

#endif
