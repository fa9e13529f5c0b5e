#include "Parallel/RankSurface.h"

namespace gridfem
{

RankSurface::RankSurface(const Communicator& ranks, const TriangleMesh& own,
  const RankSpaceOptions& options, bool hasHats, const Progress& progress,
  const TriangleList& copies)
{
  const SpaceOptions& functions = options.space.functions;
  if (hasHats && !functions.weldCoincidentPoints)
  {
    throw InvalidInput("Hat functions on several ranks need Weld Coincident Points. Turn it on.");
  }
  const auto clip = [&](const RankSpaceOptions& how, double from, double to)
  { return std::make_unique<const RankSpace>(ranks, own, how, progress.Part(from, to), copies); };
  RankSpaceOptions how = options;
  how.isBelowHats = hasHats;
  space_ = clip(how, 0.0, hasHats ? 0.5 : 1.0);
  if (!hasHats)
  {
    levels_ = std::make_unique<const RankLevels>(*space_);
    return;
  }
  this->AddHats(functions.threads, progress.Part(0.5, 0.7));
  if (!functions.joinAtPoints && levels_->ComponentsOf(0, functions.threads).count <
                                   levels_->OfGrid().ComponentsOf(0, functions.threads).count)
  {
    how.space.functions.depth = space_->Own().Functions().GetGrid().depth;
    levels_ = nullptr;
    hats_ = nullptr;
    space_ = nullptr;
    how.space.functions.joinAtPoints = true;
    space_ = clip(how, 0.7, 0.9);
    this->AddHats(functions.threads, progress.Part(0.9, 1.0));
  }
}

void RankSurface::AddHats(int threads, const Progress& progress)
{
  hats_ = std::make_unique<const RankHats>(*space_, Job{ threads, progress });
  if (hats_->Numbering().total == 0)
  {
    throw InvalidInput("No triangle has an area, so there are no hat functions.");
  }
  levels_ = std::make_unique<const RankLevels>(*space_, hats_.get());
}

} // namespace gridfem
