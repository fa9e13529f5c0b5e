// The cycles that precondition an eigenproblem on all its levels, in the necessary precision.
#ifndef GridFEM_SpectrumCycle_h
#define GridFEM_SpectrumCycle_h

#include "Krylov/WithFallback.h"
#include "Spaces/SpaceLevels.h"

#include <memory>
#include <string>

namespace gridfem
{

/// Cycles of L + σM. They are in single precision if patches are relaxed, which is the default, and
/// if single precision resolves the operator. This takes half of the time and memory and finds the
/// same pairs. Otherwise they are in double precision. The space has to outlive the cycles.
class SpectrumCycle
{
public:
  SpectrumCycle(const SpaceLevels& space, double shift, const MultigridOptions& options,
    const Progress& progress = {});

  /// The preconditioner of the hierarchy that begins at `level`. The one in double precision is
  /// built once, at its first use, which must not be from several threads. This object has to
  /// outlive the preconditioner.
  template<class Real>
  WithFallback<BlockPreconditioner<Real>> From(std::size_t level);

  /// Whether double precision was never needed.
  bool IsSingle() const { return !double_; }

  /// Where the last cycles ran; see Multigrid::Where.
  std::string Where() const;

private:
  MultigridOptions InDouble() const;
  void BuildDouble(const Progress& progress);

  const SpaceLevels& space_;
  double shift_;
  MultigridOptions options_;
  std::unique_ptr<BasicMultigrid<float>> single_;
  std::unique_ptr<Multigrid> double_;
};

} // namespace gridfem

#endif
