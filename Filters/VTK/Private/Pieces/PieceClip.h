// The clip of a surface that several MPI ranks hold. Each rank has the pieces in its own cells of
// the octree. Their triangles may come from any rank.
#ifndef GridFEM_PieceClip_h
#define GridFEM_PieceClip_h

#include "Output/ClippedSurface.h"
#include "Pieces/PieceSurface.h"

#include "vtkNew.h"

class vtkAbstractArray;

namespace gridfem
{

/// The clip of this rank. It has only the points of its pieces, the input's first. Points between
/// two ranks are on both. Pieces that are parts of a clip already stay unchanged on their ranks and
/// get the tables of the basis. All ranks know the coarse levels, and the first rank writes all
/// their functions.
class PieceClip : public ClippedSurface
{
public:
  explicit PieceClip(PieceSurface& surface);
  ~PieceClip() override;

  void UpdateClip(const Progress& progress) override;
  void UpdateBasis(bool isShared, const Progress& progress) override;
  void WriteMesh(vtkPolyData* output) const override;
  void WriteFunctions(int level, vtkUnstructuredGrid* output) const override;
  void AddBasisFunction(int level, Id function, vtkPolyData* output) const override;
  const ClippedMesh& Clipped() const override { return *clipped_; }
  const InputMesh& Source() const override { return source_; }
  const MortonKey* CellBefore() const override { return before_.empty() ? nullptr : &before_[0]; }
  int Precision() const override { return precision_; }

private:
  void Free();
  void TakeFunctions();
  void FindPrecision();
  void WriteFrame();
  Id PatchesBefore() const;
  void AddBasis();
  void AddBasisToPiece();
  MultiVector PatchesOfOwn() const;
  vtkSmartPointer<vtkAbstractArray> AtPointsShown(vtkAbstractArray* atAllPoints) const;

  PieceSurface& surface_;
  std::shared_ptr<const RankSurface> functions_; // null for a clip alone
  bool isInputClipped_ = false;
  std::shared_ptr<const Redistribution> distribution_;
  std::shared_ptr<const ClippedMesh> clipped_;
  std::vector<PatchLevel> levels_; // LevelsOfRank
  InputMesh source_;
  std::vector<MortonKey> cells_;  // of all ranks
  std::vector<MortonKey> before_; // at most one
  int precision_ = 0;
  bool areCut_ = false;           // there are cut points on some rank
  std::vector<vtkIdType> points_; // of the clipped mesh, to be output
  vtkNew<vtkPolyData> frame_;     // what does not depend on the input's arrays
};

} // namespace gridfem

#endif
