#include "Solvers/Requirements.h"

#include "Base/Errors.h"
#include "Grid/Grid.h"
#include "Solvers/MemoryEstimate.h"
#include "Spectrum/Spectrum.h"

#include <cctype>
#include <cmath>
#include <iomanip>
#include <sstream>
#include <string>

namespace gridfem
{
namespace
{

/// Bounds of this size only say that a number fits its type.
constexpr double Unbounded = 1e9;

/// Bytes of everything that a filter makes on the grid.
double BytesOf(const TriangleMesh& mesh, const MemoryEstimate& grid, FunctionKind kind)
{
  return grid.bytes + (kind == FunctionKind::Hats          ? EstimateHatMemory(mesh, grid.functions)
                        : kind == FunctionKind::SmoothGrid ? EstimateSmoothMemory(grid.functions)
                                                           : 0.0);
}

} // namespace

std::string LabelOf(const std::string& property)
{
  std::string label;
  for (std::size_t k = 0; k < property.size(); ++k)
  {
    const bool beginsWord = k > 0 && std::isupper(property[k]) && std::islower(property[k - 1]);
    label += (beginsWord ? " " : "") + property.substr(k, 1);
  }
  return label;
}

std::string RefusalOf(const std::string& property, double value, double least, double most)
{
  if (std::isnan(value))
  {
    return LabelOf(property) + " is not a number.";
  }
  if (std::isfinite(value) && value >= least && value <= most)
  {
    return {};
  }
  std::ostringstream message;
  message << LabelOf(property) << " is " << value << "; it must be ";
  if (least <= -Unbounded && most >= Unbounded)
  {
    message << "finite";
  }
  else if (most >= Unbounded)
  {
    message << least << " or more";
  }
  else
  {
    message << "from " << least << " to " << most;
  }
  return message.str() + ".";
}

void RequireInRange(const std::string& property, double value, double least, double most)
{
  const std::string refusal = RefusalOf(property, value, least, most);
  if (!refusal.empty())
  {
    throw InvalidInput(refusal);
  }
}

void RequireAtLeast(const std::string& property, double value, double least)
{
  RequireInRange(property, value, least, std::numeric_limits<double>::max());
}

void RequireNumber(const std::string& property, double value)
{
  if (std::isnan(value))
  {
    throw InvalidInput(RefusalOf(property, value, value, value));
  }
}

void RequireFirstDegree(FunctionKind kind, const char* subject)
{
  if (kind == FunctionKind::SmoothGrid)
  {
    throw InvalidInput(std::string(subject) +
                       " need functions of degree one. Set Function Space to Grid or to Hat "
                       "Functions.");
  }
}

int FittingDepth(const TriangleMesh& mesh, int most, int least, FunctionKind kind)
{
  return FinestDepth(most, least,
    [&](int depth)
    { return BytesOf(mesh, EstimateMemory(mesh, depth), kind) <= AvailableMemory(); });
}

int ChooseDepth(const TriangleMesh& mesh, int wanted, FunctionKind kind, double perPoint)
{
  const bool isAutomatic = wanted == AutomaticDepth;
  int depth = isAutomatic ? SuggestedDepth(mesh) : wanted;
  if (kind == FunctionKind::Hats)
  {
    depth = DepthForPoints(mesh, depth, perPoint);
  }
  else if (kind == FunctionKind::SmoothGrid && isAutomatic)
  {
    depth -= 1; // about as accurate as trilinear functions at the depth suggested for them
  }
  return isAutomatic ? FittingDepth(mesh, depth, MinimumDepth, kind) : depth;
}

void RequireMemory(const MemoryNeed& need, double available, const std::string& where)
{
  if (need.bytes > available)
  {
    constexpr double GB = 1e9;
    std::ostringstream message;
    message << std::setprecision(3) << need.subject << " needs about " << need.bytes / GB
            << " GB of memory" << where << ", but only " << available / GB << " GB are free. "
            << need.advice;
    throw InvalidInput(message.str());
  }
}

MemoryNeed NeedOfModes(Id functions, Id modes, int threads)
{
  return { EstimateSpectrumMemory(functions, modes, threads),
    "Number Of Modes " + std::to_string(modes) + " with " + std::to_string(functions) +
      " basis functions",
    "Choose fewer modes or a smaller Depth." };
}

void RequireMemory(const TriangleMesh& mesh, int depth, FunctionKind kind)
{
  const MemoryEstimate estimate = EstimateMemory(mesh, depth);
  std::ostringstream subject;
  subject << "Depth " << depth << " (about " << std::setprecision(3) << estimate.functions
          << " basis functions)";
  if (kind == FunctionKind::Hats)
  {
    subject << " with the hat functions of " << mesh.points.size() << " points";
  }
  else if (kind == FunctionKind::SmoothGrid)
  {
    subject << " of degree two";
  }
  RequireMemory({ BytesOf(mesh, estimate, kind), subject.str(), CoarserGrid }, AvailableMemory());
}

void RequireMemoryForHats(const TriangleMesh& mesh, Id functions)
{
  RequireMemory({ EstimateHatMemory(mesh, static_cast<double>(functions)),
                  "Hat functions on " + std::to_string(mesh.points.size()) + " points",
                  "Set Function Space to Grid, or use a mesh with fewer points." },
    AvailableMemory());
}

} // namespace gridfem
