// Makes sure that OpenMP gets the threads it needs. OpenMP ends the process when it cannot start a
// thread, so we try to start the threads ourselves first.
#ifndef GridFEM_Teams_h
#define GridFEM_Teams_h

#include <functional>

namespace gridfem
{

/// Makes sure that the calling thread can have teams of `threads` threads from now on. Cheap once
/// it has had such a team. Throws OutOfThreads.
void RequireTeam(int threads);

/// Largest number of threads in a team of the calling thread. 0 means no limit, as everywhere
/// outside SideBySide.
int ThreadLimit() noexcept;

/// Runs body(k) for 0 <= k < count at the same time, for a few jobs that each use several threads.
/// Each body runs on its own thread, whose teams have a share of `threads`. Bodies for which no
/// thread can be started run one after the other. Once all bodies have ended, it rethrows the first
/// exception.
void SideBySide(int count, int threads, const std::function<void(int)>& body);

/// Whether the system can start `threads` threads in addition to the existing ones.
bool CanStart(int threads) noexcept;

} // namespace gridfem

#endif
