// Finds places between the points of a surface, on its triangles in the space of its modes.
#ifndef GridFEM_MapPlaces_h
#define GridFEM_MapPlaces_h

#include "Base/Grouping.h"
#include "Spectrum/MapRefinement.h"

#include <array>
#include <vector>

namespace gridfem
{

/// A point on a triangle of the reference. The weights have the sum 1.
struct PlaceOfMap
{
  std::array<Id, 3> rows;
  std::array<double, 3> weights;
  double distance = 0.0; // in the space of the modes
};

/// Triangles of a surface in the space of its modes.
class MapPlaces
{
public:
  /// @param rows      of the mesh
  /// @param embedded  a row for each of them, the place in the space
  MapPlaces(const TriangleMesh& mesh, const ModeRows& rows, const MultiVector& embedded);

  /// Returns the nearest place on the triangles around the place of a row in space, or the row
  /// itself if there are none.
  PlaceOfMap Nearest(Id row, const Eigen::RowVectorXd& query) const;

private:
  const MultiVector& embedded_;
  std::vector<std::array<Id, 3>> triangles_; // rows of the corners
  std::vector<Index> classOf_;               // per row, the same for coincident points
  Groups around_; // corners of triangles (3 × triangle + corner) by class
};

} // namespace gridfem

#endif
