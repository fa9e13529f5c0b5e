// The piece of a filter's surface that one of several MPI ranks holds.
#ifndef GridFEM_PieceSurface_h
#define GridFEM_PieceSurface_h

#include "Pipeline/InputSurface.h"

#include "Parallel/DistributedSurface.h"

#include "vtkSmartPointer.h"

#include <map>

class vtkDataArray;

namespace gridfem
{

/// Reads this rank's piece, which may be null. Copies count once: cells that vtkGhostType marks as
/// duplicates, and pieces that an earlier rank has, too. A basis gives its grid, and also its cells
/// if the piece carries it. On the same surface this gives the same functions.
class PieceSurface
  : public DistributedSurface
  , public InputSurface
{
public:
  PieceSurface(Stages& stages, vtkAlgorithm* filter, const FilterOptions& options);

  ///@{ The functions of the base classes.
  void Prepare(const Progress& progress) override;
  std::shared_ptr<const TriangleMesh> SharedMesh() const override { return triangles_.triangles; }
  void SetInput(vtkPolyData* input, vtkPolyData* basisData) override;
  InputMesh ReadTriangles() override;
  InputArray Find(int index, const std::string& property) override;
  InputArray FindOn(const InputMesh& mesh, int index, const std::string& property) override;
  int DataTypeOf(int index, const InputArray& array) const override;
  MultiVector MeansOnCells(const MultiVector& onTriangles, Id cells) const override;
  InputMesh WithCopies(const InputMesh& mesh) const override;
  void Agree(std::vector<double>& numbers) const override { this->AgreeOn(numbers); }
  Id CopiedTriangles() const override;
  int UsedDepth() const override;
  ClippedSurface& Clip() override;
  void Run(const Progress& progress, const std::function<void(const Progress&)>& body) override;
  void Free() override;
  ///@}

  ///@{ For the clip of this piece.
  vtkPolyData* Piece() const { return input_; }
  const FilterOptions& Options() const { return options_; }
  const InputMesh& Copies() const { return copies_; }
  const Progress& ProgressOfRank() const { return this->OwnProgress(); }
  bool IsRepeated() const { return isRepeated_; } // whether an earlier rank has the piece, too

  /// Notes the threads of this rank as those in use. Collective.
  void NoteThreads();

  /// Reads the piece, which replaces the current piece.
  /// @param joinsSeams  joins the seams of the surface of all ranks. Pieces of a clip that are read
  ///   with their cells have none. Throws NeedsWholeSurface if there are hanging nodes.
  void ReadAnew(bool joinsSeams) { triangles_ = this->Read(joinsSeams); }

  /// Brings the functions up to date.
  /// @param isClipped  the pieces are parts of a clip, whose grid and cells are taken
  /// @param release    called before the functions are made again: frees everything that refers to
  ///   the old ones
  void PrepareFunctions(
    const SurfaceOptions& asked, bool isClipped, const std::function<void()>& release = [] {});
  ///@}

private:
  InputMesh Read(bool joinsSeams);

  /// Stands in for a chosen array.
  struct StandIn
  {
    vtkSmartPointer<vtkDataArray> array; // for a rank without polygons
    int dataType = 0;                    // of the first rank that has the array
  };

  std::vector<double> NumbersOfBasis(vtkPolyData* basisData) const;
  void RequireBasis(const std::vector<double>& told) const;
  StageKey KeyOfFunctions(const SurfaceOptions& asked, bool isClipped) const;
  void AgreeOnArray(int index, InputArray& array);

  InputMesh copies_;
  bool isRepeated_ = false;
  std::map<int, StandIn> arrays_; // by index
};

} // namespace gridfem

#endif
