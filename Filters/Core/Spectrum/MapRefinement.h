// Refines a functional map from few modes to many.
#ifndef GridFEM_MapRefinement_h
#define GridFEM_MapRefinement_h

#include "Base/Job.h"
#include "Spectrum/FunctionalMap.h"

#include <vector>

namespace gridfem
{

/// The modes of a surface scaled to area 1, at the points that they reach.
struct ModeRows
{
  /// @param count  of the modes
  ModeRows(const ModesOfShape& shape, Index count);

  std::vector<double> eigenvalues; // positive
  MultiVector values;              // a row per reached point; mean square about 1 over the surface
  std::vector<Id> point;           // of each row
  std::vector<Id> rowOf;           // per point of the mesh; -1: none
  MultiVector places;              // of each row, for a surface of area 1
  std::vector<Id> spread; // rows that are spread over the surface, each far from the rows before

  Index Count() const { return static_cast<Index>(eigenvalues.size()); }
};

/// A map between some modes, and what it says about some rows of the surface.
struct PartialMap
{
  MultiVector matrix;    // square
  std::vector<Id> image; // a row of the reference, per row of the surface in question
  double meanMismatch = 0.0;
};

/// The sizes of a refinement.
struct RefinementSizes
{
  Index modes = 0;      // in the end
  Id surfaceRows = 0;   // the first of `spread`, for the matrix
  Id referenceRows = 0; // the first of `spread` that images are taken from
  double growth = 0.0;  // of the number of modes in a step, at least one mode
};

class MapRefinement
{
public:
  /// Refers to both surfaces.
  MapRefinement(const ModeRows& surface, const ModeRows& reference,
    const std::vector<Landmark>& landmarks, int threads);

  /// Refines a map until it has the wanted number of modes. The image is that of the rows of the
  /// surface that the sizes name. Throws Aborted.
  PartialMap Refine(
    MultiVector matrix, const RefinementSizes& sizes, const Progress& progress) const;

  /// Returns the nearest row of the reference for each of the rows of the surface.
  std::vector<Id> ImageOf(const MultiVector& matrix, const std::vector<Id>& rows,
    const std::vector<Id>& among, const Progress& progress = {}) const;

  /// Returns the matrix of `modes` modes that fits an image of rows of the surface best. With
  /// more than forty modes, the landmarks together count like a tenth of the rows.
  MultiVector Fit(const std::vector<Id>& rows, const std::vector<Id>& image, Index modes) const;

  /// Returns the mean distance of the images of the landmarks from their partners, on a reference
  /// of area 1. 0 without landmarks.
  double MissedLandmarks(const MultiVector& matrix) const;

private:
  const ModeRows& surface_;
  const ModeRows& reference_;
  std::vector<Id> marked_;   // rows of the landmarks
  std::vector<Id> partners_; // rows of the reference
  int threads_;
};

} // namespace gridfem

#endif
