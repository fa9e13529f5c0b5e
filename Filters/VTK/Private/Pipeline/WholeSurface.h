// The surface of a filter's input that one process holds, with the basis, metric or motion that the
// input gives.
#ifndef GridFEM_WholeSurface_h
#define GridFEM_WholeSurface_h

#include "Input/MeshVersion.h"
#include "Input/TrackedMesh.h"
#include "Pipeline/InputSurface.h"
#include "Solvers/LocalSurface.h"

namespace gridfem
{

/// The functions come from the input if it carries a basis, or else from the basis data, or else
/// they are built. With trackMetric they stay as long as only points move, and the space gets the
/// metric of the moved surface.
class WholeSurface
  : public LocalSurface
  , public InputSurface
{
public:
  WholeSurface(Stages& stages, vtkAlgorithm* filter, const FilterOptions& options);

  ///@{ The functions of the base classes.
  void Prepare(const Progress& progress) override;
  void PrepareAtDepth(int depth, const Progress& progress) override;
  void PrepareMesh(const Progress& progress) override;
  StageKey InputKey() const override;
  std::shared_ptr<const TriangleMesh> ReadMesh() const override;
  std::shared_ptr<const TriangleMesh> SharedMesh() const override { return triangles_.triangles; }
  const TriangleMesh& CurrentMesh() const override { return *this->CurrentTriangles().triangles; }
  Field OnReference(Field gradients) const override;
  double LongestSide() const override;
  void SetInput(vtkPolyData* input, vtkPolyData* basisData) override;
  bool JoinsSeams() const override;
  InputMesh ReadTriangles() override;
  InputArray Find(int index, const std::string& property) override;
  InputArray FindOn(const InputMesh& mesh, int index, const std::string& property) override;
  int DataTypeOf(int index, const InputArray& array) const override;
  MultiVector MeansOnCells(const MultiVector& onTriangles, Id cells) const override;
  int UsedDepth() const override;
  void WriteTracking(vtkPolyData* output) const override;
  ClippedSurface& Clip() override;
  void Run(const Progress& progress, const std::function<void(const Progress&)>& body) override;
  void Free() override;
  ///@}

  ///@{ For the clip of this surface.
  vtkPolyData* Input() const { return input_; }
  const FilterOptions& Options() const { return options_; }

  /// The number of the input's mesh (MeshVersion).
  std::int64_t MeshNumber();

  /// Reads the input's mesh, which replaces the current mesh, and frees the functions. Throws
  /// InvalidInput unless it is a surface.
  /// @param joinsSeams  as ReadInputMesh. A clipped mesh that is read with its cells has no seams.
  void ReadAnew(bool joinsSeams, const Progress& progress);

  /// Reads the input's mesh, and makes the functions that options ask for.
  void BuildFunctions(const SurfaceOptions& asked, const Progress& progress);

  /// Takes functions that were made on the current mesh.
  void TakeFunctions(GridFunctions functions);
  ///@}

private:
  void Update(const SurfaceOptions& asked, const Progress& progress);
  void UpdateFunctions(const SurfaceOptions& asked, const Progress& progress);
  void MakeFunctions(const SurfaceOptions& asked, const Progress& progress);
  void CoarsenBasis(const SurfaceOptions& asked, const Progress& progress);
  StageKey KeyOfFunctions(const SurfaceOptions& asked, std::int64_t meshNumber) const;
  bool IsTooFineForHats() const;
  const InputMesh& CurrentTriangles() const;

  MeshVersion meshVersion_; // of the mesh
  TrackedMesh tracked_;
  int wanted_ = AutomaticDepth; // depth of the grid before it gives way
};

} // namespace gridfem

#endif
