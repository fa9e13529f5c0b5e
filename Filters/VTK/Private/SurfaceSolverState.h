// What a filter keeps between runs: its input mesh, function space and system, and the stages that
// made them.
#ifndef GridFEM_SurfaceSolverState_h
#define GridFEM_SurfaceSolverState_h

#include "InputMesh.h"
#include "Krylov/ConjugateGradients.h"
#include "ProgressBridge.h"
#include "Spaces/HatMultigrid.h"
#include "StageCache.h"
#include "SurfaceBasis.h"

#include <optional>

class vtkPolyData;

namespace gridfem
{

/// The shared properties in Core's terms.
struct SurfaceOptions
{
  SpaceOptions space;
  bool hatFunctions = false; // the functions are the hats of the mesh, the grid preconditions
  int quadratureDegree = 2;
  Index coarsestSize = 256;
  double normalStabilization = DefaultNormalStabilization;
  MultigridOptions multigrid;
  SolveOptions solve;
  int parameterUnits = 1; // vtkSurfaceFEMAlgorithm::ParameterUnitsType
};

/// Adds all that the triangles of the mesh depend on; never the vtkPolyData itself, which is a new
/// one after every hop through ParaView.
void AddMesh(StageKey& key, vtkPolyData* data);

/// Adds what a hierarchy depends on besides its matrices.
void AddMultigrid(StageKey& key, const MultigridOptions& options);

/// Adds the arrays of the clip.
void AddClipArrays(StageKey& key, vtkPolyData* data);

/// Adds the arrays of the clip and of the basis.
void AddBasisArrays(StageKey& key, vtkPolyData* data);

class SurfaceSolverState
{
public:
  explicit SurfaceSolverState(vtkAlgorithm* algorithm) : bridge(algorithm) {}

  /// Brings the mesh and the function space up to date: from `input` where it carries a basis, else
  /// from `basisData` where it is not null, else built.
  /// Throws InvalidInput and Aborted.
  void UpdateSpace(vtkPolyData* input, vtkPolyData* basisData, const Progress& progress);

  /// Builds the function space of a mesh and clips it before. Validates the mesh.
  void BuildSpace(vtkPolyData* input, const Progress& progress);

  /// Brings the system up to date, and `hats` where they are asked for. A system that another
  /// filter has built on the same basis is taken over without a run.
  void UpdateSystem(const Progress& progress);

  /// The hat functions of the mesh above the space.
  HatHierarchy BuildHats(const Progress& progress) const;

  const GridFunctions& Space() const { return *basis.space; }

  /// A weight per squared length of the parameter units, per squared grid unit.
  double WeightInGridUnits(double weight) const;

  SurfaceOptions options;
  StageCache stages;
  InputMesh mesh;
  SurfaceBasis basis;
  std::shared_ptr<const LevelOperators> system;
  std::optional<HatHierarchy> hats; // only with options.hatFunctions
  ProgressBridge bridge;

private:
  bool weldCoincidentPoints_ = true; // as the basis was made
};

} // namespace gridfem

#endif
