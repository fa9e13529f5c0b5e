// Threads that OpenMP can have. It ends the process when it cannot start one, so that they are
// started without it before.
#ifndef GridFEM_Teams_h
#define GridFEM_Teams_h

namespace gridfem
{

/// Makes sure that the calling thread can have teams of so many threads from now on; cheap once it
/// has had one. Throws OutOfThreads.
void RequireTeam(int threads);

/// Whether so many threads can be started besides those there are.
bool CanStart(int threads) noexcept;

} // namespace gridfem

#endif
