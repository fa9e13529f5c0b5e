// The surface that a filter reads from its inputs: the whole of it, or the piece of one MPI rank.
#ifndef GridFEM_InputSurface_h
#define GridFEM_InputSurface_h

#include "Equations/Poisson.h"
#include "Input/InputArray.h"
#include "Input/InputMesh.h"
#include "Solvers/GivenField.h"
#include "Solvers/Surface.h"

#include <functional>
#include <memory>
#include <string>
#include <vector>

class vtkAlgorithm;
class vtkPolyData;
class vtkSelection;

namespace gridfem
{

class ClippedSurface;
class JoinedBlocks;
class SelectedPoints;

/// The shared properties in Core's terms.
struct FilterOptions
  : EquationOptions
  , SurfaceOptions
{
  bool trackMetric = false; // keep the functions of a mesh that has only moved
  InputArray metricArray;   // none: the metric of the mesh
};

/// Adds everything that the triangles of the mesh depend on, but never the vtkPolyData itself,
/// which is a new one after every hop through ParaView.
void AddMesh(StageKey& key, vtkPolyData* data);

/// Adds the arrays of the clip.
void AddClipArrays(StageKey& key, vtkPolyData* data);

/// Adds the arrays of the clip and of the basis.
void AddBasisArrays(StageKey& key, vtkPolyData* data);

/// Functions of a surface that filters need, in addition to the functions that solvers need. All
/// functions but Triangles, Given, ConstraintsOf, UsedDepth and Free are collective on a shared
/// surface.
class InputSurface : public virtual Surface
{
public:
  ~InputSurface() override;

  /// Sets the input that Prepare works on with the current options, until another call. After null,
  /// the next run has to set it again.
  /// @param basisData  carries the basis, unless the input does; null: the functions are built
  virtual void SetInput(vtkPolyData* input, vtkPolyData* basisData) = 0;

  bool AreFunctionsGiven() const override;

  /// The triangles that functions are made on, as Prepare has read them.
  const InputMesh& Triangles() const { return triangles_; }

  /// Whether ReadTriangles joins seams. Ranks together always do.
  virtual bool JoinsSeams() const { return true; }

  /// Reads the triangles of the input without making functions.
  virtual InputMesh ReadTriangles() = 0;

  /// Returns the array that SetInputArrayToProcess(index, ...) names, or a null array if none is
  /// chosen. A shared surface is prepared for it, because ranks without polygons need not have the
  /// array.
  virtual InputArray Find(int index, const std::string& property) = 0;

  /// Does the same on triangles from ReadTriangles, without functions.
  virtual InputArray FindOn(const InputMesh& mesh, int index, const std::string& property) = 0;

  /// Returns the VTK type of results for an array from Find, the same on all ranks.
  virtual int DataTypeOf(int index, const InputArray& array) const = 0;

  /// Updates the selected points.
  /// @param joined  the blocks that the surface is joined from; null: it is one block
  void Select(SelectedPoints& points, vtkSelection* selection, const JoinedBlocks* joined) const;

  /// Returns the array in the form that solvers take.
  GivenField Given(const InputArray& array) const;

  /// Returns the values of an array where a mask or a selection includes the point. Refers to the
  /// selection.
  /// @param values  null array: the coordinates
  GivenConstraints ConstraintsOf(
    const InputArray& values, const InputArray& mask, const SelectedPoints& selection) const;

  /// Returns means on the cells of this process of values on its triangles.
  virtual MultiVector MeansOnCells(const MultiVector& onTriangles, Id cells) const = 0;

  /// Returns all triangles, including copies of triangles of other ranks.
  virtual InputMesh WithCopies(const InputMesh& mesh) const { return mesh; }

  /// Replaces the numbers by the numbers of the first rank that has any.
  virtual void Agree(std::vector<double>& /*numbers*/) const {}

  /// How many triangles of the surface were left out, because others have the same corners.
  virtual Id CopiedTriangles() const { return triangles_.copied; }

  /// The depth of the grid; AutomaticDepth without functions.
  virtual int UsedDepth() const = 0;

  /// Adds the field arrays of trackMetric to an output.
  virtual void WriteTracking(vtkPolyData* /*output*/) const {}

  /// The clip of the input, with functions if wanted, for the two filters that output it.
  virtual ClippedSurface& Clip() = 0;

  /// Runs a body, on several ranks at once if they share the surface. It gets the progress of all
  /// of them. If it throws on one rank, all throw: either Aborted, or the error on the first rank
  /// and FailedElsewhere on the others.
  virtual void Run(
    const Progress& progress, const std::function<void(const Progress& ofAll)>& body) = 0;

  /// Frees everything that has been made of the input.
  virtual void Free() = 0;

protected:
  InputSurface(vtkAlgorithm* filter, const FilterOptions& options);

  vtkAlgorithm* const filter_;
  const FilterOptions& options_;
  vtkPolyData* input_ = nullptr; // of this run
  vtkPolyData* basisData_ = nullptr;
  InputMesh triangles_;
  std::unique_ptr<ClippedSurface> clip_; // null without a call of Clip
};

} // namespace gridfem

#endif
