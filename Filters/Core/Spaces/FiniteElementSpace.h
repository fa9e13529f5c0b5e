// The interface between solvers and the functions on a surface: the levels of a hierarchy, and
// integrals and values on the finest level. A problem uses this interface and never asks for the
// kind of space. [DESIGN §5]
#ifndef GridFEM_FiniteElementSpace_h
#define GridFEM_FiniteElementSpace_h

#include "Algebra/ColumnAlgebra.h"
#include "Integrals/DirectionalElements.h"
#include "Integrals/EdgeSamples.h"
#include "Integrals/SampledFunctions.h"
#include "Spaces/SurfaceSpace.h"

#include <memory>
#include <vector>

namespace gridfem
{

struct TriangleMetric;

/// A finite element space. The conventions of SurfaceSpace apply; one process holds the whole
/// space.
class FiniteElementSpace : public SurfaceSpace
{
public:
  /// Origin, in world coordinates, of positions in units of length.
  virtual Vec3 Origin() const = 0;

  const FiniteElementSpace* NestedLevels() const override { return nullptr; }

  ///@{ The finest level.

  /// Computes LoadOfGradients for the field n x s, with n along the normal of each triangle.
  virtual MultiVector LoadOfTurnedGradients(const Field& s, const Job& job = {}) const = 0;

  /// Computes LoadOfGradients for the field s = ∇u / |∇u|, or 0 where ∇u = 0.
  /// @param coefficients  functions u of the nested levels if the space has them, otherwise of the
  ///   space itself
  /// @return rows = functions of the space, columns as `coefficients`
  virtual MultiVector LoadOfDirections(
    const MultiVector& coefficients, const Field* scale, const Job& job = {}) const = 0;

  /// Returns the values of all functions at some points: rows = points, columns = functions. Throws
  /// InvalidInput for a point that the mesh does not have.
  virtual SparseMatrix RowsAtPoints(const std::vector<Id>& points) const = 0;

  /// Returns the values of all functions along segments of triangles, for integrals over curves.
  /// Throws InvalidInput for a triangle that the mesh does not have.
  virtual EdgeSamples SamplesOfSegments(const std::vector<TriangleSegment>& segments) const = 0;

  /// Returns the functions at samples that represent the whole surface, for integrals of terms that
  /// depend on a solution. Hat functions have a sample at each of their points; a term is linear in
  /// between.
  virtual SampledFunctions Samples(const Job& job = {}) const = 0;

  /// Returns the coefficients of the mesh's own coordinates, exact up to rounding: functions x 3,
  /// in units of length from the origin. A flow starts from them.
  virtual MultiVector EmbeddingOfMesh(const Job& job = {}) const = 0;
  ///@}

  ///@{ Changes the integrals on the same functions. A copy shares everything that does not change.
  virtual std::unique_ptr<FiniteElementSpace> Copy() const = 0;

  std::shared_ptr<const SurfaceSpace> WithWeightedMass(
    const std::vector<double>& weight, const Job& job = {}) const override
  {
    std::shared_ptr<FiniteElementSpace> weighted = this->Copy();
    weighted->WeighMass(weight, job);
    return weighted;
  }

  /// Computes all integrals except loads in the metric of an embedding. Loads remain integrals over
  /// the mesh. [T §5.1]
  /// @param embedding  functions x 3 coefficients, in units of length
  /// @param parts Mass: only the mass uses the metric. The stiffness must belong to the mesh and
  ///   does not change, as in the conformalized flow [T (6.2)]
  /// @return  number of samples whose metric is singular: they contribute nothing
  virtual Id SetMetric(
    const MultiVector& embedding, const Job& job = {}, ElementParts parts = ElementParts::Both) = 0;

  /// Computes all integrals in a metric that is constant on every triangle. This includes loads,
  /// except the loads of directions. Values and gradients on the mesh do not change.
  virtual void SetMetricOnTriangles(
    std::shared_ptr<const TriangleMetric> metric, const Job& job = {}) = 0;

  /// Changes the mass to ∫ w b_i b_j with a weight w >= 0 on each triangle, and Integrals() to
  /// ∫ w b_i. The stiffness and all loads do not change. The integrals use the metric of
  /// SetMetricOnTriangles if there is one, otherwise the mesh. Throws InvalidInput unless there is
  /// one finite weight per triangle.
  virtual void WeighMass(const std::vector<double>& weight, const Job& job = {}) = 0;

  /// Prepares for Weigh: splits the stiffness along and across a direction on each triangle.
  /// [T §5.2]
  virtual void SplitStiffness(const std::vector<Vec3>& direction, const Job& job = {}) = 0;

  /// Returns the area-weighted mean of values on triangles over each element that has its own
  /// weights.
  virtual MultiVector MeansOnElements(
    const MultiVector& onTriangles, const Job& job = {}) const = 0;

  /// Sets new weights of the elements. Requires SplitStiffness. [T (5.16)-(5.19)]
  virtual void Weigh(const std::vector<ElementWeights>& weights, const Job& job = {}) = 0;

  /// Returns ∫ scale <∇u, ∇b_i> for functions u of the space, with the metric and the weights of
  /// the stiffness. On a grid, it sums stored element matrices and does not visit the triangles.
  /// [T (5.19)]
  /// @param u      functions x columns
  /// @param scale  one number per element, as returned by MeansOnElements; empty: 1
  virtual MultiVector StiffnessTimes(
    const MultiVector& u, const std::vector<double>& scale, const Job& job = {}) const = 0;
  ///@}
};

} // namespace gridfem

#endif
