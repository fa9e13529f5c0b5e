// Colours of several scans that become one: gradients inside the scans are kept, the jumps between
// them are not. [T §1, Fig. 1.2]
#ifndef GridFEM_Stitching_h
#define GridFEM_Stitching_h

#include "Problems/Poisson.h"
#include "Spaces/FiniteElementSpace.h"

#include <optional>

namespace gridfem
{

/// Which scan the points or the triangles of a mesh belong to.
struct ScanLabels
{
  FieldAssociation association = FieldAssociation::Points;
  std::vector<Index> values; // one per point or triangle, 0 or more
};

/// A mesh taken apart into its scans.
struct ScanCut
{
  /// Per triangle of the mesh its scan; Seam where its colours come from several scans.
  std::vector<Index> scanOfTriangle;
  static constexpr Index Seam = -1;

  /// The triangles that are no seam; coincident points of one scan are one point, those of two
  /// scans are two.
  TriangleMesh pieces;
  std::vector<Id> triangleOfPiece;    // per triangle of `pieces`
  std::vector<Index> pieceOfTriangle; // its inverse; -1 for seams
  std::vector<Index> pointOfPoint;    // per point of the mesh one of `pieces`; -1 for none
};

/// @param colors  where the colours live. Those of points are linear on triangles: one with corners
///                of two scans is a seam, and with labels on triangles every one that has a corner
///                in common with another scan. Those of triangles jump on edges alone.
/// Throws InvalidInput when the labels do not fit the mesh or one is negative.
ScanCut CutAtSeams(const TriangleMesh& mesh, const ScanLabels& labels, FieldAssociation colors);

/// How much of the gradient of each triangle is kept: 0 on seams and where triangles of two scans
/// meet, 1 from a distance along the surface on, rising smoothly between.
/// @param width  the distance, world units; 0: 1 on all triangles but seams
/// Throws InvalidInput when it is not a number from 0 on.
std::vector<double> KeptShares(const TriangleMesh& mesh, const ScanCut& cut, double width);

struct StitchOptions : EquationOptions
{
  double blendWidth = 0.0; // of KeptShares: margins of scans, where colours are poor, count less
  std::optional<Index> reference; // the scan that keeps its mean; none: the whole surface
};

struct StitchedColors
{
  MultiVector values; // rows and columns as the colours
  SolveReport report;
  SolutionAccuracy accuracy; // of the function
};

/// The function whose gradients are those of the colours, and zero on seams, with the mean of the
/// colours, or that of the reference, on every connected component. Where functions overlap a gap
/// between two scans they are stitched across it.
/// @param details  a space on cut.pieces, connectivity-aware and without welding, or null. With it
///                 the result is the colours plus what stitching changes, smoothed over two units
///                 of length within each scan, so that details finer than the functions stay.
///                 Without it, and at points without a triangle that is no seam, the function
///                 itself.
/// Throws InvalidInput when the colours do not fit, and Aborted. Same bits for any number of
/// threads.
StitchedColors StitchColors(const FiniteElementSpace& space, const TriangleMesh& mesh,
  const ScanCut& cut, const Field& colors, const StitchOptions& options,
  const FiniteElementSpace* details, const Job& job = {});

} // namespace gridfem

#endif
