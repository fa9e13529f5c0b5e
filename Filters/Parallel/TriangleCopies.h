// Triangles that a rank has as copies of another rank's, such as those of ghost cells: they are not
// integrated, and get the values of the originals.
#ifndef GridFEM_TriangleCopies_h
#define GridFEM_TriangleCopies_h

#include "Parallel/Redistribution.h"

#include <array>
#include <vector>

namespace gridfem
{

using TriangleList = std::vector<std::array<Id, 3>>;

/// An original is the triangle of another rank with the same corners in the same order, bit for
/// bit. Whoever clips near a triangle has received the original, and answers for it.
class TriangleCopies
{
public:
  /// Collective.
  /// @param own       this rank's triangles
  /// @param copies    further ones, of the same points
  /// @param received  what this rank has received of all ranks' own triangles
  TriangleCopies(const Communicator& ranks, const TriangleMesh& own, const TriangleList& copies,
    const Grid& grid, const BlockPartition& partition, const TriangleMesh& received);

  /// Collective. Rows of points that only copies use become those of the originals' points; NaN
  /// where no rank has the original.
  /// @param atPoints  rows of this rank's points; the same columns on all ranks
  void FillPoints(const Redistribution& distribution, MultiVector& atPoints) const;

  /// Collective. The rows of the originals: one for each copy, NaN where no rank has it.
  /// @param onTriangles  rows of this rank's own triangles; the same columns on all ranks
  MultiVector RowsOfOriginals(
    const Redistribution& distribution, const MultiVector& onTriangles) const;

  /// Per point of this rank: whether only copies use it.
  const std::vector<char>& IsCopied() const { return isCopied_; }

private:
  using Corners = std::array<double, 9>;

  void Find(const std::vector<std::vector<Corners>>& asked, const TriangleMesh& received);
  template<class RowsOf>
  std::vector<std::vector<double>> Answers(
    const MultiVector& rows, int rowsEach, RowsOf&& rowsOf) const;

  Communicator ranks_;
  bool areThere_ = false; // on any rank
  TriangleList copies_;
  std::vector<char> isCopied_;
  std::vector<std::vector<Index>> asked_; // copies, by the rank that answers for them
  std::vector<std::vector<Index>> found_; // received triangles that others ask for; -1: none
  TriangleList corners_;                  // of the received triangles
};

} // namespace gridfem

#endif
