// Computes the figures of the thesis' chapters 4 and 6.2. Writes the input of draw_figures.py into
// the folder of the first argument. Further arguments: the figures to compute (default: all but
// 6.9, whose errors take ten minutes).
#include "AlgebraicMultigrid.h"
#include "Figures.h"
#include "FlowComparison.h"
#include "Measure.h"

#include <algorithm>
#include <cstdio>
#include <filesystem>

namespace
{

/// Ten minutes.
void WriteFlowErrors(const std::string& folder)
{
  using namespace gridfem::benchmarks;
  const FlowComparisonOptions options;
  const FlowComparison comparison = CompareFlows(options);
  PrintComparison(options, comparison);
  WriteFigure(FigureOf(comparison), folder);
}

} // namespace

int main(int argc, char** argv)
{
  using namespace gridfem::benchmarks;
  const std::vector<std::string> arguments(argv + std::min(argc, 1), argv + argc);
  const std::string folder = arguments.empty() ? "." : arguments.front();
  std::filesystem::create_directories(folder);
  const MessagePassing libraries;
  const std::pair<const char*, void (*)(const std::string&)> figures[] = {
    { "4.4", WriteQuadratureFigure },
    { "4.5", WriteRigidMotionFigure },
    { "4.6", WriteCotangentFigure },
    { "4.7", WriteHatConvergence },
    { "4.8", WriteGridConvergence },
    { "4.11", WriteRotatedCubes },
    { "4.13", WriteErrorMaps },
    { "6.6", WriteSeparatedCubes },
    { "6.7", WriteKnotConvergence },
    { "6.9", WriteFlowErrors },
  };
  for (const auto& [number, write] : figures)
  {
    const bool isWanted = arguments.size() < 2
                            ? number != std::string("6.9")
                            : std::count(arguments.begin() + 1, arguments.end(), number) > 0;
    if (isWanted)
    {
      const Stopwatch watch;
      write(folder);
      std::printf("Figure %s: %.1f s\n", number, watch.Seconds());
      std::fflush(stdout);
    }
  }
}
