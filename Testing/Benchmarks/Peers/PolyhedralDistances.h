// Exact distances along a triangle mesh, by CGAL: the method of Xin and Wang, which follows windows
// of shortest paths from edge to edge.
#ifndef GridFEM_Benchmarks_PolyhedralDistances_h
#define GridFEM_Benchmarks_PolyhedralDistances_h

#include "Grid/TriangleMesh.h"

#include <vector>

namespace gridfem::benchmarks
{

/// From one point to others, one thread. Empty where the mesh is no manifold; infinity at points
/// that the source does not reach.
std::vector<double> PolyhedralDistances(
  const TriangleMesh& mesh, Id source, const std::vector<Id>& targets);

/// To all points.
std::vector<double> PolyhedralDistances(const TriangleMesh& mesh, Id source);

} // namespace gridfem::benchmarks

#endif
