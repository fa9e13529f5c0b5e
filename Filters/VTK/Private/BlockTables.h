// The tables that a filter makes of the blocks of a composite input. ParaView's charts draw those
// of a multi-block only, not those of a partitioned collection.
#ifndef GridFEM_BlockTables_h
#define GridFEM_BlockTables_h

#include "vtkSmartPointer.h"

#include <vector>

class vtkDataObject;
class vtkInformationVector;

namespace gridfem
{

/// Puts multi-blocks in the place of other composite outputs whose blocks are tables, under the
/// names of the blocks. The pipeline needs its own ones when it fills them again.
class BlockTables
{
public:
  /// At the end of an execution.
  void Exchange(vtkInformationVector* outputs);

  /// At the start of the next one, unless the pipeline has made new ones by itself.
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
