// Evaluates functions given by their coefficients, and their surface gradients. [T §4.2, Function
// Evaluation]
#ifndef GridFEM_Evaluation_h
#define GridFEM_Evaluation_h

#include "Algebra/SparseMatrix.h"
#include "Base/Job.h"
#include "Grid/GridFunctions.h"

namespace gridfem
{

/// Returns values at the input's points: rows = input points, columns as `coefficients`. Points
/// that no triangle uses get 0. Throws Aborted.
/// @param level  functions on the finest patches of the space
template<int Functions>
MultiVector EvaluateAtPoints(const GridFunctions& space, const BasicPatchLevel<Functions>& level,
  const MultiVector& coefficients, const Job& job = {});
inline MultiVector EvaluateAtPoints(
  const GridFunctions& space, const MultiVector& coefficients, const Job& job = {})
{
  return EvaluateAtPoints(space, space.Finest(), coefficients, job);
}

/// Returns values at all points of the clipped mesh, input points first.
MultiVector EvaluateAtClippedPoints(
  const GridFunctions& space, const MultiVector& coefficients, int threads = 0);

/// Returns the mean surface gradients on source triangles, in world units: rows = triangles, three
/// columns for each column of `coefficients`. Triangles without area get 0. Same bits for any
/// number of threads. Throws Aborted.
template<int Functions>
MultiVector MeanGradients(const GridFunctions& space, const BasicPatchLevel<Functions>& level,
  Id triangles, const MultiVector& coefficients, const Job& job = {});
inline MultiVector MeanGradients(
  const GridFunctions& space, Id triangles, const MultiVector& coefficients, const Job& job = {})
{
  return MeanGradients(space, space.Finest(), triangles, coefficients, job);
}

/// Returns, for each source triangle, the area of its pieces in squared grid units.
std::vector<double> AreasOfPieces(const GridFunctions& space, Id triangles);

/// Returns the means of ∇u / |∇u| like MeanGradients, with one direction per piece; 0 where ∇u = 0.
MultiVector MeanDirections(
  const GridFunctions& space, Id triangles, const MultiVector& coefficients, const Job& job = {});

/// Returns the values of all functions at input points, one row per point. Rows of points that no
/// triangle uses are empty. Throws InvalidInput for a point that does not exist.
template<int Functions>
SparseMatrix EvaluationRows(const GridFunctions& space, const BasicPatchLevel<Functions>& level,
  const std::vector<Id>& points);

/// Returns the area-weighted mean of values on source triangles over each finest patch. Patches
/// without area get 0.
MultiVector MeansOnPatches(
  const GridFunctions& space, const MultiVector& onTriangles, int threads = 0);

} // namespace gridfem

#endif
