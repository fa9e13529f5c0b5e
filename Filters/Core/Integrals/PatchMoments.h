// Moments: the integrals from which the element matrices of a patch follow linearly. Along each
// axis, products of the two linear functions 1 - t and t are combinations of three quadratics.
// Therefore 27 moments give all 36 entries of the mass matrix, and 63 moments give the stiffness
// matrix. They are summed over several samples at once, one per SIMD lane.
#ifndef GridFEM_PatchMoments_h
#define GridFEM_PatchMoments_h

#include "Base/SimdLanes.h"
#include "Integrals/ElementMatrices.h"
#include "Integrals/TangentPlane.h"

namespace gridfem
{

/// Samples that are added together, one per lane.
struct SampleBatch
{
  Lanes position[3]; // in the cell's own coordinates
  Lanes mass;        // weight of b_i b_j
  LaneTensor tensor; // couples ∇b_i and ∇b_j, times the weight
};

/// Number of batches that a sum takes at once: the points of the default rule.
constexpr int BatchesAtOnce = 3;

class MassMoments
{
public:
  /// @param batch  `count` batches; BatchesAtOnce or a multiple of it is the fastest count
  void Add(const SampleBatch* batch, int count);
  ElementMatrix Matrix() const;

private:
  // The index is 9 y + 3 x + z, where each number selects a quadratic: (1 - t)², t (1 - t), t².
  std::array<Lanes, 27> sum_ = MakeZeros<27>();

  friend class StiffnessMoments;
  template<std::size_t Count>
  static std::array<Lanes, Count> MakeZeros()
  {
    std::array<Lanes, Count> zeros;
    zeros.fill(Lanes::Zero());
    return zeros;
  }
};

class StiffnessMoments
{
public:
  void Add(const SampleBatch* batch, int count);
  ElementMatrix Matrix() const;

private:
  // Axis q follows p, and axis r follows q. The first 27 sums are for T_pp: index 9 p + 3 a + k for
  // quadratic a along q and k along r. From `Mixed` on, the sums are for T_pq, with index
  // 12 p + 3 (a + 2 b) + k. Numbers a and b select linear functions along p and q, and k selects a
  // quadratic along r.
  std::array<Lanes, 63> sum_ = MassMoments::MakeZeros<63>();
};

} // namespace gridfem

#endif
