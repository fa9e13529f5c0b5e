#include "Pipeline/FailureDump.h"

#include "vtkCallbackCommand.h"
#include "vtkExecutive.h"
#include "vtkNew.h"

namespace gridfem
{

void FailureDump::Silence(vtkExecutive* executive)
{
  this->Print();
  // An object whose errors are observed does not print them.
  vtkNew<vtkCallbackCommand> silence;
  silence->SetClientData(this);
  silence->SetCallback(
    [](vtkObject*, unsigned long, void* self, void*) { static_cast<FailureDump*>(self)->Print(); });
  executive_ = executive;
  observer_ = executive->AddObserver(vtkCommand::ErrorEvent, silence);
}

void FailureDump::Print()
{
  if (executive_)
  {
    executive_->RemoveObserver(observer_);
    executive_ = nullptr;
  }
}

} // namespace gridfem
