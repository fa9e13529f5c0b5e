// Gaussian random fields with Matérn covariance on a surface, as solutions of an equation with
// white noise.
#ifndef GridFEM_MaternField_h
#define GridFEM_MaternField_h

#include "Equations/Poisson.h"

#include <cstdint>
#include <memory>
#include <vector>

namespace gridfem
{

struct MaternOptions : EquationOptions
{
  double kappa = 1.0; // κ > 0, per unit of length of the space
  int smoothness = 1; // ν: 1, 2 or 3
};

struct FieldSamples
{
  MultiVector coefficients; // rows = functions, one column per sample or load
  SolveReport report;       // of the worst solve
};

/// Samples the solutions u of (κ² - Δ)^((ν+1)/2) u = σ √(4πν) κ^ν W with white noise W and σ = 1.
/// On a plane they have the Matérn covariance (κr)^ν K_ν(κr) / (2^(ν-1) Γ(ν)), so the variance
/// is 1. Boundaries are natural: the normal derivative is 0. [Whittle 1954; Lindgren, Rue and
/// Lindström: An explicit link between Gaussian fields and Gaussian Markov random fields, 2011]
///
/// Let K = κ² M + L. The samples are K⁻¹ w for ν = 1, K⁻¹ M K⁻¹ k for ν = 2, and K⁻¹ M K⁻¹ w for
/// ν = 3. The noise w has the covariance M, and the noise k has the covariance K (RandomLoads).
/// K⁻¹ k then has the covariance K⁻¹, which is the covariance for ν = 0. The hierarchy does every
/// solve; no large matrix is factorized.
class MaternField
{
public:
  /// Throws InvalidInput for options out of range, and Aborted.
  MaternField(std::shared_ptr<const FiniteElementSpace> space, const MaternOptions& options,
    const Job& job = {});

  /// Returns the samples `first` .. `first` + `count` - 1 of a seed. Same bits for any number of
  /// threads. Throws Aborted.
  FieldSamples Sample(std::uint64_t seed, Id first, Id count, const Job& job = {}) const;

  /// The standard deviation of the mean of a sample over each connected component. On a component
  /// of area A it is √(4πν / A) / κ. If it is not small beside 1, the samples on this component
  /// have a standard deviation above 1.
  std::vector<double> DeviationsOfMeans(const Job& job = {}) const;

  /// The tolerance of the solves of Covariances. Dense systems of covariances amplify errors.
  double CovarianceTolerance() const;

  /// Returns S b for the covariance S of the coefficients of Sample. If the load b is the row of a
  /// point, S b has the covariances of all coefficients with the field at this point. It takes
  /// ν + 1 solves, to CovarianceTolerance. Same bits for any number of threads. Throws
  /// InvalidInput unless the load has a row for each function, and Aborted.
  FieldSamples Covariances(MultiVector load, const Job& job = {}) const;

private:
  /// Solves with K several times, and multiplies by M in between.
  FieldSamples Solve(MultiVector load, int solves, double tolerance, const Job& job) const;

  /// Makes the variance 1.
  double Scale() const;

  std::shared_ptr<const FiniteElementSpace> space_;
  MaternOptions options_;
  SparseMatrix mass_;
  std::unique_ptr<Multigrid> multigrid_; // of K
};

} // namespace gridfem

#endif
