// How long threads of OpenMP look for work before they sleep.
#ifndef GridFEM_ShortWaits_h
#define GridFEM_ShortWaits_h

namespace gridfem
{

/// From the first call on, threads that wait for each other sleep after some microseconds. As
/// OpenMP comes they spin for milliseconds, and take the processor from the thread they wait for
/// where a machine does other work. Does nothing where the environment says how to wait, and
/// where OpenMP is not GNU's on Linux.
void KeepWaitsShort();

} // namespace gridfem

#endif
