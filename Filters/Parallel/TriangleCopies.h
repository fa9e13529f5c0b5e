// Triangles of a rank that are copies of another rank's triangles, such as ghost cells. They are
// not integrated, and get the values of the originals.
#ifndef GridFEM_TriangleCopies_h
#define GridFEM_TriangleCopies_h

#include "Parallel/Redistribution.h"

#include <array>
#include <vector>

namespace gridfem
{

using TriangleList = std::vector<std::array<Id, 3>>;

/// Finds the originals of copies. An original is the triangle of another rank with the same corners
/// in the same order, bit for bit. Every rank that clips near a triangle has received the original;
/// one of them answers for it.
class TriangleCopies
{
public:
  /// Collective.
  /// @param own       this rank's triangles
  /// @param copies    additional triangles of the same points
  /// @param received  the triangles that this rank has received from all ranks
  TriangleCopies(const Communicator& ranks, const TriangleMesh& own, const TriangleList& copies,
    const Grid& grid, const BlockPartition& partition, const TriangleMesh& received);

  /// Collective. Fills rows of points that only copies use with the rows of the originals' points;
  /// NaN if no rank has the original.
  /// @param atPoints  rows of this rank's points; the same columns on all ranks
  void FillPoints(const Redistribution& distribution, MultiVector& atPoints) const;

  /// Collective. The rows of the originals: one for each copy, NaN if no rank has the original.
  /// @param onTriangles  rows of this rank's own triangles; the same columns on all ranks
  MultiVector RowsOfOriginals(
    const Redistribution& distribution, const MultiVector& onTriangles) const;

private:
  using Corners = std::array<double, 9>;

  void Find(const std::vector<std::vector<Corners>>& asked, const TriangleMesh& received);
  template<class RowsOf>
  std::vector<std::vector<double>> Answers(
    const MultiVector& rows, int rowsEach, RowsOf&& rowsOf) const;

  Communicator ranks_;
  bool areThere_ = false; // whether any rank has copies
  TriangleList copies_;
  std::vector<char> isCopied_;
  std::vector<std::vector<Index>> asked_; // copies, by the rank that answers for them
  std::vector<std::vector<Index>> found_; // received triangles that other ranks ask for; -1: none
  TriangleList corners_;                  // of the received triangles
};

} // namespace gridfem

#endif
