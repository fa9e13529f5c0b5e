// The state that a filter keeps between runs: its options, stages, progress, and the surface in
// use.
#ifndef GridFEM_FilterState_h
#define GridFEM_FilterState_h

#include "Pipeline/InputSurface.h"
#include "Pipeline/ProgressBridge.h"

#include <map>
#include <string>

namespace gridfem
{

class FilterState
{
public:
  explicit FilterState(vtkAlgorithm* filter);
  ~FilterState();

  /// The surface in use: the whole, unless the ranks run a body together or did so last.
  InputSurface& Surface() const { return *used_; }

  /// Sets the input of this run, and returns its surface.
  InputSurface& Read(vtkPolyData* input, vtkPolyData* basisData);

  /// Whether the surface in use is this rank's piece.
  bool UsesPiece() const { return used_ != whole_.get(); }

  /// Takes the whole surface from here on.
  void UseWhole() { used_ = whole_.get(); }

  /// Runs a body on all MPI ranks, each with its piece as the surface in use. Collective. Needs
  /// MPI.
  void RunTogether(const std::function<void()>& body);

  /// The progress of the run, of all ranks within RunTogether.
  Progress GetProgress() { return this->UsesPiece() ? progressOfAll_ : bridge.GetProgress(); }

  /// Notes whether a property was given a value out of its range. Returns whether the note changed.
  bool NoteRange(const std::string& property, double value, double least, double most);

  /// Throws InvalidInput if the last value of a property was out of its range.
  void RequireRanges() const;

  /// Frees everything that the stages have made.
  void Free();

  FilterOptions options; // the requested options
  Stages stages;
  ProgressBridge bridge;

private:
  vtkAlgorithm* filter_;
  std::map<std::string, std::string> refusals_; // messages, by property
  std::unique_ptr<InputSurface> whole_;
  std::unique_ptr<InputSurface> piece_; // null before RunTogether
  InputSurface* used_;
  Progress progressOfAll_;
};

} // namespace gridfem

#endif
