// The spaces on a basis, and the grid that replaces the grid of the basis below hat functions.
#include "Solvers/SurfaceBasis.h"

#include "Meshes.h"

#include <gtest/gtest.h>

using namespace gridfem;
using namespace gridfem::testing;

namespace
{

/// Two spheres that share a point: one component of hats, two of the grid.
TriangleMesh TouchingSpheres(int fineness)
{
  const TriangleMesh sphere = Transform(GeodesicSphere(fineness), { 1, 2, 3 }, 0.4);
  const Vec3 shared = sphere.points[0];
  TriangleMesh other = Transform(sphere, { 1, 0, 0 }, 0.0, 1.0, 2.0 * shared);
  for (Vec3& point : other.points)
  {
    point = (point - shared).norm() < 1e-9 ? shared : point;
  }
  return Join(sphere, other);
}

HatSpace SpaceOn(const SurfaceBasis& basis, const SpaceChoice& choice)
{
  return dynamic_cast<const HatSpace&>(*MakeSpace(basis, choice, {}));
}

void ExpectOptions(const HatSpace& space, const OperatorOptions& options)
{
  ASSERT_NE(space.Hats().joinedGrid, nullptr);
  const LevelOperators& operators = space.Grid().Operators();
  EXPECT_EQ(operators.normalStabilization, options.normalStabilization);
  EXPECT_EQ(operators.quadratureDegree, options.quadratureDegree);
  const std::size_t levels = space.NumberOfLevels();
  EXPECT_LE(space.NumberOfFunctions(levels - 1), options.coarsestSize);
  EXPECT_GT(space.NumberOfFunctions(levels - 2), options.coarsestSize);
}

} // namespace

TEST(SurfaceBasis, AGridThatReplacesAnotherKeepsItsOptions)
{
  const auto mesh = std::make_shared<const TriangleMesh>(TouchingSpheres(12));
  SpaceOptions functions;
  functions.depth = 5;
  const SurfaceBasis basis = MakeSurfaceBasis(mesh, BuildGridFunctions(*mesh, functions), true);
  SpaceChoice choice;
  choice.kind = FunctionKind::Hats;
  for (const double stabilization : { 1e-2, 1e-1 })
  {
    for (const Index coarsest : { 60, 400 })
    {
      choice.normalStabilization = stabilization;
      choice.coarsestSize = coarsest;
      choice.quadratureDegree = coarsest == 60 ? 4 : 2;
      ExpectOptions(SpaceOn(basis, choice), choice);
      EXPECT_NE(FindSpace(basis, choice), nullptr);
      ExpectOptions(BuildHatSpace(*mesh, { choice, functions }), choice);
    }
  }
  choice.normalStabilization = 0.3;
  EXPECT_EQ(FindSpace(basis, choice), nullptr); // nobody has made it
}
