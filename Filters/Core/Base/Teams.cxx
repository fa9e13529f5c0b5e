#include "Base/Teams.h"

#include "Base/Errors.h"

#include <algorithm>
#include <atomic>
#include <condition_variable>
#include <exception>
#include <mutex>
#include <string>
#include <thread>
#include <vector>

namespace gridfem
{
namespace
{

/// Starts threads that exist at the same time and end together.
class Trial
{
public:
  explicit Trial(int threads)
  {
    threads_.reserve(threads);
    try
    {
      for (int k = 0; k < threads; ++k)
      {
        threads_.emplace_back([this] { this->Wait(); });
      }
    }
    catch (...)
    {
      this->End();
      throw;
    }
  }
  ~Trial() { this->End(); }
  Trial(const Trial&) = delete;
  Trial& operator=(const Trial&) = delete;

private:
  void Wait()
  {
    std::unique_lock<std::mutex> lock(mutex_);
    end_.wait(lock, [this] { return isOver_; });
  }

  void End()
  {
    {
      const std::lock_guard<std::mutex> lock(mutex_);
      isOver_ = true;
    }
    end_.notify_all();
    for (std::thread& thread : threads_)
    {
      thread.join();
    }
    threads_.clear();
  }

  std::mutex mutex_;
  std::condition_variable end_;
  bool isOver_ = false;
  std::vector<std::thread> threads_;
};

thread_local int threadLimit = 0;

} // namespace

int ThreadLimit() noexcept
{
  return threadLimit;
}

void SideBySide(int count, int threads, const std::function<void(int)>& body)
{
  std::mutex mutex;
  std::exception_ptr error;
  const auto run = [&](int k)
  {
    const int before = threadLimit;
    threadLimit = std::max(1, threads / count + (k < threads % count ? 1 : 0));
    try
    {
      body(k);
    }
    catch (...)
    {
      const std::lock_guard<std::mutex> lock(mutex);
      error = error ? error : std::current_exception();
    }
    threadLimit = before;
  };
  std::vector<std::thread> others;
  others.reserve(count);
  int next = 1;
  try
  {
    for (; next < count; ++next)
    {
      others.emplace_back(run, next);
    }
  }
  catch (const std::exception&)
  {
    // The system has no more threads, or no memory to start one.
  }
  run(0);
  for (; next < count; ++next)
  {
    run(next);
  }
  for (std::thread& other : others)
  {
    other.join();
  }
  if (error)
  {
    std::rethrow_exception(error);
  }
}

bool CanStart(int threads) noexcept
{
  try
  {
    const Trial trial(threads);
    return true;
  }
  catch (const std::exception&)
  {
    return false;
  }
}

void RequireTeam(int threads)
{
  thread_local int most = 1; // OpenMP keeps a team for each thread that asks for one
  if (threads <= most)
  {
    return;
  }
  if (!CanStart(threads - 1))
  {
    throw OutOfThreads(std::to_string(threads) +
                       " threads cannot be started: the limit of memory or of processes is "
                       "reached. Try with one thread.");
  }
  std::atomic<int> started{ 0 }; // the compiler would drop a region without work
#pragma omp parallel num_threads(threads)
  {
    ++started;
  }
  most = threads;
}

} // namespace gridfem
