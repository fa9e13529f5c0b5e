// Random clips, levels, matrices and metrics.
#include "Invariants.h"
#include "RandomProblem.h"

#include "Integrals/TriangleMetric.h"
#include "Largest.h"

#include <algorithm>
#include <cmath>
#include <numeric>

namespace gridfem::testing
{
namespace
{

void RequireArea(const TriangleMesh& mesh, const ClippedMesh& clipped, Outcome& outcome)
{
  double area = 0.0;
  double size = 0.0;
  for (Id piece = 0; piece < clipped.NumberOfPieces(); ++piece)
  {
    area += PieceArea(clipped, piece);
    size += 1.0;
  }
  const double cell = clipped.grid.spacing;
  const double exact = SurfaceArea(mesh);
  // Every piece has a few sides that are at most two cells long.
  const double allowed =
    1e-12 * exact + 10.0 * size * cell * cell * Displacement(mesh, clipped.grid);
  outcome.Require(std::abs(area * cell * cell - exact) <= allowed, "the clip has another area");
}

void RequireInsideCells(const TriangleMesh& mesh, const ClippedMesh& clipped, Outcome& outcome)
{
  const double allowed = Displacement(mesh, clipped.grid);
  bool isInside = true;
  for (Id piece = 0; piece < clipped.NumberOfPieces(); ++piece)
  {
    const CellIndex cell = MortonDecode(clipped.cells[clipped.CellOf(piece)]);
    for (Index k = clipped.pieceBegin[piece]; k < clipped.pieceBegin[piece + 1]; ++k)
    {
      for (int axis = 0; axis < 3; ++axis)
      {
        const double from = clipped.position[clipped.corners[k]][axis] - cell[axis];
        isInside = isInside && from > -allowed && from < 1.0 + allowed;
      }
    }
  }
  outcome.Require(isInside, "a piece is outside its cell");
}

/// Whether |A - Aᵀ| is at most rounding.
bool IsSymmetric(const SparseMatrix& A)
{
  const SparseMatrix transposed = Transpose(A);
  double largest = 0.0;
  for (std::size_t k = 0; k < A.value.size(); ++k)
  {
    largest = testing::Larger(largest, std::abs(A.value[k]));
  }
  for (std::size_t k = 0; k < A.value.size(); ++k)
  {
    if (!(std::abs(A.value[k] - transposed.value[k]) <= 1e-13 * largest))
    {
      return false;
    }
  }
  return true;
}

/// Whether P maps functions of the coarser level to the same functions of the finer level, so that
/// Pᵀ A P is the coarser A.
bool IsNested(Choice& choice, const FiniteElementSpace& space, std::size_t level)
{
  const SparseMatrix fine = space.Matrix(level, 1.0, 1.0);
  const SparseMatrix coarse = space.Matrix(level + 1, 1.0, 1.0);
  MultiVector x(coarse.rows, 1);
  for (Id i = 0; i < x.rows(); ++i)
  {
    x(i, 0) = choice.Real(-1.0, 1.0);
  }
  MultiVector prolonged;
  MultiVector product;
  MultiVector restricted;
  MultiVector direct;
  Multiply(space.Prolongation(level), x, prolonged);
  Multiply(fine, prolonged, product);
  Multiply(space.Restriction(level), product, restricted);
  Multiply(coarse, x, direct);
  return (restricted - direct).norm() <= 1e-11 * (direct.norm() + product.norm());
}

void RequireMatrices(
  Choice& choice, const FiniteElementSpace& space, std::size_t firstNested, Outcome& outcome)
{
  double largest = 0.0; // of this level and the finer levels that it is summed from
  for (std::size_t level = 0; level < space.NumberOfLevels(); ++level)
  {
    const SparseMatrix mass = space.Matrix(level, 1.0, 0.0);
    const SparseMatrix stiffness = space.Matrix(level, 0.0, 1.0);
    outcome.Require(IsSymmetric(mass) && IsSymmetric(stiffness), "a matrix is not symmetric");
    MultiVector product;
    Multiply(stiffness, MultiVector::Ones(stiffness.columns, 1), product);
    const std::vector<double> diagonal = stiffness.Diagonal();
    largest = std::accumulate(diagonal.begin(), diagonal.end(), largest, testing::Larger);
    outcome.Require(
      product.size() == 0 || product.cwiseAbs().maxCoeff<Eigen::PropagateNaN>() <= 1e-12 * largest,
      "constants have energy");
    if (level + 1 < space.NumberOfLevels() && level >= firstNested)
    {
      outcome.Require(IsNested(choice, space, level), "levels are not nested");
    }
  }
}

/// Requires that Σ ∫ b_i is the area.
void RequireIntegrals(
  const FiniteElementSpace& space, double area, double allowed, Outcome& outcome)
{
  double sum = 0.0;
  for (const double integral : space.Integrals())
  {
    sum += integral;
  }
  outcome.Require(
    std::abs(sum * std::pow(space.UnitLength(), 2) - area) <= allowed, "integrals miss the area");
}

/// Returns symmetric positive tensors of random size, orientation and anisotropy.
Field RandomTensors(Choice& choice, const TriangleMesh& mesh)
{
  const double ratio = choice.PowerOfTen(0.0, choice.OneIn(5) ? 20.0 : 4.0);
  Field tensors{ FieldAssociation::Triangles, MultiVector(mesh.triangles.size(), 6) };
  for (Id t = 0; t < tensors.values.rows(); ++t)
  {
    const Vec3 d = choice.Vector().normalized();
    const double scale = choice.PowerOfTen(-2.0, 2.0);
    const Eigen::Matrix3d tensor =
      scale * (Eigen::Matrix3d::Identity() + ratio * d * d.transpose());
    tensors.values.row(t) << tensor(0, 0), tensor(1, 1), tensor(2, 2), tensor(0, 1), tensor(1, 2),
      tensor(0, 2);
  }
  return tensors;
}

} // namespace

void CheckClip(Choice& choice, RandomSurface& surface, Outcome& outcome)
{
  ClipOptions options;
  options.depth = choice.OneIn(50) ? static_cast<int>(choice.Of({ -1, 15 }))
                                   : static_cast<int>(choice.Integer(2, 5));
  options.weldCoincidentPoints = surface.options.functions.weldCoincidentPoints;
  options.threads = surface.options.functions.threads;
  options.joinAtPoints = surface.options.functions.joinAtPoints;
  const ClippedMesh clipped = Clip(*surface.mesh, options);
  RequireInsideCells(*surface.mesh, clipped, outcome);
  if (HasOrdinarySize(clipped.grid))
  {
    RequireArea(*surface.mesh, clipped, outcome);
  }
  // The same must work with the pieces alone, as read from a file.
  ClippedMesh restored = clipped;
  restored.links = FindLinks(clipped, {});
  for (const FunctionSupport support :
    { FunctionSupport::Plain, FunctionSupport::ConnectivityAware })
  {
    BuildGridFunctions(restored, support, options.threads);
  }
}

void CheckSpaces(Choice& choice, RandomSurface& surface, Outcome& outcome)
{
  surface.Build();
  RequireMatrices(choice, *surface.space, surface.isOnHats ? 1 : 0, outcome);
  const Grid& grid = surface.grid->Functions().GetGrid();
  if (HasOrdinarySize(grid))
  {
    const double area = SurfaceArea(*surface.mesh);
    const double pieces = double(surface.grid->Functions().clipped.NumberOfPieces());
    // Hats leave out triangles flatter than 1e-10 of their longest edge.
    const double perPiece = 10.0 * std::pow(grid.spacing, 2) * Displacement(*surface.mesh, grid) +
                            1e-9 * std::pow(grid.spacing * grid.CellsPerSide(), 2);
    const double allowed = 1e-12 * area + pieces * perPiece;
    RequireIntegrals(*surface.space, area, allowed, outcome);
    if (surface.isChecked && !IsThin(*surface.mesh, grid))
    {
      RequireNoOrder(choice, surface, allowed, outcome);
      RequireNoWelding(choice, surface, allowed, outcome);
    }
    if (surface.isChecked)
    {
      RequireNoPlace(choice, surface, outcome);
    }
  }
  const MultiVector atPoints =
    surface.space->ValuesAtPoints(MultiVector::Ones(surface.space->NumberOfFunctions(0), 1));
  const std::vector<char> isReached = surface.space->PointsWithFunctions();
  bool isOne = true;
  for (Id point = 0; point < atPoints.rows(); ++point)
  {
    isOne = isOne && std::abs(atPoints(point, 0) - (isReached[point] ? 1.0 : 0.0)) < 1e-12;
  }
  outcome.Require(isOne, "functions do not add up to 1");
}

void CheckMetric(Choice& choice, RandomSurface& surface, Outcome& outcome)
{
  surface.Build();
  const std::unique_ptr<FiniteElementSpace> space = surface.space->Copy();
  const TriangleMesh& mesh = *surface.mesh;
  const Id kind = choice.Integer(0, 3);
  if (kind == 0)
  {
    space->SetMetricOnTriangles(
      std::make_shared<const TriangleMetric>(MetricOfTensors(mesh, RandomTensors(choice, mesh))));
  }
  else if (kind == 1)
  {
    MultiVector embedding = space->EmbeddingOfMesh();
    const double size = choice.PowerOfTen(-12.0, 3.0);
    for (Id k = 0; k < embedding.size(); ++k)
    {
      embedding.data()[k] += size * choice.Real(-1.0, 1.0);
    }
    space->SetMetric(embedding);
  }
  else if (kind == 2)
  {
    std::vector<double> weight(mesh.triangles.size());
    for (double& w : weight)
    {
      w = choice.OneIn(3) ? 0.0 : choice.PowerOfTen(-3.0, 3.0);
    }
    space->WeighMass(weight);
  }
  else
  {
    std::vector<Vec3> direction(mesh.triangles.size());
    for (Vec3& d : direction)
    {
      d = choice.OneIn(5) ? Vec3::Zero() : choice.Vector();
    }
    space->SplitStiffness(direction);
    const MultiVector onTriangles = MultiVector::Ones(mesh.triangles.size(), 1);
    std::vector<ElementWeights> weights(space->MeansOnElements(onTriangles).rows());
    for (ElementWeights& w : weights)
    {
      w = { choice.PowerOfTen(-3.0, 3.0),
        { choice.PowerOfTen(-3.0, 3.0), choice.PowerOfTen(-3.0, 3.0) } };
    }
    space->Weigh(weights);
  }
  RequireMatrices(choice, *space, surface.isOnHats ? 1 : 0, outcome);

  PoissonOptions options;
  options.screeningWeight = RandomWeight(choice);
  options.multigrid = RandomCycle(choice);
  options.solve = RandomSolve(choice);
  const Field f = OrdinaryField(choice, mesh, 1, FieldAssociation::Points);
  const Multigrid multigrid =
    BuildMultigrid(*space, options.screeningWeight, 1.0, options.multigrid);
  const PoissonSolution solution =
    SolvePoisson(*space, multigrid, space->LoadOfValues(f), {}, options);
  outcome.Add(solution.report);
  outcome.RequireFinite(solution.coefficients, "the solution in another metric");
}

} // namespace gridfem::testing
