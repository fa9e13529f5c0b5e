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
  /// Collective, before the pipeline goes through the blocks: puts aligned inputs in the place of
  /// composite ones. Throws nothing.
  void Align(vtkInformationVector** inputs, int ports);

  /// Puts the inputs back.
  void Restore();

  /// Throws on all ranks when the inputs cannot be aligned.
  void RequireAligned() const;

private:
  void AlignPort(vtkInformation* information, const std::vector<std::string>& blocks);

  std::vector<std::pair<vtkSmartPointer<vtkInformation>, vtkSmartPointer<vtkDataObject>>> given_;
  std::exception_ptr failure_;
};

} // namespace gridfem

#endif
