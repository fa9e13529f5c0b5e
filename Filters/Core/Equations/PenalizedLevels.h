// Levels with a penalty on the values of their functions at some places.
#ifndef GridFEM_PenalizedLevels_h
#define GridFEM_PenalizedLevels_h

#include "Equations/RowPenalty.h"
#include "Spaces/SpaceLevels.h"

#include <memory>

namespace gridfem
{

/// The levels of a space with the stiffness L + Cᵀ W C instead of L. A component that a place
/// touches has no constant any more. Keeps a reference to the space.
class PenalizedLevels : public SpaceLevels
{
public:
  /// @param nested  the nested levels of the space with a penalty of their own; null if the space
  ///   has no such levels
  PenalizedLevels(const SpaceLevels& space, RowPenalty penalty,
    std::unique_ptr<const PenalizedLevels> nested = nullptr);

  std::size_t NumberOfLevels() const override { return space_.NumberOfLevels(); }
  Index NumberOfFunctions(std::size_t level) const override
  {
    return space_.NumberOfFunctions(level);
  }
  void FillMatrix(
    std::size_t level, double a, double b, SparseMatrix& matrix, const Job& job) const override;
  SharedMatrix Prolongation(std::size_t level) const override { return space_.Prolongation(level); }
  SharedMatrix Restriction(std::size_t level) const override { return space_.Restriction(level); }
  LevelRelaxation Relaxation(std::size_t level, const MultigridOptions& options) const override
  {
    return space_.Relaxation(level, options);
  }
  Components ComponentsOf(std::size_t level, const Job& job = {}) const override;
  double Extent() const override { return space_.Extent(); }
  const SpaceLevels* NestedLevels() const override { return nested_.get(); }
  const std::vector<double>& Integrals() const override { return space_.Integrals(); }
  Columns SquaredNorms(const MultiVector& u, const Job& job = {}) const override
  {
    return space_.SquaredNorms(u, job);
  }
  MultiVector ValuesAtPoints(const MultiVector& coefficients, const Job& job = {}) const override
  {
    return space_.ValuesAtPoints(coefficients, job);
  }
  const DistributedRows* Distributed(std::size_t level) const override
  {
    return space_.Distributed(level);
  }
  std::shared_ptr<const DistributedLevel> Divide(
    std::size_t level, const SparseMatrix& A, const MultigridOptions& options) const override
  {
    return space_.Divide(level, A, options);
  }

private:
  const SpaceLevels& space_;
  const RowPenalty penalty_;
  const std::unique_ptr<const PenalizedLevels> nested_;
};

} // namespace gridfem

#endif
