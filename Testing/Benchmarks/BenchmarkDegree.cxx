// Eigenvalues by functions of first and second degree: seconds from the triangles to the modes at a
// given error.
//
// The error is the median over modes 2 to 100 of the relative error. The truth of a sphere is
// known. On other surfaces it is the finest Smooth Grid, which has to agree with the next coarser
// one. Seconds and unknowns at an error lie between those of two depths, on a straight line through
// logarithms. Both degrees run in the same way, each job in a process of its own, on two threads.
#include "Measure.h"
#include "Meshes.h"
#include "SetupCost.h"
#include "SpectrumJobs.h"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <functional>

namespace
{

using namespace gridfem;
using namespace gridfem::benchmarks;

constexpr int Threads = 2;
constexpr int Modes = 100;
constexpr double Coarse = 1e-3; // the errors at which seconds are compared
constexpr double Fine = 1e-4;

double MedianError(const std::vector<double>& found, const std::vector<double>& exact)
{
  std::vector<double> errors;
  for (std::size_t k = 1; k < std::min(found.size(), exact.size()); ++k)
  {
    const double error = std::abs(found[k] / exact[k] - 1.0);
    errors.push_back(std::isnan(error) ? HUGE_VAL : error);
  }
  std::sort(errors.begin(), errors.end());
  return errors.at(errors.size() / 2);
}

struct Measured
{
  double error;
  double seconds;
  double unknowns;
  double bytes;
};

using Number = double Measured::*;

/// Between the depths around an error. NaN if no depth reaches it, or the coarsest one does
/// already.
double AtError(const std::vector<Measured>& depths, double error, Number number)
{
  for (std::size_t k = 1; k < depths.size(); ++k)
  {
    const Measured& before = depths[k - 1];
    const Measured& after = depths[k];
    if (after.error <= error && before.error > error)
    {
      const double part = std::log(error / before.error) / std::log(after.error / before.error);
      return before.*number * std::pow(after.*number / (before.*number), part);
    }
  }
  return NAN;
}

class Degrees
{
public:
  /// @param finest  the depth of the Smooth Grid that is the truth
  Degrees(std::string name, TriangleMesh mesh, int finest = 8)
    : name_(std::move(name)), mesh_(std::move(mesh)), finest_(finest)
  {
  }

  void Run(std::vector<double> truth)
  {
    std::printf("\n%s, %zu triangles\n", name_.c_str(), mesh_.triangles.size());
    const Table table({ "functions", "depth", "unknowns", "s", "MB", "median error" });
    double uncertain = 0.0;
    if (truth.empty())
    {
      truth = this->Job(FunctionKind::SmoothGrid, finest_).eigenvalues;
      uncertain = MedianError(this->Job(FunctionKind::SmoothGrid, finest_ - 1).eigenvalues, truth);
      std::printf("The truth differs from the next coarser depth by %.1e\n", uncertain);
    }
    const auto first = this->Measure(table, "first degree", FunctionKind::Grid, 4, 8, truth);
    const auto second =
      this->Measure(table, "second degree", FunctionKind::SmoothGrid, 3, finest_ - 2, truth);
    this->Compare(first, second, Coarse, uncertain, 2.0);
    this->Compare(first, second, Fine, uncertain, 5.0);
  }

private:
  SpectrumJob Job(FunctionKind kind, int depth) const
  {
    return SolverSpectrum(mesh_, kind, depth, Modes, Threads);
  }

  std::vector<Measured> Measure(const Table& table, const std::string& functions, FunctionKind kind,
    int from, int to, const std::vector<double>& truth) const
  {
    std::vector<Measured> depths;
    for (int depth = from; depth <= to; ++depth)
    {
      const SpectrumJob job = this->Job(kind, depth);
      const Measured measured{ MedianError(job.eigenvalues, truth), job.seconds, job.unknowns,
        job.peak };
      depths.push_back(measured);
      table.Row({ functions, std::to_string(depth), Text("%.0f", measured.unknowns),
        Text("%.2f", measured.seconds), Text("%.0f", 1e-6 * measured.bytes),
        Text("%.1e", measured.error) });
    }
    return depths;
  }

  /// The truth has to be three times as accurate as the error.
  void Compare(const std::vector<Measured>& first, const std::vector<Measured>& second,
    double error, double uncertain, double bound) const
  {
    const auto quotient = [&](Number number)
    { return AtError(first, error, number) / AtError(second, error, number); };
    const std::string which = Text("%.0e-", error) + name_;
    const double seconds = quotient(&Measured::seconds);
    if (3.0 * uncertain > error || std::isnan(seconds))
    {
      std::printf("Not compared at %.0e: %s\n", error,
        std::isnan(seconds) ? "no two depths lie around this error"
                            : "the truth is not known well");
      return;
    }
    PrintAtLeast("degree/seconds-at-" + which, seconds, bound);
    PrintAtLeast("degree/unknowns-at-" + which, quotient(&Measured::unknowns), 3.0);
    PrintAtLeast("degree/bytes-at-" + which, quotient(&Measured::bytes), 1.0);
  }

  std::string name_;
  TriangleMesh mesh_;
  int finest_;
};

} // namespace

/// Parts: sphere, and the names of the meshes below.
int main(int argc, char** argv)
{
  const Parts parts(argc, argv);
  if (parts.Want("sphere"))
  {
    Degrees("sphere", testing::Transform(testing::GeodesicSphere(200), { 1, 2, 3 }, 0.7))
      .Run(SphereEigenvalues(Modes));
  }
  if (parts.Want("rocker"))
  {
    Degrees("rocker", RockerArm(1).mesh).Run({});
  }
  for (const auto& [name, file] : { std::pair{ "turbine", "turbine_cad_18k.ply" },
         std::pair{ "armadillo", "armadillo_100k.ply" }, std::pair{ "dragon", "dragon_871k.ply" },
         std::pair{ "brain", "brain_mni_LR.ply" }, std::pair{ "knot", "knot_26k.ply" } })
  {
    if (parts.Want(name))
    {
      Degrees(name, RealMesh(name, file).mesh).Run({});
    }
  }
  if (parts.Want("brain")) // its folds take more memory at depth 8 than there is
  {
    Degrees("brain", RealMesh("brain", "brain_mni_LR.ply").mesh, 7).Run({});
  }
  return 0;
}
