// Reads formulas of reactions, and computes them at many places.
#ifndef GridFEM_ReactionFormulas_h
#define GridFEM_ReactionFormulas_h

#include "Solvers/DynamicsSolver.h"

#include <string>

namespace gridfem
{

/// Returns the reactions of two species by formulas of u and v, or of one species by a formula of u
/// if the second formula is blank. Returns none if the first one is blank. Rates are NaN where a
/// formula is undefined. Throws InvalidInput for a formula that cannot be read.
GivenReactions ReactionsOfFormulas(const std::string& ofU, const std::string& ofV);

} // namespace gridfem

#endif
