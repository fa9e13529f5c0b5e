// Surfaces of several kinds, and ways to distribute them to ranks.
#ifndef GridFEM_Testing_Surfaces_h
#define GridFEM_Testing_Surfaces_h

#include "Parallel/RankSpace.h"

#include <string>
#include <vector>

namespace gridfem::testing
{

struct NamedSurface
{
  std::string name;
  TriangleMesh mesh;
};

/// Surfaces of many kinds: a sphere, a torus, many components, a non-manifold soup, an open
/// surface. Further ones are a plate whose faces lie on planes of the grid, a few triangles longer
/// than the cells, and sheets with a thin gap.
std::vector<NamedSurface> Surfaces();

enum class Dealing
{
  OneRank,    // the last rank has all
  Contiguous, // one range of triangles each
  Shuffled,   // triangle by triangle, in random order
  EveryOther  // odd ranks have none
};
constexpr Dealing Dealings[] = { Dealing::OneRank, Dealing::Contiguous, Dealing::Shuffled,
  Dealing::EveryOther };

/// The rank of every triangle.
std::vector<int> Deal(const TriangleMesh& mesh, Dealing dealing, int ranks);

/// The triangles of a rank with the points that they use.
/// @param points  if not null: gets the numbers of these points in the mesh
TriangleMesh PartOf(const TriangleMesh& mesh, const std::vector<int>& rankOf, int rank,
  std::vector<Id>* points = nullptr);

/// A space with one thread. It has as many levels for one rank as for several, shared from level 2
/// on.
RankSpaceOptions Options(int depth);

} // namespace gridfem::testing

#endif
