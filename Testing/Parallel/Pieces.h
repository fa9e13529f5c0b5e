// Pieces of surfaces on the ranks, and comparison with the whole.
#ifndef GridFEM_Testing_Pieces_h
#define GridFEM_Testing_Pieces_h

#include "Parallel/RankSurface.h"
#include "Problems/Poisson.h"
#include "Problems/SurfaceDerivatives.h"
#include "Surfaces.h"

#include <memory>
#include <vector>

namespace gridfem::testing
{

/// With which few iterations lead to small tolerances.
RankSpaceOptions StableOptions();

/// The functions of a grid, or hats above them, as one process holds them.
std::unique_ptr<const FiniteElementSpace> WholeSpace(
  const TriangleMesh& mesh, const RankSpaceOptions& options, bool hasHats);

/// Three columns, which differ from point to point.
MultiVector VectorsAt(const std::vector<Vec3>& points);

/// One thread, and solutions to rounding.
EquationOptions Exactly();

/// (λM + L) u = f + div s with the gradient s of f, on one process or on ranks, from the load on.
/// @param f  at the points of the space
PoissonSolution SolveScreened(
  const SurfaceSpace& space, const MultiVector& f, const PoissonOptions& options);

/// A rank's part, the numbers of its points and triangles in the whole, and what it has of other
/// ranks.
struct Piece
{
  TriangleMesh mesh;
  std::vector<Id> points;
  std::vector<Id> triangles;
  TriangleList copies;
  std::vector<Id> originals; // of the copies, in the whole
};

/// @param withCopies  of the triangles that touch the part
Piece PieceOf(const TriangleMesh& mesh, Dealing dealing, bool withCopies);

/// Whether rows here are those of the whole, to 1e-8 of its largest number. What is not a number in
/// one is none in the other.
void ExpectRows(const char* name, const MultiVector& found, const MultiVector& whole,
  const std::vector<Id>& places, const std::vector<char>& isCompared = {});

} // namespace gridfem::testing

#endif
