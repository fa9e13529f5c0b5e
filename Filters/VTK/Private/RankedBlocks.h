// Composite inputs on several MPI ranks. The pipeline runs a filter block by block and skips blocks
// that are not there; a rank without a block would leave the others waiting for it.
#ifndef GridFEM_RankedBlocks_h
#define GridFEM_RankedBlocks_h

#include "vtkSmartPointer.h"

#include <exception>
#include <string>
#include <utility>
#include <vector>

class vtkDataObject;
class vtkInformation;
class vtkInformationVector;

namespace gridfem
{

/// Gives every rank the same blocks while a filter runs, empty surfaces where it has none.
class RankedBlocks
{
public:
  /// At the start of an execution. The pipeline tells of one of its own for every block, too.
  /// Collective at the outermost one: puts aligned inputs in the place of composite ones. Throws
  /// nothing.
  void Begin(vtkInformationVector** inputs, int ports);

  /// At its end: at the outermost one puts the inputs back.
  void End();

  /// Throws on all ranks when the inputs cannot be aligned.
  void RequireAligned() const;

private:
  void Align(vtkInformationVector** inputs, int ports);
  void AlignPort(vtkInformation* information, const std::vector<std::string>& blocks);

  std::vector<std::pair<vtkSmartPointer<vtkInformation>, vtkSmartPointer<vtkDataObject>>> given_;
  std::exception_ptr failure_;
  int depth_ = 0; // of executions
};

} // namespace gridfem

#endif
