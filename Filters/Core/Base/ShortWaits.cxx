#include "Base/ShortWaits.h"

#include "Base/Teams.h"

#include <omp.h>

#include <atomic>
#include <cstdlib>
#include <future>
#include <thread>
#include <utility>

#if defined(__linux__) && defined(__GNUC__) && !defined(__clang__)
#define GRIDFEM_GNU_OPENMP
#include <csignal>
#include <unistd.h>
#endif

namespace gridfem
{
namespace
{

#ifdef GRIDFEM_GNU_OPENMP
/// GNU's OpenMP waits for a short time only as long as the process has more of its threads than
/// there are processors; the environment is read when it is loaded, which is before us. So one team
/// of so many threads exists for good, and sleeps.
void HoldManyThreads(std::promise<void> areHeld)
{
  sigset_t all;
  sigfillset(&all);
  pthread_sigmask(SIG_BLOCK, &all, nullptr); // so that the threads never wake
  std::atomic<int> started{ 0 };             // a region without work would be left out
#pragma omp parallel num_threads(omp_get_num_procs() + 1)
  {
    ++started;
  }
  areHeld.set_value();
  while (true)
  {
    pause();
  }
}

bool SaysHowToWait()
{
  return std::getenv("OMP_WAIT_POLICY") || std::getenv("GOMP_SPINCOUNT");
}
#endif

bool Begin()
{
#ifdef GRIDFEM_GNU_OPENMP
  if (!SaysHowToWait())
  {
    if (!CanStart(omp_get_num_procs() + 1))
    {
      return false; // waits stay long
    }
    std::promise<void> areHeld;
    std::future<void> held = areHeld.get_future();
    std::thread(HoldManyThreads, std::move(areHeld)).detach();
    held.wait(); // lest somebody takes the memory for them meanwhile
  }
#endif
  return true;
}

} // namespace

void KeepWaitsShort()
{
  [[maybe_unused]] static const bool hasBegun = Begin();
}

} // namespace gridfem
