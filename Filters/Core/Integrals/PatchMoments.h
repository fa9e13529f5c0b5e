// The integrals that the element matrices of a patch are linear in. Along each axis, products of
// the two linear functions 1 - t and t are combinations of three quadratics; so 27 moments stand
// for all 36 entries of the mass matrix, and 63 for those of the stiffness matrix. They are summed
// over several samples at once, one per SIMD lane.
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
  LaneTensor tensor; // of ∇b_i and ∇b_j, times the weight
};

/// What a sum takes in one go: the points of the default rule.
constexpr int BatchesAtOnce = 3;

class MassMoments
{
public:
  /// @param batch  `count` of them; BatchesAtOnce or a multiple is the fastest
  void Add(const SampleBatch* batch, int count);
  ElementMatrix Matrix() const;

private:
  // Quadratic y, x, z: (1 - t)², t (1 - t), t².
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
  // With q the axis after p and r the one after q: first T_pp, with quadratic a along q and k along
  // r at 9 p + 3 a + k; then, from `Mixed` on, T_pq, with linear function a along p and b along q
  // and quadratic k along r at 12 p + 3 (a + 2 b) + k.
  std::array<Lanes, 63> sum_ = MassMoments::MakeZeros<63>();
};

} // namespace gridfem

#endif
