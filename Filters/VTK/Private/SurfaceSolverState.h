// Holds the data that a filter keeps between runs: its input mesh, function space and system, and
// the stages that made them.
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
  bool trackMetric = false; // keep the functions of a mesh that has only moved
};

/// Adds everything that the triangles of the mesh depend on, but never the vtkPolyData itself,
/// which is a new one after every hop through ParaView.
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

  /// Sets the input that Prepare works on with the current options, until another call. After null,
  /// the next run has to set it again.
  void SetInput(vtkPolyData* input, vtkPolyData* basisData);

  ///@{ The functions of the base class Surface.
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

  /// Brings the mesh and the function space up to date. The space comes from `input` if it carries
  /// a basis, or else from `basisData` if that is not null, or else it is built. With trackMetric
  /// both stay as long as only points move, and UpdateSystem gives them the metric of the moved
  /// surface. Throws InvalidInput and Aborted.
  void UpdateSpace(vtkPolyData* input, vtkPolyData* basisData, const Progress& progress);

  /// Reads triangles as those that the functions of the run are on. Their seams are joined as the
  /// properties or a given basis say.
  InputMesh ReadMeshOf(vtkPolyData* data, const Progress& progress) const;

  /// Chooses the depth for `mesh`.
  void ChooseDepth();

  /// Validates and clips a mesh, and builds its function space.
  void BuildSpace(vtkPolyData* input, const Progress& progress);

  /// Brings the finite element space up to date, in the metric of `metricArray`. In the mesh's own
  /// metric, a space that another filter has built on the same basis is reused without a run.
  void UpdateSystem(const Progress& progress);

  ///@{ On several MPI ranks that compute together. Collective; the words of DistributedSurface
  /// hold here, too.

  /// Runs a body with stages. A stage runs on all ranks if it has to run on one. Inside the body,
  /// GetProgress is the progress of all ranks.
  void RunTogether(const DistributedSurface::Body& body);

  /// Works as UpdateSpace and UpdateSystem, on the pieces of all ranks. A basis gives its grid, and
  /// also its cells if the piece carries it. On the same surface this gives the same functions.
  /// @param piece, basisData  may be null
  void UpdateTogether(vtkPolyData* piece, vtkPolyData* basisData);

  /// Does the same with the functions that the properties ask for.
  /// @param isClipped  the pieces are parts of a clip, whose grid and cells are taken
  /// @param release    called before another space is made: frees everything that holds the old one
  void BuildTogether(
    vtkPolyData* piece, bool isClipped, const std::function<void()>& release = [] {});
  ///@}

  ///@{ The input of a solver, on one process and on several. Collective.

  /// The surface of the filter's run, or of all ranks together.
  Progress GetProgress() { return isTogether_ ? progressOfAll_ : bridge.GetProgress(); }

  /// Returns the array that SetInputArrayToProcess(index, ...) names, or a null array if none is
  /// chosen. On several ranks it prepares the surface, because ranks without polygons need not have
  /// the array.
  InputArray Find(int index, const std::string& property);

  /// Does the same on a mesh that has been read, without the surface.
  InputArray FindOn(const InputMesh& onMesh, int index, const std::string& property);

  /// Returns the VTK type of results for an array from Find, the same on all ranks.
  int DataTypeOf(int index, const InputArray& array) const;

  /// Returns the selected points.
  /// @param joined  the blocks that the surface is joined from; null: it is one block
  void Select(
    SelectedPoints& points, vtkSelection* selection, const JoinedBlocks* joined = nullptr) const;

  /// Returns the array in the form that solvers take.
  GivenField Given(const InputArray& array) const;

  /// Returns the values of an array where a mask or a selection includes the point. Refers to the
  /// selection.
  /// @param values  null array: the coordinates
  GivenConstraints ConstraintsOf(
    const InputArray& values, const InputArray& mask, const SelectedPoints& selection) const;
  ///@}

  /// Returns means on the cells of this process of values on the triangles of `mesh`. Collective.
  MultiVector MeansOnCells(const MultiVector& onTriangles, Id cells) const;

  /// The current mesh of the input: `mesh`, or the moved mesh.
  const InputMesh& CurrentInput() const;

  /// Adds the field arrays of trackMetric to an output.
  void WriteTracking(vtkPolyData* output) const;

  /// Frees everything that the stages have made.
  void Free();

  /// The functions of the grid.
  const GridFunctions& Functions() const { return *basis.space; }

  FilterOptions options;  // the requested options
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
  std::shared_ptr<const TriangleMetric> metric_; // of `space`; null: the metric of the mesh
};

} // namespace gridfem

#endif
