// Makes the colors of several scans one: gradients inside the scans are kept, the jumps between
// them are not. [T §1, Fig. 1.2]
#ifndef GridFEM_Stitching_h
#define GridFEM_Stitching_h

#include "Equations/Poisson.h"
#include "Spaces/FiniteElementSpace.h"

#include <optional>

namespace gridfem
{

/// The scan of every point or every triangle of a mesh.
struct ScanLabels
{
  FieldAssociation association = FieldAssociation::Points;
  std::vector<Index> values; // one per point or triangle, 0 or more
};

/// A mesh split into its scans.
struct ScanCut
{
  /// The scan of every triangle of the mesh; Seam if its colors come from several scans.
  std::vector<Index> scanOfTriangle;
  static constexpr Index Seam = -1;

  /// The triangles that are not seams. Coincident points of one scan are one point; coincident
  /// points of two scans are two points.
  TriangleMesh pieces;
  std::vector<Id> triangleOfPiece;    // per triangle of `pieces`
  std::vector<Index> pieceOfTriangle; // its inverse; -1 for seams
  std::vector<Index> pointOfPoint;    // per point of the mesh, a point of `pieces`; -1 for none
};

/// Cuts a mesh into its scans.
/// @param colors  whether colors are on points or triangles. Colors on points are linear on
///   triangles. A triangle with corners of two scans is then a seam. With labels on triangles, so
///   is every triangle that shares a corner with another scan. Colors of triangles jump only on
///   edges.
/// Throws InvalidInput when the labels do not fit the mesh or one is negative.
ScanCut CutAtSeams(const TriangleMesh& mesh, const ScanLabels& labels, FieldAssociation colors);

/// The share of each triangle's gradient that is kept. It is 0 on seams and where triangles of two
/// scans meet. It rises smoothly to 1 at a distance along the surface.
/// @param width  this distance, world units; 0: the share is 1 on all triangles but seams
/// Throws InvalidInput when `width` is not a number from 0 on.
std::vector<double> KeptShares(const TriangleMesh& mesh, const ScanCut& cut, double width);

struct StitchOptions : EquationOptions
{
  double blendWidth = 0.0;        // of KeptShares: margins of scans have poor colors and count less
  std::optional<Index> reference; // the scan that keeps its mean; none: the whole surface
};

struct StitchedColors
{
  MultiVector values; // rows and columns as the colors
  SolveReport report;
  SolutionAccuracy accuracy; // of the function before details
};

/// Finds the function with the gradients of the colors inside the scans, and zero gradients on
/// seams. On every connected component it has the mean of the colors, or the mean of the reference.
/// Scans on two sides of a gap are stitched across the gap if functions overlap it.
/// @param details  a space on cut.pieces, connectivity-aware and without welding, or null. With it,
///   the result is the colors plus the change by stitching, smoothed over two units of length
///   within each scan. Details finer than the functions then stay. The result is the function
///   itself without `details`, and at points whose triangles are all seams.
/// Throws InvalidInput when the colors do not fit, and Aborted. Same bits for any number of
/// threads.
StitchedColors StitchColors(const FiniteElementSpace& space, const TriangleMesh& mesh,
  const ScanCut& cut, const Field& colors, const StitchOptions& options,
  const FiniteElementSpace* details, const Job& job = {});

} // namespace gridfem

#endif
