#include "Input/SurfaceInput.h"

#include "Input/InputValidation.h"

#include "Base/Errors.h"

#include "vtkDataSet.h"
#include "vtkDataSetSurfaceFilter.h"
#include "vtkInformation.h"
#include "vtkInformationVector.h"
#include "vtkPolyData.h"
#include "vtkSmartPointer.h"

namespace gridfem
{

SurfaceInput::SurfaceInput() = default;
SurfaceInput::~SurfaceInput() = default;

vtkInformationVector** SurfaceInput::Of(vtkInformationVector** inputs, int numberOfPorts)
{
  RequireFurtherInputs(inputs, numberOfPorts);
  vtkDataSet* data = vtkDataSet::GetData(inputs[0]);
  if (!data || this->Of(data) == data)
  {
    this->Free();
    return inputs;
  }
  if (surface_->GetNumberOfPoints() == 0)
  {
    throw InvalidInput("The input has no surface: neither polygons nor volume cells.");
  }
  return inputs_.Of(inputs, numberOfPorts, surface_);
}

vtkPolyData* SurfaceInput::Of(vtkDataSet* data)
{
  RequireSoundCells(data);
  if (auto* surface = vtkPolyData::SafeDownCast(data))
  {
    return surface;
  }
  this->Extract(data);
  return surface_;
}

/// Extracts the surface only if the data set has changed: no two have the same time of change.
void SurfaceInput::Extract(vtkDataSet* data)
{
  if (extracted_ == data->GetMTime())
  {
    return;
  }
  auto copy = vtkSmartPointer<vtkDataSet>::Take(data->NewInstance());
  copy->ShallowCopy(data); // the data set stays with its own pipeline
  vtkNew<vtkDataSetSurfaceFilter> filter;
  filter->SetInputData(copy);
  filter->PassThroughPointIdsOn();
  filter->PassThroughCellIdsOn();
  filter->Update();
  surface_->ShallowCopy(filter->GetOutput());
  extracted_ = data->GetMTime();
}

void SurfaceInput::Free()
{
  surface_->Initialize();
  inputs_.Free();
  extracted_ = 0;
}

} // namespace gridfem
