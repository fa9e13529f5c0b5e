// A surface that one process holds, with the functions that its options ask for.
#ifndef GridFEM_LocalSurface_h
#define GridFEM_LocalSurface_h

#include "Solvers/Surface.h"
#include "Solvers/SurfaceBasis.h"

namespace gridfem
{

class LocalSurface : public virtual Surface
{
public:
  /// @param mesh  stays as it is
  LocalSurface(
    Stages& stages, std::shared_ptr<const TriangleMesh> mesh, const SurfaceOptions& options);

  void Prepare(const Progress& progress) override;
  void PrepareAtDepth(int depth, const Progress& progress) override;
  void PrepareMesh(const Progress& progress) override;
  StageKey InputKey() const override { return {}; } // neither changes
  std::shared_ptr<const TriangleMesh> ReadMesh() const override { return mesh_; }
  std::int64_t StructureVersion() const override { return structure_; }
  const SurfaceOptions& UsedOptions() const override { return used_; }
  std::shared_ptr<const TriangleMesh> SharedMesh() const override { return mesh_; }
  std::shared_ptr<const SurfaceSpace> SharedSpace() const override { return space_; }
  std::shared_ptr<const FiniteElementSpace> WholeSpace() const override { return space_; }
  bool AreCoincidentPointsWelded() const override { return basis_.weldCoincidentPoints; }
  double Area() const override;
  double LongestSide() const override;
  HeldValues Hold(const std::vector<Id>& points, const MultiVector& values) const override;
  BoundaryTerms OnBoundary(const MultiVector* flux, const MultiVector* values) const override;
  EdgeSamples SampleBoundary(bool ofNested) const override;
  std::vector<char> PointsWithFunctions() const override;

  /// The functions of the grid; none before they are made.
  const SurfaceBasis& Basis() const { return basis_; }

protected:
  /// For a surface whose mesh can change. It overrides Prepare and all functions that read the
  /// mesh.
  explicit LocalSurface(Stages& stages) : Surface(stages) {}

  /// Makes functions on a mesh. The options determine the depth.
  void BuildBasis(const std::shared_ptr<const TriangleMesh>& mesh, const SurfaceOptions& asked,
    const Progress& progress);

  /// A metric that replaces the metric of the mesh.
  struct GivenMetric
  {
    StageKey structure; // a change of it may change the structure of matrices
    StageKey numbers;   // a change of it changes their numbers alone
    std::function<std::shared_ptr<const TriangleMetric>()> make; // null: the metric of the mesh
  };

  /// Brings the space on the functions up to date (SystemStage). In the metric of the mesh, a space
  /// that somebody else has made on the same basis is reused without a run.
  void UpdateSpace(const GivenMetric& metric, const Progress& progress);

  /// Frees functions and space.
  void FreeBasis();

  SurfaceOptions used_;
  SurfaceBasis basis_;

private:
  void Build(const SurfaceOptions& asked, const Progress& progress);

  const std::shared_ptr<const TriangleMesh> mesh_;
  const SurfaceOptions asked_;
  std::shared_ptr<const FiniteElementSpace> space_;
  std::shared_ptr<const TriangleMetric> metric_; // of the space; null: that of the mesh
  StageKey structureKey_;
  std::int64_t structure_ = 0;
};

} // namespace gridfem

#endif
