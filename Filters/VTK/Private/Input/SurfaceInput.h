// Provides the surface that a filter computes on, for any kind of data set.
#ifndef GridFEM_SurfaceInput_h
#define GridFEM_SurfaceInput_h

#include "Pipeline/InformationCopy.h"

#include "vtkNew.h"
#include "vtkType.h"

class vtkDataSet;
class vtkInformationVector;
class vtkPolyData;

namespace gridfem
{

/// Passes vtkPolyData on, and extracts the surface of any other data set. The surface has its
/// two-dimensional cells and the outer faces of its volume cells, with their arrays and with
/// `vtkOriginalPointIds` and `vtkOriginalCellIds`.
class SurfaceInput
{
public:
  SurfaceInput();
  ~SurfaceInput();

  /// Returns the inputs, with the surface on port 0.
  /// @param inputs  one vector per port; they have to live as long as the result is used
  /// Throws InvalidInput for a data set without a surface, and for damaged cells on any port.
  vtkInformationVector** Of(vtkInformationVector** inputs, int numberOfPorts);

  /// Returns the surface of a data set. vtkPolyData is its own surface. Empty if there is none.
  /// Throws InvalidInput for damaged cells.
  vtkPolyData* Of(vtkDataSet* data);

  /// Frees the surface.
  void Free();

private:
  void Extract(vtkDataSet* data);

  vtkNew<vtkPolyData> surface_;
  vtkMTimeType extracted_ = 0; // the data set that the surface is of
  OtherFirstInput inputs_;
};

} // namespace gridfem

#endif
