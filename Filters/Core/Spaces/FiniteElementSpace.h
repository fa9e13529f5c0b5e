// What a solver has to know of the functions on a surface, whatever they are: the levels of a
// hierarchy, and on the finest one integrals and values. A problem asks a space, never which space
// it has. [DESIGN §5]
#ifndef GridFEM_FiniteElementSpace_h
#define GridFEM_FiniteElementSpace_h

#include "Algebra/ColumnAlgebra.h"
#include "Integrals/DirectionalElements.h"
#include "Integrals/EdgeSamples.h"
#include "Spaces/SurfaceSpace.h"

#include <memory>
#include <vector>

namespace gridfem
{

struct TriangleMetric;

/// The words of SurfaceSpace hold here, too. One process holds all of it.
class FiniteElementSpace : public SurfaceSpace
{
public:
  /// The place in the world that positions in units of length are relative to.
  virtual Vec3 Origin() const = 0;

  const FiniteElementSpace* NestedLevels() const override { return nullptr; }

  ///@{ The finest level.

  /// LoadOfGradients with n x s, n along the normal of each triangle.
  virtual MultiVector LoadOfTurnedGradients(const Field& s, const Job& job = {}) const = 0;

  /// LoadOfGradients with s = ∇u / |∇u|; 0 where ∇u = 0.
  /// @param coefficients  functions u of the nested levels, where the space has such below it, else
  ///   of the space itself
  /// @return rows = functions of the space, columns as `coefficients`
  virtual MultiVector LoadOfDirections(
    const MultiVector& coefficients, const Field* scale, const Job& job = {}) const = 0;

  /// The values of all functions at some points: rows = points, columns = functions. Throws
  /// InvalidInput for a point that the mesh does not have.
  virtual SparseMatrix RowsAtPoints(const std::vector<Id>& points) const = 0;

  /// The values of all functions along segments of triangles, for integrals over curves. Throws
  /// InvalidInput for a triangle that the mesh does not have.
  virtual EdgeSamples SamplesOfSegments(const std::vector<TriangleSegment>& segments) const = 0;

  /// The coefficients of the mesh's own coordinates, exact but for rounding: functions x 3, in
  /// units of length from the origin. What a flow starts from.
  virtual MultiVector EmbeddingOfMesh(const Job& job = {}) const = 0;
  ///@}

  ///@{ Other numbers on the same functions. A copy shares all that does not change.
  virtual std::unique_ptr<FiniteElementSpace> Copy() const = 0;

  std::shared_ptr<const SurfaceSpace> WithWeighedMass(
    const std::vector<double>& weight, const Job& job = {}) const override
  {
    std::shared_ptr<FiniteElementSpace> weighed = this->Copy();
    weighed->WeighMass(weight, job);
    return weighed;
  }

  /// All integrals in the metric of an embedding, but for loads, which stay those of the mesh.
  /// [T §5.1]
  /// @param embedding  functions x 3 coefficients, in units of length
  /// @param parts      Mass: the stiffness stays that of the mesh, which it has to be before; as in
  ///                   the conformalised flow [T (6.2)]
  /// @return  number of samples whose metric is singular: they contribute nothing
  virtual Id SetMetric(
    const MultiVector& embedding, const Job& job = {}, ElementParts parts = ElementParts::Both) = 0;

  /// All integrals in a metric that is constant on every triangle, loads as well, but for those of
  /// directions. Values and gradients on the mesh stay what they are in space.
  virtual void SetMetricOnTriangles(
    std::shared_ptr<const TriangleMetric> metric, const Job& job = {}) = 0;

  /// The mass becomes ∫ w b_i b_j with a weight w >= 0 on each triangle, and Integrals() ∫ w b_i;
  /// the stiffness and all loads stay. In the metric of SetMetricOnTriangles, else of the mesh.
  /// Throws InvalidInput when there is not one finite weight per triangle.
  virtual void WeighMass(const std::vector<double>& weight, const Job& job = {}) = 0;

  /// Makes ready for Weigh: splits the stiffness along and across a direction on each triangle.
  /// [T §5.2]
  virtual void SplitStiffness(const std::vector<Vec3>& direction, const Job& job = {}) = 0;

  /// Per element that has weights of its own, the mean of values on triangles, weighted by area.
  virtual MultiVector MeansOnElements(
    const MultiVector& onTriangles, const Job& job = {}) const = 0;

  /// New weights of the elements, for SplitStiffness has been called. [T (5.16)-(5.19)]
  virtual void Weigh(const std::vector<ElementWeights>& weights, const Job& job = {}) = 0;

  /// ∫ scale <∇u, ∇b_i> for functions u of the space, in the metric and with the weights of the
  /// stiffness. Sums what the elements keep, on a grid without a look at the triangles. [T (5.19)]
  /// @param u      functions x columns
  /// @param scale  one number per element, as from MeansOnElements; empty: 1
  virtual MultiVector StiffnessTimes(
    const MultiVector& u, const std::vector<double>& scale, const Job& job = {}) const = 0;
  ///@}
};

} // namespace gridfem

#endif
