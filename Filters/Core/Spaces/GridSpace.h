// The functions of a grid as a finite element space: trilinear B-splines restricted to the surface
// and nested from level to level. [DESIGN §1, §2]
#ifndef GridFEM_GridSpace_h
#define GridFEM_GridSpace_h

#include "Integrals/SurfaceMetric.h"
#include "Integrals/TriangleMetric.h"
#include "Spaces/FiniteElementSpace.h"
#include "Spaces/LevelOperators.h"

#include <optional>

namespace gridfem
{

/// The unit of length is the side of a cell. Many spaces may share functions and operators. A new
/// metric or new weights belong to a single space.
class GridSpace : public FiniteElementSpace
{
public:
  /// @param mesh  the mesh of the pieces' source triangles
  GridSpace(std::shared_ptr<const TriangleMesh> mesh,
    std::shared_ptr<const GridFunctions> functions,
    std::shared_ptr<const LevelOperators> operators);

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
  Id SetMetric(const MultiVector& embedding, const Job& job = {},
    ElementParts parts = ElementParts::Both) override;
  /// Works like SetMetric, with the metric of the mesh with moved points.
  Id SetMetricOfMesh(
    const TriangleMesh& moved, const Job& job = {}, ElementParts parts = ElementParts::Both);
  void SetMetricOnTriangles(
    std::shared_ptr<const TriangleMetric> metric, const Job& job = {}) override;
  void WeighMass(const std::vector<double>& weight, const Job& job = {}) override;
  void SplitStiffness(const std::vector<Vec3>& direction, const Job& job = {}) override;
  MultiVector MeansOnElements(const MultiVector& onTriangles, const Job& job = {}) const override;
  void Weigh(const std::vector<ElementWeights>& weights, const Job& job = {}) override;
  MultiVector StiffnessTimes(
    const MultiVector& u, const std::vector<double>& scale, const Job& job = {}) const override;

  const GridFunctions& Functions() const { return *functions_; }
  const LevelOperators& Operators() const { return own_ ? *own_ : *shared_; }
  const TriangleMesh& Mesh() const { return *mesh_; }

private:
  Id Integrate(const SampleMetric& metric, const Job& job, ElementParts parts);
  void IntegrateTriangles(const std::vector<double>& weight, const Job& job);
  LevelOperators& OwnOperators();
  const QuadratureRule& Rule() const;

  std::shared_ptr<const TriangleMesh> mesh_;
  std::shared_ptr<const GridFunctions> functions_;
  std::shared_ptr<const LevelOperators> shared_;
  std::optional<LevelOperators> own_; // set once numbers have changed
  std::shared_ptr<const DirectionalElements> split_;
  std::shared_ptr<const TriangleMetric> metric_; // null: the metric of the mesh, or of an embedding
};

/// Options of the operators on the functions.
struct OperatorOptions
{
  int quadratureDegree = 2;
  Index coarsestSize = 256; // most functions in the largest component of the coarsest level
  /// The weight of |∂u/∂n|² in the operator, in (0, 1]. 1e-2 needs few iterations to small
  /// tolerances on any surface, at 1.2 to 1.6 times the discretization error.
  double normalStabilization = DefaultNormalStabilization;
};

struct GridSpaceOptions : OperatorOptions
{
  SpaceOptions functions;
};

/// Clips a mesh and builds functions and operators. Throws InvalidInput and Aborted.
GridSpace BuildGridSpace(
  TriangleMesh mesh, const GridSpaceOptions& options, const Progress& progress = {});

} // namespace gridfem

#endif
