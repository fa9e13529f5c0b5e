// Holds the in-memory shortcut of the basis. An information key attaches it to the field array
// PatchBasisIds, so that it survives shallow copies from filter to filter. Everything in it can be
// rebuilt from the arrays.
#ifndef vtkSurfaceBasisHolder_h
#define vtkSurfaceBasisHolder_h

#include "Solvers/SurfaceBasis.h"

#include "vtkObject.h"

#include <mutex>

class vtkAbstractArray;
class vtkInformationObjectBaseKey;

class vtkSurfaceBasisHolder : public vtkObject
{
public:
  static vtkSurfaceBasisHolder* New();
  vtkTypeMacro(vtkSurfaceBasisHolder, vtkObject);

  static vtkInformationObjectBaseKey* BASIS();

  /// Puts a holder of the basis on the array.
  static void Attach(vtkAbstractArray* array, const gridfem::SurfaceBasis& basis);

  /// The holder on the array, or null. The array may be null.
  static vtkSurfaceBasisHolder* Find(vtkAbstractArray* array);

  /// The basis on the mesh that the basis filter was given.
  const gridfem::SurfaceBasis& OnSourceMesh() const { return this->Source; }

  /// The basis on the basis filter's output. It is converted on the first request.
  gridfem::SurfaceBasis OnClippedMesh();

protected:
  vtkSurfaceBasisHolder() = default;
  ~vtkSurfaceBasisHolder() override = default;

private:
  vtkSurfaceBasisHolder(const vtkSurfaceBasisHolder&) = delete;
  void operator=(const vtkSurfaceBasisHolder&) = delete;

  gridfem::SurfaceBasis Source;
  gridfem::SurfaceBasis Clipped;
  std::mutex Mutex;
};

#endif
