// One rank's view of a space on several ranks: its levels, and fields on the rank's own mesh.
#ifndef GridFEM_RankLevels_h
#define GridFEM_RankLevels_h

#include "Parallel/RankHats.h"
#include "Parallel/RankLevel.h"
#include "Parallel/RankSpace.h"
#include "Spaces/SpaceLevels.h"

#include <memory>
#include <vector>

namespace gridfem
{

/// The distributed levels come first: the functions of RankHats::Numbering if there are hats, then
/// the functions of RankSpace::Numberings. The shared levels follow. The mesh consists of the
/// rank's own triangles. All functions are collective, except functions that return a number or a
/// reference. A progress passed to them has to give the same answer on all ranks. Keeps references
/// to the space and the hats.
class RankLevels : public SurfaceSpace
{
public:
  /// @param hats  of the same surface, above the levels of the grid; may be null
  explicit RankLevels(const RankSpace& space, const RankHats* hats = nullptr);

  const RankSpace& Space() const { return space_; }

  /// This rank's part of the finest level, as a space on the triangles that the rank has received.
  const FiniteElementSpace& Own() const;

  /// Numbering of a distributed level.
  const LevelNumbering& Numbering(std::size_t level) const;

  const RankRows& Rows(std::size_t level) const { return rows_[level]; }

  /// The levels of the grid: this object, if there are no hats.
  const RankLevels& OfGrid() const { return grid_ ? *grid_ : *this; }
  const SurfaceSpace* NestedLevels() const override { return grid_.get(); }

  /// Null if there are none.
  const RankHats* Hats() const { return hats_; }

  /// ∫ scale <d, ∇b_i> with the directions of gradients d = ∇u / |∇u|; complete in all rows.
  /// @param coefficients  of a function u of the grid
  /// @param scale         on this rank's own points or triangles
  MultiVector LoadOfDirections(
    const MultiVector& coefficients, const Field& scale, const Job& job = {}) const;

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
  MultiVector ValuesAtPoints(const MultiVector& coefficients, const Job& job = {}) const override;
  double UnitLength() const override;
  MultiVector LoadOfValues(const Field& f, const Job& job = {}) const override;
  MultiVector LoadOfWeightedValues(
    const Field& f, const std::vector<double>& weight, const Job& job = {}) const override;
  MultiVector LoadOfGradients(
    const Field& s, const Field* scale, const Job& job = {}) const override;
  MultiVector LoadOfGradientsOf(
    const Field& f, const Field* scale, const Job& job = {}) const override;
  MultiVector LoadOfGradientsOfCoordinates(const Field* scale, const Job& job = {}) const override;
  MultiVector GradientsOnTriangles(
    const MultiVector& coefficients, const Job& job = {}) const override;
  std::vector<char> PointsWithFunctions() const override;
  std::shared_ptr<const SurfaceSpace> WithWeightedMass(
    const std::vector<double>& weight, const Job& job = {}) const override;
  void SumAtPoints(MultiVector& parts) const override { space_.SumAtPoints(parts); }
  const DistributedRows* Distributed(std::size_t level) const override;
  std::shared_ptr<const DistributedLevel> Divide(
    std::size_t level, const SparseMatrix& A, const MultigridOptions& options) const override;

private:
  bool IsDivided(std::size_t level) const { return level < rows_.size(); }
  /// The space that holds a level on this rank, and the level's number in that space.
  const SpaceLevels& HolderOf(std::size_t level) const;
  std::size_t LevelThere(std::size_t level) const;
  /// The number of a level in the grid.
  std::size_t GridLevel(std::size_t level) const { return hats_ ? level - 1 : level; }
  bool IsOfHats(std::size_t level) const { return hats_ && level == 0; }
  MultiVector ValuesOf(
    const MultiVector& coefficients, std::vector<char>* hasValue, const Job& job) const;
  MultiVector MeansOfRanks(const MultiVector& means, const std::vector<double>& areas) const;
  Field Send(const Field& own) const;
  template<class Integrate>
  MultiVector Load(const Job& job, Integrate&& integrate) const;

  const RankSpace& space_;
  const RankHats* hats_;
  std::unique_ptr<const RankLevels> grid_;     // if there are hats
  std::vector<RankRows> rows_;                 // of the distributed levels
  std::vector<std::vector<PatchLevel>> parts_; // PatchesByRanks of the grid's distributed levels
  std::vector<double> integrals_;
  /// Areas of this rank's parts of the triangles that it has received, as the functions see them.
  std::vector<double> areas_;
};

/// A progress that aborts all ranks when one rank asks for it. Otherwise the other ranks would wait
/// for that rank.
Progress OfAllRanks(const Communicator& ranks, const Progress& progress);

} // namespace gridfem

#endif
