// Values and surface gradients of functions given by their coefficients. [T §4.2, Function
// Evaluation]
#ifndef GridFEM_Evaluation_h
#define GridFEM_Evaluation_h

#include "Grid/GridFunctions.h"

namespace gridfem
{

/// Values at the input's points: rows = input points, columns as `coefficients`. Points that no
/// triangle uses get 0.
MultiVector EvaluateAtPoints(
  const GridFunctions& space, const MultiVector& coefficients, int threads = 0);

/// Values at all points of the clipped mesh, input points first.
MultiVector EvaluateAtClippedPoints(
  const GridFunctions& space, const MultiVector& coefficients, int threads = 0);

/// Value at a point (grid units) of a patch of the finest level.
Eigen::RowVectorXd EvaluateInPatch(
  const GridFunctions& space, Id patch, const Vec3& position, const MultiVector& coefficients);

/// Surface gradient (world units) at a point (grid units) of a piece: one column per function.
/// The normal is that of the piece; a piece without area gives zero.
Eigen::Matrix3Xd EvaluateGradientInPiece(
  const GridFunctions& space, Id piece, const Vec3& position, const MultiVector& coefficients);

} // namespace gridfem

#endif
