// A surface that changes with time: at the times 1, 2 and 3 a sphere whose radius is the time.
#ifndef GridFEM_Testing_GrowingSphere_h
#define GridFEM_Testing_GrowingSphere_h

#include "FilterSupport.h"

#include "vtkInformation.h"
#include "vtkInformationVector.h"
#include "vtkObjectFactory.h"
#include "vtkPolyDataAlgorithm.h"
#include "vtkStreamingDemandDrivenPipeline.h"

namespace gridfem::testing
{

class GrowingSphere : public vtkPolyDataAlgorithm
{
public:
  static GrowingSphere* New();
  vtkTypeMacro(GrowingSphere, vtkPolyDataAlgorithm);

  /// The last time that a sphere was requested for.
  double Time = 0.0;
  /// The number of spheres made.
  int Runs = 0;

protected:
  using Pipeline = vtkStreamingDemandDrivenPipeline;

  GrowingSphere() { this->SetNumberOfInputPorts(0); }

  int RequestInformation(
    vtkInformation*, vtkInformationVector**, vtkInformationVector* outputs) override
  {
    const double steps[] = { 1.0, 2.0, 3.0 };
    const double range[] = { 1.0, 3.0 };
    vtkInformation* info = outputs->GetInformationObject(0);
    info->Set(Pipeline::TIME_STEPS(), steps, 3);
    info->Set(Pipeline::TIME_RANGE(), range, 2);
    return 1;
  }

  int RequestData(vtkInformation*, vtkInformationVector**, vtkInformationVector* outputs) override
  {
    vtkInformation* info = outputs->GetInformationObject(0);
    const double asked =
      info->Has(Pipeline::UPDATE_TIME_STEP()) ? info->Get(Pipeline::UPDATE_TIME_STEP()) : 1.0;
    this->Time = std::min(3.0, std::max(1.0, std::round(asked)));
    ++this->Runs;
    vtkPolyData* output = vtkPolyData::GetData(outputs);
    output->ShallowCopy(ToPolyData(GeodesicSphere(8, this->Time)));
    AddPointArray(output, "x", 1, [](const Vec3& p, int) { return p[0]; });
    output->GetInformation()->Set(vtkDataObject::DATA_TIME_STEP(), this->Time);
    return 1;
  }
};
vtkStandardNewMacro(GrowingSphere);

} // namespace gridfem::testing

#endif
