// Copies the information of a port, with another data object.
#ifndef GridFEM_InformationCopy_h
#define GridFEM_InformationCopy_h

#include "vtkDataObject.h"
#include "vtkExecutive.h"
#include "vtkInformation.h"
#include "vtkInformationExecutivePortKey.h"
#include "vtkInformationExecutivePortVectorKey.h"
#include "vtkNew.h"
#include "vtkSmartPointer.h"

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

} // namespace gridfem

#endif
