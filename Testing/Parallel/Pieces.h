// Pieces of surfaces on the ranks, and comparisons with the whole surface.
#ifndef GridFEM_Testing_Pieces_h
#define GridFEM_Testing_Pieces_h

#include "Equations/Poisson.h"
#include "Parallel/RankSurface.h"
#include "Shape/SurfaceDerivatives.h"
#include "Surfaces.h"

#include <memory>
#include <vector>

namespace gridfem::testing
{

/// Options with which few iterations reach small tolerances.
RankSpaceOptions StableOptions();

/// The functions of a grid, or hats above them, in one process.
std::unique_ptr<const FiniteElementSpace> WholeSpace(
  const TriangleMesh& mesh, const RankSpaceOptions& options, bool hasHats);

/// Three columns that differ from point to point.
MultiVector VectorsAt(const std::vector<Vec3>& points);

/// One thread, and solutions to rounding.
EquationOptions Exactly();

/// Solves (λM + L) u = f + div s with the gradient s of f, on one process or on several ranks. It
/// starts from the load.
/// @param f  at the points of the space
PoissonSolution SolveScreened(
  const SurfaceSpace& space, const MultiVector& f, const PoissonOptions& options);

/// A rank's part of a surface, the numbers of its points and triangles in the whole, and its copies
/// of other ranks' triangles.
struct Piece
{
  TriangleMesh mesh;
  std::vector<Id> points;
  std::vector<Id> triangles;
  TriangleList copies;
  std::vector<Id> originals; // originals of the copies, in the whole
};

/// @param withCopies  whether the part has copies of the triangles that touch it
Piece PieceOf(const TriangleMesh& mesh, Dealing dealing, bool withCopies);

/// Expects that rows here equal the rows of the whole, to 1e-8 of its largest number. NaN has to be
/// at the same places.
void ExpectRows(const char* name, const MultiVector& found, const MultiVector& whole,
  const std::vector<Id>& places, const std::vector<char>& isCompared = {});

} // namespace gridfem::testing

#endif
