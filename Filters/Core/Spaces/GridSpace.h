// The functions of a grid as a finite element space: trilinear B-splines restricted to the surface
// and nested from level to level. [DESIGN §1, §2]
#ifndef GridFEM_GridSpace_h
#define GridFEM_GridSpace_h

#include "Integrals/SurfaceMetric.h"
#include "Spaces/CellSpace.h"
#include "Spaces/LevelOperators.h"

#include <optional>

namespace gridfem
{

/// The patches are the elements of Weigh and StiffnessTimes.
class GridSpace : public CellSpace<LevelOperators, PatchLevel>
{
public:
  using CellSpace::CellSpace;

  void FillMatrix(
    std::size_t level, double a, double b, SparseMatrix& matrix, const Job& job) const override;
  const std::vector<double>& Integrals() const override;
  Columns SquaredNorms(const MultiVector& u, const Job& job = {}) const override;
  MultiVector EmbeddingOfMesh(const Job& job = {}) const override;

  std::unique_ptr<FiniteElementSpace> Copy() const override;
  Id SetMetric(const MultiVector& embedding, const Job& job = {},
    ElementParts parts = ElementParts::Both) override;
  /// Works like SetMetric, with the metric of the mesh with moved points.
  Id SetMetricOfMesh(
    const TriangleMesh& moved, const Job& job = {}, ElementParts parts = ElementParts::Both);
  void SplitStiffness(const std::vector<Vec3>& direction, const Job& job = {}) override;
  MultiVector MeansOnElements(const MultiVector& onTriangles, const Job& job = {}) const override;
  void Weigh(const std::vector<ElementWeights>& weights, const Job& job = {}) override;
  MultiVector StiffnessTimes(
    const MultiVector& u, const std::vector<double>& scale, const Job& job = {}) const override;

  const GridFunctions& Functions() const { return *grid_; }
  const LevelOperators& Operators() const { return own_ ? *own_ : *operators_; }
  const TriangleMesh& Mesh() const { return *mesh_; }

private:
  const std::vector<PatchLevel>& Levels() const override { return grid_->levels; }
  Components FinestComponents() const override;
  void IntegrateTriangles(const std::vector<double>& weight, const Job& job) override;
  Id Integrate(const SampleMetric& metric, const Job& job, ElementParts parts);
  LevelOperators& OwnOperators();

  std::optional<LevelOperators> own_; // set once numbers have changed
  std::shared_ptr<const DirectionalElements> split_;
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
