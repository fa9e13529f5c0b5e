// The cycles that precondition an eigenproblem on all its levels, in the precision that it needs.
#ifndef GridFEM_SpectrumCycle_h
#define GridFEM_SpectrumCycle_h

#include "Krylov/WithFallback.h"
#include "Spaces/SpaceLevels.h"

#include <memory>

namespace gridfem
{

/// Cycles of L + σM. Single precision where patches are relaxed, as they are by default, and it
/// resolves the operator: it takes half of the time and memory, and the pairs that are found are
/// the same. Else double. The space has to outlive it.
class SpectrumCycle
{
public:
  SpectrumCycle(const SpaceLevels& space, double shift, const MultigridOptions& options,
    const Progress& progress = {});

  /// Of the hierarchy that begins at `level`. The one in double is built once, when it is first
  /// asked for, which must not be from several threads. This has to outlive what it gives.
  template<class Real>
  WithFallback<BlockPreconditioner<Real>> From(std::size_t level);

  /// Whether double was never needed.
  bool IsSingle() const { return !double_; }

private:
  void BuildDouble(const Progress& progress);

  const SpaceLevels& space_;
  double shift_;
  MultigridOptions options_;
  std::unique_ptr<BasicMultigrid<float>> single_;
  std::unique_ptr<Multigrid> double_;
};

} // namespace gridfem

#endif
