// The distance along a surface on several ranks from the nearest of some points.
// [Distance/GeodesicDistance.h]
#ifndef GridFEM_RankDistance_h
#define GridFEM_RankDistance_h

#include "Distance/GeodesicDistance.h"
#include "Parallel/RankHeat.h"

#include <memory>
#include <vector>

namespace gridfem
{

/// GeodesicDistance for several ranks, without estimated errors. Heat flows on the finest level, so
/// the smoothing has to be below MostSmoothing. All functions are collective.
class RankDistance : public DistanceMethod
{
public:
  /// Keeps a reference to the levels.
  /// @param mesh  this rank's own triangles
  /// Throws InvalidInput on all ranks for options out of range, RankFailure, and Aborted.
  RankDistance(const RankLevels& levels, std::shared_ptr<const TriangleMesh> mesh,
    const DistanceOptions& options, const Job& job = {});

  /// @param sources  points of this rank; if several lie in one place, one or all of them may be
  ///   listed
  /// @return         distance at this rank's points
  DistanceField From(
    const std::vector<Id>& sources, const SolveOptions& solve, const Job& job = {}) const override;

private:
  std::vector<char> MarkSources(const std::vector<Id>& sources) const;
  std::vector<double> StraightDistances(const std::vector<char>& isSource, int threads) const;
  MultiVector LoadOfDistance(const MultiVector& heat, const std::vector<char>& isSource) const;
  std::vector<double> ZeroesAt(const SparseMatrix& rows, const MultiVector& distance) const;

  const RankLevels& levels_;
  std::shared_ptr<const TriangleMesh> mesh_;
  DistanceOptions options_;
  Components components_;
  std::vector<Index> component_; // of every point
  std::unique_ptr<RankHeat> heat_;
  std::unique_ptr<Multigrid> poisson_; // of L
};

} // namespace gridfem

#endif
