// Applies the preconditioner of a block iteration, which takes rows from a source, to a stored
// block.
#ifndef GridFEM_Testing_ApplyRows_h
#define GridFEM_Testing_ApplyRows_h

#include "Multigrid/BlockPreconditioner.h"

namespace gridfem::testing
{

/// z = B r, with all corrections wanted.
template<class Real>
ResidualMeasures Apply(
  const BlockPreconditioner<Real>& precondition, const Vectors<Real>& r, Vectors<Real>& z)
{
  z.resize(r.rows(), r.cols());
  const RowSource<Real> source{ r.rows(), r.cols(),
    [&r](Id begin, Id end, Block<Real> part) { part = r.middleRows(begin, end - begin); } };
  return precondition(
    source, [](const ResidualMeasures&) { return true; },
    [&z](Id begin, Id end, const ConstBlock<Real>& part)
    { z.middleRows(begin, end - begin) = part; });
}

} // namespace gridfem::testing

#endif
