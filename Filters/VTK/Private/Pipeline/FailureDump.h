// Keeps the pipeline from adding its own report to a failure that the filter has already reported.
#ifndef GridFEM_FailureDump_h
#define GridFEM_FailureDump_h

#include "vtkWeakPointer.h"

class vtkExecutive;

namespace gridfem
{

/// Silences the report that an executive prints if its filter fails. The report prints the failed
/// request: a page of keys beside the one useful message.
class FailureDump
{
public:
  FailureDump() = default;
  ~FailureDump() { this->Print(); }
  FailureDump(const FailureDump&) = delete;
  FailureDump& operator=(const FailureDump&) = delete;

  /// Silences the next report of the executive. Observers that others have put on it still get it.
  void Silence(vtkExecutive* executive);

  /// Prints reports again.
  void Print();

private:
  vtkWeakPointer<vtkExecutive> executive_;
  unsigned long observer_ = 0;
};

} // namespace gridfem

#endif
