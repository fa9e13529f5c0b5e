// Runs Core on random input. Every case must give a result, or a message that explains why not. It
// must never crash, hang, or return a wrong number silently.
//
//     FuzzCore FIRST_SEED NUMBER  prints a summary, and the seeds of broken cases
//     FuzzCore SEED               describes one case
//     FuzzCore                    runs the seeds of all cases found so far
//
// With "defects" as first argument, FuzzCore runs the series of surfaces with defects instead.
// Their results must equal the results of the clean surface.
//
// Returns 1 if something is broken. The current seed is the last output on the error stream, so
// that a crash shows it.
#include "RandomProblem.h"

#include <chrono>
#include <cstdlib>
#include <iomanip>
#include <iostream>
#include <map>

using namespace gridfem::testing;

namespace
{

/// Seconds that no case may exceed, even on a busy machine.
constexpr double Longest = 10.0;

#if defined(__SANITIZE_ADDRESS__)
constexpr double Slowdown = 10.0;
#else
constexpr double Slowdown = 1.0;
#endif

/// Largest fraction of the cases with default options that may miss their tolerance.
constexpr double LargestShare = 2e-3;

/// Seeds of cases that were broken once, or missed their tolerance with default options. A change
/// of the generator changes these cases. Each finding therefore also has a test of its own in the
/// folder of its concept.
constexpr std::uint64_t Found[] = { 2684, 5456, 6906, 1004525, 1025469, 1044447, 1051031, 1055105,
  2010166, 2011440, 2015058, 3506428, 3511331, 3516046, 3539173, 3604339, 3607997, 3623297 };

struct Timed
{
  Outcome outcome;
  double seconds;
};

using RunOne = Outcome (*)(std::uint64_t seed);

Timed RunTimed(RunOne run, std::uint64_t seed)
{
  std::cerr << "\rseed " << seed << ' ' << std::flush;
  const auto start = std::chrono::steady_clock::now();
  Timed timed{ run(seed), 0.0 };
  timed.seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
  timed.outcome.Require(timed.seconds < Longest * Slowdown, "took too long");
  return timed;
}

bool IsCounted(const Outcome& outcome)
{
  return outcome.isDefault && outcome.refusal.empty();
}

bool IsMissed(const Outcome& outcome)
{
  return IsCounted(outcome) && !outcome.converged && !outcome.isDataLimited;
}

struct Counts
{
  int cases = 0;
  int refused = 0;
  int iterative = 0;
  int converged = 0;
  double seconds = 0.0;
  double longest = 0.0;
  std::uint64_t slowest = 0;

  void Add(std::uint64_t seed, const Timed& timed)
  {
    ++cases;
    refused += !timed.outcome.refusal.empty();
    const bool hasReport = timed.outcome.isIterative && timed.outcome.refusal.empty();
    iterative += hasReport;
    converged += hasReport && timed.outcome.converged;
    seconds += timed.seconds;
    if (timed.seconds > longest)
    {
      longest = timed.seconds;
      slowest = seed;
    }
  }
};

void Describe(std::ostream& stream, std::uint64_t seed, const Timed& timed)
{
  const Outcome& outcome = timed.outcome;
  stream << seed << ": " << outcome.problem << " on " << outcome.description << "; "
         << timed.seconds << " s";
  if (!outcome.refusal.empty())
  {
    stream << "; refused: " << outcome.refusal;
  }
  if (!outcome.converged)
  {
    stream << "; not converged, energy " << outcome.smallestEnergy << ", end "
           << static_cast<int>(outcome.end);
  }
  for (const std::string& what : outcome.broken)
  {
    stream << "; BROKEN: " << what;
  }
  stream << '\n';
}

void Print(const std::string& problem, const Counts& counts)
{
  std::cout << std::left << std::setw(20) << problem << std::right << std::setw(8) << counts.cases
            << std::setw(9) << counts.refused << std::setw(10) << counts.converged << " of "
            << std::setw(6) << counts.iterative << std::setw(9) << std::setprecision(3)
            << 1e3 * counts.seconds / std::max(counts.cases, 1) << std::setw(10) << counts.longest
            << std::setw(10) << counts.slowest << '\n';
}

int RunFound()
{
  int broken = 0;
  for (const std::uint64_t seed : Found)
  {
    const Timed timed = RunTimed(RunCase, seed);
    broken += !timed.outcome.broken.empty() || IsMissed(timed.outcome);
    Describe(std::cout, seed, timed);
  }
  return broken > 0;
}

int RunSeeds(RunOne run, std::uint64_t first, std::uint64_t number)
{
  std::map<std::string, Counts> counts;
  int broken = 0;
  int defaults = 0;
  int missed = 0;
  int limited = 0; // by their data
  for (std::uint64_t seed = first; seed < first + number; ++seed)
  {
    const Timed timed = RunTimed(run, seed);
    const Outcome& outcome = timed.outcome;
    counts[outcome.problem].Add(seed, timed);
    const bool isCounted = IsCounted(outcome);
    const bool isMissed = IsMissed(outcome);
    defaults += isCounted;
    missed += isMissed;
    limited += isCounted && !outcome.converged && outcome.isDataLimited;
    broken += !outcome.broken.empty();
    if (isMissed || !outcome.broken.empty())
    {
      Describe(std::cout, seed, timed);
    }
  }
  std::cout << "\nproblem                cases  refused  converged         ms/case    s, slowest\n";
  for (const auto& [problem, count] : counts)
  {
    Print(problem, count);
  }
  std::cout << number << " cases, " << broken << " broken; with default options " << missed
            << " of " << defaults << " have missed their tolerance, and " << limited
            << " could not reach it in numbers of sixteen digits\n";
  return broken > 0 || missed > std::max(1.0, LargestShare * defaults);
}

} // namespace

int main(int argc, char** argv)
{
  const bool areDefects = argc > 1 && std::string(argv[1]) == "defects";
  const RunOne run = areDefects ? RunDefectCase : RunCase;
  char** const seeds = argv + (areDefects ? 2 : 1);
  if (!seeds[0])
  {
    return RunFound();
  }
  const std::uint64_t seed = std::strtoull(seeds[0], nullptr, 10);
  if (seeds[1])
  {
    return RunSeeds(run, seed, std::strtoull(seeds[1], nullptr, 10));
  }
  const Timed timed = RunTimed(run, seed);
  Describe(std::cout, seed, timed);
  return !timed.outcome.broken.empty();
}
