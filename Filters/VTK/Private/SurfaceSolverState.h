// What a filter keeps between runs: its input mesh, function space and system, and the stages that
// made them.
#ifndef GridFEM_SurfaceSolverState_h
#define GridFEM_SurfaceSolverState_h

#include "DistributedSurface.h"
#include "InputArray.h"
#include "InputMesh.h"
#include "Krylov/ConjugateGradients.h"
#include "MeshVersion.h"
#include "Problems/Poisson.h"
#include "ProgressBridge.h"
#include "Solvers/GivenField.h"
#include "Solvers/Surface.h"
#include "Solvers/SurfaceBasis.h"
#include "TrackedMesh.h"

class vtkPolyData;
class vtkSelection;

namespace gridfem
{

class JoinedBlocks;

/// The shared properties in Core's terms.
struct FilterOptions
  : EquationOptions
  , SurfaceOptions
{
  bool trackMetric = false; // of a mesh that has only moved since its functions were made
};

/// Adds all that the triangles of the mesh depend on; never the vtkPolyData itself, which is a new
/// one after every hop through ParaView.
void AddMesh(StageKey& key, vtkPolyData* data);

/// Adds the arrays of the clip.
void AddClipArrays(StageKey& key, vtkPolyData* data);

/// Adds the arrays of the clip and of the basis.
void AddBasisArrays(StageKey& key, vtkPolyData* data);

class SurfaceSolverState : public Surface
{
public:
  explicit SurfaceSolverState(vtkAlgorithm* algorithm)
    : Surface(stages), bridge(algorithm), algorithm_(algorithm)
  {
  }

  /// What Prepare works on with the options as they are, until another call. With null the next run
  /// has to say it again.
  void SetInput(vtkPolyData* input, vtkPolyData* basisData);

  ///@{ Surface.
  void Prepare(const Progress& progress) override;
  void PrepareAtDepth(int depth, const Progress& progress) override;
  void PrepareMesh(const Progress& progress) override;
  StageKey InputKey() const override;
  bool AreFunctionsGiven() const override;
  std::shared_ptr<const TriangleMesh> ReadMesh() const override;
  std::int64_t StructureVersion() const override { return structure_; }
  const SurfaceOptions& UsedOptions() const override { return used_; }
  std::shared_ptr<const TriangleMesh> SharedMesh() const override { return mesh.triangles; }
  const TriangleMesh& CurrentMesh() const override { return *this->CurrentInput().triangles; }
  std::shared_ptr<const SurfaceSpace> SharedSpace() const override;
  std::shared_ptr<const FiniteElementSpace> WholeSpace() const override;
  Field OnReference(Field gradients) const override;
  bool AreCoincidentPointsWelded() const override;
  double Area() const override;
  double LongestSide() const override;
  bool IsShared() const override { return isTogether_; }
  void Together(const std::function<void()>& body) const override;
  void Require(const MemoryNeed& own) const override;
  const DividedRows* SumsOverProcesses() const override;
  double Largest(double own) const override;
  bool IsFirst(bool holds) const override;
  HeldValues Hold(const std::vector<Id>& points, const MultiVector& values) const override;
  BoundaryTerms OnBoundary(const MultiVector* flux, const MultiVector* values) const override;
  std::unique_ptr<DistanceMethod> MakeDistance(
    const DistanceOptions& options, const Job& job) const override;
  std::vector<char> PointsWithFunctions() const override;
  void FillCopies(MultiVector& atPoints) const override;
  ///@}

  /// Brings the mesh and the function space up to date: from `input` where it carries a basis, else
  /// from `basisData` where it is not null, else built. With trackMetric they stay where only
  /// points have moved, and UpdateSystem gives them the metric of the moved surface. Throws
  /// InvalidInput and Aborted.
  void UpdateSpace(vtkPolyData* input, vtkPolyData* basisData, const Progress& progress);

  /// Decides on the depth for `mesh`.
  void ChooseDepth();

  /// Builds the function space of a mesh and clips it before. Validates the mesh.
  void BuildSpace(vtkPolyData* input, const Progress& progress);

  /// Brings the finite element space up to date, in the metric of `metricArray`. One in that of the
  /// mesh that another filter has built on the same basis is taken over without a run.
  void UpdateSystem(const Progress& progress);

  ///@{ On several MPI ranks that compute together. Collective; the words of DistributedSurface
  /// hold here, too.

  /// Runs a body with stages that run on all ranks where they have to on one. GetProgress is that
  /// of all ranks in it.
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

  ///@{ The input of a solver, on one process and on several. Collective.

  /// Of the filter's run, or of all ranks together.
  Progress GetProgress() { return isTogether_ ? progressOfAll_ : bridge.GetProgress(); }

  /// The array that SetInputArrayToProcess(index, ...) names; a null array when none is chosen. On
  /// several ranks it prepares the surface, because ranks without polygons need not have the array.
  InputArray Find(int index, const std::string& property);

  /// The same on a mesh that has been read, without the surface.
  InputArray FindOn(const InputMesh& onMesh, int index, const std::string& property);

  /// The VTK type of results for an array from Find, the same on all ranks.
  int DataTypeOf(int index, const InputArray& array) const;

  /// The points that a selection takes.
  /// @param joined  the blocks that the surface is joined of; null: it is of one block
  void Select(
    SelectedPoints& points, vtkSelection* selection, const JoinedBlocks* joined = nullptr) const;

  /// The array as a solver takes it.
  GivenField Given(const InputArray& array) const;

  /// The values of an array where a mask or a selection takes the point. Refers to the selection.
  /// @param values  null array: the coordinates
  GivenConstraints ConstraintsOf(
    const InputArray& values, const InputArray& mask, const SelectedPoints& selection) const;
  ///@}

  /// Means on the cells of this process of values on the triangles of `mesh`. Collective.
  MultiVector MeansOnCells(const MultiVector& onTriangles, Id cells) const;

  /// The mesh of the input: `mesh`, or where that has moved to.
  const InputMesh& CurrentInput() const;

  /// Adds what trackMetric has done to the field arrays of an output.
  void WriteTracking(vtkPolyData* output) const;

  /// Frees all that the stages have made.
  void Free();

  /// The functions of the grid.
  const GridFunctions& Functions() const { return *basis.space; }

  FilterOptions options;  // what is asked for
  InputArray metricArray; // of the input; none: the metric of the mesh
  Stages stages;
  InputMesh mesh;
  MeshVersion meshVersion; // of `mesh`
  SurfaceBasis basis;
  std::shared_ptr<const FiniteElementSpace> space;
  DistributedSurface together; // in use in place of `basis` and `space`
  ProgressBridge bridge;

private:
  std::vector<double> TakeBasisTogether(vtkPolyData* basisData, SurfaceOptions& asked) const;
  void BuildShared(vtkPolyData* piece, bool isClipped, const SurfaceOptions& asked,
    const std::function<void()>& release);
  void RequireBasisTogether(const std::vector<double>& told) const;
  int DepthFor(int wanted) const;
  void NoteFunctions();
  void TakeEnough(const Progress& progress);

  std::shared_ptr<const FiniteElementSpace> InMetric(
    std::shared_ptr<const FiniteElementSpace> ofMesh, const Progress& progress) const;

  bool GivesWay() const;
  StageKey SpaceKey(
    vtkPolyData* input, vtkPolyData* basisData, std::int64_t meshNumber, int depth) const;

  vtkAlgorithm* algorithm_;
  Progress progressOfAll_;
  vtkPolyData* input_ = nullptr; // of this run
  vtkPolyData* basisData_ = nullptr;
  SurfaceOptions used_;
  bool isTogether_ = false;     // within RunTogether
  int wanted_ = AutomaticDepth; // of the grid, before it gives way
  TrackedMesh tracked_;
  StageKey structureKey_;
  std::int64_t structure_ = 0;
  std::shared_ptr<const TriangleMetric> metric_; // of `space`; null: that of the mesh
};

} // namespace gridfem

#endif
