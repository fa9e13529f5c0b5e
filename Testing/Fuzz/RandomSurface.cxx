#include "RandomSurface.h"

#include "Grid/RequireSurface.h"

#include <limits>
#include <sstream>

namespace gridfem::testing
{
namespace
{

void ChooseIntegrals(Choice& choice, GridSpaceOptions& options)
{
  options.quadratureDegree = choice.Of({ 2, 2, 4, 6, 10, 12 });
  options.coarsestSize = static_cast<Index>(choice.Of({ 256, 64, 8, 1 }));
  options.normalStabilization = choice.Of({ DefaultNormalStabilization, 1e-2, 0.1, 1.0, 1e-14 });
}

Id RowsOf(const TriangleMesh& mesh, FieldAssociation where)
{
  const Id triangles = static_cast<Id>(mesh.triangles.size());
  return where == FieldAssociation::Points      ? static_cast<Id>(mesh.points.size())
         : where == FieldAssociation::Triangles ? triangles
                                                : 3 * triangles;
}

/// Fills a column with a constant, rough numbers or waves along the rows.
void FillColumn(Choice& choice, MultiVector& values, Id column)
{
  const Id kind = choice.Integer(0, 3);
  const double wave = choice.PowerOfTen(-2.0, 0.5);
  for (Id row = 0; row < values.rows(); ++row)
  {
    values(row, column) = kind == 0   ? 1.0
                          : kind == 1 ? std::sin(wave * double(row))
                                      : choice.Real(-1.0, 1.0);
  }
}

} // namespace

void RandomSurface::Build()
{
  if (isChecked)
  {
    RequireSurface(*mesh);
  }
  if (isOnHats)
  {
    const auto hats = std::make_shared<HatSpace>(BuildHatSpace(*mesh, options));
    space = hats;
    grid = &hats->Grid();
  }
  else
  {
    const auto functions = std::make_shared<GridSpace>(BuildGridSpace(*mesh, options));
    space = functions;
    grid = functions.get();
  }
}

std::string RandomSurface::Describe() const
{
  std::ostringstream text;
  text << name << "; " << mesh->triangles.size() << " triangles, "
       << (isOnHats ? "hats, depth " : "depth ") << options.functions.depth
       << (options.functions.connectivityAware ? "" : ", plain")
       << (options.functions.weldCoincidentPoints ? "" : ", not welded")
       << (options.functions.joinAtPoints ? ", joined at points" : "")
       << (isChecked ? "" : ", unchecked");
  return text.str();
}

RandomSurface MakeRandomSurface(Choice& choice, bool isDefault)
{
  RandomMesh made = MakeRandomMesh(choice);
  RandomSurface surface;
  surface.name = made.name;
  surface.mesh = std::make_shared<const TriangleMesh>(std::move(made.mesh));
  SpaceOptions& functions = surface.options.functions;
  functions.depth = choice.OneIn(80) ? 5 : choice.Of({ 2, 2, 2, 2, 3, 3, 3, 3, 4 });
  functions.connectivityAware = !choice.OneIn(3);
  functions.weldCoincidentPoints = !choice.OneIn(4);
  functions.joinAtPoints = choice.OneIn(8);
  functions.threads = static_cast<int>(choice.Of({ 1, 1, 1, 2 }));
  surface.isOnHats = choice.OneIn(3);
  surface.isChecked = isDefault || !choice.OneIn(10);
  if (!isDefault)
  {
    ChooseIntegrals(choice, surface.options);
  }
  return surface;
}

MultigridOptions RandomCycle(Choice& choice)
{
  MultigridOptions options;
  options.cycle = choice.Of({ CycleType::V, CycleType::W });
  options.smoother =
    choice.Of({ SmootherType::Patch, SmootherType::GaussSeidel, SmootherType::SliceGaussSeidel });
  options.preSweeps = options.postSweeps = static_cast<int>(choice.Of({ 1, 1, 2, 0 }));
  options.precision =
    choice.Of({ FactorPrecision::Mixed, FactorPrecision::Single, FactorPrecision::Double });
  options.sweepsPerSynchronization = static_cast<int>(choice.Integer(1, 3));
  options.threads = static_cast<int>(choice.Of({ 1, 1, 2 }));
  return options;
}

SolveOptions RandomSolve(Choice& choice)
{
  SolveOptions options;
  options.tolerance = choice.PowerOfTen(-14.0, 1.0);
  options.maximumIterations = static_cast<int>(choice.Of({ 1, 5, 20, 60 }));
  options.measure = choice.Of({ SolveOptions::Measure::Energy, SolveOptions::Measure::Residual });
  options.giveUp = choice.Of({ SolveOptions::GiveUp::Never, SolveOptions::GiveUp::AtStandstill,
    SolveOptions::GiveUp::WhenTooSlow });
  return options;
}

Field OrdinaryField(Choice& choice, const TriangleMesh& mesh, Id columns, FieldAssociation where)
{
  Field field{ where, MultiVector(RowsOf(mesh, where), columns) };
  for (Id column = 0; column < columns; ++column)
  {
    FillColumn(choice, field.values, column);
  }
  return field;
}

Field RandomField(Choice& choice, const TriangleMesh& mesh, Id columns, FieldAssociation where)
{
  Field field = OrdinaryField(choice, mesh, columns, where);
  for (Id column = 0; column < columns; ++column)
  {
    field.values.col(column) *= choice.OneIn(4) ? choice.Of({ 0.0, 1e-300, 1e-30, 1e30, 1e300 })
                                                : choice.PowerOfTen(-3.0, 3.0);
  }
  if (choice.OneIn(20) && field.values.size() > 0)
  {
    field.values.data()[choice.Integer(0, field.values.size() - 1)] = choice.Of(
      { std::numeric_limits<double>::quiet_NaN(), std::numeric_limits<double>::infinity() });
  }
  return field;
}

std::vector<Id> RandomPoints(Choice& choice, const TriangleMesh& mesh, Id most)
{
  const Id count = static_cast<Id>(mesh.points.size());
  std::vector<Id> points;
  for (Id k = choice.Integer(0, most); k > 0 && count > 0; --k)
  {
    points.push_back(
      choice.OneIn(200) ? choice.Of<Id>({ -1, count }) : choice.Integer(0, count - 1));
  }
  return points;
}

double RandomWeight(Choice& choice)
{
  return choice.OneIn(6) ? 0.0 : choice.PowerOfTen(-12.0, 6.0);
}

} // namespace gridfem::testing
