// Random shapes, and fields on them.
#include "RandomProblem.h"

#include "Shape/HodgeDecomposition.h"
#include "Shape/MeanCurvatureFlow.h"
#include "Shape/MovedSurface.h"
#include "Shape/Stitching.h"
#include "Shape/SurfaceDerivatives.h"
#include "Shape/SurfaceDetail.h"

#include <algorithm>
#include <cmath>

namespace gridfem::testing
{
namespace
{

/// Whether all used points are finite. Points that no triangle uses may be anything.
bool AreFinite(const TriangleMesh& mesh, const std::vector<Vec3>& points)
{
  for (const auto& corner : mesh.triangles)
  {
    if (!points[corner[0]].allFinite() || !points[corner[1]].allFinite() ||
        !points[corner[2]].allFinite())
    {
      return false;
    }
  }
  return true;
}

HatFunctions HatsOf(const RandomSurface& surface)
{
  HatOptions options;
  options.weldCoincidentPoints = surface.options.functions.weldCoincidentPoints;
  options.unitLength = surface.space->UnitLength();
  return NumberHatFunctions(*surface.mesh, options);
}

} // namespace

void Stitch(Choice& choice, RandomSurface& surface, Outcome& outcome)
{
  surface.options.functions.connectivityAware = true;
  surface.Build();
  const TriangleMesh& mesh = *surface.mesh;
  ScanLabels labels;
  labels.association = choice.Of({ FieldAssociation::Points, FieldAssociation::Triangles });
  labels.values.resize(
    labels.association == FieldAssociation::Points ? mesh.points.size() : mesh.triangles.size());
  for (Index& label : labels.values)
  {
    label = static_cast<Index>(
      choice.OneIn(500) ? choice.Of<Id>({ -1, 2147483647 }) : choice.Integer(0, 2));
  }
  const FieldAssociation where =
    choice.Of({ FieldAssociation::Points, FieldAssociation::Triangles });
  const Field colors = OrdinaryField(choice, mesh, 3, where);
  const ScanCut cut = CutAtSeams(mesh, labels, where);
  StitchOptions options;
  options.blendWidth = choice.OneIn(2) ? 0.0 : choice.PowerOfTen(-3.0, 1.0);
  options.multigrid = RandomCycle(choice);
  options.solve = RandomSolve(choice);
  if (choice.OneIn(3))
  {
    options.reference = static_cast<Index>(choice.Integer(0, 3));
  }
  std::unique_ptr<GridSpace> details;
  if (choice.OneIn(2) && !cut.pieces.triangles.empty())
  {
    GridSpaceOptions ofDetails = surface.options;
    ofDetails.functions.weldCoincidentPoints = false;
    details = std::make_unique<GridSpace>(BuildGridSpace(cut.pieces, ofDetails));
  }
  const StitchedColors stitched =
    StitchColors(*surface.space, mesh, cut, colors, options, details.get());
  outcome.Add(stitched.report);
  outcome.RequireFinite(stitched.values, "a stitched color");
  outcome.Require(stitched.values.rows() == colors.values.rows(), "colors are missing");
}

void Flow(Choice& choice, RandomSurface& surface, Outcome& outcome)
{
  surface.Build();
  const TriangleMesh& mesh = *surface.mesh;
  FlowOptions options;
  options.timeStep = choice.PowerOfTen(-6.0, 4.0);
  options.conformalized = choice.OneIn(2);
  options.rescaling =
    choice.Of({ Rescaling::None, Rescaling::ConstantArea, Rescaling::ConstantVolume });
  options.multigrid.threads = 1;
  if (!options.conformalized && choice.OneIn(3))
  {
    options.rescaling = Rescaling::None;
    options.fixed = BoundaryOf(mesh, surface.options.functions.weldCoincidentPoints);
  }
  if (!options.conformalized && choice.OneIn(4))
  {
    options.rebuild = [&surface](const TriangleMesh& moved, const Job&)
    { return std::make_unique<GridSpace>(BuildGridSpace(moved, surface.options)); };
  }
  MeanCurvatureFlow flow(surface.space, surface.mesh, options);
  outcome.Require(AreFinite(mesh, flow.Points()), "the start is not finite");
  for (Id step = choice.Integer(1, 4); step > 0; --step)
  {
    const FlowStep made = flow.Advance({});
    if (made.end != FlowEnd::None)
    {
      break;
    }
    outcome.isIterative = true;
    outcome.converged = outcome.converged && made.converged;
    outcome.Require(!made.converged || std::isfinite(made.area), "an area is not finite");
    outcome.RequireEstimate(made.accuracy);
  }
  outcome.Require(AreFinite(mesh, flow.Points()), "a moved point is not finite");
}

void ChangeDetail(Choice& choice, RandomSurface& surface, Outcome& outcome)
{
  surface.Build();
  const TriangleMesh& mesh = *surface.mesh;
  std::unique_ptr<FiniteElementSpace> space = surface.space->Copy();
  const HatFunctions hats = HatsOf(surface);
  if (choice.OneIn(2))
  {
    const TriangleCurvatures curvatures =
      CurvaturesOnTriangles(mesh, ComputeCurvatures(mesh, hats, PointNormals(mesh, hats)));
    const double usual = UsualCurvature(mesh, curvatures);
    space->SplitStiffness(curvatures.direction);
    const double most = choice.PowerOfTen(-3.0, 3.0);
    space->Weigh(WeightsOfMetric(space->MeansOnElements(curvatures.values),
      [&](double curvature) { return curvature > usual ? most : 1.0; }));
  }
  PoissonOptions options;
  options.screeningWeight = RandomWeight(choice);
  options.multigrid = RandomCycle(choice);
  options.solve = RandomSolve(choice);
  const SignalInSpace signal =
    choice.OneIn(2) ? ShapeInSpace(*space)
                    : ProjectSignal(*space, RandomField(choice, mesh, 2, FieldAssociation::Points),
                        options.multigrid, options.solve);
  const MultiVector load = space->StiffnessTimes(signal.coefficients, {});
  const Multigrid multigrid =
    BuildMultigrid(*space, options.screeningWeight, 1.0, options.multigrid);
  const PoissonSolution solution =
    SolvePoisson(*space, multigrid, MultiVector::Zero(load.rows(), load.cols()), load, options);
  outcome.Add(solution.report);
  outcome.RequireFinite(solution.coefficients, "the detail");
  std::vector<Vec3> points = mesh.points;
  ScaleToVolume(mesh, UsedPoints(mesh), points);
  outcome.Require(AreFinite(mesh, points), "a scaled point is not finite");
}

void FindCurvatures(Choice& choice, RandomSurface& surface, Outcome& outcome)
{
  surface.Build();
  const TriangleMesh& mesh = *surface.mesh;
  const HatFunctions hats = HatsOf(surface);
  MultiVector normals = PointNormals(mesh, hats);
  outcome.Require(normals.allFinite(), "a normal is not finite");
  if (choice.OneIn(2))
  {
    NormalSmoothing smoothing;
    smoothing.scale = choice.PowerOfTen(-3.0, 3.0) * surface.space->UnitLength();
    smoothing.multigrid = RandomCycle(choice);
    smoothing.solve = RandomSolve(choice);
    SolveReport report;
    normals = SmoothNormals(*surface.space, normals, smoothing, report);
    outcome.Add(report);
    outcome.RequireFinite(normals, "a smoothed normal");
  }
  const PrincipalCurvatures found = ComputeCurvatures(mesh, hats, normals);
  for (std::size_t point = 0; point < mesh.points.size(); ++point)
  {
    outcome.Require(!outcome.converged || (std::isfinite(found.minimum[point]) &&
                                            found.minimum[point] <= found.maximum[point]),
      "curvatures are not finite or not in order");
    const double shape = ShapeIndex(found.minimum[point], found.maximum[point]);
    outcome.Require(!outcome.converged || std::abs(shape) <= 1.0, "a shape index is out of range");
  }
}

void Decompose(Choice& choice, RandomSurface& surface, Outcome& outcome)
{
  surface.Build();
  HodgeOptions options;
  options.multigrid = RandomCycle(choice);
  options.solve = RandomSolve(choice);
  options.weldCoincidentPoints = surface.options.functions.weldCoincidentPoints;
  const Field v = RandomField(
    choice, *surface.mesh, 3, choice.Of({ FieldAssociation::Points, FieldAssociation::Triangles }));
  const HodgeDecomposition parts = DecomposeField(*surface.space, *surface.mesh, v, options);
  outcome.Add(parts.report);
  outcome.RequireFinite(parts.gradientOnTriangles, "a gradient");
  outcome.RequireFinite(parts.rotationOnTriangles, "a rotation");
  // No integral sees a NaN on a triangle without area.
  outcome.Require(!v.values.allFinite() || !outcome.converged || parts.restOnTriangles.allFinite(),
    "a rest is not finite");
  outcome.RequireFinite(parts.potentialAtPoints, "a potential");
  outcome.RequireFinite(parts.streamAtPoints, "a stream function");
}

void Derive(Choice& choice, RandomSurface& surface, Outcome& outcome)
{
  surface.Build();
  EquationOptions options;
  options.multigrid = RandomCycle(choice);
  options.solve = RandomSolve(choice);
  const Field f = RandomField(choice, *surface.mesh, choice.Integer(1, 3),
    choice.Of({ FieldAssociation::Points, FieldAssociation::Triangles }));
  const SurfaceDerivatives found =
    ComputeDerivatives(*surface.space, *surface.mesh, f, nullptr, options);
  outcome.Add(found.report);
  outcome.RequireFinite(found.gradientOnTriangles, "a gradient");
  outcome.RequireFinite(found.gradientAtPoints, "a gradient at a point");
  outcome.RequireFinite(found.laplacianAtPoints, "a Laplacian");
  outcome.RequireFinite(found.divergenceAtPoints, "a divergence");
  outcome.RequireFinite(found.curlAtPoints, "a curl");
}

} // namespace gridfem::testing
