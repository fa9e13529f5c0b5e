// Surfaces of several kinds, and ways to deal them out to ranks.
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

/// A sphere, a torus, many components, a non-manifold soup, an open surface, a plate whose faces
/// lie on planes of the grid, a few triangles that are longer than the cells, sheets with a thin
/// gap.
std::vector<NamedSurface> Surfaces();

enum class Dealing
{
  OneRank,    // the last one has all
  Contiguous, // one stretch of triangles each
  Shuffled,   // triangle by triangle, in no order
  EveryOther  // odd ranks have none
};
constexpr Dealing Dealings[] = { Dealing::OneRank, Dealing::Contiguous, Dealing::Shuffled,
  Dealing::EveryOther };

/// The rank of every triangle.
std::vector<int> Deal(const TriangleMesh& mesh, Dealing dealing, int ranks);

/// The triangles of a rank with the points that they use.
/// @param points  if not null: which points of the mesh they are
TriangleMesh PartOf(const TriangleMesh& mesh, const std::vector<int>& rankOf, int rank,
  std::vector<Id>* points = nullptr);

/// A space of one thread with as many levels for one rank as for several, shared from level 2 on.
RankSpaceOptions Options(int depth);

} // namespace gridfem::testing

#endif
