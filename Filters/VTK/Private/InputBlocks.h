// Composite inputs. The pipeline runs a filter block by block and skips blocks that are not there;
// on several MPI ranks one without a block would leave the others waiting for it.
#ifndef GridFEM_InputBlocks_h
#define GridFEM_InputBlocks_h

#include "vtkSmartPointer.h"

#include <exception>
#include <string>
#include <utility>
#include <vector>

class vtkCompositeDataSet;
class vtkDataObject;
class vtkInformation;
class vtkInformationVector;

namespace gridfem
{

/// Gives every rank the same blocks while a filter runs, empty surfaces where it has none, and
/// knows the whole input while a filter sees a block of it.
class InputBlocks
{
public:
  /// At the start of an execution. The pipeline tells of one of its own for every block, too.
  /// Collective at the outermost one: puts aligned inputs in the place of composite ones. Throws
  /// nothing.
  void Begin(vtkInformationVector** inputs, int ports);

  /// At its end: at the outermost one puts the inputs back.
  void End();

  /// Whether a block of port 0 has a point or cell array of this name; false outside of composite
  /// inputs.
  bool AnyHas(const std::string& array) const;

  /// The whole input of port 0; null outside of composite inputs.
  vtkCompositeDataSet* Whole() const { return whole_; }

  /// Throws on all ranks when the inputs cannot be aligned.
  void RequireAligned() const;

private:
  void Align(vtkInformationVector** inputs, int ports);
  void AlignPort(vtkInformation* information, const std::vector<std::string>& blocks);

  std::vector<std::pair<vtkSmartPointer<vtkInformation>, vtkSmartPointer<vtkDataObject>>> given_;
  vtkSmartPointer<vtkCompositeDataSet> whole_; // of port 0
  std::exception_ptr failure_;
  int depth_ = 0; // of executions
};

} // namespace gridfem

#endif
