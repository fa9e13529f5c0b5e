// Controls how long OpenMP threads spin before they sleep.
#ifndef GridFEM_ShortWaits_h
#define GridFEM_ShortWaits_h

namespace gridfem
{

/// From the first call on, waiting threads sleep after some microseconds. By default, OpenMP
/// threads spin for milliseconds. On a busy machine, they then take the processor from the very
/// thread they wait for. Does nothing if environment variables set the wait policy, or if OpenMP is
/// not GNU's on Linux.
void KeepWaitsShort();

} // namespace gridfem

#endif
