#include "Pipeline/vtkSurfaceBasisHolder.h"

#include "Output/BasisConversion.h"

#include "vtkAbstractArray.h"
#include "vtkInformation.h"
#include "vtkInformationObjectBaseKey.h"
#include "vtkNew.h"
#include "vtkObjectFactory.h"

vtkStandardNewMacro(vtkSurfaceBasisHolder);
vtkInformationKeyRestrictedMacro(vtkSurfaceBasisHolder, BASIS, ObjectBase, "vtkSurfaceBasisHolder");

void vtkSurfaceBasisHolder::Attach(vtkAbstractArray* array, const gridfem::SurfaceBasis& basis)
{
  vtkNew<vtkSurfaceBasisHolder> holder;
  holder->Source = basis;
  array->GetInformation()->Set(BASIS(), holder);
}

vtkSurfaceBasisHolder* vtkSurfaceBasisHolder::Find(vtkAbstractArray* array)
{
  return array && array->HasInformation()
           ? vtkSurfaceBasisHolder::SafeDownCast(array->GetInformation()->Get(BASIS()))
           : nullptr;
}

gridfem::SurfaceBasis vtkSurfaceBasisHolder::OnClippedMesh()
{
  const std::lock_guard<std::mutex> lock(this->Mutex);
  if (!this->Clipped)
  {
    this->Clipped = gridfem::OnClippedMesh(this->Source);
  }
  return this->Clipped;
}
