// Threads that OpenMP can have. It ends the process when it cannot start one, so that they are
// started without it before.
#ifndef GridFEM_Teams_h
#define GridFEM_Teams_h

#include <functional>

namespace gridfem
{

/// Makes sure that the calling thread can have teams of so many threads from now on; cheap once it
/// has had one. Throws OutOfThreads.
void RequireTeam(int threads);

/// The most threads that a team of the calling thread may have; 0: as many as it asks for, as
/// anywhere but within SideBySide.
int ThreadLimit() noexcept;

/// Runs body(k) for 0 <= k < count at the same time, each on a thread whose teams have a share of
/// `threads`: for few jobs that several threads take part in. The first exception of a body is
/// thrown again when all have ended. Bodies that no thread can be started for run one after the
/// other.
void SideBySide(int count, int threads, const std::function<void(int)>& body);

/// Whether so many threads can be started besides those there are.
bool CanStart(int threads) noexcept;

} // namespace gridfem

#endif
