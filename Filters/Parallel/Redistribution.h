// The way of a surface from the ranks that were given it to those that compute with it, and back:
// every triangle goes to all ranks whose region it may meet. [BlockPartition.h]
#ifndef GridFEM_Redistribution_h
#define GridFEM_Redistribution_h

#include "Grid/TriangleMesh.h"
#include "Parallel/BlockPartition.h"

#include <vector>

namespace gridfem
{

class Redistribution
{
public:
  /// Collective. Triangles are numbered rank after rank, points as well.
  /// @param own  the triangles that this rank was given; a border's points are repeated
  /// @param cells  of triangles that are pieces already; null: they are clipped
  Redistribution(const Communicator& ranks, const TriangleMesh& own, const Grid& grid,
    const BlockPartition& partition, const std::vector<MortonKey>* cells = nullptr);

  /// What this rank has received: triangles in the order of their numbers; points sorted in
  /// space by their coordinates alone, coincident ones in the order of their numbers. The order is
  /// part of what makes clipping the same on all ranks. Gives up the mesh.
  TriangleMesh TakeMesh() { return std::move(mesh_); }

  /// Collective. Rows of a field at the points, or on the triangles, of the received mesh.
  /// @param own  rows of this rank's own points or triangles; the same columns on all ranks
  MultiVector SendPoints(const MultiVector& own) const;
  MultiVector SendTriangles(const MultiVector& own) const;

  /// Collective. The way back: rows at received points, the same bits on all ranks that return one.
  /// @param rows   at the received points
  /// @param isKnown  which of them are returned
  /// @param own    gets the rows; those that no rank returns are left as they are
  /// @return  per own point whether a rank has returned it
  std::vector<char> ReturnPoints(
    const MultiVector& rows, const std::vector<char>& isKnown, MultiVector& own) const;

  /// Collective. The way back of what is made of parts of triangles: the sum over the ranks that
  /// have received a triangle. Rows = own triangles.
  /// @param rows  at the received triangles; the same columns on all ranks
  MultiVector SumTriangles(const MultiVector& rows) const;

  Id NumberOfOwnPoints() const { return numberOfOwnPoints_; }

  ///@{ What goes to a rank, ascending: own points, own triangles.
  const std::vector<Index>& PointsTo(int rank) const { return sentPoints_[rank]; }
  const std::vector<Index>& TrianglesTo(int rank) const { return sentTriangles_[rank]; }
  ///@}

  /// Of the points that ranks have sent here, one rank after the other: the places in the received
  /// mesh. Triangles come in the same order and stay in it.
  const std::vector<Index>& PlacesOfPoints() const { return pointPlace_; }

  /// Per received point the rank that has given it.
  std::vector<int> GiversOfPoints() const;

private:
  using Lists = std::vector<std::vector<Index>>; // one per rank

  void Route(const TriangleMesh& own, const Grid& grid, const BlockPartition& partition,
    const std::vector<MortonKey>* cells);
  void Receive(const TriangleMesh& own, const Grid& grid);
  MultiVector Send(
    const MultiVector& own, const Lists& sent, const std::vector<Index>& place) const;

  Communicator ranks_;
  Lists sentTriangles_; // own triangles that go to each rank, ascending
  Lists sentPoints_;    // own points of these, ascending
  Id numberOfOwnPoints_ = 0;
  Id numberOfOwnTriangles_ = 0;
  std::vector<Index> pointPlace_;    // in the received mesh, of received points rank after rank
  std::vector<Index> trianglePlace_; // the same for triangles
  std::vector<Id> receivedPoints_;   // from each rank
  std::vector<Id> receivedTriangles_;
  TriangleMesh mesh_;
};

} // namespace gridfem

#endif
