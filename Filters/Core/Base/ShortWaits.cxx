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
/// Starts one team that exists forever, and sleeps. GNU's OpenMP waits for only a short time while
/// the process has more OpenMP threads than processors. Environment variables cannot do this,
/// because OpenMP reads them when it is loaded, before our code runs.
void HoldManyThreads(std::promise<void> areHeld)
{
  sigset_t all;
  sigfillset(&all);
  pthread_sigmask(SIG_BLOCK, &all, nullptr); // so that the threads never wake
  std::atomic<int> started{ 0 };             // the compiler would drop a region without work
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
      return false; // threads keep spinning for a long time
    }
    std::promise<void> areHeld;
    std::future<void> held = areHeld.get_future();
    std::thread(HoldManyThreads, std::move(areHeld)).detach();
    held.wait(); // so that nobody takes the memory of these threads meanwhile
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
