// Restricts a filter to a part of its input, but keeps the rest in its output.
#ifndef GridFEM_Domain_h
#define GridFEM_Domain_h

#include "Input/InputArray.h"
#include "Pipeline/InformationCopy.h"
#include "Solvers/Stages.h"

#include "vtkNew.h"
#include "vtkSmartPointer.h"

class vtkAlgorithm;
class vtkInformationVector;
class vtkPolyData;
class vtkUnsignedCharArray;

namespace gridfem
{

/// The index of the DomainArray in SetInputArrayToProcess, the same in all filters.
constexpr int DomainIndex = 9;

/// The part of the input where the DomainArray is neither 0 nor NaN. A cell is in the domain if its
/// own value is, or all values at its points are. The other cells get the ghost flag of hidden
/// cells, which all filters leave out.
class Domain
{
public:
  Domain();
  ~Domain();

  /// Returns the inputs, with the cells outside of the domain marked on port 0.
  /// @param inputs  one vector per port; they have to live as long as the result is used
  /// Throws InvalidInput for an array that is missing or has several components.
  vtkInformationVector** Apply(
    vtkAlgorithm* filter, vtkInformationVector** inputs, int numberOfPorts);

  /// Replaces the marks of an output by the ghost flags of the input.
  void PutBack(vtkPolyData* output) const;

  void Free();

private:
  void Mark(vtkPolyData* surface, const InputArray& array);

  StageKey marked_; // the mesh and the array that the marks are of
  vtkSmartPointer<vtkUnsignedCharArray> marks_;
  vtkSmartPointer<vtkUnsignedCharArray> given_; // of the input; null: none
  vtkNew<vtkPolyData> surface_;
  OtherFirstInput inputs_;
};

} // namespace gridfem

#endif
