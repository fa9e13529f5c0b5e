// Copies the information of a port, with another data object.
#ifndef GridFEM_InformationCopy_h
#define GridFEM_InformationCopy_h

#include "vtkDataObject.h"
#include "vtkExecutive.h"
#include "vtkInformation.h"
#include "vtkInformationExecutivePortKey.h"
#include "vtkInformationExecutivePortVectorKey.h"
#include "vtkInformationVector.h"
#include "vtkNew.h"
#include "vtkSmartPointer.h"

#include <vector>

namespace gridfem
{

/// Returns all entries of `given`, with `data` in the place of its data. It does not hold the
/// pipeline, whose garbage collection would not see this copy and would never free the source of
/// the data.
inline vtkSmartPointer<vtkInformation> CopyWith(vtkDataObject* data, vtkInformation* given)
{
  vtkNew<vtkInformation> information;
  information->Copy(given);
  information->Remove(vtkExecutive::PRODUCER());
  information->Remove(vtkExecutive::CONSUMERS());
  information->Set(vtkDataObject::DATA_OBJECT(), data);
  return information;
}

/// The inputs of a filter with other data on port 0.
class OtherFirstInput
{
public:
  /// @param inputs  one vector per port; they have to live as long as the result is used
  vtkInformationVector** Of(vtkInformationVector** inputs, int numberOfPorts, vtkDataObject* data)
  {
    first_->SetInformationObject(0, CopyWith(data, inputs[0]->GetInformationObject(0)));
    ports_.assign(inputs, inputs + numberOfPorts);
    ports_[0] = first_;
    return ports_.data();
  }

  void Free() { first_->SetNumberOfInformationObjects(0); }

private:
  vtkNew<vtkInformationVector> first_;
  std::vector<vtkInformationVector*> ports_;
};

} // namespace gridfem

#endif
