// The hat functions of a mesh as a finite element space. They are the finest level above the levels
// of a grid, which accelerates the solution. [T §4.2, Hat-Basis Incorporation]
#ifndef GridFEM_HatSpace_h
#define GridFEM_HatSpace_h

#include "Spaces/GridSpace.h"
#include "Spaces/HatMatrices.h"
#include "Spaces/HatTransfer.h"

namespace gridfem
{

/// Data of the hats of a mesh above a grid, shared by all a M + b L, in the grid's unit of length.
struct HatLevel
{
  HatFunctions functions;
  HatMatrices matrices;
  PatchOrder order;          // order of the sweeps
  PatchOrder groups;         // groups of eight hats each; see GroupByCoupling
  SharedMatrix prolongation; // from the finest functions of the grid
  SharedMatrix restriction;
  /// Replaces the given grid if sheets touch only at points. The given grid's functions are split
  /// there, but hats are not. A correction that moves one whole sheet would then cost no energy on
  /// the grid and much energy on the hats.
  std::shared_ptr<const GridSpace> joinedGrid;
};

/// Builds the data of the hats. Throws InvalidInput when no triangle has an area.
/// @param mesh    the mesh that the grid's functions were made from, with the same
///   weldCoincidentPoints
/// @param ofGrid  the options of the given grid's operators, also for a grid that replaces it
HatLevel BuildHatLevel(const TriangleMesh& mesh, const GridFunctions& grid,
  const OperatorOptions& ofGrid, bool weldCoincidentPoints,
  HatTransfer transfer = HatTransfer::Evaluation, const Job& job = {});

/// Level 0 consists of the hats, and level l + 1 is level l of the grid. The hats are relaxed by
/// Gauss-Seidel with twice the sweeps of the grid's levels, and in groups after a sweep.
class HatSpace : public FiniteElementSpace
{
public:
  HatSpace(std::shared_ptr<const HatLevel> hats, GridSpace grid);

  std::size_t NumberOfLevels() const override;
  Index NumberOfFunctions(std::size_t level) const override;
  void FillMatrix(
    std::size_t level, double a, double b, SparseMatrix& matrix, const Job& job) const override;
  SharedMatrix Prolongation(std::size_t level) const override;
  SharedMatrix Restriction(std::size_t level) const override;
  LevelRelaxation Relaxation(std::size_t level, const MultigridOptions& options) const override;
  Components ComponentsOf(std::size_t level, const Job& job = {}) const override;
  const FiniteElementSpace* NestedLevels() const override { return &grid_; }

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
  void SetMetricOnTriangles(
    std::shared_ptr<const TriangleMetric> metric, const Job& job = {}) override;
  void WeighMass(const std::vector<double>& weight, const Job& job = {}) override;
  void SplitStiffness(const std::vector<Vec3>& direction, const Job& job = {}) override;
  MultiVector MeansOnElements(const MultiVector& onTriangles, const Job& job = {}) const override;
  void Weigh(const std::vector<ElementWeights>& weights, const Job& job = {}) override;
  MultiVector StiffnessTimes(
    const MultiVector& u, const std::vector<double>& scale, const Job& job = {}) const override;

  const HatLevel& Hats() const { return *hats_; }
  const GridSpace& Grid() const { return grid_; }
  const HatMatrices& Matrices() const { return own_ ? *own_ : hats_->matrices; }

private:
  HatWeights Weights() const;
  void Assemble(const Job& job);

  std::shared_ptr<const HatLevel> hats_;
  GridSpace grid_;
  std::shared_ptr<const HatMatrices> own_; // set once numbers have changed
  std::shared_ptr<const std::vector<Vec3>> direction_;
  std::shared_ptr<const TriangleMesh> moved_;    // mesh whose metric is used; null: the mesh itself
  ElementParts movedParts_ = ElementParts::Both; // the matrices in the metric of moved_
  std::shared_ptr<const std::vector<ElementWeights>> weights_;
  std::shared_ptr<const TriangleMetric> metric_; // null: the metric of the mesh, or of moved points
};

/// Builds grid and hats. Throws InvalidInput and Aborted.
HatSpace BuildHatSpace(TriangleMesh mesh, const GridSpaceOptions& options,
  HatTransfer transfer = HatTransfer::Evaluation, const Progress& progress = {});

} // namespace gridfem

#endif
