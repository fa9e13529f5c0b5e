// What a filter keeps between runs: its input mesh, function space and system, and the stages that
// made them.
#ifndef GridFEM_SurfaceSolverState_h
#define GridFEM_SurfaceSolverState_h

#include "DistributedSurface.h"
#include "InputArray.h"
#include "InputMesh.h"
#include "Krylov/ConjugateGradients.h"
#include "MeshVersion.h"
#include "Problems/EdgeConditions.h"
#include "Problems/Poisson.h"
#include "Problems/Requirements.h"
#include "ProgressBridge.h"
#include "StageCache.h"
#include "SurfaceBasis.h"
#include "TrackedMesh.h"

class vtkPolyData;

namespace gridfem
{

/// The shared properties in Core's terms.
struct SurfaceOptions : EquationOptions
{
  SpaceOptions space;
  SpaceChoice choice;                              // on the basis
  double functionsPerPoint = EnoughToPrecondition; // of the grid below hat functions, at most
  int parameterUnits = 1;                          // vtkSurfaceFEMAlgorithm::ParameterUnitsType
  bool trackMetric = false; // of a mesh that has only moved since its functions were made
};

/// The stages that filters have in common.
inline constexpr const char* SpaceStage = "Space";   // mesh, clipping, patches, levels
inline constexpr const char* SystemStage = "System"; // element matrices, patterns, prolongations
inline constexpr const char* HierarchyStage = "Hierarchy";         // level matrices, smoothers
inline constexpr const char* RightHandSideStage = "RightHandSide"; // integrals of given arrays
inline constexpr const char* SolveStage = "Solve";

/// Adds all that the triangles of the mesh depend on; never the vtkPolyData itself, which is a new
/// one after every hop through ParaView.
void AddMesh(StageKey& key, vtkPolyData* data);

/// Adds what a hierarchy depends on besides its matrices.
void AddMultigrid(StageKey& key, const MultigridOptions& options);

/// Adds what a solution depends on besides its equation.
void AddSolver(StageKey& key, const SurfaceOptions& options);

/// Adds the arrays of the clip.
void AddClipArrays(StageKey& key, vtkPolyData* data);

/// Adds the arrays of the clip and of the basis.
void AddBasisArrays(StageKey& key, vtkPolyData* data);

class SurfaceSolverState
{
public:
  explicit SurfaceSolverState(vtkAlgorithm* algorithm) : bridge(algorithm) {}

  /// Brings the mesh and the function space up to date: from `input` where it carries a basis, else
  /// from `basisData` where it is not null, else built. With trackMetric they stay where only
  /// points have moved, and UpdateSystem gives them the metric of the moved surface. Throws
  /// InvalidInput and Aborted.
  void UpdateSpace(vtkPolyData* input, vtkPolyData* basisData, const Progress& progress);

  /// Replaces the depth that is asked for by the one for `mesh`.
  void ChooseDepth();

  /// Builds the function space of a mesh and clips it before. Validates the mesh.
  void BuildSpace(vtkPolyData* input, const Progress& progress);

  /// Brings the finite element space up to date, in the metric of `metricArray`. One in that of the
  /// mesh that another filter has built on the same basis is taken over without a run.
  void UpdateSystem(const Progress& progress);

  ///@{ On several MPI ranks that compute together. Collective; the words of DistributedSurface
  /// hold here, too.

  /// Runs a body with stages that run on all ranks where they have to on one.
  void RunTogether(const DistributedSurface::Body& body);

  /// As UpdateSpace and UpdateSystem, on the pieces of all ranks. Of a basis the grid counts, and
  /// the cells where the piece carries it: on the same surface that gives the same functions.
  /// @param piece, basisData  may be null
  void UpdateTogether(vtkPolyData* piece, vtkPolyData* basisData);

  /// The same with the functions that the properties ask for.
  /// @param isClipped  the pieces are parts of a clip, whose grid and cells are taken
  /// @param release    called before another space is made: lets go what holds the one that was
  void BuildTogether(
    vtkPolyData* piece, bool isClipped, const std::function<void()>& release = [] {});
  ///@}

  ///@{ What solvers ask of the space, be it that of one process or of ranks together: then
  /// collective, but for SolverSpace.
  std::shared_ptr<const SurfaceSpace> SolverSpace() const;
  /// Runs what can throw on one rank alone.
  void Together(const std::function<void()>& body) const;
  Field Read(const InputArray& array, NaNs nans = NaNs::Refused) const;
  HeldValues Hold(const std::vector<Id>& points, const MultiVector& values) const;
  /// The known values of an array where a mask or a selection is given, else none (KnownValues).
  /// @param components  of the values
  HeldValues HoldKnown(const InputArray& array, const InputArray& mask,
    const SelectedPoints& selection, Id components) const;
  BoundaryTerms OnBoundary(const MultiVector* flux, const MultiVector* values) const;
  MultiVector ValuesAtPoints(const MultiVector& coefficients, const Progress& progress = {}) const;
  std::vector<char> PointsWithFunctions() const;
  /// Of rows at points that the space has given.
  void FillCopies(MultiVector& atPoints) const;
  /// Of values on the triangles of `mesh`.
  MultiVector MeansOnCells(const MultiVector& onTriangles, Id cells) const;
  ///@}

  /// Changes when more of the space does than its numbers: a hierarchy of another one cannot be
  /// updated.
  std::int64_t StructureVersion() const { return structure_; }

  /// The mesh of the input: `mesh`, or where that has moved to.
  const InputMesh& CurrentMesh() const;

  /// A gradient that is given on the current mesh, for integrals over `mesh`.
  Field OnReference(Field gradients) const;

  /// Gradients on the triangles of `mesh`, on those of the current one.
  MultiVector OnCurrent(MultiVector gradients) const;

  /// Adds what trackMetric has done to the field arrays of an output.
  void WriteTracking(vtkPolyData* output) const;

  /// Frees all that the stages have made.
  void Free();

  Job MakeJob(const Progress& progress) const { return { options.space.threads, progress }; }

  /// The functions of the grid.
  const GridFunctions& Functions() const { return *basis.space; }

  /// A weight per squared length of the parameter units, per squared grid unit.
  double WeightInGridUnits(double weight) const;

  /// A length in the parameter units, in the world's.
  double LengthInWorldUnits(double length) const;

  SurfaceOptions options;
  InputArray metricArray; // of the input; none: the metric of the mesh
  StageCache stages;
  InputMesh mesh;
  MeshVersion meshVersion; // of `mesh`
  SurfaceBasis basis;
  std::shared_ptr<const FiniteElementSpace> space;
  DistributedSurface together; // in use in place of `basis` and `space`
  ProgressBridge bridge;

private:
  std::vector<double> TakeBasisTogether(vtkPolyData* basisData);
  void RequireBasisTogether(const std::vector<double>& told) const;
  int DepthFor(int wanted) const;
  void TakeEnough(const Progress& progress);

  std::shared_ptr<const FiniteElementSpace> InMetric(
    std::shared_ptr<const FiniteElementSpace> ofMesh, const Progress& progress) const;

  bool GivesWay() const;
  StageKey SpaceKey(
    vtkPolyData* input, vtkPolyData* basisData, std::int64_t meshNumber, int depth) const;

  int wanted_ = AutomaticDepth; // of the grid, before it gives way
  TrackedMesh tracked_;
  StageKey structureKey_;
  std::int64_t structure_ = 0;
  std::shared_ptr<const TriangleMetric> metric_; // of `space`; null: that of the mesh
};

} // namespace gridfem

#endif
