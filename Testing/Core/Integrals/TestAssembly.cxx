// Compares level matrices and prolongations with dense sums, Galerkin products and point values.
#include "Integrals/Assembly.h"

#include "ElementSums.h"
#include "Integrals/TrilinearBasis.h"
#include "Spaces.h"

#include <Eigen/SparseCore>

#include <gtest/gtest.h>

using namespace gridfem;
using namespace gridfem::testing;

namespace
{

class AssemblyOnSpaces : public ::testing::TestWithParam<SpaceCase>
{
};

Eigen::MatrixXd DenseSum(const PatchLevel& level, const Array<ElementMatrix>& elements)
{
  Eigen::MatrixXd sum = Eigen::MatrixXd::Zero(level.numberOfFunctions, level.numberOfFunctions);
  for (Id p = 0; p < level.NumberOfPatches(); ++p)
  {
    for (int i = 0; i < FunctionsPerPatch; ++i)
    {
      for (int j = 0; j < FunctionsPerPatch; ++j)
      {
        sum(level.dof[p][i], level.dof[p][j]) += elements[p][PackedIndex(i, j)];
      }
    }
  }
  return sum;
}

SparseMatrix Assemble(
  const PatchLevel& level, const ElementMatrices& elements, double a, double b, int threads = 0)
{
  const FunctionPlaces places = PlacesOfFunctions(level);
  SparseMatrix matrix = BuildPattern(level, places, threads);
  AssembleValues(level, places, elements.mass, a, elements.stiffness, b, matrix, threads);
  return matrix;
}

/// Returns the value of a function of the patch's level at a point in grid units of the finest
/// level.
double ValueInPatch(const PatchLevel& level, Id patch, double side, const Vec3& position,
  const MultiVector& coefficients)
{
  const CellIndex cell = MortonDecode(level.cell[patch]);
  std::array<double, FunctionsPerPatch> b;
  TrilinearValues(position / side - Vec3(cell[0], cell[1], cell[2]), b);
  double value = 0.0;
  for (int c = 0; c < FunctionsPerPatch; ++c)
  {
    value += b[c] * coefficients(level.dof[patch][c], 0);
  }
  return value;
}

SparseMatrix ProlongationOf(const PatchLevel& fine, const PatchLevel& coarse)
{
  return BuildProlongation(fine, PlacesOfFunctions(fine), coarse);
}

} // namespace

TEST_P(AssemblyOnSpaces, PlacesOfFunctionsInvertTheTable)
{
  const GridFunctions space = GetParam().Build();
  for (const PatchLevel& level : space.levels)
  {
    const FunctionPlaces places = PlacesOfFunctions(level);
    ASSERT_EQ(static_cast<Id>(places.item.size()), FunctionsPerPatch * level.NumberOfPatches());
    for (Index f = 0; f < level.numberOfFunctions; ++f)
    {
      ASSERT_LT(places.begin[f], places.begin[f + 1]) << "function without a patch";
      for (Index k = places.begin[f]; k < places.begin[f + 1]; ++k)
      {
        const Index place = places.item[k];
        ASSERT_EQ(level.dof[place / FunctionsPerPatch][place % FunctionsPerPatch], f);
        ASSERT_TRUE(k == places.begin[f] || places.item[k - 1] < place);
      }
    }
  }
}

TEST_P(AssemblyOnSpaces, MatricesAreTheSumsOfTheirElements)
{
  const GridFunctions space = GetParam().Build();
  const PatchLevel& level = space.levels[1];
  const ElementMatrices elements =
    Coarsened(space.levels[0], level, IntegrateElements(space, TriangleRule(2)));
  const Eigen::MatrixXd M = DenseSum(level, elements.mass);
  const Eigen::MatrixXd L = DenseSum(level, elements.stiffness);
  // Each entry takes a few additions of at most eight terms.
  EXPECT_LT(
    RelativeDifference(Dense(Assemble(level, elements, 3.0, 0.5)), 3.0 * M + 0.5 * L), 1e-14);
  EXPECT_LT(
    RelativeDifference(Dense(Assemble(level, { elements.mass, {} }, 2.0, 0.0)), 2.0 * M), 1e-14);
  EXPECT_LT(
    RelativeDifference(Dense(Assemble(level, { {}, elements.stiffness }, 0.0, 1.0)), L), 1e-14);
}

TEST_P(AssemblyOnSpaces, MatricesAreSymmetricToTheLastBit)
{
  const GridFunctions space = GetParam().Build();
  const ElementMatrices elements = IntegrateElements(space, TriangleRule(2));
  const SparseMatrix A = Assemble(space.Finest(), elements, 0.3, 1.0);
  for (Index row = 0; row < A.rows; ++row)
  {
    for (Id k = A.rowBegin[row]; k < A.rowBegin[row + 1]; ++k)
    {
      ASSERT_EQ(A.value[k], A.Coefficient(A.column[k], row));
      ASSERT_TRUE(k == A.rowBegin[row] || A.column[k - 1] < A.column[k]);
    }
  }
}

TEST_P(AssemblyOnSpaces, FillingAgainReplacesTheValues)
{
  const GridFunctions space = GetParam().Build();
  const PatchLevel& level = space.Finest();
  const ElementMatrices elements = IntegrateElements(space, TriangleRule(2));
  const FunctionPlaces places = PlacesOfFunctions(level);
  SparseMatrix A = BuildPattern(level, places);
  EXPECT_TRUE(A.value.empty());
  AssembleValues(level, places, elements.mass, 7.0, elements.stiffness, 1.0, A, 1);
  AssembleValues(level, places, elements.mass, 0.1, elements.stiffness, 1.0, A, 2);
  const SparseMatrix B = Assemble(level, elements, 0.1, 1.0, 1);
  EXPECT_EQ(A.rowBegin, B.rowBegin);
  EXPECT_EQ(A.column, B.column);
  EXPECT_EQ(A.value, B.value); // the same bits for one thread and two
}

TEST_P(AssemblyOnSpaces, GalerkinProductsEqualTheAssembledCoarseMatrices)
{
  const GridFunctions space = GetParam().Build();
  ElementMatrices elements = IntegrateElements(space, TriangleRule(2));
  Eigen::SparseMatrix<double> A;
  for (std::size_t l = 0; l < space.levels.size(); ++l)
  {
    SCOPED_TRACE(l);
    const SparseMatrix assembled = Assemble(space.levels[l], elements, 0.1, 1.0);
    if (l > 0)
    {
      EXPECT_LT(RelativeDifference(Eigen::MatrixXd(A), Dense(assembled)), 1e-12);
    }
    if (l + 1 < space.levels.size())
    {
      const SparseMatrix prolongation = ProlongationOf(space.levels[l], space.levels[l + 1]);
      const Eigen::SparseMatrix<double> P = Dense(prolongation).sparseView();
      const Eigen::SparseMatrix<double> fine = Dense(assembled).sparseView();
      A = P.transpose() * fine * P;
      elements = Coarsened(space.levels[l], space.levels[l + 1], elements);
    }
  }
}

TEST_P(AssemblyOnSpaces, ProlongationRowsAreTheSameFromEveryPatchOfASupport)
{
  const GridFunctions space = GetParam().Build();
  for (std::size_t l = 0; l + 1 < space.levels.size(); ++l)
  {
    const PatchLevel& fine = space.levels[l];
    const PatchLevel& coarse = space.levels[l + 1];
    const Eigen::MatrixXd P = Dense(BuildProlongation(fine, PlacesOfFunctions(fine), coarse, 2));
    ASSERT_EQ(P.rowwise().sum(), Eigen::VectorXd::Ones(fine.numberOfFunctions));
    for (Id patch = 0; patch < fine.NumberOfPatches(); ++patch)
    {
      for (int c = 0; c < FunctionsPerPatch; ++c)
      {
        for (int p = 0; p < FunctionsPerPatch; ++p)
        {
          const double weight = ChildWeights(fine.Octant(patch))[c][p];
          ASSERT_EQ(P(fine.dof[patch][c], coarse.dof[fine.parent[patch]][p]), weight);
        }
      }
    }
  }
}

TEST_P(AssemblyOnSpaces, ProlongedFunctionsHaveTheSameValuesOnTheSurface)
{
  const GridFunctions space = GetParam().Build();
  const std::size_t top = space.levels.size() - 1;
  const MultiVector coarse = RandomValues(space.levels[top].numberOfFunctions, 1);
  MultiVector fine = coarse;
  for (std::size_t l = top; l-- > 0;)
  {
    MultiVector next;
    Multiply(ProlongationOf(space.levels[l], space.levels[l + 1]), fine, next);
    fine = next;
  }
  const MultiVector random = RandomValues(10000, 3, 5).cwiseAbs();
  for (Id k = 0; k < random.rows(); ++k)
  {
    const Id piece = std::min(space.clipped.NumberOfPieces() - 1,
      static_cast<Id>(random(k, 0) * double(space.clipped.NumberOfPieces())));
    const Index* ids = space.clipped.corners.data() + space.clipped.pieceBegin[piece];
    const double s = random(k, 1);
    const double t = random(k, 2) * (1.0 - s);
    const Vec3 position = (1.0 - s - t) * space.clipped.position[ids[0]] +
                          s * space.clipped.position[ids[1]] + t * space.clipped.position[ids[2]];
    Id patch = space.piecePatch[piece];
    const double value = ValueInPatch(space.Finest(), patch, 1.0, position, fine);
    for (std::size_t l = 0; l < top; ++l)
    {
      patch = space.levels[l].parent[patch];
    }
    const double side = std::pow(2.0, double(top));
    // Coefficients are at most 1, and their weights sum to 1.
    ASSERT_NEAR(value, ValueInPatch(space.levels[top], patch, side, position, coarse), 1e-13);
  }
}

INSTANTIATE_TEST_SUITE_P(Spaces, AssemblyOnSpaces, ::testing::ValuesIn(AllSpaces(3)));

TEST(Assembly, OfTheThesisSphereHasEighteenEntriesPerRow)
{
  SpaceOptions options;
  options.depth = 5;
  options.connectivityAware = false;
  const GridFunctions space = BuildGridFunctions(LatLongSphere(140, 69), options);
  const SparseMatrix A = BuildPattern(space.Finest(), PlacesOfFunctions(space.Finest()));
  EXPECT_NEAR(double(A.NonZeros()) / A.rows, 18.0, 0.5); // thesis, Table 6.2: 18.3 and 17.95
}
