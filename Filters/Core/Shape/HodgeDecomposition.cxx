#include "Shape/HodgeDecomposition.h"

#include "Base/Errors.h"
#include "Base/VectorRows.h"
#include "Equations/EdgeConditions.h"
#include "Equations/L2Projection.h"
#include "Equations/PointConstraints.h"
#include "Grid/SurfaceEdges.h"
#include "Shape/MovedSurface.h"

namespace gridfem
{
namespace
{

/// Means over the triangles of the tangential part of v.
MultiVector TangentialMeans(
  const TriangleMesh& mesh, const std::vector<Vec3>& normals, const Field& v)
{
  MultiVector means(static_cast<Id>(mesh.triangles.size()), 3);
  for (Id t = 0; t < means.rows(); ++t)
  {
    const auto row = v.RowsOf(t, mesh.triangles[t]);
    const Vec3 mean =
      (v.values.row(row[0]) + v.values.row(row[1]) + v.values.row(row[2])).transpose() / 3.0;
    SetRow(means, t, mean - normals[t].dot(mean) * normals[t]);
  }
  return means;
}

/// ∫ <v, n x ∇b_i>
MultiVector LoadOfRotation(const FiniteElementSpace& space, const Field& v,
  const MultiVector& onTriangles, const SurfaceEdges& edges, const Job& job)
{
  if (edges.IsOriented())
  {
    return -space.LoadOfTurnedGradients(v, job); // <v, n x ∇b> = -<n x v, ∇b>
  }
  Field facing{ FieldAssociation::Triangles, onTriangles };
  for (Id t = 0; t < onTriangles.rows(); ++t)
  {
    facing.values.row(t) *= edges.side[t];
  }
  return -space.LoadOfTurnedGradients(facing, job);
}

/// Solves L x = load without a condition at boundaries. Each column has mean 0.
MultiVector SolveFree(const FiniteElementSpace& space, const MultiVector& load,
  const HodgeOptions& options, HodgeDecomposition& parts, const Job& job)
{
  const Multigrid multigrid =
    BuildMultigrid(space, 0.0, 1.0, options.multigrid, job.progress.Part(0.0, 0.3));
  PoissonOptions poisson{ options, 0.0 };
  poisson.estimateErrors = true;
  PoissonSolution solution = SolvePoisson(space, multigrid,
    MultiVector::Zero(load.rows(), load.cols()), load, poisson, job.progress.Part(0.3, 1.0));
  KeepWorse(solution.accuracy, parts.accuracy);
  KeepWorse(std::move(solution.report), parts.report);
  return std::move(solution.coefficients);
}

/// Tolerance of the energy residual if the option is 0.
constexpr double HeldTolerance = 1e-4;

/// Solves L x = load with the value 0 on some edges.
MultiVector SolveHeld(const FiniteElementSpace& space, HeldRows rows, const MultiVector& load,
  const HodgeOptions& options, HodgeDecomposition& parts, const Job& job)
{
  SolveOptions solve = options.solve;
  solve.tolerance = solve.tolerance > 0.0 ? solve.tolerance : HeldTolerance;
  ConstraintOptions constraints;
  constraints.tolerance = std::max(constraints.tolerance, solve.tolerance);
  constraints.maximumSteps = 3; // functions cannot meet the rest
  constraints.estimateOn = &space;
  const MultiVector zero = MultiVector::Zero(rows.rows, load.cols());
  const ConstrainedHierarchy hierarchy(space, 0.0, 1.0, std::move(rows), constraints.penalty,
    options.multigrid, job.progress.Part(0.0, 0.3));
  ConstrainedSolution solution = SolveConstrained(
    space, 0.0, hierarchy, load, zero, constraints, solve, job.progress.Part(0.3, 1.0));
  SetMeans(space, solution.isHeld,
    MultiVector::Zero(static_cast<Id>(solution.isHeld.size()), load.cols()), solution.coefficients,
    job.threads);
  KeepWorse(solution.accuracy, parts.accuracy);
  KeepWorse(std::move(solution.report), parts.report);
  return std::move(solution.coefficients);
}

/// Coefficients of u and of w. w is 0 where the surface ends.
MultiVector SolvePotentials(const FiniteElementSpace& space, const TriangleMesh& mesh,
  const SurfaceEdges& edges, const MultiVector& load, const HodgeOptions& options,
  HodgeDecomposition& parts, const Job& job)
{
  std::vector<TriangleEdge> ends = edges.boundary;
  ends.insert(ends.end(), edges.branching.begin(), edges.branching.end());
  if (ends.empty())
  {
    return SolveFree(space, load, options, parts, job);
  }
  HeldValues held =
    HoldEdges(space, mesh, ends, MultiVector::Zero(static_cast<Id>(mesh.points.size()), 1));
  MultiVector potentials(load.rows(), 2);
  potentials.col(0) = SolveFree(space, load.col(0), options, parts, job.Part(0.0, 0.5));
  potentials.col(1) =
    SolveHeld(space, std::move(held.rows), load.col(1), options, parts, job.Part(0.5, 1.0));
  return potentials;
}

/// n x the gradients; 0 on components without two sides.
MultiVector Turned(const MultiVector& gradients, const std::vector<Vec3>& normals,
  const std::vector<signed char>& side)
{
  MultiVector turned(gradients.rows(), 3);
  for (Id t = 0; t < turned.rows(); ++t)
  {
    const Vec3 gradient = gradients.row(t).transpose();
    SetRow(turned, t, side[t] * normals[t].cross(gradient));
  }
  return turned;
}

void ProjectToPoints(const FiniteElementSpace& space, const HodgeOptions& options,
  HodgeDecomposition& parts, const Job& job)
{
  Field all{ FieldAssociation::Triangles, MultiVector(parts.restOnTriangles.rows(), 9) };
  all.values << parts.gradientOnTriangles, parts.rotationOnTriangles, parts.restOnTriangles;
  L2Projection projection(space, options, job.Part(0.0, 0.3));
  const MultiVector atPoints = space.ValuesAtPoints(
    projection.Solve(space.LoadOfValues(all, job.Part(0.3, 0.5)), {}, job.Part(0.5, 1.0)),
    job.threads);
  parts.gradientAtPoints = atPoints.leftCols(3);
  parts.rotationAtPoints = atPoints.middleCols(3, 3);
  parts.restAtPoints = atPoints.rightCols(3);
  KeepWorse(projection.accuracy, parts.accuracy);
  KeepWorse(std::move(projection.report), parts.report);
}

} // namespace

HodgeDecomposition DecomposeField(const FiniteElementSpace& space, const TriangleMesh& mesh,
  const Field& v, const HodgeOptions& options, const Job& job)
{
  RequireVectors(v, mesh);
  if (v.values.cols() != 3)
  {
    throw InvalidInput("A field to be decomposed needs three components.");
  }
  const SurfaceEdges edges = FindSurfaceEdges(mesh, options.weldCoincidentPoints, job.threads);
  job.Check(0.1);
  const std::vector<Vec3> normals = NormalsOfTriangles(mesh);
  const MultiVector onTriangles = TangentialMeans(mesh, normals, v);
  MultiVector load(space.NumberOfFunctions(0), 2);
  load.col(0) = space.LoadOfGradients(v, nullptr, job.Part(0.1, 0.15));
  load.col(1) = LoadOfRotation(space, v, onTriangles, edges, job.Part(0.15, 0.2));

  HodgeDecomposition parts;
  parts.report = SolveReport::Solved();
  parts.accuracy = SolutionAccuracy::Exact();
  parts.numberOfComponents = edges.numberOfComponents;
  parts.numberOfOneSided = edges.numberOfOneSided;
  const MultiVector potentials =
    SolvePotentials(space, mesh, edges, load, options, parts, job.Part(0.2, 0.7));
  const MultiVector gradients = space.GradientsOnTriangles(potentials, job.threads);
  parts.gradientOnTriangles = gradients.leftCols(3);
  parts.rotationOnTriangles = Turned(gradients.rightCols(3), normals, edges.side);
  parts.restOnTriangles = onTriangles - parts.gradientOnTriangles - parts.rotationOnTriangles;
  const MultiVector atPoints = space.ValuesAtPoints(potentials, job.threads);
  parts.potentialAtPoints = atPoints.leftCols(1);
  parts.streamAtPoints = atPoints.rightCols(1);
  ProjectToPoints(space, options, parts, job.Part(0.7, 1.0));
  return parts;
}

} // namespace gridfem
