// The transfer of a surface from the ranks that were given it to the ranks that compute with it,
// and back. Every triangle goes to all ranks whose region it may meet. [BlockPartition.h]
#ifndef GridFEM_Redistribution_h
#define GridFEM_Redistribution_h

#include "Grid/TriangleMesh.h"
#include "Parallel/BlockPartition.h"

#include <array>
#include <vector>

namespace gridfem
{

class Redistribution
{
public:
  /// Collective. Triangles are numbered rank after rank, and so are points.
  /// @param own    the triangles that this rank was given; points on borders are repeated
  /// @param cells  cells of triangles that are pieces already; null: triangles are clipped
  Redistribution(const Communicator& ranks, const TriangleMesh& own, const Grid& grid,
    const BlockPartition& partition, const std::vector<MortonKey>* cells = nullptr);

  /// The mesh that this rank has received; it is given up. Triangles are in the order of their
  /// numbers. Points are sorted in space by their coordinates alone. Coincident points keep the
  /// order of their numbers. This order helps to make clipping the same on all ranks.
  TriangleMesh TakeMesh() { return std::move(mesh_); }

  /// Collective. Sends the rows of a field to the points, or the triangles, of the received mesh.
  /// @param own  rows of this rank's own points or triangles; the same columns on all ranks
  MultiVector SendPoints(const MultiVector& own) const;
  MultiVector SendTriangles(const MultiVector& own) const;

  /// Collective. Returns rows at received points. They have the same bits on all ranks that return
  /// a point.
  /// @param rows     at the received points
  /// @param isKnown  whether each of them is returned
  /// @param own      gets the rows; rows that no rank returns stay as they are
  /// @return         per own point: whether a rank has returned it
  std::vector<char> ReturnPoints(
    const MultiVector& rows, const std::vector<char>& isKnown, MultiVector& own) const;

  /// Collective. Returns values of parts of triangles: the sum over the ranks that have received a
  /// triangle. Rows = own triangles.
  /// @param rows  at the received triangles; the same columns on all ranks
  MultiVector SumTriangles(const MultiVector& rows) const;

  Id NumberOfOwnPoints() const { return numberOfOwnPoints_; }

  ///@{ Own points and own triangles that are sent to a rank, ascending.
  const std::vector<Index>& PointsTo(int rank) const { return sentPoints_[rank]; }
  const std::vector<Index>& TrianglesTo(int rank) const { return sentTriangles_[rank]; }
  ///@}

  /// The places in the received mesh of the points that ranks have sent here, rank after rank.
  /// Triangles keep the order in which they come.
  const std::vector<Index>& PlacesOfPoints() const { return pointPlace_; }

  /// The rank that has sent each received point.
  std::vector<int> GiversOfPoints() const;

private:
  using Lists = std::vector<std::vector<Index>>; // one per rank
  using Point = std::array<double, 3>;
  using Corners = std::array<Index, 3>; // places among the points sent to the same rank

  void Route(const TriangleMesh& own, const Grid& grid, const BlockPartition& partition,
    const std::vector<MortonKey>* cells);
  void Receive(const TriangleMesh& own, const Grid& grid);
  void FillMessages(const TriangleMesh& own, std::vector<std::vector<Point>>& points,
    std::vector<std::vector<Corners>>& corners) const;
  void BuildMesh(std::vector<std::vector<Point>> points, std::vector<std::vector<Corners>> corners,
    const Grid& grid);
  MultiVector Send(const MultiVector& own, Id ownRows, const Lists& sent,
    const std::vector<Id>& expected, const std::vector<Index>& place) const;

  Communicator ranks_;
  Lists sentTriangles_; // own triangles that go to each rank, ascending
  Lists sentPoints_;    // own points of these triangles, ascending
  Id numberOfOwnPoints_ = 0;
  Id numberOfOwnTriangles_ = 0;
  std::vector<Index> pointPlace_;    // in the received mesh, for received points rank after rank
  std::vector<Index> trianglePlace_; // the same for triangles
  std::vector<Id> receivedPoints_;   // number from each rank
  std::vector<Id> receivedTriangles_;
  TriangleMesh mesh_;
};

} // namespace gridfem

#endif
