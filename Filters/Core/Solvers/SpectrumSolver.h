// Computes the smallest eigenvalues of the Laplace operator of a surface, and their eigenfunctions.
#ifndef GridFEM_SpectrumSolver_h
#define GridFEM_SpectrumSolver_h

#include "Solvers/OptionFields.h"
#include "Solvers/Surface.h"
#include "Spectrum/Spectrum.h"

#include <functional>
#include <string>
#include <vector>

namespace gridfem
{

/// The options of an equation for modes. Its tolerance is the relative error of the eigenvalues in
/// the function space. A V-cycle costs less than a W-cycle.
EquationOptions EquationOfModes();

/// Computes the modes at the depth of the surface, or at the depth that a wanted accuracy needs.
class SpectrumSolver
{
public:
  struct Options
  {
    EquationOptions equation = EquationOfModes();
    int numberOfModes = 20;
    /// The wanted relative error of the eigenvalues of the surface. Above 0 it chooses the depth,
    /// unless functions are given. Processes that share a surface cannot choose a depth.
    double accuracy = 0.0;
    bool zeroBoundaryValues = false; // modes vanish on the boundary, else nothing flows across it

    template<class Self, class Visit>
    static void ForEach(Self& self, Visit&& visit)
    {
      visit(self.equation);
      visit("NumberOfModes", self.numberOfModes, Within(1, 100000));
      visit("Accuracy", self.accuracy, Within(0.0, 0.5));
      visit("ZeroBoundaryValues", self.zeroBoundaryValues, AnyValue());
    }
  };

  /// Receives the cost of a computation of a minute or more, before it begins.
  using Announcement = std::function<void(const std::string& cost, bool takesHours)>;

  struct Input
  {
    /// There may be more modes than requested, because the last group of equal eigenvalues is
    /// complete.
    bool completesMultiplets = false;
    Announcement announce;
  };

  struct Result
  {
    Spectrum spectrum;               // in units of the space
    std::vector<double> eigenvalues; // per squared world length
    MultiVector atPoints;            // of Solve alone: a column per mode (ModesAtPoints)
    int depth = 0;                   // of the grid
    bool isAccurate = true;          // as accurate as wanted
    bool isErrorTrusted = true;      // all estimated errors
    std::vector<std::string> warnings;

    int NumberOfModes() const { return static_cast<int>(eigenvalues.size()); }
  };

  /// The default options of the surface.
  static SurfaceOptions SurfaceDefaults();

  /// Computes the modes. With a wanted accuracy it raises the depth until the estimated errors on
  /// the grid are small enough, or the next depth does not fit into memory. Errors that are not
  /// trusted have to be small enough at two depths, one after the other. Collective. Throws
  /// InvalidInput and Aborted.
  const Result& Update(
    Surface& surface, const Input& input, const Options& options, const Job& job);

  /// The modes `first` and following at the points of this process. Each column is a mode, whose
  /// square has the integral 1 in world units. Collective.
  MultiVector ModesAtPoints(
    const Surface& surface, Id first, Id count, const Progress& progress = {}) const;

  /// Frees the modes, but keeps their number.
  void Free() { result_.spectrum = {}; }

  static Result Solve(std::shared_ptr<const TriangleMesh> mesh, const Input& input,
    const Options& options, const SurfaceOptions& surfaceOptions = SurfaceDefaults(),
    const Job& job = {});

private:
  /// A depth of a search.
  struct Choice
  {
    int depth = 0;
    bool wasAccurate = false; // whether the errors were small enough at the depth before
  };

  Choice FirstDepth(Surface& surface, const Options& options);
  bool IsConfirmed() const;
  bool AreGridErrorsAtMost(double accuracy) const;
  int NextDepth(const Surface& surface, double accuracy) const;
  void UpdateModes(
    const Surface& surface, const Input& input, const Options& options, const Progress& progress);
  void TakeGridErrors(const Spectrum& nested, int wanted);
  void Judge(const Surface& surface, const Options& options);

  std::vector<double> gridErrors_; // estimated, of the wanted modes on the grid
  bool areTrusted_ = false;        // all of these errors
  bool lacksBoundary_ = false;     // though the modes are to vanish there
  StageKey depthKey_;              // of the mesh and the wishes that a depth was chosen for
  Choice chosen_;                  // for them
  Choice now_;                     // the depth of the solve, if it is chosen
  Result result_;
};

} // namespace gridfem

#endif
