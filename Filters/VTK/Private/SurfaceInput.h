// The surface that a filter computes on, whatever data set it is given.
#ifndef GridFEM_SurfaceInput_h
#define GridFEM_SurfaceInput_h

#include "vtkNew.h"
#include "vtkType.h"

#include <vector>

class vtkDataSet;
class vtkInformationVector;
class vtkPolyData;

namespace gridfem
{

/// Hands vtkPolyData on, and takes the surface of any other data set: its two-dimensional cells and
/// the outer faces of its volume cells, with their arrays and with `vtkOriginalPointIds` and
/// `vtkOriginalCellIds`.
class SurfaceInput
{
public:
  SurfaceInput();
  ~SurfaceInput();

  /// @param inputs  one vector per port; valid as long as the result is used
  /// @return the same, with the surface on port 0 where that has none itself
  /// Throws InvalidInput for a data set without a surface.
  vtkInformationVector** Of(vtkInformationVector** inputs, int numberOfPorts);

  /// The surface of a data set; that itself, where it is one. Empty for one without a surface.
  vtkPolyData* Of(vtkDataSet* data);

  /// Frees the surface.
  void Free();

private:
  void Extract(vtkDataSet* data);

  vtkNew<vtkPolyData> surface_;
  vtkMTimeType extracted_ = 0; // the data set that the surface is of
  vtkNew<vtkInformationVector> first_;
  std::vector<vtkInformationVector*> ports_;
};

} // namespace gridfem

#endif
