#include "Surfaces.h"

#include "Support/Meshes.h"

#include <random>

namespace gridfem::testing
{

namespace
{

/// Three fins around one edge, and triangles across them in random order.
TriangleMesh NonManifoldSoup()
{
  TriangleMesh soup;
  for (int fin = 0; fin < 3; ++fin)
  {
    soup = Join(soup, Transform(FlatRectangle(6, 6), Vec3::UnitY(), 2.1 * fin));
  }
  std::mt19937 random(19);
  std::uniform_real_distribution<double> position(-0.8, 0.8);
  for (int t = 0; t < 60; ++t)
  {
    const auto first = static_cast<Id>(soup.points.size());
    const Vec3 center(position(random), position(random), position(random));
    for (int corner = 0; corner < 3; ++corner)
    {
      soup.points.push_back(
        center + 0.3 * Vec3(position(random), position(random), position(random)));
    }
    soup.triangles.push_back({ first, first + 1, first + 2 });
  }
  return soup;
}

} // namespace

std::vector<NamedSurface> Surfaces()
{
  return { { "sphere", LatLongSphere(30, 15) }, { "torus", Torus(40, 16, 1.0, 0.3) },
    { "components", CubeArray(3, 2, 0.07) }, { "soup", NonManifoldSoup() },
    { "open", Transform(FlatRectangle(13, 9), Vec3(1, 2, 3), 0.7) },
    { "plate", Box(8, { 0, 0, 0 }, { 1, 1, 0.125 }) }, { "long triangles", Box(1) },
    { "thin gap", TwoSheets(12, 0.02) } };
}

std::vector<int> Deal(const TriangleMesh& mesh, Dealing dealing, int ranks)
{
  const std::size_t triangles = mesh.triangles.size();
  std::vector<int> rankOf(triangles, ranks - 1);
  std::mt19937 random(7);
  for (std::size_t t = 0; t < triangles; ++t)
  {
    switch (dealing)
    {
      case Dealing::OneRank:
        break;
      case Dealing::Contiguous:
        rankOf[t] = static_cast<int>(t * ranks / triangles);
        break;
      case Dealing::Shuffled:
        rankOf[t] = static_cast<int>(random() % ranks);
        break;
      case Dealing::EveryOther:
        rankOf[t] = static_cast<int>(t * ranks / triangles) / 2 * 2;
        break;
    }
  }
  return rankOf;
}

TriangleMesh PartOf(
  const TriangleMesh& mesh, const std::vector<int>& rankOf, int rank, std::vector<Id>* points)
{
  TriangleMesh part;
  std::vector<Id> place(mesh.points.size(), -1);
  for (std::size_t t = 0; t < mesh.triangles.size(); ++t)
  {
    if (rankOf[t] != rank)
    {
      continue;
    }
    std::array<Id, 3> corners;
    for (int corner = 0; corner < 3; ++corner)
    {
      Id& point = place[mesh.triangles[t][corner]];
      if (point < 0)
      {
        point = static_cast<Id>(part.points.size());
        part.points.push_back(mesh.points[mesh.triangles[t][corner]]);
        if (points)
        {
          points->push_back(mesh.triangles[t][corner]);
        }
      }
      corners[corner] = point;
    }
    part.triangles.push_back(corners);
  }
  return part;
}

RankSpaceOptions Options(int depth)
{
  RankSpaceOptions options;
  options.space.functions.depth = depth;
  options.space.functions.threads = 1;
  options.space.coarsestSize = 16;
  options.granularity = 2;
  return options;
}

} // namespace gridfem::testing
