// Random problems on random surfaces, and the requirements on their results.
#ifndef GridFEM_Testing_RandomProblem_h
#define GridFEM_Testing_RandomProblem_h

#include "Defects.h"
#include "Outcome.h"
#include "RandomSurface.h"

namespace gridfem::testing
{

/// Runs the case of a seed. Exceptions of Core other than InvalidInput count as broken.
Outcome RunCase(std::uint64_t seed);

/// Runs a case of another series: a solver on a surface with defects and on the clean surface.
Outcome RunDefectCase(std::uint64_t seed);

///@{ Each adds violated requirements to the outcome, and may throw any exception of Core.
using RandomProblem = void (*)(Choice& choice, RandomSurface& surface, Outcome& outcome);

// Meshes, levels and matrices.
void CheckClip(Choice& choice, RandomSurface& surface, Outcome& outcome);
void CheckSpaces(Choice& choice, RandomSurface& surface, Outcome& outcome);
void CheckMetric(Choice& choice, RandomSurface& surface, Outcome& outcome);

// Equations.
void SolveDefaultPoisson(Choice& choice, RandomSurface& surface, Outcome& outcome);
void SolveAnyPoisson(Choice& choice, RandomSurface& surface, Outcome& outcome);
void SolveWithConstraints(Choice& choice, RandomSurface& surface, Outcome& outcome);
void FindSpectrum(Choice& choice, RandomSurface& surface, Outcome& outcome);
void FindDistance(Choice& choice, RandomSurface& surface, Outcome& outcome);
void Diffuse(Choice& choice, RandomSurface& surface, Outcome& outcome);
void Interpolate(Choice& choice, RandomSurface& surface, Outcome& outcome);

// Shapes and fields.
void Stitch(Choice& choice, RandomSurface& surface, Outcome& outcome);
void Flow(Choice& choice, RandomSurface& surface, Outcome& outcome);
void ChangeDetail(Choice& choice, RandomSurface& surface, Outcome& outcome);
void FindCurvatures(Choice& choice, RandomSurface& surface, Outcome& outcome);
void Decompose(Choice& choice, RandomSurface& surface, Outcome& outcome);
void Derive(Choice& choice, RandomSurface& surface, Outcome& outcome);
///@}

/// Requires that a random solver has the same results on a clean surface and on the same surface
/// with defects.
void CompareWithClean(Choice& choice, const Defects& defects, Outcome& outcome);

} // namespace gridfem::testing

#endif
