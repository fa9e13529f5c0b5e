// Finds the points of a surface in a selection that ParaView makes with the mouse or by a query.
#ifndef GridFEM_SelectedPoints_h
#define GridFEM_SelectedPoints_h

#include "Grid/TriangleMesh.h"

#include "vtkSmartPointer.h"
#include "vtkWeakPointer.h"

#include <cstdint>
#include <vector>

class vtkAlgorithm;
class vtkDataObject;
class vtkDataSet;
class vtkPolyData;
class vtkSelection;

namespace gridfem
{

class JoinedBlocks;
class Surface;

/// The selected points. vtkExtractSelection evaluates the selection on the data set of the filter's
/// input port 0. For composite data it takes the whole input, so that ids refer to their block. A
/// selected cell selects its points.
class SelectedPoints
{
public:
  explicit SelectedPoints(vtkAlgorithm* filter);
  ~SelectedPoints();
  SelectedPoints(const SelectedPoints&) = delete;
  SelectedPoints& operator=(const SelectedPoints&) = delete;

  /// Evaluates a selection. On a shared surface each rank evaluates it on its own piece, and the
  /// selection of one rank applies on all.
  /// @param selection  null: there is none
  /// @param input      the filter's input, or the surface of it with `vtkOriginalPointIds` and
  /// `vtkOriginalCellIds`; null: an empty piece
  /// @param joined     the blocks that the surface is joined from; null: it is one block
  /// Throws InvalidInput for a selection of anything but points or cells, or of a kind that cannot
  /// be evaluated. Ranks also refuse a query, which may depend on the data of other ranks, and any
  /// selection on a gathered surface. Collective on a shared surface.
  void Update(const Surface& surface, vtkSelection* selection, vtkPolyData* input,
    const JoinedBlocks* joined = nullptr);

  /// Frees the data that the next update could reuse.
  void Free();

  /// Whether there is a selection. It may select nothing.
  bool IsGiven() const { return isGiven_; }

  /// A flag for each point of the surface. Empty without a selection.
  const std::vector<char>& Points() const { return isSelected_; }

  /// Returns the selected points that a triangle uses, ascending.
  /// @param mesh  the mesh of the surface
  std::vector<Id> Ids(const TriangleMesh& mesh) const;

  /// A number that changes if the points do.
  std::int64_t Version() const { return version_; }

private:
  std::vector<char> Evaluate(
    vtkSelection* selection, vtkPolyData* surface, const JoinedBlocks* joined);
  vtkDataSet* PartOf(vtkDataObject* block) const;
  std::vector<char> PointsOfBlocks(const JoinedBlocks& joined) const;
  void Extract(vtkDataObject* data, vtkSelection* own, std::int64_t selectionTime);

  vtkAlgorithm* filter_;
  unsigned long observers_[2] = { 0, 0 };
  vtkWeakPointer<vtkDataObject> whole_; // while the pipeline goes through its blocks
  bool isGiven_ = false;
  std::vector<char> isSelected_;
  std::int64_t version_ = 0;
  vtkSmartPointer<vtkDataObject> extracted_; // the data with `vtkInsidedness`
  std::int64_t dataTime_ = 0;                // that it was extracted at
  std::int64_t selectionTime_ = 0;
};

} // namespace gridfem

#endif
