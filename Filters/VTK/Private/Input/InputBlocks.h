// Aligns composite inputs. The pipeline runs a filter block by block and skips missing blocks. A
// rank without a block would leave the other MPI ranks waiting for it.
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

struct MissingArray;

/// Gives every rank the same blocks while a filter runs. A rank without a block gets an empty
/// surface. Knows the whole input while a filter sees one block of it.
class InputBlocks
{
public:
  /// Call it at the start of an execution. The pipeline starts one of its own for every block, too.
  /// The outermost call is collective and replaces composite inputs by aligned composite inputs.
  /// Throws nothing. Returns whether it is the outermost call.
  bool Begin(vtkInformationVector** inputs, int ports);

  /// Call it at the end of an execution. The outermost call puts the inputs back. Returns whether
  /// it is the outermost call.
  bool End();

  /// Whether a block of port 0 has the array that another one lacks. False if the input is not
  /// composite.
  bool AnyHas(const MissingArray& missing) const;

  /// The whole input of port 0. Null if it is not composite.
  vtkCompositeDataSet* Whole() const { return whole_; }

  /// Throws on all ranks if the inputs cannot be aligned.
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
