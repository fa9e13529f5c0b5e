#include "Measure.h"

#include "Base/LargeMemory.h"
#include "Multigrid/Device.h"

#include <malloc.h>
#include <poll.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <cmath>
#include <csignal>
#include <cstdio>
#include <cstring>
#include <exception>
#include <fstream>
#include <limits>
#include <stdexcept>

namespace gridfem::benchmarks
{

namespace
{

/// Benchmarks measure the CPU, also on a machine with a GPU.
[[maybe_unused]] const bool isOnCpu = []
{
  UseDevice(nullptr);
  return true;
}();

constexpr int LookEveryMilliseconds = 100;

/// A line of the status of a process, in bytes.
double StatusBytes(const std::string& key, const std::string& process = "self")
{
  std::ifstream status("/proc/" + process + "/status");
  for (std::string name; status >> name;)
  {
    if (name == key)
    {
      double kibibytes = 0.0;
      status >> kibibytes;
      return 1024.0 * kibibytes;
    }
    status.ignore(std::numeric_limits<std::streamsize>::max(), '\n');
  }
  return 0.0;
}

[[noreturn]] void Deliver(int pipe, const std::function<std::vector<double>()>& body)
{
  int code = 1;
  try
  {
    const std::vector<double> numbers = body();
    const auto bytes = static_cast<ssize_t>(numbers.size() * sizeof(double));
    code = write(pipe, numbers.data(), numbers.size() * sizeof(double)) == bytes ? 0 : 1;
  }
  catch (const std::exception& error)
  {
    std::fprintf(stderr, "%s\n", error.what());
  }
  std::fflush(stdout);
  _exit(code);
}

void PrintRatio(const std::string& name, double measured, const char* relation, double bound)
{
  std::printf("RATIO %s %.4g %s %.4g\n", name.c_str(), measured, relation, bound);
  std::fflush(stdout);
}

} // namespace

double ResidentBytes()
{
  return StatusBytes("VmRSS:");
}

double PeakBytes()
{
  return StatusBytes("VmHWM:");
}

void ReleaseFreeMemory()
{
  malloc_trim(0);
}

void WarmMemory(double bytes)
{
  const auto size = static_cast<std::size_t>(bytes);
  void* const memory = AllocateLargeMemory(size);
  std::memset(memory, 1, size);
  FreeLargeMemory(memory, size);
}

void ResetPeak()
{
  std::ofstream("/proc/self/clear_refs") << "5";
}

std::vector<double> InOwnProcess(const std::function<std::vector<double>()>& body)
{
  return InOwnProcess(body, HUGE_VAL).numbers;
}

LimitedRun InOwnProcess(const std::function<std::vector<double>()>& body, double limit)
{
  int ends[2];
  std::fflush(stdout);
  const double before = ResidentBytes();
  const Stopwatch watch;
  const pid_t child = pipe(ends) == 0 ? fork() : -1;
  if (child < 0)
  {
    throw std::runtime_error("A process for the measurement could not be started.");
  }
  if (child == 0)
  {
    Deliver(ends[1], body);
  }
  close(ends[1]);
  LimitedRun run;
  pollfd answer{ ends[0], POLLIN, 0 };
  while (poll(&answer, 1, LookEveryMilliseconds) == 0 && !run.isStopped)
  {
    if (watch.Seconds() > limit)
    {
      run.isStopped = true;
      run.peak = StatusBytes("VmHWM:", std::to_string(child)) - before;
      kill(child, SIGKILL);
    }
  }
  for (double number; read(ends[0], &number, sizeof number) == sizeof number;)
  {
    run.numbers.push_back(number);
  }
  close(ends[0]);
  int status = 0;
  waitpid(child, &status, 0);
  if (!run.isStopped && (!WIFEXITED(status) || WEXITSTATUS(status) != 0))
  {
    throw std::runtime_error("The process of a measurement failed.");
  }
  return run;
}

bool Parts::Want(const std::string& name) const
{
  return names_.empty() || this->IsNamed(name);
}

bool Parts::IsNamed(const std::string& name) const
{
  return std::find(names_.begin(), names_.end(), name) != names_.end();
}

std::string Text(const char* format, double value)
{
  char buffer[64];
  std::snprintf(buffer, sizeof buffer, format, value);
  return buffer;
}

Table::Table(const std::vector<std::string>& header)
{
  for (const std::string& name : header)
  {
    width_.push_back(std::max<std::size_t>(name.size(), 9));
  }
  width_.front() = std::max<std::size_t>(width_.front(), 30);
  std::printf("\n");
  this->Row(header);
  for (const std::size_t width : width_)
  {
    std::printf("|%s", std::string(width + 2, '-').c_str());
  }
  std::printf("|\n");
}

void Table::Row(const std::vector<std::string>& cells) const
{
  for (std::size_t c = 0; c < width_.size(); ++c)
  {
    const int width = static_cast<int>(c == 0 ? -1 : 1) * static_cast<int>(width_[c]);
    std::printf("| %*s ", width, c < cells.size() ? cells[c].c_str() : "");
  }
  std::printf("|\n");
  std::fflush(stdout);
}

void PrintAtMost(const std::string& name, double measured, double bound)
{
  PrintRatio(name, measured, "<=", bound);
}

void PrintAtLeast(const std::string& name, double measured, double bound)
{
  PrintRatio(name, measured, ">=", bound);
}

} // namespace gridfem::benchmarks
