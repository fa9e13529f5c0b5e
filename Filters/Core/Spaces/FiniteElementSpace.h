// What a solver has to know of the functions on a surface, whatever they are: the levels of a
// hierarchy, and on the finest one integrals and values. A problem asks a space, never which space
// it has. [DESIGN §5]
#ifndef GridFEM_FiniteElementSpace_h
#define GridFEM_FiniteElementSpace_h

#include "Algebra/ColumnAlgebra.h"
#include "Base/Job.h"
#include "Grid/Field.h"
#include "Integrals/DirectionalElements.h"
#include "Integrals/EdgeSamples.h"
#include "Multigrid/Multigrid.h"

#include <memory>
#include <vector>

namespace gridfem
{

struct TriangleMetric;

/// The connected components of the functions of one level.
struct Components
{
  std::vector<Index> ofFunction; // 0 .. count - 1
  Index count = 0;
};

/// How a level is relaxed.
struct LevelRelaxation
{
  PatchOrder order;
  PatchOrder groups;                       // relaxed together after a sweep over all; may be empty
  std::optional<LevelSmoothing> smoothing; // in place of the options of the hierarchy
};

/// Level 0 is the finest. All integrals are in the space's unit of length: mass in squared units,
/// stiffness without one. Const methods are safe to call from several threads, and all results are
/// the same, bit for bit, for any number of them. A method that takes a job throws Aborted.
class FiniteElementSpace
{
public:
  virtual ~FiniteElementSpace() = default;

  ///@{ Every level.
  virtual std::size_t NumberOfLevels() const = 0;
  virtual Index NumberOfFunctions(std::size_t level) const = 0;

  /// a M + b L, in place where the matrix has the level's pattern already.
  virtual void FillMatrix(
    std::size_t level, double a, double b, SparseMatrix& matrix, const Job& job) const = 0;
  SparseMatrix Matrix(std::size_t level, double a, double b, const Job& job = {}) const;

  /// From level + 1 to this level, and its transpose; not for the coarsest.
  virtual SharedMatrix Prolongation(std::size_t level) const = 0;
  virtual SharedMatrix Restriction(std::size_t level) const = 0;

  virtual LevelRelaxation Relaxation(std::size_t level, const MultigridOptions& options) const = 0;
  virtual Components ComponentsOf(std::size_t level, const Job& job = {}) const = 0;
  ///@}

  /// The levels below the finest as a space of their own, where the finest does not contain them;
  /// null where every level contains the next coarser one.
  virtual const FiniteElementSpace* NestedLevels() const { return nullptr; }

  /// World units per unit of length.
  virtual double UnitLength() const = 0;

  /// The place in the world that positions in units of length are relative to.
  virtual Vec3 Origin() const = 0;

  /// About the longest extent of the surface, in units of length.
  virtual double Extent() const = 0;

  ///@{ The finest level. Fields are given on the mesh, in world units; each method throws
  /// InvalidInput when their rows or columns do not fit.

  /// ∫ b_i.
  virtual const std::vector<double>& Integrals() const = 0;

  /// ∫ f b_i: rows = functions, columns = components of f.
  virtual MultiVector LoadOfValues(const Field& f, const Job& job = {}) const = 0;

  /// ∫ w f b_i with a weight w on each triangle.
  virtual MultiVector LoadOfWeightedValues(
    const Field& f, const std::vector<double>& weight, const Job& job = {}) const = 0;

  /// ∫ <s, ∇b_i> as the stiffness has it, without a unit. Vector c of s lies in columns 3c .. 3c+2;
  /// its part normal to the surface is ignored.
  /// @param scale  one column that multiplies s, or null
  /// @return rows = functions, one column per vector
  virtual MultiVector LoadOfGradients(
    const Field& s, const Field* scale, const Job& job = {}) const = 0;

  /// The same with n x s, n along the normal of each triangle.
  virtual MultiVector LoadOfTurnedGradients(const Field& s, const Job& job = {}) const = 0;

  /// The same with s = ∇u / |∇u|; 0 where ∇u = 0.
  /// @param coefficients  functions u of the nested levels, where the space has such below it, else
  ///   of the space itself
  /// @return rows = functions of the space, columns as `coefficients`
  virtual MultiVector LoadOfDirections(
    const MultiVector& coefficients, const Field* scale, const Job& job = {}) const = 0;

  /// The same with s = ∇f, f linear on each triangle (f must live on points).
  virtual MultiVector LoadOfGradientsOf(
    const Field& f, const Field* scale, const Job& job = {}) const = 0;

  /// The same for the coordinates of the mesh's points, with what they are in space: on a grid with
  /// a weight of the normal derivative they stay the solution of their own equation.
  virtual MultiVector LoadOfGradientsOfCoordinates(
    const Field* scale, const Job& job = {}) const = 0;

  /// Rows = points of the mesh; 0 at points that no function reaches.
  virtual MultiVector ValuesAtPoints(
    const MultiVector& coefficients, const Job& job = {}) const = 0;

  /// Mean surface gradients on the triangles, per world length: rows = triangles, three columns for
  /// each of the coefficients'; 0 on triangles without an area.
  virtual MultiVector GradientsOnTriangles(
    const MultiVector& coefficients, const Job& job = {}) const = 0;

  /// ∫ u² of every column, in squared units of length, for functions u of the space.
  virtual Columns SquaredNorms(const MultiVector& u, const Job& job = {}) const = 0;

  /// The values of all functions at some points: rows = points, columns = functions. Throws
  /// InvalidInput for a point that the mesh does not have.
  virtual SparseMatrix RowsAtPoints(const std::vector<Id>& points) const = 0;

  /// The values of all functions along segments of triangles, for integrals over curves. Throws
  /// InvalidInput for a triangle that the mesh does not have.
  virtual EdgeSamples SamplesOfSegments(const std::vector<TriangleSegment>& segments) const = 0;

  /// Per point of the mesh: 1 where a function reaches it.
  virtual std::vector<char> PointsWithFunctions() const = 0;

  /// The coefficients of the mesh's own coordinates, exact but for rounding: functions x 3, in
  /// units of length from the origin. What a flow starts from.
  virtual MultiVector EmbeddingOfMesh(const Job& job = {}) const = 0;
  ///@}

  ///@{ Other numbers on the same functions. A copy shares all that does not change.
  virtual std::unique_ptr<FiniteElementSpace> Copy() const = 0;

  /// All integrals in the metric of an embedding, but for loads, which stay those of the mesh.
  /// [T §5.1]
  /// @param embedding  functions x 3 coefficients, in units of length
  /// @return  number of samples whose metric is singular: they contribute nothing
  virtual Id SetMetric(const MultiVector& embedding, const Job& job = {}) = 0;

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

  /// a ∫ u b_i + b ∫ scale <∇u, ∇b_i> for functions u of the space, as mass and stiffness have it:
  /// in the same metric and with the same weights. Sums what the elements keep, on a grid without
  /// a look at the triangles.
  /// @param u      functions x columns
  /// @param scale  one number per element, as from MeansOnElements; empty: 1
  virtual MultiVector LoadOfFunction(double a, double b, const MultiVector& u,
    const std::vector<double>& scale, const Job& job = {}) const = 0;
  ///@}
};

/// a M + b L on every level, ready to cycle.
Multigrid BuildMultigrid(const FiniteElementSpace& space, double a, double b,
  const MultigridOptions& options, const Progress& progress = {});

/// New values, in place, for a hierarchy of the same space or of a copy of it.
void UpdateMultigrid(const FiniteElementSpace& space, double a, double b, Multigrid& multigrid);

/// The levels of a hierarchy, as Multigrid takes them.
std::vector<MultigridLevel> BuildMultigridLevels(const FiniteElementSpace& space, double a,
  double b, const MultigridOptions& options, const Progress& progress = {});

} // namespace gridfem

#endif
