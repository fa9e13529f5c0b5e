// The points of a surface that a selection takes, as ParaView makes them with the mouse or by a
// query.
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

class DistributedSurface;
class JoinedBlocks;

/// Evaluated by vtkExtractSelection on the data set of the filter's input port 0, of composite data
/// on the whole of it, so that ids count in the block that they are of. A selected cell takes its
/// points.
class SelectedPoints
{
public:
  explicit SelectedPoints(vtkAlgorithm* filter);
  ~SelectedPoints();
  SelectedPoints(const SelectedPoints&) = delete;
  SelectedPoints& operator=(const SelectedPoints&) = delete;

  /// @param selection  null: there is none
  /// @param surface    what the filter computes on: its input, or the surface of it with
  ///                   `vtkOriginalPointIds` and `vtkOriginalCellIds`
  /// @param joined     the blocks that the surface is joined of; null: it is of one block
  /// Throws InvalidInput for a selection of something else than points or cells, or of a kind that
  /// cannot be evaluated.
  void Update(vtkSelection* selection, vtkPolyData* surface, const JoinedBlocks* joined = nullptr);

  /// Collective, within DistributedSurface::Run: the points of this rank's own piece, which it
  /// evaluates alone. What one rank selects is a selection of all. Throws also for a query, which
  /// may look at what other ranks have.
  /// @param piece  as `surface`; may be null
  void UpdateTogether(
    const DistributedSurface& together, vtkSelection* selection, vtkPolyData* piece);

  /// Frees what the next update could take over.
  void Free();

  /// Whether there is a selection, be it of nothing.
  bool IsGiven() const { return isGiven_; }

  /// Per point of the surface; empty without a selection.
  const std::vector<char>& Points() const { return isSelected_; }

  /// The selected points that a triangle uses, ascending.
  /// @param mesh  of the surface
  std::vector<Id> Ids(const TriangleMesh& mesh) const;

  /// Changes when the points do.
  std::int64_t Version() const { return version_; }

private:
  std::vector<char> Evaluate(
    vtkSelection* selection, vtkPolyData* surface, const JoinedBlocks* joined);
  void Take(bool isGiven, std::vector<char> isSelected);
  void Extract(vtkSelection* selection);
  vtkDataSet* PartOf(vtkDataObject* block) const;
  std::vector<char> PointsOfBlocks(const JoinedBlocks& joined) const;
  void ExtractFrom(vtkDataObject* data, vtkSelection* selection);

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
