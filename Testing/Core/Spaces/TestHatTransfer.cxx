// Tests the transfer between hats and grid functions: evaluation and the thesis' pseudo-evaluation.
#include "Spaces/HatTransfer.h"

#include "Hybrid.h"
#include "Integrals/Evaluation.h"
#include "Spaces.h"

#include <gtest/gtest.h>

#include <set>

using namespace gridfem;
using namespace gridfem::testing;

namespace
{

/// Returns dense Rᵀ as written in the thesis: M_c⁻¹ Pᵀ M_f E_f with lumped masses, over the clipped
/// mesh.
Eigen::MatrixXd PseudoEvaluation(const Hybrid& hybrid)
{
  const ClippedMesh& clipped = hybrid.space.Grid().Functions().clipped;
  const auto points = static_cast<Id>(clipped.position.size());
  Eigen::VectorXd mass = Eigen::VectorXd::Zero(points);
  for (Id piece = 0; piece < clipped.NumberOfPieces(); ++piece)
  {
    const Index* corner = &clipped.corners[clipped.pieceBegin[piece]];
    const Id count = clipped.pieceBegin[piece + 1] - clipped.pieceBegin[piece];
    for (Id k = 1; k + 1 < count; ++k)
    {
      const Vec3& apex = clipped.position[corner[0]];
      const double third =
        (clipped.position[corner[k]] - apex).cross(clipped.position[corner[k + 1]] - apex).norm() /
        6.0;
      for (const Id point : { corner[0], corner[k], corner[k + 1] })
      {
        mass[point] += third;
      }
    }
  }
  const HatFunctions& functions = hybrid.space.Hats().functions;
  Eigen::MatrixXd P = Eigen::MatrixXd::Zero(points, functions.Count());
  for (Id point = 0; point < points; ++point)
  {
    if (point < clipped.numberOfInputPoints)
    {
      P(point, functions.ofPoint[point]) = 1.0;
      continue;
    }
    const CutPoint& cut = clipped.cutPoints[point - clipped.numberOfInputPoints];
    for (int k = 0; k < 3; ++k)
    {
      P(point, functions.ofPoint[hybrid.mesh.triangles[cut.triangle][k]]) += cut.Weights()[k];
    }
  }
  const Index count = hybrid.space.Grid().Functions().Finest().numberOfFunctions;
  const Eigen::MatrixXd E =
    EvaluateAtClippedPoints(hybrid.space.Grid().Functions(), MultiVector::Identity(count, count));
  const Eigen::VectorXd lumped = P.transpose() * mass;
  return lumped.cwiseInverse().asDiagonal() * (P.transpose() * (mass.asDiagonal() * E));
}

/// Returns the fraction of the surface, measured in ∫ b_i, whose grid functions get no residual
/// (empty columns).
double ShareWithoutResidual(const Hybrid& hybrid)
{
  const SharedArray<Index>& column = hybrid.space.Hats().prolongation->column;
  const std::set<Index> reached(column.begin(), column.end());
  double without = 0.0;
  double all = 0.0;
  for (std::size_t i = 0; i < hybrid.space.Grid().Operators().integral.size(); ++i)
  {
    all += hybrid.space.Grid().Operators().integral[i];
    without +=
      reached.count(static_cast<Index>(i)) ? 0.0 : hybrid.space.Grid().Operators().integral[i];
  }
  return without / all;
}

} // namespace

TEST(HatTransfer, EvaluatesAtThePoints)
{
  for (const TriangleMesh& mesh :
    { Transform(GeodesicSphere(5), { 1, 2, 3 }, 0.4), Unweld(Transform(Box(3), { 1, 2, 3 }, 0.4)) })
  {
    const Hybrid hybrid(mesh, 4, HatTransfer::Evaluation);
    const MultiVector x =
      RandomValues(hybrid.space.Grid().Functions().Finest().numberOfFunctions, 2);
    MultiVector onHats;
    Multiply(hybrid.space.Hats().prolongation, x, onHats);
    EXPECT_LT(RelativeDifference(ValuesAtPoints(hybrid.space.Hats().functions, onHats),
                EvaluateAtPoints(hybrid.space.Grid().Functions(), x)),
      1e-13);
  }
}

/// A hat whose pieces have no area cannot weigh sheets, so it takes the value at its point. Other
/// hats keep their rows.
TEST(HatTransfer, EvaluatesAtThePointsOfHatsWithoutArea)
{
  const TriangleMesh mesh = Transform(GeodesicSphere(5), { 1, 2, 3 }, 0.4);
  const GridFunctions space = Hybrid(mesh, 4).space.Grid().Functions();
  const HatFunctions hats = NumberHatFunctions(mesh);
  MultiVector sums = MultiVector::Ones(hats.Count(), 1);
  for (Index hat = 0; hat < hats.Count(); hat += 3)
  {
    sums(hat, 0) = 0.0;
  }
  const auto weights = [&](const std::vector<char>& isBare)
  { return Dense(BuildHatWeights(hats, space, mesh, HatTransfer::PseudoEvaluation, isBare)); };
  const Eigen::MatrixXd found = weights(BareRows(sums));
  const Eigen::MatrixXd ofArea = weights({});
  const Eigen::MatrixXd atPoints =
    Dense(BuildHatProlongation(hats, space, mesh, HatTransfer::Evaluation));
  for (Index hat = 0; hat < hats.Count(); ++hat)
  {
    const Eigen::MatrixXd& expected = hat % 3 == 0 ? atPoints : ofArea;
    ASSERT_LT(
      (found.row(hat) - expected.row(hat)).cwiseAbs().maxCoeff<Eigen::PropagateNaN>(), 1e-14)
      << hat;
  }
}

TEST(HatTransfer, IsThePseudoEvaluationMatrixOfTheThesis)
{
  for (const TriangleMesh& mesh : { Transform(GeodesicSphere(4), { 1, 2, 3 }, 0.4),
         Transform(Box(2), { 1, 1, 3 }, 0.8), FlatRectangle(3, 2) })
  {
    for (const int depth : { 2, 3, 4 }) // grids coarser and finer than the mesh
    {
      const Hybrid hybrid(mesh, depth, HatTransfer::PseudoEvaluation);
      EXPECT_LT((Dense(hybrid.space.Hats().prolongation) - PseudoEvaluation(hybrid))
                  .cwiseAbs()
                  .maxCoeff<Eigen::PropagateNaN>(),
        1e-12);
    }
  }
}

TEST(HatTransfer, KeepsConstants)
{
  for (const SpaceCase& c : AllSpaces())
  {
    const GridFunctions space = c.Build();
    const HatFunctions hats = NumberHatFunctions(c.mesh);
    for (const HatTransfer transfer : { HatTransfer::Evaluation, HatTransfer::PseudoEvaluation })
    {
      MultiVector sums;
      Multiply(BuildHatProlongation(hats, space, c.mesh, transfer),
        MultiVector::Ones(space.Finest().numberOfFunctions, 1), sums);
      EXPECT_LT((sums.array() - 1.0).abs().maxCoeff<Eigen::PropagateNaN>(), 1e-14) << c;
    }
  }
}

TEST(HatTransfer, ReachesTheWholeSurfaceAlsoWhereTheGridIsFiner)
{
  // Each of 18 points reaches only its own 8 functions, about a tenth of a grid of depth 5. The
  // points of the clipped mesh miss few functions. All pieces touch such a function with one
  // cut-off corner of their cell, so all their points lie on faces where it vanishes. On the
  // pieces, it is at most 1/27.
  const TriangleMesh mesh = Transform(GeodesicSphere(2), { 1, 2, 3 }, 0.4);
  EXPECT_GT(ShareWithoutResidual(Hybrid(mesh, 5, HatTransfer::Evaluation)), 0.5);
  EXPECT_LT(ShareWithoutResidual(Hybrid(mesh, 5, HatTransfer::PseudoEvaluation)), 1.0 / 27.0);
}

TEST(HatTransfer, RefusesAnotherMesh)
{
  const Hybrid hybrid(GeodesicSphere(3), 3);
  EXPECT_THROW(BuildHatProlongation(hybrid.space.Hats().functions, hybrid.space.Grid().Functions(),
                 GeodesicSphere(2), HatTransfer::Evaluation),
    InvalidInput);
}
