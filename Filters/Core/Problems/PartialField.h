// Fields of which not every value is known or counts the same. [DESIGN §3] Where processes hold the
// surface together, each splits the field on its own mesh.
#ifndef GridFEM_PartialField_h
#define GridFEM_PartialField_h

#include "Grid/TriangleMesh.h"
#include "Spaces/SurfaceSpace.h"

namespace gridfem
{

struct PartialField
{
  Field values;                 // 0 where unknown
  std::vector<double> weight;   // per triangle; 0 on those with an unknown value
  std::vector<char> isKnown;    // per triangle: no value is unknown
  std::vector<char> hasValue;   // per row of the values: it is known
  Id numberOfIgnoredPoints = 0; // CountIgnoredPoints, where somebody wants to know
};

/// A row with a NaN is unknown, and so is a triangle with a corner that is.
/// @param weight  one column, of the values: 0 or more; on points its mean over a triangle counts.
///                Null: 1
/// Throws InvalidInput when rows or columns do not fit, or a weight is negative or not finite.
PartialField SplitField(Field field, const Field* weight, const TriangleMesh& mesh);

/// Known points all of whose triangles have an unknown value: they do not count. Of all processes,
/// which call it together.
Id CountIgnoredPoints(
  const SurfaceSpace& space, const PartialField& field, const TriangleMesh& mesh);

/// One column for each triangle: 0 where a value is unknown, else 1 or the mean of
/// `scale`: what gradients of the field count.
Field ScaleOfKnown(const PartialField& field, const Field* scale, const TriangleMesh& mesh);

/// Per component of the functions the mean of the field over what is known there, whatever its
/// weight; NaN where nothing is.
MultiVector MeansOfKnown(const SurfaceSpace& space, const PartialField& field, const Job& job = {});

} // namespace gridfem

#endif
