// The surface of all ranks, for solvers: each rank holds a piece, and no rank gathers the whole.
#ifndef GridFEM_DistributedSurface_h
#define GridFEM_DistributedSurface_h

#include "Parallel/RankSurface.h"
#include "Solvers/Surface.h"

#include <functional>
#include <memory>
#include <vector>

namespace gridfem
{

/// Solvers run on it within Run. The mesh of a rank is its piece without copies of other ranks'
/// triangles. A derived class reads it in Prepare.
class DistributedSurface : public virtual Surface
{
public:
  using Body = std::function<void(const Progress& ofAll)>;

  /// Runs a body on all ranks. A stage runs on all ranks if it has to run on one. The progress of
  /// the body is aborted for all ranks or none. Throws as Communicator::Guard.
  void Run(const Progress& progress, const Body& body);

  const Communicator& Ranks() const { return ranks_; }

  /// The functions. Null before Prepare.
  const std::shared_ptr<const RankSurface>& Functions() const { return functions_; }
  const Grid& GetGrid() const { return functions_->Space().Own().Functions().GetGrid(); }

  /// The number of threads that this rank may use. Ranks share the threads of a machine.
  int ThreadsOfRank(int wanted) const;

  /// Replaces the numbers by the numbers of the first rank that has any.
  void AgreeOn(std::vector<double>& numbers) const;

  ///@{ Solvers call them for a whole surface alone. They throw std::logic_error.
  void PrepareAtDepth(int /*depth*/, const Progress& /*progress*/) override { NeedWhole(); }
  void PrepareMesh(const Progress& /*progress*/) override { NeedWhole(); }
  StageKey InputKey() const override { NeedWhole(); }
  std::shared_ptr<const TriangleMesh> ReadMesh() const override { NeedWhole(); }
  std::shared_ptr<const FiniteElementSpace> WholeSpace() const override { NeedWhole(); }
  ///@}

  ///@{ The functions of the base class.
  std::int64_t StructureVersion() const override { return structure_; }
  const SurfaceOptions& UsedOptions() const override { return used_; }
  std::shared_ptr<const SurfaceSpace> SharedSpace() const override;
  bool AreCoincidentPointsWelded() const override { return used_.space.weldCoincidentPoints; }
  double Area() const override { return area_; }
  double LongestSide() const override;
  bool IsShared() const override { return true; }
  void Together(const std::function<void()>& body) const override { ranks_.Together(body); }
  void Require(const MemoryNeed& own) const override;
  const DistributedRows* SumsOverProcesses() const override { return &numbers_; }
  double Largest(double own) const override;
  bool IsFirst(bool holds) const override;
  HeldValues Hold(const std::vector<Id>& points, const MultiVector& values) const override;
  BoundaryTerms OnBoundary(const MultiVector* flux, const MultiVector* values) const override;
  std::unique_ptr<DistanceMethod> MakeDistance(
    const DistanceOptions& options, const Job& job) const override;
  EdgeSamples SampleBoundary(bool ofNested) const override;
  std::vector<char> PointsWithFunctions() const override;
  void FillCopies(MultiVector& atPoints) const override;
  ///@}

protected:
  DistributedSurface(Stages& stages, const Communicator& ranks);

  /// Whether an earlier rank has the same triangles, bit by bit.
  bool IsRepeated(const TriangleMesh& own) const;

  /// Measures the surface. Throws InvalidInput if it has no area.
  void Measure(const TriangleMesh& own);

  /// Gives all ranks the grid of the first rank with triangles. Throws InvalidInput if another rank
  /// has other cells.
  void AgreeOn(GivenCells& cells) const;

  /// Makes the functions that options ask for on the current mesh.
  /// @param copies  triangles of its points that are copies of another rank's triangles
  /// @param given   the cells of its triangles if they are pieces of a clip; null: they are clipped
  void BuildFunctions(const SurfaceOptions& asked, const TriangleList& copies,
    const std::shared_ptr<const GivenCells>& given);

  /// Notes the options in use, with the depth of the functions and the threads of this rank.
  void NoteOptions(const SurfaceOptions& asked);

  void FreeFunctions() { functions_ = nullptr; }

  /// The progress of this rank alone.
  const Progress& OwnProgress() const { return own_; }

  SurfaceOptions used_;

private:
  [[noreturn]] static void NeedWhole();

  const Communicator ranks_;
  const RankRows numbers_; // sums numbers; it has no rows
  Progress own_;
  std::shared_ptr<const RankSurface> functions_;
  std::int64_t structure_ = 0;
  double area_ = 0.0;
};

} // namespace gridfem

#endif
