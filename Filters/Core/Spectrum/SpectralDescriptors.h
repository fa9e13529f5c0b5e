// Descriptors made of eigenfunctions at the points of a mesh: signatures of points, distances
// between points, and the parts of a function in a band of frequencies. All are sums over modes;
// this file solves no eigenproblem.
// HKS: Sun, Ovsjanikov, Guibas 2009. WKS: Aubry, Schlickewei, Cremers 2011. Biharmonic distance:
// Lipman, Rustamov, Funkhouser 2010. Diffusion distance: Coifman, Lafon 2006.
#ifndef GridFEM_SpectralDescriptors_h
#define GridFEM_SpectralDescriptors_h

#include "Algebra/DistributedRows.h"
#include "Base/Job.h"
#include "Grid/TriangleMesh.h"

#include <vector>

namespace gridfem
{

/// Eigenfunctions at the points of a mesh. L is the length unit of the mesh.
struct PointModes
{
  std::vector<double> eigenvalues; // ascending, 1/L²
  MultiVector values;              // rows = points, a column per mode; ∫ φ² = 1
  double area = 0.0;               // of the surface, L²
};

/// The number of leading modes with eigenvalue zero, one per connected component. An eigenvalue is
/// zero if it is below 1e-9 of the largest. Throws InvalidInput when shapes or values do not fit
/// (NaN, not ascending, area not positive), or when every eigenvalue is zero.
Index CountZeroModes(const PointModes& modes);

/// `count` >= 1 times (L²) in geometric order between 4 ln 10 / λ of the last mode and of the first
/// mode that is not constant. At the smallest time the last mode fades, at the largest time the
/// first mode fades.
std::vector<double> HeatTimes(const PointModes& modes, int count);

/// The part of the heat from x that remains at x, times the area: area Σ exp(-λ t) φ(x)². Rows =
/// points, a column per time. It has no unit: scaling the mesh and the times changes nothing. On a
/// connected surface it is 1 for long times.
MultiVector HeatKernelSignature(
  const PointModes& modes, const std::vector<double>& times, const Job& job = {});

/// Bands of the wave kernel. Energies are logarithms of eigenvalues (of λ L²); `width` is the
/// standard deviation of a band.
struct WaveBands
{
  std::vector<double> energies;
  double width = 0.0;
};

/// `count` >= 1 energies, evenly between the energies of the first mode that is not constant and of
/// the last mode, two widths inside. The width is 7/128 of that range, which is seven steps of the
/// hundred that the authors take.
WaveBands WaveEnergies(const PointModes& modes, int count);

/// The weighted mean of area φ(x)² over the modes of a band, with weights exp(-(E - log λ)² / (2
/// width²)). Constant modes do not count. Rows = points, a column per energy. It has no unit; its
/// mean over the surface is 1.
MultiVector WaveKernelSignature(
  const PointModes& modes, const WaveBands& bands, const Job& job = {});

/// The distance of every point to the nearest of `sources`, in L: sqrt(Σ (φ(x) - φ(y))² / λ²).
/// Points on a component without a source get NaN, because their distance is infinite. Throws
/// InvalidInput when there is no source, or naming a source that is no point.
std::vector<double> BiharmonicDistance(
  const PointModes& modes, const std::vector<Id>& sources, int threads = 0);

/// The same for sqrt(area Σ exp(-2 λ t) (φ(x) - φ(y))²). It measures how differently heat from x
/// and y has spread after the time t >= 0 (L²). It has no unit, and is finite between components,
/// too.
std::vector<double> DiffusionDistance(
  const PointModes& modes, const std::vector<Id>& sources, double time, int threads = 0);

/// Functions as sums of modes. Rows = modes, columns = functions.
struct ModeExpansion
{
  MultiVector shares;       // of every mode in the best approximation by all modes
  MultiVector remaining;    // root of the integral of the squared error by the modes up to the row
  Eigen::RowVectorXd norms; // the same root before the first mode

  /// The same root by the first `count` modes.
  Eigen::RowVectorXd RemainingAfter(Index count) const
  {
    return count > 0 ? Eigen::RowVectorXd(remaining.row(count - 1)) : norms;
  }
};

/// Expands functions in modes (rows = points). The functions and the modes are linear on every
/// triangle, and their products are integrated exactly: c = (ΦᵀMΦ)⁻¹ ΦᵀM f. The inverse is needed
/// because modes are orthonormal as functions of the space, not as linear functions between the
/// points. A mode has the share 1 in itself and 0 in the others, to rounding. Throws InvalidInput
/// when the mesh has too few points to tell the modes apart.
/// @param distributed  for several processes, each with the mesh of its triangles; collective
ModeExpansion ExpandInModes(const TriangleMesh& mesh, const PointModes& modes, const MultiVector& f,
  int threads = 0, const DistributedRows* distributed = nullptr);

/// Σ shares φ over the modes first .. last; an empty sum is 0. Rows = points.
MultiVector SumOfModes(
  const PointModes& modes, const MultiVector& shares, Index first, Index last, int threads = 0);

} // namespace gridfem

#endif
