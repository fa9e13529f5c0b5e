// Joins several chosen arrays into one, so that they are solved together.
#ifndef GridFEM_JoinedArrays_h
#define GridFEM_JoinedArrays_h

#include "Base/Types.h"
#include "Input/InputArray.h"
#include "Solvers/StageKey.h"

#include "vtkSmartPointer.h"

#include <functional>
#include <string>
#include <vector>

class vtkPointData;

namespace gridfem
{

class InputSurface;

///@{ The further arrays of a filter, which its user has chosen beside the array of index 0. They
/// are of points if this array is, else of cells. Their indices of SetInputArrayToProcess are the
/// last ones.
void AddFurtherArray(vtkAlgorithm* filter, const char* name);
void ClearFurtherArrays(vtkAlgorithm* filter);
int NumberOfFurtherArrays(vtkAlgorithm* filter);
///@}

/// The array of index 0 and the further arrays.
class JoinedArrays
{
public:
  using FindArray = std::function<InputArray(int index, const std::string& property)>;

  /// Returns an array with the components of all arrays. It is `first` itself if there are no
  /// further arrays. Else it is the same object as before, unless an array has changed. Collective
  /// on a shared surface. Throws InvalidInput if there is no first array, or if a further array is
  /// missing among the arrays of its kind, points or cells.
  /// @param property  of the first array, for messages
  /// @param find      returns the array of an index
  InputArray Join(vtkAlgorithm* filter, const InputSurface& surface, const InputArray& first,
    const std::string& property, const FindArray& find);

  /// The same with further arrays of the surface.
  InputArray Join(vtkAlgorithm* filter, InputSurface& surface, const InputArray& first,
    const std::string& property);

  /// Adds the solution of each array to the point data, and makes the first one active. It has the
  /// given name. The solution of a further array has the name of this array before it, with `_`.
  void AddSolutions(const char* name, const MultiVector& values, vtkPointData* points) const;

private:
  struct Part
  {
    InputArray array;
    int dataType; // the same on all ranks
  };

  vtkSmartPointer<vtkDataArray> CopyTogether() const;

  std::vector<Part> parts_;
  StageKey key_;
  vtkSmartPointer<vtkDataArray> joined_; // null without further arrays
};

} // namespace gridfem

#endif
