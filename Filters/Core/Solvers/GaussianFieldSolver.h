// Samples Gaussian random fields with Matérn covariance over a surface, freely or given observed
// values at some points.
#ifndef GridFEM_GaussianFieldSolver_h
#define GridFEM_GaussianFieldSolver_h

#include "Equations/Kriging.h"
#include "Equations/MaternField.h"
#include "Solvers/GivenField.h"
#include "Solvers/OptionFields.h"
#include "Solvers/Surface.h"

#include <limits>
#include <memory>
#include <string>
#include <vector>

namespace gridfem
{

/// Samples fields with mean 0, or estimates their mean and standard deviation at every point. With
/// observations it predicts the field instead, with a constant unknown mean (kriging), and samples
/// what the observations leave open. One process has to hold the surface. See MaternField and
/// KrigingWeights.
class GaussianFieldSolver
{
public:
  struct Options
  {
    EquationOptions equation = EndedByTolerance(1e-6);
    double range = 0.2; // distance of correlation 0.14 (Smoothness 1); parameter units, above 0
    int smoothness = 2; // ν of the covariance
    double standardDeviation = 1.0;
    int seed = 1;
    int numberOfSamples = 1;
    /// Mean and standard deviation of the samples, instead of the samples. A single sample has no
    /// standard deviation; its number stands for SamplesOfStatistics.
    bool statistics = false;
    /// Standard deviation of the errors of observations, at least LeastNoise of that of the field.
    double observationNoise = 0.0;

    template<class Self, class Visit>
    static void ForEach(Self& self, Visit&& visit)
    {
      visit(self.equation);
      visit("Range", self.range, AtLeast(0.0));
      visit("Smoothness", self.smoothness, Within(1, 3));
      visit("StandardDeviation", self.standardDeviation, AtLeast(0.0));
      visit("Seed", self.seed, Within(0, std::numeric_limits<int>::max()));
      visit("NumberOfSamples", self.numberOfSamples, Within(1, 100000));
      visit("Statistics", self.statistics, AnyValue());
      visit("ObservationNoise", self.observationNoise, AtLeast(0.0));
    }
  };

  /// Exact observations close to each other make a system that no solve is accurate enough for. So
  /// they have errors of this fraction of the standard deviation.
  static constexpr double LeastNoise = 1e-3;

  static constexpr int SamplesOfStatistics = 100;

  /// Their covariances are a dense matrix.
  static constexpr Id MostObservations = 4000;

  struct Input
  {
    /// Observed values with one component, or none. They are found in every update, and their
    /// version does not count. Other values repeat only the solves with them.
    GivenConstraints observations;
  };

  /// What follows from the observations.
  struct Prediction
  {
    Eigen::VectorXd mean;             // at points; empty without observations
    Eigen::VectorXd leaveOneOutError; // at points: observation minus its prediction from all
                                      // others; the mean of several; NaN at other points
    double leaveOneOutRatio = 0.0;    // KrigingWeights::LeaveOneOut
    double logLikelihood = 0.0;       // KrigingWeights::LogLikelihood
  };

  struct Result
  {
    /// A column for each sample, or mean and standard deviation. With observations the mean is that
    /// of the prediction, and the standard deviation refers to it.
    MultiVector atPoints;
    Prediction prediction;
    SolveReport report; // of the worst solve
    std::vector<std::string> warnings;
  };

  static SurfaceOptions SurfaceDefaults() { return StabilizedSurface(); }

  /// Samples the field. Another seed or other values repeat only the solves. Throws InvalidInput
  /// and Aborted.
  const Result& Update(
    Surface& surface, const Input& input, const Options& options, const Job& job = {});

  static Result Solve(std::shared_ptr<const TriangleMesh> mesh, const Input& input,
    const Options& options, const SurfaceOptions& surfaceOptions = SurfaceDefaults(),
    const Job& job = {});

private:
  void UpdateField(const Surface& surface, const Options& options, const Job& job);
  void TakeObservations(const Surface& surface, const Input& input);
  void UpdateCovariances(const Surface& surface, const Job& job);
  void Predict(const Surface& surface, const Options& options, const Job& job);
  void Sample(const Surface& surface, const Options& options, const Job& job);
  MultiVector SomeSamples(
    const Surface& surface, const Options& options, Id first, Id count, const Job& job);
  std::vector<std::string> Warnings(const Options& options) const;

  std::unique_ptr<const MaternField> field_;
  PointValues observed_;                                // empty without observations
  NormalErrors errors_;                                 // of the observed points
  std::unique_ptr<const PointCovariances> covariances_; // of the observed points
  std::unique_ptr<const KrigingWeights> weights_;
  std::vector<std::string> resolutionWarnings_;
  std::vector<double> deviationsOfMeans_; // MaternField
  SolveReport ofSamples_;
  SolveReport ofCovariances_; // their tolerance is another one
  Result result_;
};

} // namespace gridfem

#endif
