// Joins all blocks of a composite input into one surface. The filter computes on it once, at the
// first block that the pipeline visits. Every block gets its part of the outputs.
#ifndef GridFEM_JoinedBlocks_h
#define GridFEM_JoinedBlocks_h

#include "Input/SurfaceInput.h"
#include "Pieces/GatheredSurface.h"
#include "Pipeline/InformationCopy.h"
#include "Solvers/Stages.h"

#include "vtkNew.h"
#include "vtkSmartPointer.h"

#include <exception>
#include <map>
#include <memory>
#include <string>
#include <vector>

class vtkCompositeDataSet;
class vtkDataSet;
class vtkInformationVector;
class vtkPolyData;

namespace gridfem
{

/// The blocks of an input. They are joined as the pieces of several ranks are. Each of several
/// ranks joins its own blocks, and the result is its piece. The surface stays for the next
/// execution, until a block changes.
class JoinedBlocks
{
public:
  /// A block that has points, and their places in the whole.
  struct Block
  {
    vtkDataSet* data = nullptr;
    vtkSmartPointer<vtkPolyData> surface;
    std::string name; // for messages: "block 'wing'", "block 3" with the composite index
    int piece = -1;   // of the joined surface; -1: left out
  };

  JoinedBlocks();
  ~JoinedBlocks();

  /// Whether a block of this execution has been computed on, with or without success.
  bool HasStarted() const { return hasStarted_; }

  /// @param outputs  the outputs of the filter: the results have the same types
  void Start(vtkInformationVector* outputs);

  /// Takes the surfaces of all blocks.
  /// @param isShared  other ranks have blocks, too: then no block may be a volume
  void Read(vtkCompositeDataSet* whole, bool isShared);

  /// The number of blocks with points.
  static int CountBlocks(vtkCompositeDataSet* whole);

  /// Leaves out the blocks without an array of this name, and returns their names. Does nothing if
  /// all blocks have it, or none.
  std::vector<std::string> LeaveOut(const std::string& array);

  /// Joins the blocks that are not left out. Returns the inputs with the surface on port 0.
  vtkInformationVector** Inputs(
    vtkInformationVector** inputs, int ports, bool weldCoincidentPoints);

  /// The data objects for the outputs of the whole.
  vtkInformationVector* Results() { return results_; }

  /// Informs the remaining blocks why there is no result.
  void Fail(const std::exception_ptr& failure) { failure_ = failure; }

  /// Fills the outputs of one block. Throws Aborted or FailedElsewhere if the whole has failed.
  void HandBack(vtkDataSet* data, vtkInformationVector* outputs) const;

  const GatheredSurface& Surface() const { return entry_->surface; }
  const std::vector<Block>& Blocks() const { return blocks_; }
  bool IsEmpty() const { return blocks_.empty(); }

  /// Call it after all blocks. Frees the results, and also the surface, unless it is kept.
  void Finish(bool isKept);

private:
  struct Entry
  {
    StageKey key;
    GatheredSurface surface;
    bool isUsed = false; // in this execution
  };

  void ReadBlock(vtkDataSet* data, const std::string& name, std::size_t index);

  std::vector<Block> blocks_;
  std::vector<std::unique_ptr<SurfaceInput>> surfaces_; // of blocks that are none themselves
  std::map<std::vector<bool>, Entry> entries_;          // by which blocks are left out
  Entry* entry_ = nullptr;
  OtherFirstInput inputs_;
  vtkNew<vtkInformationVector> results_;
  std::exception_ptr failure_;
  bool hasStarted_ = false;
};

} // namespace gridfem

#endif
