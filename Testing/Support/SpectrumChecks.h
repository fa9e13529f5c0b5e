// Common parts of tests of spectra: spectra of small problems, properties of every spectrum, and
// independent references.
#ifndef GridFEM_Testing_SpectrumChecks_h
#define GridFEM_Testing_SpectrumChecks_h

#include "Dense.h"
#include "Discretization.h"
#include "Largest.h"
#include "Spectrum/Spectrum.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <vector>

namespace gridfem::testing
{

constexpr double Pi = 3.14159265358979323846;

/// Discretizes with an exact quadrature rule.
inline Discretization DiscretizeExactly(
  const TriangleMesh& mesh, int depth, bool connectivityAware = true)
{
  return Discretize(mesh, depth, 6, connectivityAware);
}

inline Spectrum Solve(const Discretization& on, int modes, double tolerance = 1e-8, int threads = 0)
{
  SpectrumOptions options;
  options.numberOfModes = modes;
  options.tolerance = tolerance;
  options.multigrid.threads = threads;
  return ComputeSpectrum(ViewOf(on.space, on.system), options);
}

/// Returns eigenvalues in world units.
inline std::vector<double> WorldValues(const Discretization& on, const Spectrum& spectrum)
{
  std::vector<double> values = spectrum.eigenvalues;
  for (double& value : values)
  {
    value /= on.Spacing() * on.Spacing();
  }
  return values;
}

/// Returns eigenvalues of a dense solver, in grid units.
inline std::vector<double> DenseReference(const Discretization& on, int modes)
{
  return DenseEigenvalues(
    StiffnessMatrix(on.space, on.system), MassMatrix(on.space, on.system), modes);
}

/// Checks the properties of every spectrum: order, M-orthonormality, true residuals, the sign rule.
inline void CheckPairs(const Discretization& on, const Spectrum& spectrum)
{
  const SparseMatrix mass = MassMatrix(on.space, on.system);
  const SparseMatrix stiffness = StiffnessMatrix(on.space, on.system);
  const Id count = static_cast<Id>(spectrum.eigenvalues.size());
  ASSERT_EQ(spectrum.vectors.cols(), count);
  ASSERT_EQ(spectrum.residuals.size(), spectrum.eigenvalues.size());
  EXPECT_TRUE(std::is_sorted(spectrum.eigenvalues.begin(), spectrum.eigenvalues.end()));
  MultiVector massX;
  MultiVector stiffnessX;
  Multiply(mass, spectrum.vectors, massX);
  Multiply(stiffness, spectrum.vectors, stiffnessX);
  const Eigen::MatrixXd gram = spectrum.vectors.transpose() * massX;
  EXPECT_LT(
    (gram - Eigen::MatrixXd::Identity(count, count)).cwiseAbs().maxCoeff<Eigen::PropagateNaN>(),
    1e-9);
  for (Id j = 0; j < count; ++j)
  {
    const Eigen::VectorXd r = stiffnessX.col(j) - spectrum.eigenvalues[j] * massX.col(j);
    // |r|² <= |L + shift M| rᵀBr, up to the quality of B, and the norm of L is below 10.
    const double bound = 10.0 * spectrum.residuals[j] * std::sqrt(spectrum.eigenvalues[j]);
    EXPECT_LT(r.norm(), bound + 1e-9) << "mode " << j;
    // Among entries of about the same magnitude, the first one decides the sign.
    EXPECT_GT(massX.col(j).maxCoeff<Eigen::PropagateNaN>(),
      (1.0 - 3e-6) * massX.col(j).cwiseAbs().maxCoeff<Eigen::PropagateNaN>());
  }
}

/// Returns the largest relative error of the modes after the constants.
inline double LargestError(const std::vector<double>& values, const std::vector<double>& exact)
{
  double error = 0.0;
  for (std::size_t j = 0; j < values.size(); ++j)
  {
    error = Larger(error, exact[j] > 0.0 ? std::abs(values[j] / exact[j] - 1.0) : values[j]);
  }
  return error;
}

/// Returns l (l + 1), each 2 l + 1 times, for `spheres` unit spheres.
inline std::vector<double> SphereValues(int modes, int spheres = 1)
{
  std::vector<double> values;
  for (int l = 0; static_cast<int>(values.size()) < modes; ++l)
  {
    values.insert(values.end(), (2 * l + 1) * spheres, l * (l + 1.0));
  }
  values.resize(modes);
  return values;
}

} // namespace gridfem::testing

#endif
