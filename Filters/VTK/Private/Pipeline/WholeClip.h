// The clip of a surface that one process holds.
#ifndef GridFEM_WholeClip_h
#define GridFEM_WholeClip_h

#include "Output/ClippedSurface.h"
#include "Pipeline/WholeSurface.h"

#include "vtkNew.h"

namespace gridfem
{

class WholeClip : public ClippedSurface
{
public:
  explicit WholeClip(WholeSurface& surface);
  ~WholeClip() override;

  void UpdateClip(const Progress& progress) override;
  void UpdateBasis(bool isShared, const Progress& progress) override;
  void WriteMesh(vtkPolyData* output) const override;
  void WriteFunctions(int level, vtkUnstructuredGrid* output) const override;
  void AddBasisFunction(int level, Id function, vtkPolyData* output) const override;
  const ClippedMesh& Clipped() const override;
  const InputMesh& Source() const override { return surface_.Triangles(); }
  int Precision() const override;

private:
  StageKey KeyOfMesh() const;
  void MakeFrame();
  void AddBasisToFrame(const std::vector<Id>& cellPatch);
  void BuildFunctions(const Progress& progress);
  void ReadFunctions(const Progress& progress);

  WholeSurface& surface_;
  bool isInputClipped_ = false;
  ClippedMesh clipped_;       // without functions
  vtkNew<vtkPolyData> frame_; // what does not depend on the input's arrays
};

} // namespace gridfem

#endif
