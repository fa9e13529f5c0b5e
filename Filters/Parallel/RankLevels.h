// The space of several ranks, as one of them sees it: levels, and fields on its own mesh.
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
/// ones. The mesh is that of the rank's own triangles. All functions are collective but those that
/// return a number; what a progress of theirs says has to be the same on all ranks. Keeps a
/// reference to the space.
class RankLevels : public SurfaceSpace
{
public:
  explicit RankLevels(const RankSpace& space);

  const RankSpace& Space() const { return space_; }

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
  std::shared_ptr<const SurfaceSpace> WithWeighedMass(
    const std::vector<double>& weight, const Job& job = {}) const override;
  void SumAtPoints(MultiVector& parts) const override { space_.SumAtPoints(parts); }
  const DividedRows* Divided(std::size_t level) const override;
  std::shared_ptr<const DividedLevel> Divide(
    std::size_t level, const SparseMatrix& A, const MultigridOptions& options) const override;

private:
  bool IsDivided(std::size_t level) const { return level < rows_.size(); }
  /// The space that has a level here, and its number there.
  const GridSpace& HolderOf(std::size_t level) const;
  std::size_t LevelThere(std::size_t level) const;
  Field Send(const Field& own) const;
  template<class Integrate>
  MultiVector Load(const Job& job, Integrate&& integrate) const;

  const RankSpace& space_;
  std::vector<RankRows> rows_;                 // of the divided levels
  std::vector<std::vector<PatchLevel>> parts_; // PatchesByRanks
  std::vector<double> integrals_;
  std::vector<double> areas_; // of this rank's parts of the triangles that it has received
};

/// An abort that one rank asks for is one of all: the others would wait for it.
Progress OfAllRanks(const Communicator& ranks, const Progress& progress);

} // namespace gridfem

#endif
