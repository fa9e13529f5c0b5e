// Covariances against dense ones. Predictions against the dense system of the posterior, which has
// the inverse of the covariance, and against predictions without an observation.
#include "Equations/Kriging.h"

#include "Base/Errors.h"
#include "Dense.h"
#include "EitherSpace.h"
#include "Spaces.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

using namespace gridfem;
using namespace gridfem::testing;

namespace
{

constexpr double Kappa2 = 0.3; // per squared unit of length of the space

std::unique_ptr<FiniteElementSpace> Build(bool isOnHats, int threads = 0)
{
  return BuildEither(
    Transform(Torus(14, 9, 1.0, 0.4), { 1, 2, 3 }, 0.4), isOnHats, 3, 1e-2, threads);
}

MaternField FieldOn(const FiniteElementSpace& space, int smoothness, int threads = 0)
{
  MaternOptions options;
  options.solve.tolerance = 1e-11;
  options.solve.maximumIterations = 200;
  options.kappa = std::sqrt(Kappa2);
  options.smoothness = smoothness;
  options.multigrid.threads = threads;
  return MaternField(space.Copy(), options, threads);
}

/// The covariance of the coefficients, densely.
Eigen::MatrixXd DenseCovariance(const FiniteElementSpace& space, int smoothness)
{
  const Eigen::MatrixXd mass = Dense(space.Matrix(0, 1.0, 0.0));
  const Eigen::MatrixXd K = Dense(space.Matrix(0, Kappa2, 1.0));
  Eigen::MatrixXd covariance =
    DenseSolution(K, Eigen::MatrixXd::Identity(K.rows(), K.cols())); // of ν = 0
  for (int k = 0; k < smoothness; ++k)
  {
    covariance = DenseSolution(K, Product(mass, covariance));
  }
  return 4.0 * std::acos(-1.0) * smoothness * std::pow(Kappa2, smoothness) * covariance;
}

const std::vector<Id> Observed = { 3, 4, 17, 40, 59, 77, 101, 118, 125 };

MultiVector Observations()
{
  MultiVector y(static_cast<Id>(Observed.size()), 2);
  for (Id k = 0; k < y.rows(); ++k)
  {
    y.row(k) << 11.0 + std::sin(1.7 * double(k)), 0.3 * double(k * k % 7);
  }
  return y;
}

Eigen::MatrixXd WithNoise(Eigen::MatrixXd covariance, double noise)
{
  covariance.diagonal().array() += noise * noise;
  return covariance;
}

double LargestDifference(const Eigen::MatrixXd& one, const Eigen::MatrixXd& other)
{
  return (one - other).cwiseAbs().maxCoeff<Eigen::PropagateNaN>();
}

/// The prediction at the functions.
MultiVector Predict(
  const PointCovariances& covariances, const KrigingWeights& weights, const MultiVector& y)
{
  const KrigingWeights::Prediction prediction = weights.Of(y);
  return covariances.ToCoefficients(prediction.weights).coefficients.rowwise() + prediction.mean;
}

/// The most likely coefficients u and mean m of the posterior with the precision Q, which minimize
/// (u - m 1)ᵀ Q (u - m 1) + |A u - y|² / τ².
Eigen::MatrixXd MostLikely(
  const Eigen::MatrixXd& Q, const Eigen::MatrixXd& A, const Eigen::MatrixXd& y, double noise)
{
  const Id n = Q.rows();
  const Eigen::VectorXd Q1 = Q.rowwise().sum();
  Eigen::MatrixXd system(n + 1, n + 1);
  system << Q + Product(A.transpose(), A) / (noise * noise), -Q1, -Q1.transpose(), Q1.sum();
  Eigen::MatrixXd right = Eigen::MatrixXd::Zero(n + 1, y.cols());
  right.topRows(n) = Product(A.transpose(), y) / (noise * noise);
  return DenseSolution(system, right).topRows(n);
}

} // namespace

TEST(Kriging, CovariancesAreThoseOfTheField)
{
  for (const bool isOnHats : { false, true })
  {
    const auto space = Build(isOnHats);
    const SparseMatrix rows = space->RowsAtPoints(Observed);
    const Eigen::MatrixXd A = Dense(rows);
    for (const int smoothness : { 1, 2, 3 })
    {
      const MaternField field = FieldOn(*space, smoothness);
      const PointCovariances covariances(field, rows);
      EXPECT_TRUE(covariances.Report().converged);
      const Eigen::MatrixXd columns = ProductWithTransposed(DenseCovariance(*space, smoothness), A);
      const Eigen::MatrixXd between = Product(A, columns);
      const double allowed = 1e-7 * between.diagonal().maxCoeff<Eigen::PropagateNaN>();
      EXPECT_LT(
        (covariances.BetweenPoints() - between).cwiseAbs().maxCoeff<Eigen::PropagateNaN>(), allowed)
        << isOnHats << smoothness;
      const MultiVector found =
        space->ValuesAtPoints(covariances.ToCoefficients(MultiVector::Identity(9, 9)).coefficients);
      EXPECT_LT((found - space->ValuesAtPoints(columns)).cwiseAbs().maxCoeff<Eigen::PropagateNaN>(),
        allowed)
        << isOnHats << smoothness;
    }
  }
}

/// The prediction solves the hat system of the posterior.
TEST(Kriging, PredictsWhatThePosteriorDoes)
{
  const auto space = Build(true);
  const SparseMatrix rows = space->RowsAtPoints(Observed);
  for (const int smoothness : { 1, 2, 3 })
  {
    const MaternField field = FieldOn(*space, smoothness);
    const PointCovariances covariances(field, rows);
    const Eigen::MatrixXd S = DenseCovariance(*space, smoothness);
    const Eigen::MatrixXd Q = DenseSolution(S, Eigen::MatrixXd::Identity(S.rows(), S.cols()));
    for (const double noise : { 0.1, 1.0 })
    {
      const KrigingWeights weights(WithNoise(covariances.BetweenPoints(), noise));
      const MultiVector found = Predict(covariances, weights, Observations());
      const Eigen::MatrixXd expected = MostLikely(Q, Dense(rows), Observations(), noise);
      for (const Id c : { 0, 1 })
      {
        EXPECT_LT((found.col(c) - expected.col(c)).cwiseAbs().maxCoeff<Eigen::PropagateNaN>(),
          1e-6 * expected.col(c).cwiseAbs().maxCoeff<Eigen::PropagateNaN>())
          << smoothness << noise << c;
      }
    }
  }
}

/// With little noise the prediction is the observations.
TEST(Kriging, MeetsExactObservations)
{
  constexpr double Noise = 1e-3;
  for (const bool isOnHats : { false, true })
  {
    const auto space = Build(isOnHats);
    const MaternField field = FieldOn(*space, 1);
    const PointCovariances covariances(field, space->RowsAtPoints(Observed));
    const KrigingWeights weights(WithNoise(covariances.BetweenPoints(), Noise));
    const MultiVector y = Observations();
    const MultiVector met = covariances.AtPoints(Predict(covariances, weights, y));
    EXPECT_LT((met - y).cwiseAbs().maxCoeff<Eigen::PropagateNaN>(), 0.01);
  }
}

/// The errors and their deviations are those of a prediction from the other observations.
TEST(Kriging, LeavesOneOut)
{
  constexpr double Noise = 0.2;
  const auto space = Build(true);
  const MaternField field = FieldOn(*space, 2);
  const PointCovariances all(field, space->RowsAtPoints(Observed));
  const Eigen::VectorXd y = Observations().col(0);
  const Id n = y.size();
  const Eigen::MatrixXd C = WithNoise(all.BetweenPoints(), Noise);
  const KrigingWeights::LeaveOneOut found = KrigingWeights(C).Validate(y);
  double squares = 0.0;
  for (Id out = 0; out < n; ++out)
  {
    // The observation that is left out is the last one.
    Eigen::PermutationMatrix<Eigen::Dynamic> last(static_cast<int>(n));
    last.setIdentity();
    last.applyTranspositionOnTheRight(out, n - 1);
    const Eigen::MatrixXd ordered = last.transpose() * C * last;
    const Eigen::VectorXd known = (last.transpose() * y).head(n - 1);
    const Eigen::MatrixXd others = ordered.topLeftCorner(n - 1, n - 1);
    const Eigen::VectorXd to = ordered.col(n - 1).head(n - 1);
    const KrigingWeights::Prediction prediction = KrigingWeights(others).Of(known);
    const double error = y[out] - prediction.mean[0] - to.dot(prediction.weights.col(0));
    EXPECT_NEAR(found.error[out], error, 1e-9);
    // The variance of the error, from C and the weights of the observations in the prediction.
    Eigen::VectorXd combination(n);
    for (Id k = 0; k < n - 1; ++k)
    {
      const KrigingWeights::Prediction unit =
        KrigingWeights(others).Of(Eigen::MatrixXd::Identity(n - 1, n - 1).col(k));
      combination[k] = -unit.mean[0] - to.dot(unit.weights.col(0));
    }
    combination[n - 1] = 1.0;
    const double variance = combination.dot(ordered * combination);
    EXPECT_NEAR(found.deviation[out], std::sqrt(variance), 1e-9);
    squares += error * error / variance;
  }
  EXPECT_NEAR(found.ratio, std::sqrt(squares / double(n)), 1e-9);
  EXPECT_TRUE(
    std::isnan(KrigingWeights(C.topLeftCorner(1, 1)).Validate(Eigen::VectorXd::Ones(1)).error[0]));
}

/// The likelihood of the differences from any one of the observations, by their own covariance.
TEST(Kriging, HasTheLikelihoodOfTheDifferences)
{
  const double pi = std::acos(-1.0);
  Eigen::Matrix3d C;
  C << 2.0, 1.2, 0.3, 1.2, 1.5, -0.1, 0.3, -0.1, 4.0;
  const Eigen::Vector3d y(4.0, 5.0, 9.0);
  const double found = KrigingWeights(C).LogLikelihood(y);
  for (const Id from : { 0, 1, 2 })
  {
    const Id i = (from + 1) % 3;
    const Id k = (from + 2) % 3;
    const Eigen::Vector2d d(y[i] - y[from], y[k] - y[from]);
    // The covariance of the two differences, and its inverse by Cramer's rule.
    const double a = C(i, i) + C(from, from) - 2.0 * C(i, from);
    const double b = C(k, k) + C(from, from) - 2.0 * C(k, from);
    const double c = C(i, k) - C(i, from) - C(k, from) + C(from, from);
    const double determinant = a * b - c * c;
    const double squares =
      (b * d[0] * d[0] - 2.0 * c * d[0] * d[1] + a * d[1] * d[1]) / determinant;
    EXPECT_NEAR(found, -0.5 * (squares + std::log(determinant)) - std::log(2.0 * pi), 1e-12);
  }
  EXPECT_NEAR(KrigingWeights(C.topLeftCorner(1, 1)).LogLikelihood(y.head(1)), 0.0, 1e-14);
}

/// A field and the same field plus a random constant tell the same, because the mean is unknown.
TEST(Kriging, ACommonConstantOfTheFieldChangesNothing)
{
  const auto space = Build(true);
  const MaternField field = FieldOn(*space, 2);
  const PointCovariances covariances(field, space->RowsAtPoints(Observed));
  const MultiVector y = Observations();
  const Eigen::MatrixXd C = WithNoise(covariances.BetweenPoints(), 0.3);
  const KrigingWeights one(C);
  for (const double variance : { 0.5, 20.0 })
  {
    const KrigingWeights other((C.array() + variance).matrix());
    EXPECT_LT(LargestDifference(one.Of(y).weights, other.Of(y).weights), 1e-9) << variance;
    EXPECT_LT(LargestDifference(one.Of(y).mean, other.Of(y).mean), 1e-9) << variance;
    const Eigen::VectorXd values = y.col(0);
    EXPECT_NEAR(one.Validate(values).ratio, other.Validate(values).ratio, 1e-9) << variance;
    EXPECT_NEAR(one.LogLikelihood(values), other.LogLikelihood(values), 1e-9) << variance;
  }
}

/// The columns of many points are not kept, and products with them take solves.
TEST(Kriging, ManyPointsGiveTheSame)
{
  const auto space = Build(true);
  const MaternField field = FieldOn(*space, 1);
  std::vector<Id> some(100);
  std::vector<Id> many(300);
  for (std::size_t k = 0; k < many.size(); ++k)
  {
    many[k] = static_cast<Id>(k) % 126;
  }
  std::copy_n(many.begin(), some.size(), some.begin());
  const PointCovariances ofSome(field, space->RowsAtPoints(some));
  const PointCovariances ofMany(field, space->RowsAtPoints(many));
  const Eigen::MatrixXd block = ofMany.BetweenPoints().topLeftCorner(100, 100);
  EXPECT_LT((block - ofSome.BetweenPoints()).cwiseAbs().maxCoeff<Eigen::PropagateNaN>(), 1e-7);
  MultiVector weights = MultiVector::Zero(300, 2);
  weights.topRows(100) = RandomValues(100, 2);
  const MultiVector one = ofSome.ToCoefficients(weights.topRows(100)).coefficients;
  const MultiVector other = ofMany.ToCoefficients(weights).coefficients;
  EXPECT_LT((one - other).cwiseAbs().maxCoeff<Eigen::PropagateNaN>(),
    1e-7 * one.cwiseAbs().maxCoeff<Eigen::PropagateNaN>());
}

TEST(Kriging, GivesTheSameBitsForAnyNumberOfThreads)
{
  for (const bool isOnHats : { false, true })
  {
    const auto predict = [&](int threads)
    {
      const auto space = Build(isOnHats, threads);
      const MaternField field = FieldOn(*space, 2, threads);
      const PointCovariances covariances(field, space->RowsAtPoints(Observed), threads);
      const KrigingWeights weights(WithNoise(covariances.BetweenPoints(), 0.1));
      return Predict(covariances, weights, Observations());
    };
    EXPECT_EQ(predict(1), predict(3)) << isOnHats;
  }
}

TEST(Kriging, RefusesCovariancesThatAreNone)
{
  Eigen::Matrix2d C;
  C << 1.0, 2.0, 2.0, 1.0;
  EXPECT_THROW(KrigingWeights{ C }, InvalidInput);
  C(0, 1) = C(1, 0) = std::nan("");
  EXPECT_THROW(KrigingWeights{ C }, InvalidInput);
}
