// Connected components of a surface on several ranks, and the means of functions on each.
#ifndef GridFEM_RankComponents_h
#define GridFEM_RankComponents_h

#include "Parallel/RankMatrices.h"

#include <vector>

namespace gridfem
{

/// Blocks here have a row per function that this rank owns, means one per component of the whole.
/// As ComponentMeans, whose words hold here, too. All functions are collective.
class RankComponents
{
public:
  /// @param level     the patches of this rank's cells, functions as in the numbering
  /// @param integral  what this rank's patches add to ∫ b_i
  RankComponents(const Communicator& ranks, const LevelNumbering& numbering,
    const LevelVectors& vectors, const PatchLevel& level, const std::vector<double>& integral);

  Id Count() const { return static_cast<Id>(area_.size()); }

  /// Per own function: its component, and its integral.
  const std::vector<Index>& OfFunctions() const { return component_; }
  const std::vector<double>& Integrals() const { return integral_; }

  MultiVector OfIntegrals(const MultiVector& load) const;
  MultiVector OfFunction(const MultiVector& coefficients) const;
  void AddConstants(const MultiVector& mean, MultiVector& coefficients) const;
  void SubtractIntegrals(const MultiVector& mean, MultiVector& load) const;

private:
  template<class Weight>
  MultiVector WeightedMeans(const MultiVector& x, Weight&& weight) const;

  Communicator ranks_;
  std::vector<Index> component_; // per own function
  std::vector<double> integral_; // per own function
  std::vector<double> area_;     // per component of the whole
};

} // namespace gridfem

#endif
