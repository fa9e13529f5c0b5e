// The heat method of CGAL, which first flips edges to an intrinsic Delaunay triangulation.
#ifndef GridFEM_Benchmarks_IntrinsicHeat_h
#define GridFEM_Benchmarks_IntrinsicHeat_h

#include "Grid/TriangleMesh.h"

#include <memory>
#include <vector>

namespace gridfem::benchmarks
{

class IntrinsicHeat
{
public:
  /// Flips edges and factorizes, on one thread.
  explicit IntrinsicHeat(const TriangleMesh& mesh);
  ~IntrinsicHeat();

  /// Whether the mesh is a manifold. Otherwise there are no distances.
  bool IsManifold() const;

  /// Distances from one point to all points.
  std::vector<double> From(Id source);

private:
  struct Implementation;
  std::unique_ptr<Implementation> implementation_;
};

} // namespace gridfem::benchmarks

#endif
