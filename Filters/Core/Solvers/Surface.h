// The interface that solvers use to a surface, whether one process holds it or several share it.
#ifndef GridFEM_Surface_h
#define GridFEM_Surface_h

#include "Equations/EdgeConditions.h"
#include "Solvers/Stages.h"
#include "Solvers/SurfaceOptions.h"

#include <functional>
#include <memory>

namespace gridfem
{

class DistanceMethod;
struct DistanceOptions;

/// The stages that all solvers have.
inline constexpr const char* MeshStage = "Mesh";     // of solvers that need no functions
inline constexpr const char* SpaceStage = "Space";   // mesh, clipping, patches, levels
inline constexpr const char* SystemStage = "System"; // element matrices, patterns, prolongations
inline constexpr const char* HierarchyStage = "Hierarchy";         // level matrices, smoothers
inline constexpr const char* RightHandSideStage = "RightHandSide"; // integrals of given fields
inline constexpr const char* SolveStage = "Solve";

/// A mesh with the functions on it. If several processes share the surface, all of them call the
/// methods marked as collective, in the same order. A body that can throw on one of them alone runs
/// within Together.
class Surface
{
public:
  virtual ~Surface() = default;

  /// Brings mesh, functions and element matrices up to date (SpaceStage, SystemStage). Repeated
  /// calls cost next to nothing. Collective. Throws InvalidInput and Aborted.
  virtual void Prepare(const Progress& progress) = 0;

  /// Prepares the surface in the same way, at a depth of the solver's choice.
  virtual void PrepareAtDepth(int depth, const Progress& progress) = 0;

  /// Brings only the mesh up to date (MeshStage), for a solver that needs no functions. Functions
  /// of an earlier run may be freed. Not on a shared surface. Throws InvalidInput and Aborted.
  virtual void PrepareMesh(const Progress& progress) = 0;

  /// The key of the mesh and of all requests to its functions, except their depth.
  virtual StageKey InputKey() const = 0;

  /// Whether the functions are given, so that the solver cannot choose their depth.
  virtual bool AreFunctionsGiven() const { return false; }

  /// The triangles that Prepare is going to work on, for the choice of a depth.
  virtual std::shared_ptr<const TriangleMesh> ReadMesh() const = 0;

  /// The stages of the surface and of the solver that works on it. A surface serves one solver: two
  /// would take each other's results for their own. Give another solver a surface of its own.
  Stages& GetStages() const { return stages_; }

  /// Changes when functions are added, removed or renumbered, so that a hierarchy cannot be
  /// updated.
  virtual std::int64_t StructureVersion() const = 0;

  /// The options, with the depth, the threads and the support that are in use.
  virtual const SurfaceOptions& UsedOptions() const = 0;

  int Threads() const { return this->UsedOptions().space.threads; }
  Job MakeJob(const Progress& progress) const { return { this->Threads(), progress }; }

  /// The triangles of this process on which the functions were made.
  virtual std::shared_ptr<const TriangleMesh> SharedMesh() const = 0;
  const TriangleMesh& Mesh() const { return *this->SharedMesh(); }

  /// The triangles of Mesh() at their moved places (TrackMetric). Without a motion it is Mesh().
  virtual const TriangleMesh& CurrentMesh() const { return this->Mesh(); }

  virtual std::shared_ptr<const SurfaceSpace> SharedSpace() const = 0;
  const SurfaceSpace& Space() const { return *this->SharedSpace(); }

  /// The space of a surface that one process holds. Solvers that ranks cannot run together use it;
  /// the surface is gathered for them. Throws std::logic_error on a shared surface.
  virtual std::shared_ptr<const FiniteElementSpace> WholeSpace() const = 0;

  /// Converts a gradient on the current mesh for integrals over Mesh().
  virtual Field OnReference(Field gradients) const { return gradients; }

  /// Whether coincident points of the mesh count as one.
  virtual bool AreCoincidentPointsWelded() const = 0;

  ///@{ Sizes in squared world units, and in world units.
  virtual double Area() const = 0;
  virtual double LongestSide() const = 0;
  ///@}

  /// Converts a weight from the parameter units to the units of the space, per squared unit of
  /// length.
  double WeightInSpaceUnits(double weight) const;

  /// Converts a length from the parameter units to world units.
  double LengthInWorldUnits(double length) const;

  ///@{ Collective.

  /// Whether several processes share the surface.
  virtual bool IsShared() const { return false; }

  /// Runs a body that may throw on some of the processes only. Then it throws on all.
  virtual void Together(const std::function<void()>& body) const { body(); }

  /// Throws InvalidInput if one process has less memory than it needs.
  virtual void Require(const MemoryNeed& own) const;

  /// Sums numbers that each process has a part of. Null if this process has all of them.
  virtual const DistributedRows* SumsOverProcesses() const { return nullptr; }

  /// The largest number of all processes. NaN if one is NaN.
  virtual double Largest(double own) const { return own; }

  /// Whether this process is the first process where a condition holds.
  virtual bool IsFirst(bool holds) const { return holds; }

  bool Any(bool holds) const { return this->Largest(holds ? 1.0 : 0.0) > 0.0; }

  /// Rows and values that hold a solution at points of this process, and along every edge between
  /// two of them (HoldPointsAndEdges).
  virtual HeldValues Hold(const std::vector<Id>& points, const MultiVector& values) const = 0;

  /// The terms that the boundary of the whole surface adds to an equation (TermsOnBoundary).
  virtual BoundaryTerms OnBoundary(const MultiVector* flux, const MultiVector* values) const = 0;

  /// Samples along the boundary of the whole surface, the part of this process. No rows without a
  /// boundary.
  /// @param ofNested  of the functions of Space().NestedLevels()
  virtual EdgeSamples SampleBoundary(bool ofNested) const = 0;

  /// Distances on this surface as it is now. Throws InvalidInput and Aborted.
  virtual std::unique_ptr<DistanceMethod> MakeDistance(
    const DistanceOptions& options, const Job& job) const;

  /// A flag for each point of this process: 1 if a function reaches it.
  virtual std::vector<char> PointsWithFunctions() const = 0;

  /// Gives copied points the rows of their originals.
  virtual void FillCopies(MultiVector& /*atPoints*/) const {}

  /// Makes rows NaN at points that no function reaches, the rule for results of all solvers, and
  /// gives copied points the rows of their originals.
  void CompleteAtPoints(MultiVector& atPoints) const;

  /// A solution at the points of this process, with a row for each. NaN where no function reaches.
  MultiVector ValuesAtPoints(const MultiVector& coefficients, const Progress& progress = {}) const;
  ///@}

protected:
  explicit Surface(Stages& stages) : stages_(stages) {}

private:
  Stages& stages_;
};

} // namespace gridfem

#endif
