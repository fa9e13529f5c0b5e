// Ranks find the seams of the whole surface, for any distribution of its pieces.
#include "Parallel/RankSeams.h"

#include "Grid/JoinSeams.h"
#include "Meshes.h"
#include "Pieces.h"
#include "SameSeams.h"

#include <gtest/gtest.h>

#include <cmath>

using namespace gridfem;
using namespace gridfem::testing;

namespace
{

/// A tube in single precision with a seam, beside two squares of different resolution.
TriangleMesh SurfaceWithSeams()
{
  TriangleMesh tube = FlatRectangle(30, 10);
  for (Vec3& point : tube.points)
  {
    const float angle = 6.2831853F * static_cast<float>(point[0]);
    point = Vec3(std::cos(angle), std::sin(angle), point[1]);
  }
  const TriangleMesh coarse = Transform(FlatRectangle(4, 4), { 0, 0, 1 }, 0.0, 1.0, { 2, 0, 0 });
  const TriangleMesh fine = Transform(FlatRectangle(6, 6), { 0, 0, 1 }, 0.0, 1.0, { 3, 0, 0 });
  return Join(tube, Join(coarse, fine));
}

Seams OfOneProcess(const TriangleMesh& mesh)
{
  const std::vector<OpenEdge> open = FindOpenEdges(mesh);
  const Bounds bounds = BoundsOf(mesh.points);
  return FindSeams(open, ShortestSides(mesh, NumberEnds(open)),
    (bounds.high - bounds.low).maxCoeff<Eigen::PropagateNaN>());
}

} // namespace

TEST(RankSeams, AreThoseOfOneProcess)
{
  const Communicator ranks(MPI_COMM_WORLD);
  const TriangleMesh mesh = SurfaceWithSeams();
  const Seams expected = OfOneProcess(mesh);
  ASSERT_FALSE(expected.moves.empty());
  ASSERT_FALSE(expected.divisions.empty());
  for (const Dealing dealing : Dealings)
  {
    TriangleMesh own = PieceOf(mesh, dealing, false).mesh;
    const Seams found = FindSeams(ranks, own);
    ExpectSameSeams(found, expected);
    for (const MovedPoint& moved : MovePoints(found.moves, own))
    {
      EXPECT_EQ(own.points[moved.point], own.points[moved.twin]);
    }
  }
}

TEST(RankSeams, BordersOfPiecesAreNoSeams)
{
  const Communicator ranks(MPI_COMM_WORLD);
  for (const NamedSurface& surface : Surfaces())
  {
    for (const Dealing dealing : Dealings)
    {
      const Seams found = FindSeams(ranks, PieceOf(surface.mesh, dealing, false).mesh);
      EXPECT_TRUE(found.moves.empty()) << surface.name;
      EXPECT_TRUE(found.divisions.empty()) << surface.name;
    }
  }
}
