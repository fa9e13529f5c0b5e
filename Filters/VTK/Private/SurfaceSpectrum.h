// The spectrum of a filter's surface, with its stages: in the filter's function space, at its depth
// or at the one that a wanted accuracy needs.
#ifndef GridFEM_SurfaceSpectrum_h
#define GridFEM_SurfaceSpectrum_h

#include "Solvers/Stages.h"
#include "SurfaceSolverState.h"

#include "Problems/Spectrum.h"

#include <vector>

namespace gridfem
{

struct SpectrumRequest
{
  int numberOfModes = 20;
  bool completeMultiplets = false;
  /// Wanted relative accuracy of the eigenvalues, which chooses the depth; 0 keeps the depth.
  double accuracy = 0.0;
};

class SurfaceSpectrum
{
public:
  /// Brings space, system and spectrum up to date. With a wanted accuracy the depth is raised until
  /// the estimated errors on the grid are small enough, or the next one does not fit into memory; a
  /// basis that is given has its depth. Throws InvalidInput and Aborted.
  void Update(SurfaceSolverState& state, vtkPolyData* input, vtkPolyData* basisData,
    const SpectrumRequest& request);

  /// The same by all ranks together, whose space is up to date, at the depth of the space.
  void UpdateTogether(
    SurfaceSolverState& state, const SpectrumRequest& request, const Progress& progress);

  int NumberOfModes() const { return static_cast<int>(eigenvalues.size()); }

  /// Of all modes: the largest residual and the largest estimated error.
  double LargestResidual() const;
  double LargestEstimatedError() const;

  Spectrum spectrum;               // grid units
  std::vector<double> eigenvalues; // world units
  int depth = 0;                   // at which it was computed
  /// After UpdateTogether, in place of the spectrum's vectors: at the points of this rank's piece,
  /// a column per mode, world units. Else without columns.
  MultiVector atPoints;

private:
  StageKey KeyOf(const SurfaceSolverState& state, const SpectrumRequest& request) const;
  void Solve(SurfaceSolverState& state, const SpectrumRequest& request, const Progress& progress);
  void ChooseDepth(SurfaceSolverState& state, vtkPolyData* input, const SpectrumRequest& request);

  int NextDepth(const SurfaceSolverState& state, double accuracy) const;

  std::vector<double> gridErrors_; // estimated, of the wanted modes on the grid
  int nextDepth_ = 0;              // that they ask for; the depth they were found at: they suffice
  StageKey asked_;                 // what `depth` was chosen for
};

/// What a filter's options ask of the solver.
SpectrumOptions SolverOptions(const FilterOptions& options, int numberOfModes);

/// Eigenvalues of a space in world units.
std::vector<double> InWorldUnits(std::vector<double> eigenvalues, double unitLength);

/// The modes `first` and following, `count` of them, at the input's points, world units: a column
/// per mode.
MultiVector EvaluateModes(const SurfaceSolverState& state, const Spectrum& spectrum, Id first,
  Id count, const Progress& progress = {});

} // namespace gridfem

#endif
