// Chooses the equation of a model, and the length of its steps.
#ifndef GridFEM_DynamicsEquation_h
#define GridFEM_DynamicsEquation_h

#include "Equations/Evolution.h"
#include "Equations/Reactions.h"
#include "Solvers/DynamicsSolver.h"

#include <memory>

namespace gridfem
{

inline bool IsReaction(DynamicsModel model)
{
  return model != DynamicsModel::Wave && model != DynamicsModel::Transport;
}

/// The reactions of a model that has some. The given ones are those of Custom.
ReactionSystem SystemOf(const DynamicsSolver::Options& options, const GivenReactions& reactions);

/// The columns of a state.
Id NumberOfUnknowns(const DynamicsSolver::Options& options, const GivenReactions& reactions);

/// Functions per pattern length that resolve a result.
double FunctionsOfPattern(const DynamicsSolver::Options& options, const GivenReactions& reactions);

struct MadeEquation
{
  std::unique_ptr<Evolution> equation;
  double frame;
  int substeps; // from frame to frame, so that reactions and transport are resolved
};

/// @param refinement  makes this many steps of one usual step; >= 1
/// Throws InvalidInput and Aborted.
MadeEquation MakeEquation(const Surface& surface, const DynamicsSolver::Input& input,
  const DynamicsSolver::Options& options, int refinement, const Job& job);

} // namespace gridfem

#endif
