// Compares integrals by samples with integrals over all triangles.
#include "Integrals/SampledFunctions.h"

#include "Integrals/LoadVector.h"
#include "Spaces.h"
#include "Spaces/GridSpace.h"
#include "Spaces/HatSpace.h"

#include <gtest/gtest.h>

using namespace gridfem;
using namespace gridfem::testing;

namespace
{

double Largest(const MultiVector& values)
{
  return values.cwiseAbs().maxCoeff<Eigen::PropagateNaN>();
}

class SampledSpaces : public ::testing::TestWithParam<SpaceCase>
{
protected:
  GridFunctions space = GetParam().Build();
  SampledFunctions sampled = SampleFunctions(space, space.Finest(), TriangleRule(4));

  /// Values of functions at the samples.
  MultiVector At(const MultiVector& coefficients) const
  {
    MultiVector values;
    Multiply(sampled.values, coefficients, values);
    return values;
  }

  MultiVector IntegralsOf(const MultiVector& atSamples) const
  {
    MultiVector integrals;
    Multiply(sampled.integrals, atSamples, integrals);
    return integrals;
  }
};

} // namespace

INSTANTIATE_TEST_SUITE_P(Spaces, SampledSpaces, ::testing::ValuesIn(AllSpaces()));

TEST_P(SampledSpaces, IntegrateConstantsExactly)
{
  const MultiVector ones = MultiVector::Ones(space.Finest().numberOfFunctions, 1);
  const MultiVector atSamples = At(ones);
  EXPECT_LT(Largest(atSamples - MultiVector::Ones(atSamples.rows(), 1)), 1e-12);
  const MultiVector corners = MultiVector::Ones(static_cast<Id>(GetParam().mesh.points.size()), 1);
  const MultiVector exact =
    IntegrateValues(space, GetParam().mesh, { FieldAssociation::Points, corners }, TriangleRule(4));
  EXPECT_LT(Largest(IntegralsOf(atSamples) - exact), 1e-9 * Largest(exact));
}

/// The error of a field is second order: small beside its change within a cell, which is up to 1.
TEST_P(SampledSpaces, IntegrateLinearFunctionsClosely)
{
  const MultiVector coordinates = CoordinateCoefficients(space);
  const MultiVector exact =
    IntegrateValues(space, GetParam().mesh, CoordinatesOf(GetParam().mesh), TriangleRule(4));
  const double cell = space.GetGrid().spacing;
  EXPECT_LT(Largest(IntegralsOf(At(coordinates)) - exact), 0.05 * cell);
}

/// Not more work for finer triangles.
TEST(SampledFunctions, AreUpToEightInACell)
{
  SpaceOptions options;
  options.depth = 3;
  for (const int n : { 4, 40 })
  {
    const GridFunctions space = BuildGridFunctions(GeodesicSphere(n), options);
    const SampledFunctions sampled = SampleFunctions(space, space.Finest(), TriangleRule(4));
    EXPECT_GT(sampled.values.rows, space.Finest().NumberOfPatches());
    EXPECT_LE(sampled.values.rows, 8 * space.Finest().NumberOfPatches());
  }
}

/// Hat functions are sampled where they are 1, and integrate what is linear on triangles exactly.
TEST(SampledFunctions, OfHatsAreAtTheirPoints)
{
  GridSpaceOptions options;
  options.functions.depth = 4;
  const HatSpace space = BuildHatSpace(GeodesicSphere(6), options);
  const SampledFunctions sampled = space.Samples();
  const MultiVector coefficients = space.EmbeddingOfMesh();
  MultiVector values;
  Multiply(sampled.values, coefficients, values);
  EXPECT_EQ(values, coefficients);
  MultiVector integrals;
  Multiply(sampled.integrals, values, integrals);
  const Field field{ FieldAssociation::Points, space.ValuesAtPoints(coefficients) };
  const MultiVector exact = space.LoadOfValues(field);
  EXPECT_LT(Largest(integrals - exact), 1e-12 * Largest(exact));
}
