// What to tell a user of results that are not what was asked for: sentences, for whoever shows
// them.
#ifndef GridFEM_SolveWarnings_h
#define GridFEM_SolveWarnings_h

#include "Problems/GeodesicDistance.h"
#include "Problems/MeanCurvatureFlow.h"
#include "Problems/PartialField.h"
#include "Problems/PointConstraints.h"
#include "Problems/SolutionAccuracy.h"
#include "Problems/Spectrum.h"
#include "Spaces/FunctionKind.h"

#include <string>
#include <vector>

namespace gridfem
{

/// Why the iteration ended, in words.
const char* ReasonOf(const SolveReport& report);

/// The last iteration, or zeros when nothing had to be iterated.
IterationRecord LastRecord(const SolveReport& report);

/// Those that are not empty, with spaces between them.
std::string Joined(const std::vector<std::string>& sentences);

/// What to warn of when a solve has not converged to a tolerance.
std::string WarningOf(const SolveReport& report, double tolerance);

/// The same where a tolerance of 0 stands for an estimated error. Empty when it has converged.
std::string WarningOf(
  const SolveReport& report, const SolutionAccuracy& accuracy, double tolerance);

/// Where a problem was solved, for messages: "at Depth 6" or "with the hat functions of this mesh".
std::string PlaceOf(FunctionKind kind, int depth);

///@{ What to warn of when no depth gives the wanted error: of a solution, of eigenvalues.
std::string WarningOfWantedError(double wanted, double estimated, FunctionKind kind);
std::string WarningOfAccuracy(double wanted, double estimated, FunctionKind kind, int depth);
///@}

/// What to say when values are not met; empty when they are to 1e-3 of their range or of the
/// solution's size.
std::string WarningOfConstraints(const ConstrainedSolution& solution);

/// Of the screened Poisson equation with constraints: these two, and components that nothing holds.
std::vector<std::string> WarningsOf(const ConstrainedSolution& solution, double tolerance);

/// Of known values that do not count; empty when all do.
std::string WarningOf(const PartialField& field);

/// Of a spectrum that is short, has nothing but constants, is cut inside a group of equal
/// eigenvalues, or has not converged.
/// @param wanted  number of modes
/// @param where   in which space, as "at Depth 7"
/// @param tellOfGroup  false: not of a cut
std::vector<std::string> WarningsOf(
  const Spectrum& spectrum, int wanted, const std::string& where, bool tellOfGroup);

std::vector<std::string> WarningsOf(const DistanceField& field, double tolerance);

struct FlowSummary
{
  int steps = 0; // made
  int wanted = 0;
  FlowEnd end = FlowEnd::None; // why no more could be made
  int unconverged = 0;         // steps
};

/// Empty when all is well.
std::string WarningOf(const FlowSummary& flow, bool conformalized, const TriangleMesh& mesh);

} // namespace gridfem

#endif
