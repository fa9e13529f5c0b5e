#include "Pipeline/PipelineTime.h"

#include "vtkDataObject.h"
#include "vtkInformation.h"
#include "vtkInformationVector.h"
#include "vtkStreamingDemandDrivenPipeline.h"

#include <algorithm>
#include <cmath>

namespace gridfem
{
namespace
{

using Pipeline = vtkStreamingDemandDrivenPipeline;

std::optional<double> FirstStep(vtkInformation* info)
{
  return info->Length(Pipeline::TIME_STEPS()) > 0
           ? std::make_optional(info->Get(Pipeline::TIME_STEPS())[0])
           : std::nullopt;
}

/// Returns the time of the data on one output, if it has any.
std::optional<double> OutputTime(
  bool hasOwnSteps, vtkInformationVector* input, vtkInformation* output)
{
  if (hasOwnSteps)
  {
    return RequestedTime(output);
  }
  const std::optional<double> given = TimeOf(vtkDataObject::GetData(input));
  // A source with steps need not report the step of its data.
  return given || !output->Has(Pipeline::TIME_RANGE()) ? given : RequestedTime(output);
}

} // namespace

void SetTimeSteps(const std::vector<double>& steps, vtkInformationVector* outputs)
{
  const double range[2] = { steps.front(), steps.back() };
  for (int port = 0; port < outputs->GetNumberOfInformationObjects(); ++port)
  {
    vtkInformation* info = outputs->GetInformationObject(port);
    info->Set(Pipeline::TIME_STEPS(), steps.data(), static_cast<int>(steps.size()));
    info->Set(Pipeline::TIME_RANGE(), range, 2);
  }
}

std::optional<double> TimeOf(vtkDataObject* data)
{
  vtkInformation* info = data ? data->GetInformation() : nullptr;
  return info && info->Has(vtkDataObject::DATA_TIME_STEP())
           ? std::make_optional(info->Get(vtkDataObject::DATA_TIME_STEP()))
           : std::nullopt;
}

void SetTime(vtkDataObject* data, const std::optional<double>& time)
{
  vtkInformation* info = data->GetInformation();
  if (time)
  {
    info->Set(vtkDataObject::DATA_TIME_STEP(), *time);
  }
  else
  {
    info->Remove(vtkDataObject::DATA_TIME_STEP());
  }
}

std::optional<double> RequestedTime(vtkInformation* info)
{
  return info->Has(Pipeline::UPDATE_TIME_STEP())
           ? std::make_optional(info->Get(Pipeline::UPDATE_TIME_STEP()))
           : std::nullopt;
}

int ShownStep(vtkInformation* output, int firstStep, int lastStep)
{
  const double time = RequestedTime(output).value_or(lastStep);
  // NaN is not greater than the first step.
  return time > firstStep ? static_cast<int>(std::lround(std::min(time, double(lastStep))))
                          : firstStep;
}

void InputTime::ForgetOfAnother(vtkInformation* input)
{
  if (input != input_)
  {
    input_ = input;
    time_.reset();
  }
}

void InputTime::Follow(vtkInformationVector* input)
{
  vtkInformation* info = input->GetInformationObject(0);
  if (!info)
  {
    return;
  }
  this->ForgetOfAnother(info);
  if (const std::optional<double> requested = RequestedTime(info))
  {
    time_ = requested;
  }
}

void InputTime::Fix(vtkInformationVector** inputs, int ports)
{
  vtkInformation* first = inputs[0]->GetInformationObject(0);
  if (!first)
  {
    return;
  }
  this->ForgetOfAnother(first);
  if (!time_)
  {
    const std::optional<double> given = TimeOf(vtkDataObject::GetData(first));
    time_ = given ? given : FirstStep(first);
  }
  for (int port = 0; port < ports; ++port)
  {
    for (int k = 0; k < inputs[port]->GetNumberOfInformationObjects(); ++k)
    {
      vtkInformation* info = inputs[port]->GetInformationObject(k);
      if (time_)
      {
        info->Set(Pipeline::UPDATE_TIME_STEP(), *time_);
      }
      else
      {
        info->Remove(Pipeline::UPDATE_TIME_STEP());
      }
    }
  }
}

void StampTime(bool hasOwnSteps, vtkInformationVector* input, vtkInformationVector* outputs)
{
  for (int port = 0; port < outputs->GetNumberOfInformationObjects(); ++port)
  {
    vtkInformation* info = outputs->GetInformationObject(port);
    if (vtkDataObject* data = vtkDataObject::GetData(info))
    {
      SetTime(data, OutputTime(hasOwnSteps, input, info));
    }
  }
}

} // namespace gridfem
