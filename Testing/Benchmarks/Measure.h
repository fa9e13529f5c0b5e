// The tools of all benchmarks: clock, memory of the process, tables, and machine-readable lines.
#ifndef GridFEM_Benchmarks_Measure_h
#define GridFEM_Benchmarks_Measure_h

#include <algorithm>
#include <chrono>
#include <cstring>
#include <functional>
#include <limits>
#include <string>
#include <type_traits>
#include <vector>

namespace gridfem::benchmarks
{

class Stopwatch
{
public:
  double Seconds() const
  {
    return std::chrono::duration<double>(std::chrono::steady_clock::now() - start_).count();
  }

private:
  std::chrono::steady_clock::time_point start_ = std::chrono::steady_clock::now();
};

/// The least time of body(run) in `runs` runs, because the least time shows the ability of the
/// machine.
template<class Body>
double LeastSeconds(int runs, Body&& body)
{
  double least = std::numeric_limits<double>::infinity();
  for (int run = 0; run < runs; ++run)
  {
    const Stopwatch watch;
    body(run);
    least = std::min(least, watch.Seconds());
  }
  return least;
}

/// Bytes of this process in memory now, and the most there were since ResetPeak. 0 where the system
/// does not tell (only Linux does).
double ResidentBytes();
double PeakBytes();

/// Gives memory that was freed back to the system, which the allocator does not always do.
void ReleaseFreeMemory();

/// Touches that much memory and gives it back. A virtual machine gets pages from its host when it
/// first touches them, ten times as slowly as later. It loses pages that are free for seconds. So
/// the first measurement would pay for all.
void WarmMemory(double bytes);

/// If the system does not allow this, peaks describe the whole run.
void ResetPeak();

/// Runs `body` in a process of its own, so memory of other measurements does not count. Returns its
/// numbers. This process must not have used threads. Throws std::runtime_error when the other one
/// fails.
std::vector<double> InOwnProcess(const std::function<std::vector<double>()>& body);

/// The remaining numbers of a process that may have been stopped.
struct LimitedRun
{
  std::vector<double> numbers; // none when it was stopped
  bool isStopped = false;
  double peak = 0.0; // bytes it had taken until then, beyond the bytes of this process
};

/// The same, but stops the process after so many seconds.
LimitedRun InOwnProcess(const std::function<std::vector<double>()>& body, double limit);

/// The same as the first for a number or a struct of numbers.
template<class Numbers, class Body>
Numbers MeasureInOwnProcess(Body&& body)
{
  static_assert(std::is_trivially_copyable_v<Numbers> && sizeof(Numbers) % sizeof(double) == 0);
  Numbers result{};
  const std::vector<double> numbers = InOwnProcess(
    [&]
    {
      const Numbers measured = body();
      std::vector<double> packed(sizeof measured / sizeof(double));
      std::memcpy(packed.data(), &measured, sizeof measured);
      return packed;
    });
  if (numbers.size() * sizeof(double) == sizeof result)
  {
    std::memcpy(static_cast<void*>(&result), numbers.data(), sizeof result);
  }
  return result;
}

/// The parts of a group that the command line names; all when it names none.
class Parts
{
public:
  Parts(int argc, char** argv) : names_(argv + (argc > 0 ? 1 : 0), argv + argc) {}
  /// Named, or none is.
  bool Want(const std::string& name) const;
  bool IsNamed(const std::string& name) const;

private:
  std::vector<std::string> names_;
};

/// printf into a string.
std::string Text(const char* format, double value);

/// A Markdown table, printed row by row.
class Table
{
public:
  explicit Table(const std::vector<std::string>& header);
  void Row(const std::vector<std::string>& cells) const;

private:
  std::vector<std::size_t> width_;
};

/// RATIO <name> <measured> <= <bound>, and the same with >=. Flushed at once.
void PrintAtMost(const std::string& name, double measured, double bound);
void PrintAtLeast(const std::string& name, double measured, double bound);

} // namespace gridfem::benchmarks

#endif
