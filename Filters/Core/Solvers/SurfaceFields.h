// Turns given fields and constraints into the integrals and rows of a surface. Collective on a
// shared surface.
#ifndef GridFEM_SurfaceFields_h
#define GridFEM_SurfaceFields_h

#include "Solvers/GivenField.h"
#include "Solvers/Surface.h"

#include <memory>

#include <string>
#include <vector>

namespace gridfem
{

/// The coordinates of a mesh; 0 at points that no triangle uses.
Field UsedCoordinates(const TriangleMesh& mesh);

/// Returns the field. Without one it returns the coordinates of the current mesh, which are 0 at
/// points that no triangle uses. Throws InvalidInput for values that are refused.
Field ReadField(const Surface& surface, const GivenField& field, NaNs nans = NaNs::Refused);

/// Returns an optional field, or null if it is not given.
std::unique_ptr<const Field> ReadOptional(const Surface& surface, const GivenField& field);

/// Returns a constant for each column whose values differ by less than 1e-5 of their size, and 0
/// for the others. Integrals of such a column would lose the digits of its variation. Subtracting
/// the constant rounds nothing. NaN does not count. Collective.
/// @param isUsed  the rows that count; empty: all
Eigen::RowVectorXd LargeConstants(
  const Surface& surface, const MultiVector& values, const std::vector<char>& isUsed = {});

/// Subtracts the large constants of a field, and returns them. Collective.
Eigen::RowVectorXd TakeConstantsOut(const Surface& surface, Field& field);

/// Throws InvalidInput if values on cells are to be held at points or on the boundary.
void RequireHoldable(
  const GivenField& values, const GivenConstraints& constraints, bool onBoundary);

/// Returns rows and values of the constraints; no rows if none are given. Throws InvalidInput if
/// constraints are given and no process knows a value.
/// @param values  the held field, for the message and the number of columns
HeldValues HoldConstraints(
  const Surface& surface, const GivenField& values, const GivenConstraints& constraints);

/// The number of components of a field, or of the coordinates.
inline Id ComponentsOf(const GivenField& values)
{
  return values ? values.components : 3;
}

} // namespace gridfem

#endif
