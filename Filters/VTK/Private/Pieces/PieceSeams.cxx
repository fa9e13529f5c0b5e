#include "Pieces/PieceSeams.h"

#include "Pieces/CanDistribute.h"

#include "Parallel/RankSeams.h"

#include <utility>

namespace gridfem
{
namespace
{

void ApplyMoves(const Seams& seams, int threads, InputMesh& mesh)
{
  auto triangles = std::make_shared<TriangleMesh>(*mesh.triangles);
  mesh.moved = MovePoints(seams.moves, *triangles, threads);
  mesh.isWelded = true;
  mesh.triangles = std::move(triangles);
}

} // namespace

void JoinSeamsOfRanks(const Communicator& ranks, int threads, InputMesh& mesh, InputMesh& copies)
{
  const Seams seams = FindSeams(ranks, *mesh.triangles, threads);
  if (!seams.divisions.empty())
  {
    throw NeedsWholeSurface();
  }
  if (!seams.moves.empty())
  {
    ranks.Together(
      [&]
      {
        ApplyMoves(seams, threads, mesh);
        ApplyMoves(seams, threads, copies);
      });
  }
}

} // namespace gridfem
