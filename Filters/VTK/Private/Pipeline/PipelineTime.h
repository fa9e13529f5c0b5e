// Handles time in the pipeline: the steps of a filter, the time it asks its inputs for, and the
// time that its outputs report.
#ifndef GridFEM_PipelineTime_h
#define GridFEM_PipelineTime_h

#include <optional>
#include <vector>

class vtkDataObject;
class vtkInformation;
class vtkInformationVector;

namespace gridfem
{

/// Gives all outputs the filter's own time steps. They are ascending, at least one.
void SetTimeSteps(const std::vector<double>& steps, vtkInformationVector* outputs);

/// Returns the time of the data, if there is one. The data object may be null.
std::optional<double> TimeOf(vtkDataObject* data);

/// Writes the time of the data, or removes it.
void SetTime(vtkDataObject* data, const std::optional<double>& time);

/// Returns the time that an output is asked for, or an input by the filter, if there is one.
std::optional<double> RequestedTime(vtkInformation* info);

/// Returns the step that an output is asked for, if steps are whole numbers. The last if none is
/// asked for.
int ShownStep(vtkInformation* output, int firstStep, int lastStep);

/// The time that a filter asks its inputs for.
class InputTime
{
public:
  /// For a filter that passes on its input's times: notes the time that goes to its inputs.
  void Follow(vtkInformationVector* input);

  /// For a filter with time steps of its own: requests the same time from all inputs, for any time
  /// that is requested from the outputs. Mode 3 belongs to the surface and not to the input's time
  /// 3. The time is the last noted time, or else the time of the first input's data, or else its
  /// first step. It stays until the first input changes.
  /// @param ports  number of `inputs`, one vector for each port
  void Fix(vtkInformationVector** inputs, int ports);

private:
  void ForgetOfAnother(vtkInformation* input);

  std::optional<double> time_;
  const vtkInformation* input_ = nullptr; // only compared: whose time it is
};

/// Writes the time of the data on all outputs. Without it the pipeline would run the filter again
/// and again. It is the requested time if the steps are the filter's own, else the input's time.
void StampTime(bool hasOwnSteps, vtkInformationVector* input, vtkInformationVector* outputs);

} // namespace gridfem

#endif
