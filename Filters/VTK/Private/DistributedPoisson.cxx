#include "DistributedPoisson.h"

#if GRIDFEM_HAS_PARALLEL

#include "DistributedSpace.h"

#include "Parallel/RankPoisson.h"
#include "vtkSurfaceFEMAlgorithm.h"

#include "vtkDataArray.h"

#include <algorithm>
#include <optional>

namespace gridfem
{
namespace
{

/// A chosen array as all ranks see it, also those whose piece is empty.
struct Shape
{
  int columns = 0; // 0: no array
  int isOnCells = 0;
  int dataType = 0;
};

/// Collective.
Shape ShapeOf(const Communicator& ranks, const InputArray& array)
{
  Shape own;
  if (array.array)
  {
    own = { array.array->GetNumberOfComponents(),
      array.association == FieldAssociation::Triangles ? 1 : 0, array.array->GetDataType() };
  }
  Shape whole;
  std::vector<Shape> all = ranks.Gather(std::vector<Shape>{ own });
  for (const Shape& shape : all)
  {
    whole = whole.columns == 0 ? shape : whole;
  }
  ranks.Together(
    [&]
    {
      if (own.columns > 0 && (own.columns != whole.columns || own.isOnCells != whole.isOnCells))
      {
        throw InvalidInput("Array '" + array.name +
                           "' has other components here than on another rank, or is of cells here "
                           "and of points there.");
      }
    });
  return whole;
}

/// Collective. A field on the mesh that this rank has received.
std::optional<Field> SendField(
  const RankSpace& space, const InputMesh& mesh, const InputArray& array, const Shape& shape)
{
  if (shape.columns == 0)
  {
    return std::nullopt;
  }
  Field field;
  field.association = shape.isOnCells ? FieldAssociation::Triangles : FieldAssociation::Points;
  MultiVector own(0, shape.columns);
  space.Ranks().Together(
    [&]
    {
      if (array.array)
      {
        own = ReadField(array, mesh).values;
      }
    });
  field.values = shape.isOnCells ? space.Distribution().SendTriangles(own)
                                 : space.Distribution().SendPoints(own);
  return field;
}

/// Collective. λ per squared side of a cell.
double WeightInCells(const RankSpace& space, const InputMesh& mesh, double weight, int units)
{
  const double side = space.Own().UnitLength();
  double area = SurfaceArea(*mesh.triangles);
  space.Ranks().Sum(&area, 1);
  if (!(area > 0.0))
  {
    throw InvalidInput("The surface has no area: all polygons are degenerate.");
  }
  const double cube = side * space.Own().Extent();
  const double length2 = units == vtkSurfaceFEMAlgorithm::UnitArea   ? area
                         : units == vtkSurfaceFEMAlgorithm::UnitCube ? cube * cube
                                                                     : 1.0;
  return weight / length2 * side * side;
}

DistributedSolution Solve(const Communicator& ranks, const InputMesh& mesh,
  const DistributedRequest& request, const SurfaceOptions& options, const Progress& progress)
{
  const Shape value = ShapeOf(ranks, request.value);
  const Shape gradient = ShapeOf(ranks, request.gradient);
  const Shape scale = ShapeOf(ranks, request.scale);
  const RankSpaceOptions spaceOptions = DistributedOptions(ranks, options);
  const RankSpace space(ranks, *mesh.triangles, spaceOptions, progress.Part(0.0, 0.4));

  const std::optional<Field> given = SendField(space, mesh, request.value, value);
  const std::optional<Field> vectors = SendField(space, mesh, request.gradient, gradient);
  const std::optional<Field> factor = SendField(space, mesh, request.scale, scale);
  MultiVector values;
  MultiVector gradients;
  ranks.Together(
    [&]
    {
      const FiniteElementSpace& own = space.Own();
      const Job job(spaceOptions.space.functions.threads, progress.Part(0.4, 0.5));
      const Field* const factors = factor ? &*factor : nullptr;
      values = own.LoadOfValues(given ? *given : CoordinatesOf(space.Own().Mesh()), job);
      if (vectors)
      {
        gradients = own.LoadOfGradients(*vectors, factors, job);
      }
      else if (request.useValueGradient)
      {
        gradients = given ? own.LoadOfGradientsOf(*given, factors, job)
                          : own.LoadOfGradientsOfCoordinates(factors, job);
      }
      gradients *= request.gradientScale;
    });

  PoissonOptions poisson;
  poisson.screeningWeight = WeightInCells(space, mesh, request.weight, options.parameterUnits);
  poisson.multigrid = options.multigrid;
  poisson.multigrid.threads = spaceOptions.space.functions.threads;
  poisson.solve = options.solve;
  poisson.accuracy = options.accuracy;
  poisson.estimateErrors = true;
  PoissonSolution found = SolvePoisson(space, values, gradients, poisson, progress.Part(0.5, 1.0));
  DistributedSolution solution;
  solution.values = space.ValuesAtPoints(
    found.coefficients, static_cast<Id>(mesh.triangles->points.size()), &solution.isSolved);
  solution.dataType = request.value.array || value.columns > 0 ? value.dataType : 0;
  solution.report = std::move(found.report);
  solution.accuracy = found.accuracy;
  return solution;
}

} // namespace

DistributedSolution SolveDistributed(const InputMesh& mesh, const DistributedRequest& request,
  const SurfaceOptions& options, const Progress& progress)
{
  return OnRanksOfVtk(
    [&](const Communicator& ranks) { return Solve(ranks, mesh, request, options, progress); });
}

} // namespace gridfem

#else

namespace gridfem
{

DistributedSolution SolveDistributed(
  const InputMesh&, const DistributedRequest&, const SurfaceOptions&, const Progress&)
{
  throw InvalidInput("This build has no MPI.");
}

} // namespace gridfem

#endif
