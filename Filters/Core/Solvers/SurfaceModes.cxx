#include "Solvers/SurfaceModes.h"

#include "Base/Errors.h"
#include "Base/UnsolvedRows.h"
#include "Grid/TriangleArea.h"

#include <algorithm>

namespace gridfem
{
namespace
{

/// A flag for each point: 1 if it is on a triangle with an area, or if a mode is not 0 there. Modes
/// may all be 0 on a boundary, and triangles may be those of other processes.
std::vector<char> PointsWithModes(const PointModes& modes, const TriangleMesh& mesh)
{
  std::vector<char> isReached(static_cast<std::size_t>(modes.values.rows()));
  for (std::size_t point = 0; point < isReached.size(); ++point)
  {
    isReached[point] = !modes.values.row(static_cast<Id>(point)).isZero(0.0);
  }
  for (const std::array<Id, 3>& corners : mesh.triangles)
  {
    if (AreaVector(mesh.points, corners).norm() > 0.0)
    {
      std::for_each(corners.begin(), corners.end(), [&](Id corner) { isReached[corner] = 1; });
    }
  }
  return isReached;
}

} // namespace

Progress OfOwnPoints(const Surface& surface, const Progress& progress)
{
  return surface.IsShared() ? Progress() : progress;
}

void SurfaceModes::Update(Surface& surface, const GivenModes& given,
  const SpectrumSolver::Options& options, const SpectrumSolver::Announcement& announce,
  const Progress& progress)
{
  if (!given)
  {
    this->Compute(surface, options, announce, progress);
    return;
  }
  StageKey key;
  key.Add(true).Add(given.version);
  surface.GetStages().Run(ModesStage, key,
    [&]
    {
      modes_ = given.modes;
      mesh_ = given.mesh;
      isReached_ = PointsWithModes(*modes_, *mesh_);
      constants_ = CountZeroModes(*modes_);
      areAllConstants_ = false;
    });
  isConverged_ = true;
  device_.clear();
  warnings_.clear();
}

void SurfaceModes::Compute(Surface& surface, const SpectrumSolver::Options& options,
  const SpectrumSolver::Announcement& announce, const Progress& progress)
{
  SpectrumSolver::Input input;
  input.completesMultiplets = true;
  input.announce = announce;
  const SpectrumSolver::Result& solved =
    spectrum_.Update(surface, input, options, { surface.Threads(), progress.Part(0.0, 0.98) });
  Stages& stages = surface.GetStages();
  StageKey key;
  key.Add(false).Add(stages.Version(SolveStage));
  stages.Run(ModesStage, key,
    [&]
    {
      modes_.reset();
      auto modes = std::make_shared<PointModes>();
      modes->eigenvalues = solved.eigenvalues;
      modes->area = surface.Area();
      modes->values = spectrum_.ModesAtPoints(
        surface, 0, solved.NumberOfModes(), OfOwnPoints(surface, progress.Part(0.98, 1.0)));
      isReached_ = surface.PointsWithFunctions();
      FillRows(isReached_, 0.0, modes->values);
      constants_ = solved.spectrum.numberOfConstants;
      areAllConstants_ = solved.NumberOfModes() <= constants_ && !solved.spectrum.truncated;
      modes_ = std::move(modes);
      mesh_ = surface.SharedMesh();
    });
  isConverged_ = solved.spectrum.converged;
  device_ = solved.spectrum.where;
  warnings_ = solved.warnings;
}

void SurfaceModes::RequireNonConstant() const
{
  if (areAllConstants_)
  {
    const std::string components = std::to_string(constants_);
    throw InvalidInput("All " + std::to_string(modes_->eigenvalues.size()) +
                       " modes are constants: the surface has " + components +
                       " connected components, each with one constant mode. Signatures need a " +
                       "Number Of Modes above " + components + ".");
  }
}

} // namespace gridfem
