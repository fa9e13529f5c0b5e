// The quadratic B-splines of a grid as a finite element space: functions with continuous gradients,
// restricted to the surface and nested from level to level. [T §7.2]
#ifndef GridFEM_SmoothSpace_h
#define GridFEM_SmoothSpace_h

#include "Spaces/CellSpace.h"
#include "Spaces/GridSpace.h"
#include "Spaces/SmoothOperators.h"

namespace gridfem
{

/// The error of smooth solutions falls with the third power of a cell's side, and the error of
/// eigenvalues with the fourth. A trilinear space of the same depth has about as many functions,
/// with a quarter of the entries in its matrices. Metrics and weights are constant on each
/// triangle. The triangles are the elements of Weigh and StiffnessTimes.
class SmoothSpace : public CellSpace<SmoothOperators, SmoothLevel>
{
public:
  using CellSpace::CellSpace;

  void FillMatrix(
    std::size_t level, double a, double b, SparseMatrix& matrix, const Job& job) const override;
  const std::vector<double>& Integrals() const override;
  Columns SquaredNorms(const MultiVector& u, const Job& job = {}) const override;
  MultiVector EmbeddingOfMesh(const Job& job = {}) const override;

  std::unique_ptr<FiniteElementSpace> Copy() const override;
  /// The metric is the metric of the mesh with its points moved to the values of the embedding.
  Id SetMetric(const MultiVector& embedding, const Job& job = {},
    ElementParts parts = ElementParts::Both) override;
  void SplitStiffness(const std::vector<Vec3>& direction, const Job& job = {}) override;
  MultiVector MeansOnElements(const MultiVector& onTriangles, const Job& job = {}) const override;
  void Weigh(const std::vector<ElementWeights>& weights, const Job& job = {}) override;
  MultiVector StiffnessTimes(
    const MultiVector& u, const std::vector<double>& scale, const Job& job = {}) const override;

  const GridFunctions& Grid() const { return *grid_; }
  const SmoothOperators& Operators() const { return *operators_; }

private:
  const std::vector<SmoothLevel>& Levels() const override { return operators_->levels; }
  Components FinestComponents() const override;
  void IntegrateTriangles(const std::vector<double>& weight, const Job& job) override;
  const SmoothMatrices& Matrices() const { return own_ ? *own_ : operators_->matrices; }

  std::shared_ptr<const SmoothMatrices> own_; // set once numbers have changed
  /// Tensors of the stiffness on the triangles; null: the metric of the mesh.
  std::shared_ptr<const std::vector<Eigen::Matrix3d>> tensor_;
  std::shared_ptr<const std::vector<double>> normal_; // factors along the normal; null: all are 1
  std::shared_ptr<const std::vector<Vec3>> direction_;
};

/// Clips a mesh and builds functions and operators. Throws InvalidInput and Aborted.
SmoothSpace BuildSmoothSpace(
  TriangleMesh mesh, const GridSpaceOptions& options, const Progress& progress = {});

} // namespace gridfem

#endif
