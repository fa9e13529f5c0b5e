// Runs a filter on several MPI ranks. Its inputs are gathered on the first rank, which computes,
// and every rank gets its part of the outputs.
#ifndef GridFEM_GatheredRanks_h
#define GridFEM_GatheredRanks_h

#include "Pieces/GatheredSurface.h"
#include "Pieces/Ranks.h"
#include "Solvers/Stages.h"

#include "vtkNew.h"
#include "vtkSmartPointer.h"

#include <functional>
#include <vector>

class vtkDataObject;
class vtkInformationVector;
class vtkPolyData;

namespace gridfem
{

/// The gathered surface. All functions but Free, IsEmpty and StepsOf are collective. The gathered
/// inputs stay on the first rank for the next run, until the input of one rank changes.
class GatheredRanks
{
public:
  GatheredRanks();
  ~GatheredRanks();

  /// The computation of the first rank. It fills the outputs and returns the time steps of the
  /// filter.
  using Computation = std::function<std::vector<double>(
    vtkInformationVector** inputs, vtkInformationVector* outputs)>;

  /// Brings the gathered inputs up to date, computes, and fills the outputs of all ranks. Does
  /// nothing if no rank has a point.
  /// @param inputs  one vector per port; a surface on port 0
  /// @param weldCoincidentPoints  joins the ranks' pieces at points with the same coordinates
  /// @param ownSteps  the time steps of the filter as this rank knows them
  /// Throws on all ranks if it throws on one.
  void Run(vtkInformationVector** inputs, int ports, vtkInformationVector* outputs,
    bool weldCoincidentPoints, const std::vector<double>& ownSteps, const Computation& compute);

  /// Whether no rank had a point in the last run.
  bool IsEmpty() const { return isEmpty_; }

  /// Notes that the ranks have computed without a run here.
  void NoteComputed() { isEmpty_ = false; }

  /// Returns the time steps of the first rank, which may know more of them after a run. If this
  /// rank's properties have changed since, it returns the steps of this rank.
  const std::vector<double>& StepsOf(const std::vector<double>& own) const;

  /// Frees the gathered inputs.
  void Free();

private:
  void Update(vtkInformationVector** inputs, int ports, bool weldCoincidentPoints);
  void Join(std::vector<Bytes> messages, vtkInformationVector** inputs, int ports,
    bool weldCoincidentPoints);
  vtkInformationVector** GatheredInputs(vtkInformationVector** inputs, int ports);
  std::vector<Bytes> Parts(vtkInformationVector* outputs, const std::vector<double>& steps) const;
  void TakeParts(Bytes bytes, const std::vector<double>& ownSteps, vtkInformationVector* outputs);

  StageKey key_; // the data that this rank has given
  bool isGathered_ = false;
  bool isEmpty_ = true;
  vtkSmartPointer<vtkPolyData> own_;                   // the surface of this rank
  GatheredSurface surface_;                            // on the first rank, as the rest
  std::vector<vtkSmartPointer<vtkDataObject>> others_; // per port; null on port 0 and without data
  std::vector<vtkSmartPointer<vtkInformationVector>> vectors_;
  std::vector<vtkInformationVector*> ports_;
  std::vector<double> ownSteps_;
  std::vector<double> steps_;
};

} // namespace gridfem

#endif
