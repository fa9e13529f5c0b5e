// Handles the tables that a filter makes of the blocks of a composite input. ParaView's charts draw
// tables of a multi-block only, not of a partitioned collection.
#ifndef GridFEM_BlockTables_h
#define GridFEM_BlockTables_h

#include "vtkSmartPointer.h"

#include <vector>

class vtkDataObject;
class vtkInformationVector;

namespace gridfem
{

/// Replaces other composite outputs whose blocks are tables by multi-blocks, under the names of the
/// blocks. The pipeline needs its own outputs again for the next execution.
class BlockTables
{
public:
  /// Call it at the end of an execution.
  void Exchange(vtkInformationVector* outputs);

  /// Call it at the start of the next one. Does nothing if the pipeline has made new outputs.
  void PutBack(vtkInformationVector* outputs);

private:
  struct Exchanged
  {
    int port = 0;
    vtkSmartPointer<vtkDataObject> own; // the pipeline's
    vtkSmartPointer<vtkDataObject> tables;
  };
  std::vector<Exchanged> exchanged_;
};

} // namespace gridfem

#endif
