// Fields with unknown or weighted values. [DESIGN §3] If several processes hold the surface, each
// splits the field on its own mesh.
#ifndef GridFEM_PartialField_h
#define GridFEM_PartialField_h

#include "Grid/TriangleMesh.h"
#include "Spaces/SurfaceSpace.h"

#include <optional>

namespace gridfem
{

struct PartialField
{
  Field values; // 0 where unknown
  /// The values that the weights multiply, where LeaveOutWeightless has changed them.
  std::optional<Field> counted;
  std::vector<double> weight;   // per triangle; 0 if it has an unknown value
  std::vector<char> isKnown;    // per triangle: none of its values is unknown
  std::vector<char> hasValue;   // per row of the values: the value is known
  Id numberOfIgnoredPoints = 0; // CountIgnoredPoints; set by callers that need it
};

/// Marks the unknown values of a field. A row with a NaN is unknown, and so is a triangle with an
/// unknown corner.
/// @param weight  one column of weights of the values: 0 or more. Weights on points act by their
///   mean over a triangle. Null: 1
/// Throws InvalidInput when rows or columns do not fit, or a weight is negative or not finite.
PartialField SplitField(Field field, const Field* weight, const TriangleMesh& mesh);

/// Leaves out the values at points of weight 0, which may be anything. A triangle with such a
/// corner gets the weight 0 if each of its other points has a triangle without one. Otherwise the
/// mean of its weighted corners replaces the value of the others, so that single weighted points
/// count. Does nothing unless values and weights are on points. Collective.
/// @param weight  as in SplitField
void LeaveOutWeightless(
  const SurfaceSpace& space, const Field& weight, const TriangleMesh& mesh, PartialField& field);

/// Number of known points without effect, because each of their triangles has an unknown value.
/// Collective: the number over all processes.
Id CountIgnoredPoints(
  const SurfaceSpace& space, const PartialField& field, const TriangleMesh& mesh);

/// The factor of the field's gradient on each triangle, one column: 0 if a value is unknown, else 1
/// or the mean of `scale`.
Field ScaleOfKnown(const PartialField& field, const Field* scale, const TriangleMesh& mesh);

/// Mean of the field over the known part of each component of the functions, regardless of the
/// weights. NaN on components without known values.
MultiVector MeansOfKnown(const SurfaceSpace& space, const PartialField& field, const Job& job = {});

} // namespace gridfem

#endif
