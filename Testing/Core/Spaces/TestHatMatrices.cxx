// Tests the numbering of hat functions, and their mass and stiffness: an independent assembly, and
// degenerate input.
#include "Largest.h"
#include "Spaces/HatMatrices.h"

#include "Dense.h"
#include "Spaces.h"
#include "Support/HatSystem.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

using namespace gridfem;
using namespace gridfem::testing;

namespace
{

struct MeshCase
{
  std::string name;
  TriangleMesh mesh;
  std::string file = {}; ///< name of a real mesh to use instead, read by the tests that need it

  TriangleMesh Mesh() const { return file.empty() ? mesh : ReadMesh(RealMesh(file)); }
};

void PrintTo(const MeshCase& meshCase, std::ostream* stream)
{
  *stream << meshCase.name;
}

/// Returns a fan around a vertical axis: an edge with five triangles.
TriangleMesh FiveSheets()
{
  TriangleMesh mesh;
  mesh.points = { { 0, 0, 0 }, { 0, 0, 1 } };
  for (int k = 0; k < 5; ++k)
  {
    mesh.points.push_back({ std::cos(1.2 * k), std::sin(1.2 * k), 0.3 * k });
    mesh.triangles.push_back({ 0, 1, 2 + k });
  }
  return mesh;
}

std::vector<MeshCase> Meshes()
{
  std::vector<MeshCase> cases = { { "sphere", GeodesicSphere(6) },
    { "torus", Torus(30, 12, 1.0, 0.3) }, { "open", FlatRectangle(5, 3, 7.0, 0.1) },
    { "soup", Unweld(Transform(GeodesicSphere(3), { 1, 0, 1 }, 0.3, 100.0, { 5, 6, 7 })) },
    { "two sheets", TwoSheets(6, 0.01) }, { "five sheets", FiveSheets() } };
  for (const char* name : { "dragon_res3_nonmanifold.ply", "anchor_dense_8k.ply", "conrod.stl" })
  {
    cases.push_back({ name, {}, name });
  }
  return cases;
}

class HatMatricesOf : public ::testing::TestWithParam<MeshCase>
{
protected:
  void SetUp() override
  {
    if (!GetParam().file.empty() && RealMesh(GetParam().file).empty())
    {
      GTEST_SKIP() << "The folder of real meshes is not there.";
    }
  }
};

/// Returns the largest difference between entries of a matrix and `factor` times the entries of the
/// reference, relative to the diagonal of the row.
double Difference(const SparseMatrix& A, const Eigen::SparseMatrix<double>& reference,
  double factor, const std::vector<int>& rowOfHat)
{
  double worst = 0.0;
  for (Index i = 0; i < A.rows; ++i)
  {
    const double diagonal = A.Coefficient(i, i);
    for (Id k = A.rowBegin[i]; k < A.rowBegin[i + 1]; ++k)
    {
      const double expected = factor * reference.coeff(rowOfHat[i], rowOfHat[A.column[k]]);
      worst = Larger(worst, std::abs(A.value[k] - expected) / diagonal);
    }
  }
  return worst;
}

std::vector<int> ReferenceRows(const HatFunctions& hats, const HatSystem& reference)
{
  std::vector<int> row(hats.Count(), -1);
  for (std::size_t point = 0; point < hats.ofPoint.size(); ++point)
  {
    if (hats.ofPoint[point] >= 0)
    {
      row[hats.ofPoint[point]] = reference.row[point];
    }
  }
  return row;
}

} // namespace

TEST_P(HatMatricesOf, AreThoseOfTheReference)
{
  const TriangleMesh mesh = GetParam().Mesh();
  const HatSystem reference = BuildHatSystem(mesh);
  HatOptions options;
  options.unitLength = 0.25;
  const HatFunctions hats = NumberHatFunctions(mesh, options);
  ASSERT_EQ(hats.Count(), reference.mass.rows());
  const HatMatrices matrices = AssembleHatMatrices(mesh, hats);
  EXPECT_EQ(matrices.stiffness.NonZeros(), reference.stiffness.nonZeros());
  const std::vector<int> row = ReferenceRows(hats, reference);
  EXPECT_LT(Difference(matrices.mass, reference.mass, 16.0, row), 1e-12); // 1 / unit²
  // Cotangents of needles lose digits by the aspect ratio of the triangle, which is at most 6e4
  // here.
  EXPECT_LT(Difference(matrices.stiffness, reference.stiffness, 1.0, row), 1e-10);
}

TEST_P(HatMatricesOf, HaveTheRightSumsAndAreSymmetric)
{
  const TriangleMesh mesh = GetParam().Mesh();
  const HatFunctions hats = NumberHatFunctions(mesh);
  const HatMatrices matrices = AssembleHatMatrices(mesh, hats);
  double area = 0.0;
  for (Index i = 0; i < hats.Count(); ++i)
  {
    double mass = 0.0;
    double stiffness = 0.0;
    for (Id k = matrices.mass.rowBegin[i]; k < matrices.mass.rowBegin[i + 1]; ++k)
    {
      mass += matrices.mass.value[k];
      stiffness += matrices.stiffness.value[k];
      ASSERT_EQ(matrices.mass.value[k], matrices.mass.Coefficient(matrices.mass.column[k], i));
      ASSERT_EQ(matrices.stiffness.value[k],
        matrices.stiffness.Coefficient(matrices.stiffness.column[k], i));
    }
    ASSERT_LE(std::abs(stiffness), 1e-13 * matrices.stiffness.Coefficient(i, i));
    ASSERT_NEAR(mass, matrices.integral[i], 1e-13 * mass);
    area += matrices.integral[i];
  }
  EXPECT_NEAR(area, SurfaceArea(mesh), 1e-9 * area); // flat triangles are left out
}

TEST_P(HatMatricesOf, DoNotDependOnThreads)
{
  const TriangleMesh mesh = GetParam().Mesh();
  HatOptions options;
  options.threads = 1;
  const HatMatrices one = AssembleHatMatrices(mesh, NumberHatFunctions(mesh, options), {}, 1);
  options.threads = 3;
  const HatMatrices three = AssembleHatMatrices(mesh, NumberHatFunctions(mesh, options), {}, 3);
  EXPECT_EQ(one.mass.value, three.mass.value);
  EXPECT_EQ(one.stiffness.value, three.stiffness.value);
  EXPECT_EQ(one.stiffness.column, three.stiffness.column);
}

INSTANTIATE_TEST_SUITE_P(Meshes, HatMatricesOf, ::testing::ValuesIn(Meshes()));

TEST(HatFunctions, AreSharedByCoincidentPointsOnlyWhenWelded)
{
  const TriangleMesh sphere = GeodesicSphere(3);
  const TriangleMesh soup = Unweld(sphere);
  EXPECT_EQ(NumberHatFunctions(soup).Count(), static_cast<Index>(sphere.points.size()));
  EXPECT_EQ(NumberHatFunctions(soup).numberOfComponents, 1);
  HatOptions options;
  options.weldCoincidentPoints = false;
  const HatFunctions apart = NumberHatFunctions(soup, options);
  EXPECT_EQ(apart.Count(), static_cast<Index>(soup.points.size()));
  EXPECT_EQ(apart.numberOfComponents, static_cast<Index>(soup.triangles.size()));
}

TEST(HatFunctions, AreConnectedByTrianglesThatShareAPoint)
{
  TriangleMesh mesh = Join(Torus(8, 5, 1.0, 0.2), GeodesicSphere(2, 0.1));
  EXPECT_EQ(NumberHatFunctions(mesh).numberOfComponents, 2);
  mesh.points.back() = mesh.points.front(); // now both parts touch in a point
  EXPECT_EQ(NumberHatFunctions(mesh).numberOfComponents, 1);
}

TEST(HatFunctions, LeaveOutWhatHasNoArea)
{
  TriangleMesh mesh = GeodesicSphere(3);
  const Id count = static_cast<Id>(mesh.points.size());
  const double nan = std::numeric_limits<double>::quiet_NaN();
  mesh.points.push_back({ nan, nan, nan }); // no triangle uses it
  mesh.points.push_back({ 3, 0, 0 });       // of flat triangles only
  mesh.points.push_back({ 4, 1e-13, 0 });
  mesh.points.push_back({ 5, 0, 0 });
  mesh.triangles.push_back({ count + 1, count + 2, count + 3 });
  mesh.triangles.push_back({ count + 1, count + 1, count + 2 });
  mesh.triangles.push_back({ 0, 0, 0 });
  mesh.triangles.push_back({ 0, 1, 1 });
  const HatFunctions hats = NumberHatFunctions(mesh);
  EXPECT_EQ(hats.Count(), count);
  for (Id point = 0; point < static_cast<Id>(mesh.points.size()); ++point)
  {
    EXPECT_EQ(hats.ofPoint[point] >= 0, point < count) << point;
  }
  const HatMatrices matrices = AssembleHatMatrices(mesh, hats);
  const HatMatrices clean =
    AssembleHatMatrices(GeodesicSphere(3), NumberHatFunctions(GeodesicSphere(3)));
  EXPECT_EQ(matrices.stiffness.value, clean.stiffness.value);
  EXPECT_EQ(matrices.mass.value, clean.mass.value);
}

TEST(HatMatrices, AreFiniteOnNeedlesAndObtuseTrianglesOfAnySize)
{
  for (const double height : { 1.0, 1e-3, 1e-6, 3e-10, 1e-10, 1e-14, 0.0 })
  {
    for (const double scale : { 1e-120, 1.0, 1e120 })
    {
      TriangleMesh mesh;
      mesh.points = { { 0, 0, 0 }, { 1, 0, 0 }, { 0.3, height, 0 }, { 0.4, -height, 0 },
        { 0.2, -1, 0 } };
      mesh.triangles = { { 0, 1, 2 }, { 1, 0, 3 }, { 0, 4, 1 } };
      mesh = Transform(mesh, { 1, 2, 3 }, 0.4, scale);
      HatOptions options;
      options.unitLength = scale;
      const HatMatrices matrices = AssembleHatMatrices(mesh, NumberHatFunctions(mesh, options));
      SparseMatrix A;
      Combine(1.0, matrices.mass, 1.0, matrices.stiffness, A);
      EXPECT_TRUE(Dense(A).allFinite()) << height << " " << scale;
      EXPECT_GE(A.rows, 3);
      // Negative cotangents do not make the sum of element matrices indefinite.
      const Eigen::MatrixXd dense = Dense(A);
      const Eigen::VectorXd s = dense.diagonal().cwiseSqrt().cwiseInverse();
      const Eigen::MatrixXd scaled = s.asDiagonal() * dense * s.asDiagonal();
      EXPECT_GT(DenseEigen(scaled).values[0], -1e-14);
    }
  }
}

TEST(HatFunctions, RefuseAUnitThatIsNoLength)
{
  for (const double unit : { 0.0, -1.0, std::numeric_limits<double>::infinity(),
         std::numeric_limits<double>::quiet_NaN() })
  {
    HatOptions options;
    options.unitLength = unit;
    EXPECT_THROW(NumberHatFunctions(GeodesicSphere(2), options), InvalidInput);
  }
}
