// The functions of a grid or of the mesh on a surface on several ranks, with all data that they
// refer to.
#ifndef GridFEM_RankSurface_h
#define GridFEM_RankSurface_h

#include "Parallel/RankLevels.h"

#include <memory>

namespace gridfem
{

class RankSurface
{
public:
  /// Collective. Makes a RankSpace, with hats above it if wanted. With hats, sheets that touch only
  /// in a point are joined on the grid if the hats join them. [HatLevel::joinedGrid]
  /// Throws InvalidInput for hats if no triangle has an area, or if coincident points are not
  /// welded. Without welding, ranks cannot know which of their points are the same.
  RankSurface(const Communicator& ranks, const TriangleMesh& own, const RankSpaceOptions& options,
    bool hasHats, const Progress& progress = {}, const TriangleList& copies = {});

  const RankSpace& Space() const { return *space_; }
  const RankLevels& Levels() const { return *levels_; }

private:
  void AddHats(int threads, const Progress& progress);

  std::unique_ptr<const RankSpace> space_;
  std::unique_ptr<const RankHats> hats_;
  std::unique_ptr<const RankLevels> levels_;
};

} // namespace gridfem

#endif
