// Colors of scans with different gains and offsets become one, on both kinds of space.
#include "Largest.h"
#include "Shape/Stitching.h"

#include "Base/Errors.h"
#include "EitherSpace.h"
#include "Grid/TriangleArea.h"
#include "Spaces.h"

#include <gtest/gtest.h>

#include <cmath>

using namespace gridfem;
using namespace gridfem::testing;

namespace
{

constexpr int NumberOfScans = 5;

/// The scan of a point: sectors around the z axis.
Index ScanAt(const Vec3& p)
{
  const double turn = std::atan2(p[1], p[0]) / (2.0 * EIGEN_PI) + 0.5;
  return std::min(NumberOfScans - 1, static_cast<int>(NumberOfScans * turn));
}

/// Large shapes, and detail of a few triangles.
Vec3 ColorAt(const Vec3& p)
{
  return { 0.5 + 0.3 * std::sin(3 * p[0] + p[1]) + 0.03 * std::sin(40 * p[2]),
    0.5 + 0.2 * p[2] + 0.03 * std::sin(35 * p[0] + 20 * p[1]), 0.4 + 0.2 * std::cos(4 * p[1]) };
}

/// A color as a scanner sees it.
Vec3 Seen(Index scan, const Vec3& color)
{
  const double gain[] = { 1.0, 0.92, 1.07, 0.95, 1.04 };
  const double offset[] = { 0.0, 0.12, -0.15, 0.2, -0.05 };
  return gain[scan] * color + Vec3(offset[scan], -offset[scan], 0.5 * offset[scan]);
}

std::unique_ptr<FiniteElementSpace> Build(const TriangleMesh& mesh, bool isOnHats, int depth,
  bool isAware = true, bool welds = true, int threads = 0)
{
  GridSpaceOptions options;
  options.functions.depth = depth;
  options.functions.connectivityAware = isAware;
  options.functions.weldCoincidentPoints = welds;
  options.functions.threads = threads;
  options.normalStabilization = 1e-2;
  return BuildEither(mesh, isOnHats, options);
}

StitchOptions Options(int threads = 0)
{
  StitchOptions options;
  options.multigrid.threads = threads;
  options.solve.tolerance = 1e-6;
  return options;
}

Vec3 CenterOf(const TriangleMesh& mesh, Id triangle)
{
  const auto& corner = mesh.triangles[triangle];
  return (mesh.points[corner[0]] + mesh.points[corner[1]] + mesh.points[corner[2]]) / 3.0;
}

/// A mesh in five scans with their colors at its points.
struct Scans
{
  explicit Scans(TriangleMesh scanned) : mesh(std::move(scanned))
  {
    colors.values.resize(static_cast<Id>(mesh.points.size()), 3);
    for (Id i = 0; i < colors.values.rows(); ++i)
    {
      labels.values.push_back(ScanAt(mesh.points[i]));
      SetRow(colors.values, i, Seen(labels.values.back(), ColorAt(mesh.points[i])));
    }
  }

  TriangleMesh mesh;
  ScanLabels labels;
  Field colors;
};

/// Root mean square of the difference of a column's values at the ends of triangle edges. The ends
/// are in different scans (or in the same scan).
double EdgeDifference(const Scans& scans, const MultiVector& values, bool isSeam)
{
  double sum = 0.0;
  Id edges = 0;
  for (const auto& corner : scans.mesh.triangles)
  {
    for (int k = 0; k < 3; ++k)
    {
      const Id a = corner[k];
      const Id b = corner[(k + 1) % 3];
      if ((scans.labels.values[a] != scans.labels.values[b]) == isSeam)
      {
        sum += (values.row(a) - values.row(b)).squaredNorm();
        ++edges;
      }
    }
  }
  return std::sqrt(sum / double(edges));
}

StitchedColors Stitch(
  const Scans& scans, bool isOnHats, int depth, const StitchOptions& options, bool isAware = true)
{
  const ScanCut cut = CutAtSeams(scans.mesh, scans.labels, scans.colors.association);
  const int threads = options.multigrid.threads;
  const auto space = Build(scans.mesh, isOnHats, depth, isAware, true, threads);
  const auto details = Build(cut.pieces, false, depth, true, false, threads);
  return StitchColors(*space, scans.mesh, cut, scans.colors, options, details.get(), Job(threads));
}

class Stitching : public ::testing::TestWithParam<bool>
{
};

} // namespace

TEST_P(Stitching, RemovesJumpsAndKeepsGradients)
{
  const Scans scans(Transform(GeodesicSphere(50), { 1, 2, 3 }, 0.3));
  const StitchedColors stitched = Stitch(scans, GetParam(), 5, Options());
  EXPECT_TRUE(stitched.report.converged);
  // The change of the colors themselves along an edge is no jump.
  MultiVector truth = scans.colors.values;
  for (Id i = 0; i < truth.rows(); ++i)
  {
    SetRow(truth, i, ColorAt(scans.mesh.points[i]));
  }
  const double before = EdgeDifference(scans, scans.colors.values - truth, true);
  const double after = EdgeDifference(scans, stitched.values - truth, true);
  EXPECT_LT(after, 0.1 * before);
  const double change = EdgeDifference(scans, stitched.values - scans.colors.values, false);
  EXPECT_LT(change, 0.05 * EdgeDifference(scans, scans.colors.values, false));
}

/// Scans that darken toward their borders. The colors of these margins are left out.
TEST_P(Stitching, BlendsOverMarginsThatAreWrong)
{
  constexpr double Margin = 0.12;
  Scans scans(GeodesicSphere(40));
  const ScanCut cut = CutAtSeams(scans.mesh, scans.labels, FieldAssociation::Points);
  const std::vector<double> near = KeptShares(scans.mesh, cut, 2.0 * Margin);
  MultiVector share = MultiVector::Zero(scans.colors.values.rows(), 1);
  for (std::size_t t = 0; t < near.size(); ++t)
  {
    for (const Id point : scans.mesh.triangles[t])
    {
      share(point, 0) = std::max(share(point, 0), near[t]);
    }
  }
  for (Id i = 0; i < share.rows(); ++i) // the same color everywhere, seen darker at the rim
  {
    const double dark = 0.2 * std::max(0.0, 1.0 - 2.0 * share(i, 0));
    SetRow(scans.colors.values, i,
      Seen(scans.labels.values[i], Vec3(0.5, 0.5, 0.5)) - Vec3(dark, dark, dark));
  }
  const auto spread = [&](double width)
  {
    StitchOptions options = Options();
    options.blendWidth = width;
    const StitchedColors stitched = Stitch(scans, this->GetParam(), 5, options);
    EXPECT_TRUE(stitched.report.converged);
    double largest = 0.0;
    for (Id c = 0; c < stitched.values.cols(); ++c)
    {
      const auto column = stitched.values.col(c);
      largest = Larger(largest, column.maxCoeff<Eigen::PropagateNaN>() - column.minCoeff());
    }
    return largest;
  };
  const double sharp = spread(0.0);
  const double blended = spread(2.0 * Margin);
  EXPECT_GT(sharp, 0.15);
  EXPECT_LT(blended, 0.6 * sharp);
}

/// Colors of points and of triangles. One scan shows the right colors, and the others are adjusted
/// to it.
TEST_P(Stitching, TakesOtherScansToAReference)
{
  constexpr Index Reference = 2;
  Scans scans(Transform(GeodesicSphere(40), { 1, 2, 3 }, 0.3));
  for (const FieldAssociation association :
    { FieldAssociation::Points, FieldAssociation::Triangles })
  {
    if (association == FieldAssociation::Triangles)
    {
      scans.labels = { association, {} };
      scans.colors = { association, MultiVector(static_cast<Id>(scans.mesh.triangles.size()), 3) };
      for (Id t = 0; t < scans.colors.values.rows(); ++t)
      {
        const Vec3 center = CenterOf(scans.mesh, t);
        scans.labels.values.push_back(ScanAt(center));
        SetRow(scans.colors.values, t, Seen(scans.labels.values.back(), ColorAt(center)));
      }
    }
    StitchOptions options = Options();
    options.reference = Reference;
    const StitchedColors stitched = Stitch(scans, GetParam(), 5, options);
    EXPECT_TRUE(stitched.report.converged);
    // The remaining and the original difference from the colors that the reference sees everywhere.
    double before = 0.0;
    double after = 0.0;
    Eigen::RowVector3d drift = Eigen::RowVector3d::Zero();
    double area = 0.0;
    const ScanCut cut = CutAtSeams(scans.mesh, scans.labels, association);
    for (Id t = 0; t < static_cast<Id>(scans.mesh.triangles.size()); ++t)
    {
      for (const Id row : scans.colors.RowsOf(t, scans.mesh.triangles[t]))
      {
        const Vec3 place = association == FieldAssociation::Points ? scans.mesh.points[row]
                                                                   : CenterOf(scans.mesh, t);
        const Vec3 truth = Seen(Reference, ColorAt(place));
        before += (scans.colors.values.row(row).transpose() - truth).squaredNorm();
        after += (stitched.values.row(row).transpose() - truth).squaredNorm();
        if (cut.scanOfTriangle[t] == Reference)
        {
          area += AreaOf(scans.mesh, t);
          drift +=
            AreaOf(scans.mesh, t) * (stitched.values.row(row) - scans.colors.values.row(row));
        }
      }
    }
    EXPECT_LT(after, 0.1 * before);
    EXPECT_LT((drift / area).norm(), 1e-12); // the reference keeps its mean
  }
}

TEST(KeptShares, RiseFromNothingAtTheSeamToAllBeyondTheWidth)
{
  const Scans scans(GeodesicSphere(30));
  const ScanCut cut = CutAtSeams(scans.mesh, scans.labels, FieldAssociation::Points);
  const std::vector<double> sharp = KeptShares(scans.mesh, cut, 0.0);
  const std::vector<double> narrow = KeptShares(scans.mesh, cut, 0.1);
  const std::vector<double> wide = KeptShares(scans.mesh, cut, 0.3);
  Id between = 0;
  for (std::size_t t = 0; t < sharp.size(); ++t)
  {
    ASSERT_EQ(sharp[t], cut.scanOfTriangle[t] == ScanCut::Seam ? 0.0 : 1.0);
    ASSERT_LE(narrow[t], sharp[t]);
    ASSERT_LE(wide[t], narrow[t] + 1e-12);
    ASSERT_GE(wide[t], 0.0);
    between += wide[t] > 0.1 && wide[t] < 0.9 ? 1 : 0;
  }
  EXPECT_GT(between, 500);
  // Triangles with colors of their own jump on edges, which have no triangles.
  const ScanCut onTriangles = CutAtSeams(scans.mesh, scans.labels, FieldAssociation::Triangles);
  const std::vector<double> atEdges = KeptShares(scans.mesh, onTriangles, 0.3);
  EXPECT_LT(*std::min_element(atEdges.begin(), atEdges.end()), 0.1);
  for (const double wrong : { -1.0, std::nan(""), double(INFINITY) })
  {
    EXPECT_THROW(KeptShares(scans.mesh, cut, wrong), InvalidInput);
  }
}

TEST_P(Stitching, OfOneScanChangesNothing)
{
  Scans scans(GeodesicSphere(12));
  std::fill(scans.labels.values.begin(), scans.labels.values.end(), 7);
  const StitchedColors stitched = Stitch(scans, GetParam(), 4, Options());
  // On the grid, the change is the smoothed part that the grid cannot represent: 1 % of the
  // details' 0.03.
  EXPECT_LT((stitched.values - scans.colors.values).cwiseAbs().maxCoeff<Eigen::PropagateNaN>(),
    GetParam() ? 1e-4 : 0.01);
}

INSTANTIATE_TEST_SUITE_P(BothSpaces, Stitching, ::testing::Bool());
