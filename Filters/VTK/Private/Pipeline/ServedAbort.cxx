#include "Pipeline/ServedAbort.h"

#include "Pieces/Ranks.h"
#include "Pipeline/PipelineTime.h"

#include "vtkAlgorithm.h"
#include "vtkDemandDrivenPipeline.h"
#include "vtkInformation.h"
#include "vtkInformationDoubleKey.h"
#include "vtkInformationIdTypeKey.h"
#include "vtkVersionMacros.h"

#include <algorithm>

namespace gridfem
{

namespace
{

/// The time of the last change before the abort, in the information of the filter.
vtkInformationIdTypeKey* AbortedAt()
{
  static auto* const key = vtkInformationIdTypeKey::MakeKey("ABORTED_AT", "vtkSurfaceFEMAlgorithm");
  return key;
}

/// The time step that was requested at the abort, in the information of the filter.
vtkInformationDoubleKey* AbortedTimeStep()
{
  static auto* const key =
    vtkInformationDoubleKey::MakeKey("ABORTED_TIME_STEP", "vtkSurfaceFEMAlgorithm");
  return key;
}

/// Returns the time step that is requested from the first output. 0 if there is none.
double RequestedTimeStep(vtkAlgorithm* filter)
{
  return RequestedTime(filter->GetExecutive()->GetOutputInformation(0)).value_or(0.0);
}

/// The time of the last change of the filter or of anything before it, when the pipeline began this
/// run.
vtkMTimeType TimeOfRequest(vtkAlgorithm* filter)
{
  auto* pipeline = vtkDemandDrivenPipeline::SafeDownCast(filter->GetExecutive());
  return pipeline ? pipeline->GetPipelineMTime() : filter->GetMTime();
}

} // namespace

void ServeAbort(vtkAlgorithm* filter)
{
  filter->SetAbortExecute(0); // it would empty the next run
#if VTK_VERSION_NUMBER >= VTK_VERSION_CHECK(9, 2, 20230111)
  filter->SetAbortOutput(true);
#endif
  if (!Ranks::AreSeveral())
  {
    // The abort itself and these marks have changed the filter after the request.
    const vtkMTimeType time = std::max(TimeOfRequest(filter), filter->GetMTime());
    filter->GetInformation()->Set(AbortedAt(), static_cast<vtkIdType>(time));
    filter->GetInformation()->Set(AbortedTimeStep(), RequestedTimeStep(filter));
  }
}

bool IsStillAborted(vtkAlgorithm* filter)
{
  vtkInformation* about = filter->GetInformation();
  const bool isStill = about->Has(AbortedAt()) &&
                       static_cast<vtkIdType>(TimeOfRequest(filter)) <= about->Get(AbortedAt()) &&
                       about->Get(AbortedTimeStep()) == RequestedTimeStep(filter);
  about->Remove(AbortedAt());
  return isStill;
}

} // namespace gridfem
