// The base of the spaces of a grid, for functions of either degree. It holds what is done patch by
// patch in both: values, samples and loads.
#ifndef GridFEM_CellSpace_h
#define GridFEM_CellSpace_h

#include "Integrals/QuadratureRule.h"
#include "Integrals/TriangleMetric.h"
#include "Spaces/FiniteElementSpace.h"

namespace gridfem
{

struct LevelOperators;
struct SmoothOperators;

/// The unit of length is the side of a cell. Many spaces may share functions and operators. A new
/// metric or new weights belong to a single space.
/// @tparam Operators  LevelOperators or SmoothOperators
/// @tparam Level      PatchLevel or SmoothLevel
template<class Operators, class Level>
class CellSpace : public FiniteElementSpace
{
public:
  /// @param mesh  the mesh of the pieces' source triangles
  CellSpace(std::shared_ptr<const TriangleMesh> mesh, std::shared_ptr<const GridFunctions> grid,
    std::shared_ptr<const Operators> operators);

  std::size_t NumberOfLevels() const override;
  Index NumberOfFunctions(std::size_t level) const override;
  SharedMatrix Prolongation(std::size_t level) const override;
  SharedMatrix Restriction(std::size_t level) const override;
  LevelRelaxation Relaxation(std::size_t level, const MultigridOptions& options) const override;
  Components ComponentsOf(std::size_t level, const Job& job = {}) const override;

  double UnitLength() const override;
  Vec3 Origin() const override;
  double Extent() const override;

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
  SparseMatrix RowsAtPoints(const std::vector<Id>& points) const override;
  EdgeSamples SamplesOfSegments(const std::vector<TriangleSegment>& segments) const override;
  SampledFunctions Samples(const Job& job = {}) const override;
  std::vector<char> PointsWithFunctions() const override;

  void SetMetricOnTriangles(
    std::shared_ptr<const TriangleMetric> metric, const Job& job = {}) override;
  void WeighMass(const std::vector<double>& weight, const Job& job = {}) override;

protected:
  /// The patches of all levels, finest first.
  virtual const std::vector<Level>& Levels() const = 0;
  virtual Components FinestComponents() const = 0;

  /// Integrates in the metric of the triangles.
  /// @param weight  weight of the mass on each triangle
  virtual void IntegrateTriangles(const std::vector<double>& weight, const Job& job) = 0;

  const Level& Finest() const { return this->Levels().front(); }
  const QuadratureRule& Rule() const;

  std::shared_ptr<const TriangleMesh> mesh_;
  std::shared_ptr<const GridFunctions> grid_;
  std::shared_ptr<const Operators> operators_;
  std::shared_ptr<const TriangleMetric> metric_; // null: the metric of the mesh, or of an embedding
};

extern template class CellSpace<LevelOperators, PatchLevel>;
extern template class CellSpace<SmoothOperators, SmoothLevel>;

} // namespace gridfem

#endif
