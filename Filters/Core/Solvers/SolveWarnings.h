// Sentences that tell a user how a result differs from the request. Callers decide how to show
// them.
#ifndef GridFEM_SolveWarnings_h
#define GridFEM_SolveWarnings_h

#include "Distance/GeodesicDistance.h"
#include "Equations/PartialField.h"
#include "Equations/PointConstraints.h"
#include "Equations/SolutionAccuracy.h"
#include "Shape/MeanCurvatureFlow.h"
#include "Spaces/FunctionKind.h"
#include "Spectrum/Spectrum.h"

#include <string>
#include <vector>

namespace gridfem
{

/// The reason why the iteration ended, in words.
const char* ReasonOf(const SolveReport& report);

/// The last iteration, or zeros if nothing had to be iterated.
IterationRecord LastRecord(const SolveReport& report);

/// The sentences that are not empty, with spaces between them.
std::string Joined(const std::vector<std::string>& sentences);

/// The sentences that are not empty.
std::vector<std::string> NotEmpty(std::vector<std::string> sentences);

/// The warning when a solve has not converged to a tolerance.
std::string WarningOf(const SolveReport& report, double tolerance);

/// The same if a tolerance of 0 stands for an estimated error. Empty when it has converged.
std::string WarningOf(
  const SolveReport& report, const SolutionAccuracy& accuracy, double tolerance);

/// The space of a solve, for messages: "at Depth 6" or "with the hat functions of this mesh".
std::string PlaceOf(FunctionKind kind, int depth);

///@{ The warnings when no depth gives the wanted error: of a solution, of eigenvalues.
std::string WarningOfWantedError(double wanted, double estimated, FunctionKind kind);
std::string WarningOfAccuracy(double wanted, double estimated, FunctionKind kind, int depth);
///@}

/// The warning when values are not met. Empty if they are met to 1e-3 of their range or of the
/// solution's size.
std::string WarningOfConstraints(const ConstrainedSolution& solution);

/// The warnings of the screened Poisson equation with constraints: the two above, and one about
/// components that nothing holds.
std::vector<std::string> WarningsOf(const ConstrainedSolution& solution, double tolerance);

/// The warning about known values without effect; empty if all have an effect.
std::string WarningOf(const PartialField& field);

/// The warnings about a spectrum that is too short, has only constants, or has not converged.
/// @param wanted  number of modes
/// @param where   the space, as in "at Depth 7"
std::vector<std::string> WarningsOf(const Spectrum& spectrum, int wanted, const std::string& where);

std::vector<std::string> WarningsOf(const DistanceField& field, double tolerance);

struct FlowSummary
{
  int steps = 0; // steps that were made
  int wanted = 0;
  FlowEnd end = FlowEnd::None; // why no more steps could be made
  int unconverged = 0;         // number of steps that have not converged
};

/// The warnings about a flow. Empty when all is well.
std::string WarningOf(const FlowSummary& flow, bool conformalized, const TriangleMesh& mesh);

} // namespace gridfem

#endif
