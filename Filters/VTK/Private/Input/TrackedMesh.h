// Distinguishes a mesh that has only moved from a mesh with other cells.
#ifndef GridFEM_TrackedMesh_h
#define GridFEM_TrackedMesh_h

#include "Input/InputMesh.h"

#include "Integrals/MotionMetric.h"

#include "vtkSmartPointer.h"

#include <array>
#include <cstdint>
#include <optional>

class vtkAbstractArray;
class vtkCellArray;

namespace gridfem
{

/// Holds the mesh that functions were made on, and one with the same cells at other places.
class TrackedMesh
{
public:
  TrackedMesh();
  ~TrackedMesh();

  /// Takes a mesh as the mesh of the functions. Nothing has moved then.
  /// @param version  the mesh's number from MeshVersion
  void Refer(vtkPolyData* data, std::int64_t version);

  /// The version that Refer was given. -1 if none.
  std::int64_t ReferenceVersion() const { return version_; }

  /// Treats a mesh as the moved reference. Returns false, and nothing has moved, if its cells are
  /// others or a triangle has gained or lost its area.
  /// @param reference  the triangles read from the mesh of Refer
  bool Follow(vtkPolyData* data, const InputMesh& reference);

  /// The metric of the moved mesh. Null if nothing has moved.
  const std::shared_ptr<const TriangleMetric>& Metric() const { return metric_; }

  /// The triangles of the reference at their current places.
  const InputMesh& Moved() const { return moved_; }

  /// A number for each motion. 0 if nothing has moved.
  std::int64_t Motion() const { return metric_ ? motion_ : 0; }

  /// The time of the mesh that functions are made on, if its data have one.
  std::optional<double> ReferenceTime() const { return time_; }

  /// Forgets the motion.
  void Stop();

private:
  bool HasCellsOf(vtkPolyData* data) const;

  std::int64_t version_ = -1;
  std::array<vtkSmartPointer<vtkCellArray>, 2> cells_;
  vtkSmartPointer<vtkAbstractArray> ghosts_;
  std::array<vtkIdType, 3> counts_{}; // of points, vertices, lines
  std::optional<double> time_;
  InputMesh moved_;
  std::shared_ptr<const TriangleMetric> metric_;
  std::int64_t motion_ = 0;
};

} // namespace gridfem

#endif
