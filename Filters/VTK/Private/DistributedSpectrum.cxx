#include "DistributedSpectrum.h"

#if GRIDFEM_HAS_PARALLEL

#include "DistributedSpace.h"

#include "InputValidation.h"
#include "Parallel/RankSpectrum.h"
#include "SurfaceSpectrum.h"

namespace gridfem
{
namespace
{

DistributedModes FindModes(const Communicator& ranks, const InputMesh& mesh,
  const SpectrumOptions& modes, const SurfaceOptions& options, const Progress& progress)
{
  const RankSpaceOptions spaceOptions = DistributedOptions(ranks, options);
  const RankSpace space(ranks, *mesh.triangles, spaceOptions, progress.Part(0.0, 0.3));
  SpectrumOptions wanted = modes;
  wanted.multigrid.threads = spaceOptions.space.functions.threads;
  ranks.Together(
    [&]
    {
      RequireMemoryForModes(
        space.Numberings().front().Functions(), wanted.numberOfModes, wanted.multigrid.threads);
    });
  DistributedModes found;
  found.spectrum = ComputeSpectrum(space, wanted, progress.Part(0.3, 1.0));
  found.unitLength = space.Own().UnitLength();
  // The integral over the space's units is UnitLength² times smaller than the one over world units.
  found.spectrum.vectors /= found.unitLength;
  found.values =
    space.ValuesAtPoints(found.spectrum.vectors, static_cast<Id>(mesh.triangles->points.size()));
  found.spectrum.vectors.resize(0, 0);
  return found;
}

} // namespace

DistributedModes FindModesTogether(const InputMesh& mesh, int numberOfModes,
  bool completeMultiplets, const SurfaceOptions& options, const Progress& progress)
{
  SpectrumOptions modes = SolverOptions(options, numberOfModes);
  modes.completeMultiplets = completeMultiplets;
  return OnRanksOfVtk(
    [&](const Communicator& ranks) { return FindModes(ranks, mesh, modes, options, progress); });
}

} // namespace gridfem

#else

gridfem::DistributedModes gridfem::FindModesTogether(
  const InputMesh&, int, bool, const SurfaceOptions&, const Progress&)
{
  throw InvalidInput("This build has no MPI.");
}

#endif
