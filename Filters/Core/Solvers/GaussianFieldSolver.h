// Samples Gaussian random fields with Matérn covariance over a surface.
#ifndef GridFEM_GaussianFieldSolver_h
#define GridFEM_GaussianFieldSolver_h

#include "Equations/MaternField.h"
#include "Solvers/OptionFields.h"
#include "Solvers/Surface.h"

#include <memory>
#include <string>
#include <vector>

namespace gridfem
{

/// Samples fields with mean 0, or estimates their mean and standard deviation at every point. One
/// process has to hold the surface. See MaternField.
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
    bool statistics = false; // mean and standard deviation of the samples, instead of the samples

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
    }
  };

  struct Result
  {
    MultiVector atPoints; // a column for each sample, or mean and standard deviation
    SolveReport report;   // of the worst solve
    std::vector<std::string> warnings;
  };

  static SurfaceOptions SurfaceDefaults();

  /// Samples the field. Another seed repeats only the solves. Throws InvalidInput and Aborted.
  const Result& Update(Surface& surface, const Options& options, const Job& job = {});

  static Result Solve(std::shared_ptr<const TriangleMesh> mesh, const Options& options,
    const SurfaceOptions& surfaceOptions = SurfaceDefaults(), const Job& job = {});

private:
  void UpdateField(const Surface& surface, const Options& options, const Job& job);
  void Sample(const Surface& surface, const Options& options, const Job& job);

  std::unique_ptr<const MaternField> field_;
  std::vector<std::string> warnings_; // about the resolution
  Result result_;
};

} // namespace gridfem

#endif
