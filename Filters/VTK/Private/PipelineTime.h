// Time in the pipeline: which steps a filter has, at which time it asks its inputs, and what its
// outputs say about theirs.
#ifndef GridFEM_PipelineTime_h
#define GridFEM_PipelineTime_h

#include <optional>
#include <vector>

class vtkInformation;
class vtkInformationVector;

namespace gridfem
{

/// Gives all outputs the time steps of the filter's own. Ascending, at least one.
void SetTimeSteps(const std::vector<double>& steps, vtkInformationVector* outputs);

/// The step that an output is asked for where steps are whole numbers; the last when none is.
int ShownStep(vtkInformation* output, int firstStep, int lastStep);

/// The time at which the inputs of a filter are asked for.
class InputTime
{
public:
  /// For a filter that hands its input's times on: notes the time that goes to its inputs.
  void Follow(vtkInformationVector* input);

  /// For a filter with time steps of its own: asks all inputs for the same time whatever the
  /// outputs are asked for, because mode 3 is one of the surface and not of the input's time 3.
  /// That is the time last noted, else that of the data the first input has, else its first step;
  /// it stays until the first input is another one.
  /// @param ports  number of `inputs`, one vector for each port
  void Fix(vtkInformationVector** inputs, int ports);

private:
  void ForgetOfAnother(vtkInformation* input);

  std::optional<double> time_;
  const vtkInformation* input_ = nullptr; // only compared: whose time it is
};

/// Writes the time of the data on all outputs, without which the pipeline would run the filter
/// again and again: the time asked for where the steps are the filter's own, else that of the
/// input.
void StampTime(bool hasOwnSteps, vtkInformationVector* input, vtkInformationVector* outputs);

} // namespace gridfem

#endif
