#include "Parallel/RankComponents.h"

#include <algorithm>

namespace gridfem
{

namespace
{

/// Collective. The lowest number of a function in the component of each function. It starts as the
/// lowest in the rank's part, and decreases as neighbors send lower numbers. It takes as many
/// rounds as a component crosses borders between ranks.
MultiVector LowestOfComponents(const Communicator& ranks, const LevelNumbering& numbering,
  const RankRows& rows, const Components& part)
{
  const std::vector<Index>& partOf = part.ofFunction;
  std::vector<double> ofPart;
  MultiVector lowest;
  MultiVector next;
  ranks.Together(
    [&]
    {
      ofPart.resize(part.count);
      lowest.resize(numbering.Functions(), 1);
      std::copy(numbering.number.begin(), numbering.number.end(), lowest.data());
      next.resize(numbering.Functions(), 1);
    });
  for (double change = 1.0; change > 0.0; ranks.Maximum(&change, 1))
  {
    std::fill(ofPart.begin(), ofPart.end(), static_cast<double>(numbering.total));
    for (std::size_t f = 0; f < partOf.size(); ++f)
    {
      ofPart[partOf[f]] = std::min(ofPart[partOf[f]], lowest.data()[f]);
    }
    for (std::size_t f = 0; f < partOf.size(); ++f)
    {
      next.data()[f] = ofPart[partOf[f]];
    }
    rows.TakeLeast(next);
    change = next == lowest ? 0.0 : 1.0;
    lowest.swap(next);
  }
  return lowest;
}

} // namespace

Components ComponentsOfRanks(const Communicator& ranks, const LevelNumbering& numbering,
  const RankRows& rows, const Components& part)
{
  const MultiVector lowest = LowestOfComponents(ranks, numbering, rows, part);
  std::vector<double> firsts; // numbers of the components' first functions, ascending
  ranks.Together(
    [&]
    {
      for (Index f = numbering.ghosts; f < numbering.Functions(); ++f)
      {
        if (lowest(f, 0) == static_cast<double>(numbering.number[f]))
        {
          firsts.push_back(lowest(f, 0));
        }
      }
    });
  firsts = ranks.Gather(firsts);
  Components components;
  components.count = static_cast<Index>(firsts.size());
  ranks.Together(
    [&]
    {
      components.ofFunction.resize(numbering.Functions());
      for (Index f = 0; f < numbering.Functions(); ++f)
      {
        components.ofFunction[f] = static_cast<Index>(
          std::lower_bound(firsts.begin(), firsts.end(), lowest(f, 0)) - firsts.begin());
      }
    });
  return components;
}

} // namespace gridfem
