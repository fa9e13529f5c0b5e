// Runs filters on damaged data.
//
//     FuzzFilters FIRST_SEED NUMBER  prints a summary, and the seeds of broken cases
//     FuzzFilters SEED               describes one case
//
// Returns 1 if something is broken. The current seed is the last output on the error stream, so
// that a crash shows it.
#include "DamagedInput.h"

#include "FilterSupport.h"

#include <cstdlib>
#include <iostream>
#include <map>

namespace gridfem::testing
{

bool RunOnDamaged(vtkAlgorithm* filter, DamagedCase& outcome)
{
  std::cerr << outcome.description << ' ' << std::flush; // a crash shows it
  const Messages messages(filter);
  filter->Modified();
  const bool hasResult = filter->GetExecutive()->Update() != 0;
  outcome.Require(messages.errors.size() == (hasResult ? 0u : 1u),
    std::to_string(messages.errors.size()) + " messages");
  if (!hasResult)
  {
    outcome.refusal = messages.errors.empty() ? "refused" : messages.errors.front();
    for (int port = 0; port < filter->GetNumberOfOutputPorts(); ++port)
    {
      outcome.Require(IsEmptyData(filter->GetOutputDataObject(port)), "an output after a refusal");
    }
  }
  return hasResult;
}

void DamageArray(Choice& choice, vtkDataArray* array, DamagedCase& outcome)
{
  const vtkIdType tuples = array->GetNumberOfTuples();
  const int kind = static_cast<int>(choice.Integer(0, 9));
  outcome.description += std::string(array->GetName()) + " by " + std::to_string(kind);
  if (kind == 0)
  {
    array->Resize(choice.Integer(0, tuples));
    array->SetNumberOfTuples(choice.Integer(0, tuples));
    return;
  }
  const double largest = tuples > 0 ? array->GetRange(0)[1] : 0.0;
  const Id changes = kind < 8 ? 1 : choice.Integer(1, 20);
  for (Id k = 0; k < changes && tuples > 0; ++k)
  {
    const vtkIdType tuple = choice.Integer(0, tuples - 1);
    const int component = static_cast<int>(choice.Integer(0, array->GetNumberOfComponents() - 1));
    const vtkIdType other = choice.Integer(0, tuples - 1);
    const double now = array->GetComponent(tuple, component);
    const double values[] = { array->GetComponent(other, component),
      now + choice.Of({ -1.0, 1.0, 0.5 }),
      choice.Of<double>({ std::nan(""), INFINITY, -INFINITY, -1.0, 0.0, 1e9, 1e300, 5e-324,
        2147483647.0, -9223372036854775808.0 }),
      double(choice.Integer(0, 1 + static_cast<Id>(std::min(std::max(largest, 0.0), 1e9)))),
      now * (1.0 + choice.Of({ -1.0, 1.0 }) * choice.PowerOfTen(-12.0, 3.0)) };
    array->SetComponent(tuple, component, values[choice.Integer(0, 4)]);
  }
}

} // namespace gridfem::testing

using namespace gridfem::testing;

namespace
{

struct Kind
{
  const char* name;
  void (*run)(Choice& choice, DamagedCase& outcome);
};

constexpr Kind Kinds[] = { { "basis", &SolveOnDamagedBasis }, { "cells", &RunOnDamagedCells },
  { "message", &TakeDamagedMessage }, { "selection", &SelectByDamagedNodes } };

const Kind& KindOf(std::uint64_t seed)
{
  return Kinds[seed % std::size(Kinds)];
}

DamagedCase RunSeed(std::uint64_t seed)
{
  std::cerr << "\rseed " << seed << ' ' << std::flush;
  Choice choice(seed);
  DamagedCase outcome;
  KindOf(seed).run(choice, outcome);
  return outcome;
}

void Describe(std::uint64_t seed, const DamagedCase& outcome)
{
  std::cout << seed << ": " << KindOf(seed).name << ": " << outcome.description;
  if (!outcome.refusal.empty())
  {
    std::cout << "; refused: " << outcome.refusal;
  }
  for (const std::string& what : outcome.broken)
  {
    std::cout << "; BROKEN: " << what;
  }
  std::cout << '\n';
}

struct Counts
{
  int cases = 0;
  int refused = 0;
  int broken = 0;
};

/// Returns 1 if a case is broken, or if no case of a kind is refused or none gives a result.
int RunSeeds(std::uint64_t first, std::uint64_t number)
{
  std::map<std::string, Counts> counts;
  for (std::uint64_t seed = first; seed < first + number; ++seed)
  {
    const DamagedCase outcome = RunSeed(seed);
    Counts& count = counts[KindOf(seed).name];
    ++count.cases;
    count.refused += !outcome.refusal.empty();
    count.broken += !outcome.broken.empty();
    if (!outcome.broken.empty())
    {
      Describe(seed, outcome);
    }
  }
  bool isGood = true;
  for (const auto& [name, count] : counts)
  {
    std::cout << name << ": " << count.cases << " cases, " << count.refused << " refused, "
              << count.broken << " broken\n";
    const bool hasBoth = count.refused > 0 && count.refused < count.cases;
    isGood = isGood && count.broken == 0 && (hasBoth || count.cases < 50);
  }
  return isGood ? 0 : 1;
}

} // namespace

int main(int argc, char** argv)
{
  if (argc < 2)
  {
    std::cerr << "Usage: FuzzFilters FIRST_SEED NUMBER, or FuzzFilters SEED\n";
    return 2;
  }
  const std::uint64_t seed = std::strtoull(argv[1], nullptr, 10);
  if (argc > 2)
  {
    return RunSeeds(seed, std::strtoull(argv[2], nullptr, 10));
  }
  const DamagedCase outcome = RunSeed(seed);
  Describe(seed, outcome);
  return outcome.broken.empty() ? 0 : 1;
}
