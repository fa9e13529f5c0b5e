#include "Equations/Kriging.h"

#include "Base/Errors.h"
#include "Base/NormalNumbers.h"

#include <algorithm>
#include <cmath>
#include <cstring>
#include <map>
#include <utility>

namespace gridfem
{
namespace
{

/// Columns that are solved together. They fill the lanes of a vector instruction.
constexpr Id ColumnsAtOnce = 8;

/// Points whose vectors are kept. They take as much memory as a hierarchy.
constexpr Index MostKept = 256;

} // namespace

PointCovariances::PointCovariances(const MaternField& field, SparseMatrix rows, const Job& job)
  : field_(field), rows_(std::move(rows)), loads_(Transpose(rows_, job.threads))
{
  const Id points = rows_.rows;
  betweenPoints_.resize(points, points);
  toCoefficients_.resize(loads_.rows, points <= MostKept ? points : 0);
  for (Id first = 0; first < points; first += ColumnsAtOnce)
  {
    const Id count = std::min(ColumnsAtOnce, points - first);
    MultiVector unit = MultiVector::Zero(points, count);
    unit.middleRows(first, count).setIdentity();
    MultiVector load;
    Multiply(loads_, unit, load, job.threads);
    FieldSamples columns = field_.Covariances(std::move(load),
      job.Part(double(first) / double(points), double(first + count) / double(points)));
    betweenPoints_.middleCols(first, count) = this->AtPoints(columns.coefficients, job.threads);
    if (toCoefficients_.cols() > 0)
    {
      toCoefficients_.middleCols(first, count) = columns.coefficients;
    }
    KeepWorse(std::move(columns.report), report_);
  }
  betweenPoints_ = 0.5 * (betweenPoints_ + betweenPoints_.transpose()).eval();
}

double PointCovariances::EstimateMemory(Id points, Id functions)
{
  const double n = double(points);
  const double kept = points <= MostKept ? n : 0.0;
  constexpr double Matrices = 5.0; // of the points: their covariances, factor, and temporaries
  return sizeof(double) * (kept * double(functions) + Matrices * n * n);
}

FieldSamples PointCovariances::ToCoefficients(const MultiVector& weights, const Job& job) const
{
  if (toCoefficients_.cols() > 0)
  {
    return { toCoefficients_ * weights, report_ };
  }
  MultiVector load;
  Multiply(loads_, weights, load, job.threads);
  return field_.Covariances(std::move(load), job);
}

MultiVector PointCovariances::AtPoints(const MultiVector& coefficients, int threads) const
{
  MultiVector values;
  Multiply(rows_, coefficients, values, threads);
  return values;
}

KrigingWeights::KrigingWeights(Eigen::MatrixXd covariance) : factor_(std::move(covariance))
{
  if (factor_.info() != Eigen::Success || factor_.matrixLLT().hasNaN())
  {
    throw InvalidInput("The covariances of the observations are not positive definite. Raise "
                       "Observation Noise, thin out observations that lie close together, or set "
                       "Tolerance below 1e-9.");
  }
  ones_ = factor_.solve(Eigen::VectorXd::Ones(factor_.rows()));
}

KrigingWeights::Prediction KrigingWeights::Of(const MultiVector& observations) const
{
  Prediction prediction;
  prediction.mean = ones_.transpose() * observations / ones_.sum();
  prediction.weights = factor_.solve(Eigen::MatrixXd(observations.rowwise() - prediction.mean));
  return prediction;
}

/// With P = C⁻¹ - C⁻¹ 1 1ᵀ C⁻¹ / 1ᵀ C⁻¹ 1, the errors are (P y)_i / P_ii of variance 1 / P_ii.
KrigingWeights::LeaveOneOut KrigingWeights::Validate(const Eigen::VectorXd& observations) const
{
  const Eigen::MatrixXd root =
    factor_.matrixL().solve(Eigen::MatrixXd::Identity(factor_.rows(), factor_.rows()));
  const Eigen::ArrayXd diagonal =
    root.colwise().squaredNorm().transpose().array() - ones_.array().square() / ones_.sum();
  // A single observation says nothing about itself: its P is 0 up to rounding.
  const bool isSingle = observations.size() < 2;
  LeaveOneOut result;
  result.error = this->Of(observations).weights.col(0).array() / diagonal;
  result.deviation = diagonal.rsqrt();
  if (isSingle)
  {
    result.error.setConstant(std::nan(""));
    result.deviation.setConstant(std::nan(""));
  }
  result.ratio = std::sqrt((result.error.array() / result.deviation.array()).square().mean());
  return result;
}

/// The determinant of the covariance of the differences is |C| 1ᵀ C⁻¹ 1.
double KrigingWeights::LogLikelihood(const Eigen::VectorXd& observations) const
{
  const Prediction prediction = this->Of(observations);
  const double squares =
    prediction.weights.col(0).dot((observations.array() - prediction.mean[0]).matrix());
  const double logOfDeterminant =
    2.0 * factor_.matrixLLT().diagonal().array().log().sum() + std::log(ones_.sum());
  const double differences = double(observations.size()) - 1.0;
  return -0.5 * (squares + logOfDeterminant + differences * std::log(2.0 * double(EIGEN_PI)));
}

NormalErrors::NormalErrors(const TriangleMesh& mesh, const std::vector<Id>& points)
{
  std::map<std::uint64_t, std::uint64_t> count;
  for (const Id point : points)
  {
    std::uint64_t number = 0;
    for (const double coordinate : mesh.points[point])
    {
      std::uint64_t bits = 0;
      std::memcpy(&bits, &coordinate, sizeof(bits));
      number = NormalNumbers::Mixed(number + bits);
    }
    numbers_.push_back(NormalNumbers::Mixed(number + count[number]++) / 2);
  }
}

MultiVector NormalErrors::Sample(std::uint64_t seed, Id first, Id count) const
{
  MultiVector errors(static_cast<Id>(numbers_.size()), count);
  for (Id c = 0; c < count; ++c)
  {
    // Another seed than that of the fields.
    const NormalNumbers series(NormalNumbers::Mixed(seed), static_cast<std::uint64_t>(first + c));
    for (std::size_t k = 0; k < numbers_.size(); ++k)
    {
      errors(static_cast<Id>(k), c) = series.Pair(numbers_[k])[0];
    }
  }
  return errors;
}

} // namespace gridfem
