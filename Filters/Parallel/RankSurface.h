// The functions on a surface that several ranks hold together, of a grid or of the mesh, with all
// that they refer to.
#ifndef GridFEM_RankSurface_h
#define GridFEM_RankSurface_h

#include "Parallel/RankLevels.h"

#include <memory>

namespace gridfem
{

class RankSurface
{
public:
  /// Collective. As RankSpace; with hats above it, its functions are joined at points where sheets
  /// touch in a point only, if hats join there what the grid parts. [HatLevel::joinedGrid]
  /// Throws InvalidInput for hats when no triangle has an area, or coincident points are not
  /// welded: points of two ranks at the same place are told to be one by nothing else.
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
