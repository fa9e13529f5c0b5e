// Remembers an abort, so that the same output is not computed when it is asked for once more.
#ifndef GridFEM_ServedAbort_h
#define GridFEM_ServedAbort_h

class vtkAlgorithm;

namespace gridfem
{

/// Marks the outputs of an aborted filter, so that nothing runs on them, and remembers the abort.
/// The next run, after a change, is not aborted.
void ServeAbort(vtkAlgorithm* filter);

/// Whether neither the filter nor anything before it has changed since an abort, and the same time
/// is requested. ParaView asks for the output of each port and for the view by itself, and each
/// would run the filter again. Always false on several ranks, which may differ in it.
bool IsStillAborted(vtkAlgorithm* filter);

} // namespace gridfem

#endif
