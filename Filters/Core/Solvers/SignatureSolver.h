// Computes descriptors of the points and of the shape of a surface. They are sums over its modes,
// which are computed or come with the mesh.
#ifndef GridFEM_SignatureSolver_h
#define GridFEM_SignatureSolver_h

#include "Solvers/GivenField.h"
#include "Solvers/SurfaceModes.h"

#include <limits>
#include <memory>
#include <string>
#include <vector>

namespace gridfem
{

/// The modes of a field that are kept.
enum class ModeFilter
{
  None,
  LowPass,   // up to the last mode
  HighPass,  // from the first mode on, with the part that no mode describes
  BandPass,  // from the first mode to the last
  Surrogates // random values with the energy of these values (RotateWithinGroups)
};

class SignatureSolver
{
public:
  struct Options
  {
    EquationOptions equation = EquationOfModes();
    int numberOfModes = 100;     // a group of equal eigenvalues is completed
    int numberOfScales = 16;     // times and bands
    double diffusionTime = 0.01; // squared parameter units
    ModeFilter filterType = ModeFilter::None;
    int firstMode = 1;
    int lastMode = 20;
    int numberOfSurrogates = 10;
    int seed = 1;

    template<class Self, class Visit>
    static void ForEach(Self& self, Visit&& visit)
    {
      constexpr int Largest = std::numeric_limits<int>::max();
      visit(self.equation);
      visit("NumberOfModes", self.numberOfModes, Within(2, 100000));
      visit("NumberOfScales", self.numberOfScales, Within(1, 1000));
      visit("DiffusionTime", self.diffusionTime, AtLeast(0.0));
      visit("FilterType", self.filterType, Within(0, 4));
      visit("FirstMode", self.firstMode, Within(0, Largest));
      visit("LastMode", self.lastMode, Within(0, Largest));
      visit("NumberOfSurrogates", self.numberOfSurrogates, Within(1, 10000));
      visit("Seed", self.seed, Within(0, Largest));
    }
  };

  struct Input
  {
    GivenModes modes;        // none: they are computed
    GivenField values;       // to be filtered, on points; none: the coordinates
    std::vector<Id> sources; // points that distances start at
    SpectrumSolver::Announcement announce;
  };

  /// Rows are the points of this process. Descriptors are NaN at points without modes.
  struct Result
  {
    std::shared_ptr<const PointModes> modes;
    std::vector<double> heatTimes; // squared world units
    MultiVector heatKernel;        // a column per time
    WaveBands waveBands;
    MultiVector waveKernel; // a column per band
    ///@{ One number per point if there are sources, else empty.
    std::vector<double> diffusionDistance;
    std::vector<double> biharmonicDistance;
    ///@}
    ///@{ With a filter, else without columns.
    MultiVector filtered;     // without columns for surrogates
    MultiVector surrogates;   // the columns of the values for each surrogate
    MultiVector coefficients; // of the modes (rows)
    MultiVector remaining;    // error of the sum up to each mode, relative to the error after
                              // constants, or to the values if no mode is constant
    ///@}
    bool isConverged = true;
    std::string where; // the device of the cycles; empty if modes are given
    std::vector<std::string> warnings;
  };

  /// The default options of the surface.
  static SurfaceOptions SurfaceDefaults() { return SpectrumSolver::SurfaceDefaults(); }

  /// Computes the descriptors. Given modes need no preparation of the surface: only its threads,
  /// units and stages are used. Collective. Throws InvalidInput and Aborted.
  const Result& Update(
    Surface& surface, const Input& input, const Options& options, const Job& job);

  static Result Solve(std::shared_ptr<const TriangleMesh> mesh, const Input& input,
    const Options& options, const SurfaceOptions& surfaceOptions = SurfaceDefaults(),
    const Job& job = {});

private:
  void UpdateSums(
    const Surface& surface, const Input& input, const Options& options, const Progress& progress);
  void Expand(const Surface& surface, const TriangleMesh& mesh, const Input& input);
  void Filter(const Surface& surface, const Options& options, const Progress& progress);
  MultiVector Surrogates(
    const Surface& surface, const Options& options, const Progress& progress) const;

  SurfaceModes modes_;
  ///@{ While values are filtered.
  MultiVector values_; // without their large constants
  Eigen::RowVectorXd constants_;
  MultiVector shares_; // of the modes in these values
  ///@}
  Result result_;
};

} // namespace gridfem

#endif
