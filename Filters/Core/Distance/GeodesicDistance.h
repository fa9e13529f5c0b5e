// The distance along the surface from the nearest of some points, by the heat method. Heat spreads
// from the sources for a short time, and its gradient gives the directions X. The distance is the
// function whose gradient is nearest to X. Crane, Weischedel, Wardetzky: Geodesics in Heat, 2013.
#ifndef GridFEM_GeodesicDistance_h
#define GridFEM_GeodesicDistance_h

#include "Distance/DistantHeat.h"
#include "Distance/SurfaceCurve.h"
#include "Equations/SolutionAccuracy.h"
#include "Grid/TriangleMesh.h"
#include "Krylov/ConjugateGradients.h"
#include "Spaces/FiniteElementSpace.h"

#include <array>
#include <memory>
#include <vector>

namespace gridfem
{

struct DistanceOptions
{
  /// With a smaller smoothing the heat oscillates, and distances may be wrong by half their range.
  static constexpr double LeastSmoothing = 0.9;

  /// With a smaller normal stabilization of the grid the heat oscillates, too: at sharp edges,
  /// functions that are almost zero on the surface let it change its sign.
  static constexpr double LeastStabilization = 0.1;

  /// sqrt(t) over the mean distance between functions that overlap, which is 1.2 cells. A larger
  /// value takes more time. It also rounds off the distance where fronts meet and between near
  /// sources, by about sqrt(t) / 2.
  double smoothing = 1.2;
  MultigridOptions multigrid;
  bool estimateErrors = false; // of every distance; takes a sixth to two fifths more time
  double heatChange = DistantHeat::SmallChange; // accuracy of the heat
};

struct DistanceField
{
  /// Distance of each point of the mesh, world units. It is 0 at sources. Elsewhere it is at least
  /// the straight distance through space from the sources; inside a curve it is at most the
  /// negative of that. NaN if no function reaches the point or its component has no source.
  std::vector<double> atPoints;
  SolveReport report; // not converged if the heat was not, or functions are unreached
  bool heatConverged = false;
  double heatSweeps = 0.0; // see HeatField
  Id unreached = 0;        // functions too far for any heat; their distances are wrong
  /// The heat is negative at a point, so that its direction may be wrong around and behind it.
  bool heatOscillates = false;
  /// Unknown unless it was asked for. It compares with the distance on functions twice as far from
  /// each other. On real meshes it is within a factor of four, mostly of two. The largest error is
  /// in world units. Trusted if heat reached every function, converged, and oscillates nowhere.
  SolutionAccuracy accuracy;
};

/// What is known about every point of the mesh before its distance is computed.
struct SourceMarks
{
  std::vector<char> isSource;
  std::vector<double> straight; // distance through space from the sources; no path is shorter
};

/// A method to find distances from points.
class DistanceMethod
{
public:
  virtual ~DistanceMethod() = default;

  virtual DistanceField From(
    const std::vector<Id>& sources, const SolveOptions& solve, const Job& job = {}) const = 0;

  /// Throws std::logic_error unless one process holds the surface.
  virtual DistanceField FromCurve(
    const SurfaceCurve& curve, const SolveOptions& solve, const Job& job = {}) const;
};

/// Distance by the heat method: (M + t L) u = Σ b_i(source), X = -∇u / |∇u|, L φ = ∫ <X, ∇b_i>.
/// Then φ is shifted so that its mean over the sources of each component is 0. Everything but the
/// sources is kept, so a change of the sources repeats only the solves. Heat flows on the nested
/// levels of a space that has such levels. Hats above them may be slivers, or much farther from
/// each other than t allows. Distances are exact to the size of a few functions where a single
/// front arrives. Errors are sqrt(t) / 2 to sqrt(t) where fronts meet, and within sqrt(t) of
/// boundaries.
class GeodesicDistance : public DistanceMethod
{
public:
  /// @param mesh  the mesh that the space was made from
  /// Throws InvalidInput when the smoothing is not a positive number, and Aborted.
  GeodesicDistance(std::shared_ptr<const FiniteElementSpace> space,
    std::shared_ptr<const TriangleMesh> mesh, const DistanceOptions& options, const Job& job = {});

  /// @param sources  points of the mesh. A point that no function reaches has no effect. A triangle
  ///   whose corners are all sources belongs to a source as a whole.
  /// @param solve    of the distance from its gradient
  /// Throws InvalidInput when there are no sources or a source is not a point, and Aborted. Same
  /// bits for any number of threads.
  DistanceField From(
    const std::vector<Id>& sources, const SolveOptions& solve, const Job& job = {}) const override;

  /// The distance from a curve, negative inside: L φ = ∫ <X, ∇b_i>. X points away from the curve
  /// outside and toward it inside, so φ has no crease at the curve.
  /// Near the curve X is the gradient of the distance through space (DistancesNear). The result
  /// also blends into this distance, increasingly toward the curve. Farther away the direction
  /// comes from heat that starts everywhere on the curve. φ is shifted so that its mean over the
  /// curve is 0 on each component.
  /// Close to the curve the error is the error of linear functions on the triangles. Farther away
  /// it is the error of From. Throws InvalidInput when the curve is not of this mesh, and Aborted.
  /// Same bits for any number of threads.
  DistanceField FromCurve(
    const SurfaceCurve& curve, const SolveOptions& solve, const Job& job = {}) const override;

  /// t, in squared units of length of the space.
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
  std::vector<double> ShiftedToSources(const MultiVector& distance, const std::vector<Id>& sources,
    const SourceMarks& marks, const Job& job) const;
  std::vector<double> ZeroesOnCurve(const MultiVector& distance, const SurfaceCurve& curve) const;
  std::vector<double> ShiftedToCurve(const MultiVector& distance, const SurfaceCurve& curve,
    const std::vector<double>& near, double reach, const std::vector<double>& straight,
    const Job& job) const;

  std::shared_ptr<const FiniteElementSpace> space_;
  std::shared_ptr<const TriangleMesh> mesh_;
  DistanceOptions options_;
  std::vector<Index> component_; // of every point; -1 if no function reaches it
  double time_ = 0.0;
  std::unique_ptr<DistantHeat> heat_;
  std::unique_ptr<DistantHeat> coarserHeat_; // null: errors are not estimated
  std::unique_ptr<Multigrid> poisson_;       // of L
};

///@{ Steps shared with the distance on several processes, which take them on their own parts.

/// With a smoothing below this value heat flows on the finest level.
constexpr double MostSmoothing = 3.5;

/// Σ w d² and Σ w over pairs of functions, where w is their overlap and d their distance. The root
/// of the quotient is the mean spacing.
std::array<double, 2> SpacingSums(const SparseMatrix& mass, const MultiVector& place);

/// The factor of the heat's direction on each triangle: -1, or 0 if all corners are sources.
Field AwayFromSources(const TriangleMesh& mesh, const std::vector<char>& isSource);

/// Whether heat is negative at a point. Exact heat never is.
bool IsNegativeAnywhere(const MultiVector& heatAtPoints);

/// Shifts values at points to a distance: 0 at sources, elsewhere at least the straight distance.
/// @param component  of every point; -1 if no function reaches it
/// @param zero       the value on each component that becomes 0; NaN if it has no source
std::vector<double> ShiftedToZero(const MultiVector& value, const std::vector<Index>& component,
  const std::vector<double>& zero, const SourceMarks& marks);
///@}

} // namespace gridfem

#endif
