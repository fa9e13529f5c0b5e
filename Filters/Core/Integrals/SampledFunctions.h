// The functions at samples that represent the whole surface. Terms that depend on a solution, such
// as reactions, are computed at the samples.
#ifndef GridFEM_SampledFunctions_h
#define GridFEM_SampledFunctions_h

#include "Algebra/SparseMatrix.h"
#include "Base/Job.h"
#include "Grid/GridFunctions.h"
#include "Integrals/QuadratureRule.h"

namespace gridfem
{

/// Two sparse products replace evaluation and integration, which visit all triangles.
struct SampledFunctions
{
  SparseMatrix values;    // of all functions: rows = samples
  SparseMatrix integrals; // turns numbers f at the samples into ∫ f b_i: rows = functions
};

/// Returns up to eight samples per patch: one in each octant of its cell that the surface meets.
/// A sample is at the center of the surface in the octant and has its area, however fine or coarse
/// the triangles are. Constants are integrated exactly, other fields to second order. Same bits for
/// any number of threads. Throws Aborted.
/// @param level   functions on the finest patches of the space
/// @param weight  of the area of each source triangle; null: 1
template<int Functions>
SampledFunctions SampleFunctions(const GridFunctions& space,
  const BasicPatchLevel<Functions>& level, const QuadratureRule& rule, const Job& job = {},
  const std::vector<double>* weight = nullptr);

} // namespace gridfem

#endif
