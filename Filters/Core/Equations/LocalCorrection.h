// Meets the given values of a harmonic interpolation at every point, and keeps it between them.
#ifndef GridFEM_LocalCorrection_h
#define GridFEM_LocalCorrection_h

#include "Base/Job.h"
#include "Spaces/HatFunctions.h"

#include <vector>

namespace gridfem
{

/// Corrects a harmonic interpolation at the points of a mesh where the functions are too coarse for
/// it. Like a harmonic function, the corrected values have the given values, and lie between the
/// least and the largest given value of their connected component.
class LocalCorrection
{
public:
  /// @param mesh    has to outlive this object
  /// @param points  with a given value; if several share a place, their mean counts
  /// @param values  a row for each of the points
  LocalCorrection(const TriangleMesh& mesh, bool weldCoincidentPoints,
    const std::vector<Id>& points, const MultiVector& values, int threads = 0);

  /// The points without a given value whose own value leaves the range by more than this share of
  /// the range.
  std::vector<Id> PointsBeyond(const MultiVector& atPoints, double share) const;

  /// A point needs a correction where its value leaves the range, or differs from its given value,
  /// by more than 0.1 % of the range. The values within `reach` of it become harmonic on the mesh.
  /// Each is then the mean of its neighbors with the cotangent weights of the mesh; negative
  /// weights count as small positive ones. At all other points, a given value replaces the computed
  /// value, and values beyond the range become the end of the range.
  /// @param reach     along edges, in world units: the size of the functions
  /// @param atPoints  the interpolation, with a row for each point of the mesh; NaN stays
  /// Cost O(points), and a factorization for the points that need a correction
  /// (SparseCholesky). Same bits for any number of threads. Throws Aborted.
  void Apply(double reach, MultiVector& atPoints, const Job& job = {}) const;

private:
  void TakeGiven(const std::vector<Id>& points, const MultiVector& values);
  void FindRanges();
  MultiVector OfHats(const MultiVector& atPoints) const;
  std::vector<Index> Clamp(MultiVector& values) const;
  std::vector<Index> Around(const std::vector<Index>& some, double reach) const;
  void MakeHarmonic(const std::vector<Index>& some, MultiVector& values, const Job& job) const;

  const TriangleMesh& mesh_;
  HatFunctions hats_;
  std::vector<Id> place_;     // a point of each hat
  std::vector<char> isGiven_; // whether a hat has a given value
  MultiVector given_;         // of each hat
  MultiVector low_;           // of each component
  MultiVector high_;
};

} // namespace gridfem

#endif
