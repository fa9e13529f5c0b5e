// The hierarchy of Aksoylu, Khodakovsky and Schröder on a triangle mesh: maximal independent sets
// of vertices are removed one after the other, and the holes are triangulated again. [T §4.3.2]
#ifndef GridFEM_Benchmarks_IndependentSets_h
#define GridFEM_Benchmarks_IndependentSets_h

#include "Grid/TriangleMesh.h"

#include <Eigen/SparseCore>

#include <vector>

namespace gridfem::benchmarks
{

using Prolongation = Eigen::SparseMatrix<double>;

/// Prolongations, finest first: rows = vertices of a level, columns = the remaining vertices. A
/// vertex that stays keeps its value. The neighbors of a removed vertex are laid into the plane
/// around it, with their lengths and with angles scaled to a full turn. The vertex gets the linear
/// interpolation of its new triangle. Vertices on boundaries and non-manifold edges stay.
/// @param mesh  every point is used
/// @param smallest  ends at the first level with at most that many vertices, or when less than a
/// twentieth can be removed
std::vector<Prolongation> RemoveIndependentSets(const TriangleMesh& mesh, int smallest);

/// Products of successive prolongations, so each level has at most a quarter of the vertices of the
/// level before. This is "Aksoylu #1" of the thesis; the hierarchy itself is "Aksoylu #2".
std::vector<Prolongation> Compose(const std::vector<Prolongation>& prolongations);

} // namespace gridfem::benchmarks

#endif
