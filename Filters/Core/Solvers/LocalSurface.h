// A surface that one process holds, with the functions that its options ask for.
#ifndef GridFEM_LocalSurface_h
#define GridFEM_LocalSurface_h

#include "Solvers/Surface.h"

namespace gridfem
{

class LocalSurface : public Surface
{
public:
  /// @param mesh  stays as it is
  LocalSurface(Stages& stages, std::shared_ptr<const TriangleMesh> mesh, SurfaceOptions options);

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
  bool AreCoincidentPointsWelded() const override { return used_.space.weldCoincidentPoints; }
  double Area() const override;
  double LongestSide() const override;
  HeldValues Hold(const std::vector<Id>& points, const MultiVector& values) const override;
  BoundaryTerms OnBoundary(const MultiVector* flux, const MultiVector* values) const override;
  std::vector<char> PointsWithFunctions() const override;

private:
  void Build(const SurfaceOptions& asked, const Progress& progress);

  const std::shared_ptr<const TriangleMesh> mesh_;
  const SurfaceOptions asked_;
  SurfaceOptions used_;
  std::shared_ptr<const FiniteElementSpace> space_;
  std::int64_t structure_ = 0;
};

} // namespace gridfem

#endif
