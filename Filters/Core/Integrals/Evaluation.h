// Values and surface gradients of functions given by their coefficients. [T §4.2, Function
// Evaluation]
#ifndef GridFEM_Evaluation_h
#define GridFEM_Evaluation_h

#include "Algebra/SparseMatrix.h"
#include "Base/Job.h"
#include "Grid/GridFunctions.h"

namespace gridfem
{

/// Values at the input's points: rows = input points, columns as `coefficients`. Points that no
/// triangle uses get 0. Throws Aborted.
MultiVector EvaluateAtPoints(
  const GridFunctions& space, const MultiVector& coefficients, const Job& job = {});

/// Values at all points of the clipped mesh, input points first.
MultiVector EvaluateAtClippedPoints(
  const GridFunctions& space, const MultiVector& coefficients, int threads = 0);

/// The mean surface gradients on source triangles, world units: rows = triangles, three columns for
/// each of the coefficients'; 0 on triangles without an area. Same bits for any number of threads.
/// Throws Aborted.
MultiVector MeanGradients(
  const GridFunctions& space, Id triangles, const MultiVector& coefficients, const Job& job = {});

/// The areas of the pieces of source triangles, in squared units of the grid: one for each.
std::vector<double> AreasOfPieces(const GridFunctions& space, Id triangles);

/// The mean of ∇u / |∇u| instead, one direction for each piece; 0 where ∇u = 0.
MultiVector MeanDirections(
  const GridFunctions& space, Id triangles, const MultiVector& coefficients, const Job& job = {});

/// The values of all functions at input points: a row for each, empty for points that no triangle
/// uses. Throws InvalidInput for a point that does not exist.
SparseMatrix EvaluationRows(const GridFunctions& space, const std::vector<Id>& points);

/// The means over the finest patches of values on source triangles, weighted by area; 0 on patches
/// without an area.
MultiVector MeansOnPatches(
  const GridFunctions& space, const MultiVector& onTriangles, int threads = 0);

} // namespace gridfem

#endif
