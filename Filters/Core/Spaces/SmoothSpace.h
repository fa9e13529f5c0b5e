// The quadratic B-splines of a grid as a finite element space: functions with continuous gradients,
// restricted to the surface and nested from level to level. [T §7.2]
#ifndef GridFEM_SmoothSpace_h
#define GridFEM_SmoothSpace_h

#include "Integrals/TriangleMetric.h"
#include "Spaces/FiniteElementSpace.h"
#include "Spaces/GridSpace.h"
#include "Spaces/SmoothOperators.h"

namespace gridfem
{

/// The unit of length is the side of a cell. The error of smooth solutions falls with the third
/// power of this side, and the error of eigenvalues with the fourth. A trilinear space of the same
/// depth has about as many functions, with a quarter of the entries in its matrices. Many spaces
/// may share functions and operators. A new metric or new weights belong to a single space. Metrics
/// and weights are constant on each triangle. The triangles are the elements of Weigh and
/// StiffnessTimes.
class SmoothSpace : public FiniteElementSpace
{
public:
  /// @param mesh  the mesh of the pieces' source triangles
  SmoothSpace(std::shared_ptr<const TriangleMesh> mesh, std::shared_ptr<const GridFunctions> grid,
    std::shared_ptr<const SmoothOperators> operators);

  std::size_t NumberOfLevels() const override;
  Index NumberOfFunctions(std::size_t level) const override;
  void FillMatrix(
    std::size_t level, double a, double b, SparseMatrix& matrix, const Job& job) const override;
  SharedMatrix Prolongation(std::size_t level) const override;
  SharedMatrix Restriction(std::size_t level) const override;
  LevelRelaxation Relaxation(std::size_t level, const MultigridOptions& options) const override;
  Components ComponentsOf(std::size_t level, const Job& job = {}) const override;

  double UnitLength() const override;
  Vec3 Origin() const override;
  double Extent() const override;

  const std::vector<double>& Integrals() const override;
  MultiVector LoadOfValues(const Field& f, const Job& job = {}) const override;
  MultiVector LoadOfWeightedValues(
    const Field& f, const std::vector<double>& weight, const Job& job = {}) const override;
  MultiVector LoadOfGradients(
    const Field& s, const Field* scale, const Job& job = {}) const override;
  MultiVector LoadOfTurnedGradients(const Field& s, const Job& job = {}) const override;
  MultiVector LoadOfDirections(
    const MultiVector& coefficients, const Field* scale, const Job& job = {}) const override;
  MultiVector LoadOfGradientsOf(
    const Field& f, const Field* scale, const Job& job = {}) const override;
  MultiVector LoadOfGradientsOfCoordinates(const Field* scale, const Job& job = {}) const override;
  MultiVector ValuesAtPoints(const MultiVector& coefficients, const Job& job = {}) const override;
  MultiVector GradientsOnTriangles(
    const MultiVector& coefficients, const Job& job = {}) const override;
  Columns SquaredNorms(const MultiVector& u, const Job& job = {}) const override;
  SparseMatrix RowsAtPoints(const std::vector<Id>& points) const override;
  EdgeSamples SamplesOfSegments(const std::vector<TriangleSegment>& segments) const override;
  SampledFunctions Samples(const Job& job = {}) const override;
  std::vector<char> PointsWithFunctions() const override;
  MultiVector EmbeddingOfMesh(const Job& job = {}) const override;

  std::unique_ptr<FiniteElementSpace> Copy() const override;
  /// The metric is the metric of the mesh with its points moved to the values of the embedding.
  Id SetMetric(const MultiVector& embedding, const Job& job = {},
    ElementParts parts = ElementParts::Both) override;
  void SetMetricOnTriangles(
    std::shared_ptr<const TriangleMetric> metric, const Job& job = {}) override;
  void WeighMass(const std::vector<double>& weight, const Job& job = {}) override;
  void SplitStiffness(const std::vector<Vec3>& direction, const Job& job = {}) override;
  MultiVector MeansOnElements(const MultiVector& onTriangles, const Job& job = {}) const override;
  void Weigh(const std::vector<ElementWeights>& weights, const Job& job = {}) override;
  MultiVector StiffnessTimes(
    const MultiVector& u, const std::vector<double>& scale, const Job& job = {}) const override;

  const GridFunctions& Grid() const { return *grid_; }
  const SmoothOperators& Operators() const { return *operators_; }

private:
  const SmoothLevel& Finest() const { return operators_->levels.front(); }
  const SmoothMatrices& Matrices() const { return own_ ? *own_ : operators_->matrices; }
  const QuadratureRule& Rule() const { return TriangleRule(operators_->quadratureDegree); }
  void Integrate(const std::vector<double>* weight, const Job& job);

  std::shared_ptr<const TriangleMesh> mesh_;
  std::shared_ptr<const GridFunctions> grid_;
  std::shared_ptr<const SmoothOperators> operators_;
  std::shared_ptr<const SmoothMatrices> own_; // set once numbers have changed
  /// Tensors of the stiffness on the triangles; null: the metric of the mesh.
  std::shared_ptr<const std::vector<Eigen::Matrix3d>> tensor_;
  std::shared_ptr<const std::vector<double>> normal_; // factors along the normal; null: all are 1
  std::shared_ptr<const TriangleMetric> metric_; // null: the metric of the mesh, or of an embedding
  std::shared_ptr<const std::vector<Vec3>> direction_;
};

/// Clips a mesh and builds functions and operators. Throws InvalidInput and Aborted.
SmoothSpace BuildSmoothSpace(
  TriangleMesh mesh, const GridSpaceOptions& options, const Progress& progress = {});

} // namespace gridfem

#endif
