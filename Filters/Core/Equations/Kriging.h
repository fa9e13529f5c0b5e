// What values at some points tell about a Gaussian random field everywhere (kriging).
#ifndef GridFEM_Kriging_h
#define GridFEM_Kriging_h

#include "Algebra/SparseMatrix.h"
#include "Equations/MaternField.h"
#include "Grid/TriangleMesh.h"

#include <Eigen/Cholesky>

#include <cstdint>
#include <memory>
#include <vector>

namespace gridfem
{

/// The covariances of a Matérn field of variance 1 between n points, and from these points to all
/// coefficients. With the rows A of the points and the covariance S of the coefficients, they are
/// A S Aᵀ and S Aᵀ. The n columns are solved for a few at a time.
class PointCovariances
{
public:
  /// @param field  outlives this object
  /// @param rows   RowsAtPoints of the points
  /// Throws InvalidInput if the columns of the rows are not the functions, and Aborted.
  PointCovariances(const MaternField& field, SparseMatrix rows, const Job& job = {});

  /// Bytes for this number of points, with the factors of KrigingWeights.
  static double EstimateMemory(Id points, Id functions);

  /// A S Aᵀ, symmetric.
  const Eigen::MatrixXd& BetweenPoints() const { return betweenPoints_; }

  /// Returns S Aᵀ w.
  /// @param weights  w: rows = points, any number of columns
  FieldSamples ToCoefficients(const MultiVector& weights, const Job& job = {}) const;

  /// Returns the values at the points.
  MultiVector AtPoints(const MultiVector& coefficients, int threads = 0) const;

  /// The worst solve.
  const SolveReport& Report() const { return report_; }

private:
  const MaternField& field_;
  SparseMatrix rows_;
  SparseMatrix loads_; // Aᵀ
  Eigen::MatrixXd betweenPoints_;
  MultiVector toCoefficients_; // empty for many points, whose products take solves instead
  SolveReport report_ = SolveReport::Solved();
};

/// Predicts a field with a constant unknown mean m (ordinary kriging). With the covariance C of the
/// observations, noise included, the prediction from the observations y is
///   u = m + S Aᵀ w,   w = C⁻¹ (y - m),   m = 1ᵀ C⁻¹ y / 1ᵀ C⁻¹ 1.
/// [Cressie: Statistics for Spatial Data, 1993, section 3.2]
class KrigingWeights
{
public:
  /// @param covariance  C; positive definite
  /// Throws InvalidInput if it is not positive definite up to rounding.
  explicit KrigingWeights(Eigen::MatrixXd covariance);

  struct Prediction
  {
    MultiVector weights;     // w: rows = observations
    Eigen::RowVectorXd mean; // m
  };

  /// @param observations  a column for each set of observations of the same points
  Prediction Of(const MultiVector& observations) const;

  /// How well each observation is predicted by all others. [Dubrule: Cross validation of kriging in
  /// a unique neighborhood, 1983]
  struct LeaveOneOut
  {
    Eigen::VectorXd error;     // observation minus prediction; NaN for a single observation
    Eigen::VectorXd deviation; // the standard deviation of the error that C implies
    double ratio = 0.0; // root mean square of error / deviation: 1 if C suits the observations
  };
  LeaveOneOut Validate(const Eigen::VectorXd& observations) const;

  /// The logarithm of the restricted likelihood of the observations: the density of their
  /// differences from any one of them. A constant that is added to all covariances changes neither
  /// this density nor a prediction. [Harville: Bayesian inference for variance components using
  /// only error contrasts, 1974]
  double LogLikelihood(const Eigen::VectorXd& observations) const;

private:
  Eigen::LLT<Eigen::MatrixXd> factor_;
  Eigen::VectorXd ones_; // C⁻¹ 1
};

/// Normal numbers for the errors of observations. They depend on the coordinates, so that the order
/// of the mesh changes no sample, and differ for several observations of one place.
class NormalErrors
{
public:
  NormalErrors() = default;

  /// @param points  the observed points of the mesh
  NormalErrors(const TriangleMesh& mesh, const std::vector<Id>& points);

  /// Returns a column for each of the samples `first` .. `first` + `count` - 1 of a seed.
  MultiVector Sample(std::uint64_t seed, Id first, Id count) const;

private:
  std::vector<std::uint64_t> numbers_; // per observation
};

} // namespace gridfem

#endif
