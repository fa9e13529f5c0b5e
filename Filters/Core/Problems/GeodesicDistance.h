// The distance along the surface from the nearest of some points, by the heat method: heat spreads
// from the sources for a short time, its gradient gives the directions X, and the distance is the
// function whose gradient is nearest to them. Crane, Weischedel, Wardetzky: Geodesics in Heat,
// 2013.
#ifndef GridFEM_GeodesicDistance_h
#define GridFEM_GeodesicDistance_h

#include "Grid/TriangleMesh.h"
#include "Krylov/ConjugateGradients.h"
#include "Problems/DistantHeat.h"
#include "Problems/SolutionAccuracy.h"
#include "Problems/SurfaceCurve.h"
#include "Spaces/FiniteElementSpace.h"

#include <array>
#include <memory>
#include <vector>

namespace gridfem
{

struct DistanceOptions
{
  /// sqrt(t) over the mean distance between functions that overlap, which is 1.2 cells. With much
  /// less the heat of discrete functions oscillates; more rounds off where fronts meet and where
  /// sources are near to each other, by about sqrt(t) / 2, and takes more time.
  double smoothing = 1.75;
  MultigridOptions multigrid;
  bool estimateErrors = false; // of every distance, for a sixth to two fifths more time
  double heatChange = DistantHeat::SmallChange; // how exact the heat is
};

struct DistanceField
{
  /// Per point of the mesh, world units: 0 at sources, at least 0 elsewhere, but for the inside of
  /// a curve, where it is at most 0; NaN where no function reaches or the component has no source.
  std::vector<double> atPoints;
  SolveReport report; // of the distance; not converged if the heat was not
  bool heatConverged = false;
  double heatSweeps = 0.0; // see HeatField
  Id unreached = 0;        // functions that are too far for numbers: their distances are wrong
  /// Unknown unless it was wanted. From the distance on functions twice as far from each other;
  /// within a factor of four on real meshes, mostly of two. The largest error is in world units.
  /// Trusted where all heat came and converged.
  SolutionAccuracy accuracy;
};

/// How distances from points are found.
class DistanceMethod
{
public:
  virtual ~DistanceMethod() = default;

  virtual DistanceField From(
    const std::vector<Id>& sources, const SolveOptions& solve, const Job& job = {}) const = 0;
};

/// (M + t L) u = Σ b_i(source), X = -∇u / |∇u|, L φ = ∫ <X, ∇b_i>, and φ is shifted so that its
/// mean over the sources of a component is 0. All but the sources is kept, so that other sources
/// cost the solves alone. The heat flows on the nested levels of a space that has such: hats on
/// them may be slivers, or much farther from each other than t allows. Distances are exact to the
/// size of a few functions where one front comes; where fronts meet, and within sqrt(t) of
/// boundaries, errors are sqrt(t) / 2 to sqrt(t).
class GeodesicDistance : public DistanceMethod
{
public:
  /// @param mesh  what the space was made from
  /// Throws InvalidInput when the smoothing is not a positive number, and Aborted.
  GeodesicDistance(std::shared_ptr<const FiniteElementSpace> space,
    std::shared_ptr<const TriangleMesh> mesh, const DistanceOptions& options, const Job& job = {});

  /// @param sources  points of the mesh; one that no function reaches is the source of nothing. A
  ///   triangle whose corners are all sources belongs to a source as a whole.
  /// @param solve  of the distance from its gradient
  /// Throws InvalidInput when there is none or one is no point, and Aborted. Same bits for any
  /// number of threads.
  DistanceField From(
    const std::vector<Id>& sources, const SolveOptions& solve, const Job& job = {}) const override;

  /// The distance from a curve, negative inside: L φ = ∫ <X, ∇b_i>, where X points away from the
  /// curve outside and towards it inside, so that φ has no crease there. Near the curve X is the
  /// gradient of the distance through space (DistancesNear), and so is the result, the more the
  /// nearer; farther off heat that starts everywhere on the curve gives the direction. φ is shifted
  /// so that its mean over the curve is 0 on each component. Close to the curve the error is that
  /// of linear functions on the triangles, farther off that of From.
  /// Throws InvalidInput when the curve is not of this mesh, and Aborted. Same bits for any number
  /// of threads.
  DistanceField FromCurve(
    const SurfaceCurve& curve, const SolveOptions& solve, const Job& job = {}) const;

  /// t, squared units of length of the space.
  double Time() const { return time_; }

private:
  MultiVector LoadOfDistance(
    const MultiVector& heat, const std::vector<char>& isSource, const Job& job) const;
  MultiVector LoadOfSignedDistance(const MultiVector& heat, const SurfaceCurve& curve,
    const std::vector<double>& near, const Job& job) const;
  MultiVector Solve(const MultiVector& load, const SolveOptions& solve, DistanceField& field,
    const Progress& progress) const;
  struct Sources;
  DistanceField FromAll(const Sources& sources, const SolveOptions& solve, const Job& job) const;
  void EstimateErrors(const Sources& sources, DistanceField& field, const Job& job) const;
  std::vector<double> ShiftedToSources(
    const MultiVector& distance, const std::vector<Id>& sources, const Job& job) const;
  std::vector<double> ZeroesOnCurve(const MultiVector& distance, const SurfaceCurve& curve) const;
  std::vector<double> ShiftedToCurve(const MultiVector& distance, const SurfaceCurve& curve,
    const std::vector<double>& near, const Job& job) const;

  std::shared_ptr<const FiniteElementSpace> space_;
  std::shared_ptr<const TriangleMesh> mesh_;
  DistanceOptions options_;
  std::vector<Index> component_; // of every point; -1 where no function reaches
  double time_ = 0.0;
  std::unique_ptr<DistantHeat> heat_;
  std::unique_ptr<DistantHeat> coarserHeat_; // null: no errors are estimated
  std::unique_ptr<Multigrid> poisson_;       // of L
};

///@{ Steps that processes which hold the surface together take as well, each on its own part.

/// With a smoothing below this heat flows on the finest level.
constexpr double MostSmoothing = 3.5; // twice the default

/// Σ w d² and Σ w over pairs of functions: w is their overlap, d how far they are from each other.
/// The root of the quotient is the mean spacing.
std::array<double, 2> SpacingSums(const SparseMatrix& mass, const MultiVector& place);

/// -1 on triangles, what the direction of the heat counts; 0 on those whose corners are all
/// sources.
Field AwayFromSources(const TriangleMesh& mesh, const std::vector<char>& isSource);

/// A distance at points from its values there: 0 at sources, elsewhere at least 0.
/// @param component  of every point; -1 where no function reaches
/// @param zero       what is 0 on each component; NaN where it has no source
std::vector<double> ShiftedToZero(const MultiVector& value, const std::vector<Index>& component,
  const std::vector<double>& zero, const std::vector<char>& isSource);
///@}

} // namespace gridfem

#endif
