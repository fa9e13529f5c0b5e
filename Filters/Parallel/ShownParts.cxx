#include "Parallel/ShownParts.h"

namespace gridfem
{

std::vector<Id> PointsOfPieces(const ClippedMesh& clipped)
{
  std::vector<char> isUsed(clipped.numberOfInputPoints, 0);
  for (const Index corner : clipped.corners)
  {
    if (corner < clipped.numberOfInputPoints)
    {
      isUsed[corner] = 1;
    }
  }
  std::vector<Id> points;
  for (Id point = 0; point < static_cast<Id>(clipped.position.size()); ++point)
  {
    if (point >= clipped.numberOfInputPoints || isUsed[point])
    {
      points.push_back(point);
    }
  }
  return points;
}

ClippedMesh WithPoints(const ClippedMesh& clipped, const std::vector<Id>& points)
{
  ClippedMesh shown;
  shown.grid = clipped.grid;
  shown.cells = clipped.cells;
  shown.cellBegin = clipped.cellBegin;
  shown.pieceTriangle = clipped.pieceTriangle;
  shown.pieceBegin = clipped.pieceBegin;
  std::vector<Index> place(clipped.position.size(), -1);
  for (const Id point : points)
  {
    place[point] = static_cast<Index>(shown.position.size());
    shown.position.push_back(clipped.position[point]);
    shown.numberOfInputPoints += point < clipped.numberOfInputPoints ? 1 : 0;
  }
  shown.corners.reserve(clipped.corners.size());
  for (const Index corner : clipped.corners)
  {
    shown.corners.push_back(place[corner]);
  }
  return shown;
}

std::vector<PatchLevel> LevelsOfRank(const RankSpace& space)
{
  const std::vector<PatchLevel>& own = space.Own().Functions().levels;
  const std::size_t distributed = space.Numberings().size();
  const Id before = space.Ranks().ShareOf(own[distributed].NumberOfPatches()).before;
  std::vector<PatchLevel> levels;
  space.Ranks().Together(
    [&]
    {
      levels.assign(own.begin(), own.begin() + static_cast<Id>(distributed));
      for (Index& parent : levels.back().parent)
      {
        parent += static_cast<Index>(before);
      }
      const std::vector<PatchLevel>& shared = space.Shared().Functions().levels;
      levels.insert(levels.end(), shared.begin(), shared.end());
    });
  return levels;
}

PatchLevel GatherFinest(const RankSpace& space)
{
  const LevelNumbering& numbering = space.Numberings().front();
  PatchLevel finest = space.Own().Functions().Finest();
  for (auto& dof : finest.dof)
  {
    for (Index& function : dof)
    {
      function = static_cast<Index>(numbering.number[function]);
    }
  }
  finest.cell = space.Ranks().Gather(finest.cell);
  finest.dof = space.Ranks().Gather(finest.dof);
  finest.numberOfFunctions = static_cast<Index>(numbering.total);
  return finest;
}

} // namespace gridfem
