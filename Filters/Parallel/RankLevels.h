// The levels of a space on several ranks, as one of them sees them.
#ifndef GridFEM_RankLevels_h
#define GridFEM_RankLevels_h

#include "Parallel/RankLevel.h"
#include "Parallel/RankSpace.h"
#include "Spaces/SpaceLevels.h"

#include <memory>
#include <vector>

namespace gridfem
{

/// First the divided levels, whose functions are those of RankSpace::Numberings, then the shared
/// ones. All functions are collective but those that return a number. Keeps a reference to the
/// space.
class RankLevels : public SpaceLevels
{
public:
  explicit RankLevels(const RankSpace& space);

  std::size_t NumberOfLevels() const override;
  Index NumberOfFunctions(std::size_t level) const override;
  void FillMatrix(
    std::size_t level, double a, double b, SparseMatrix& matrix, const Job& job) const override;
  SharedMatrix Prolongation(std::size_t level) const override;
  SharedMatrix Restriction(std::size_t level) const override;
  LevelRelaxation Relaxation(std::size_t level, const MultigridOptions& options) const override;
  Components ComponentsOf(std::size_t level, const Job& job = {}) const override;
  double Extent() const override;
  const std::vector<double>& Integrals() const override { return integrals_; }
  Columns SquaredNorms(const MultiVector& u, const Job& job = {}) const override;
  /// At the points of Own().
  MultiVector ValuesAtPoints(const MultiVector& coefficients, const Job& job = {}) const override;
  const DividedRows* Divided(std::size_t level) const override;
  std::shared_ptr<const DividedLevel> Divide(
    std::size_t level, const SparseMatrix& A, const MultigridOptions& options) const override;

private:
  bool IsDivided(std::size_t level) const { return level < rows_.size(); }
  /// The space that has a level here, and its number there.
  const GridSpace& HolderOf(std::size_t level) const;
  std::size_t LevelThere(std::size_t level) const;

  const RankSpace& space_;
  std::vector<RankRows> rows_;                 // of the divided levels
  std::vector<std::vector<PatchLevel>> parts_; // PatchesByRanks
  std::vector<double> integrals_;
};

/// An abort that one rank asks for is one of all: the others would wait for it.
Progress OfAllRanks(const Communicator& ranks, const Progress& progress);

} // namespace gridfem

#endif
