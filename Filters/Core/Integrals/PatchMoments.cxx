#include "Integrals/PatchMoments.h"

#include <utility>

namespace gridfem
{

namespace
{

constexpr int Mixed = 27;

/// One number for each sample of several batches.
template<int Batches>
using Factors = std::array<Lanes, Batches>;

template<int Batches>
EIGEN_ALWAYS_INLINE Factors<Batches> Product(const Factors<Batches>& a, const Factors<Batches>& b)
{
  Factors<Batches> product;
  for (int k = 0; k < Batches; ++k)
  {
    product[k] = a[k] * b[k];
  }
  return product;
}

/// The two linear functions along an axis: 1 - t and t.
template<int Batches>
struct Linear
{
  Factors<Batches> down;
  Factors<Batches> up;

  Linear(const SampleBatch* batch, int axis)
  {
    for (int k = 0; k < Batches; ++k)
    {
      up[k] = batch[k].position[axis];
      down[k] = 1.0 - up[k];
    }
  }
};

/// The three quadratics along an axis: (1 - t)², t (1 - t) and t².
template<int Batches>
struct Quadratic
{
  Factors<Batches> factor[3];

  explicit Quadratic(const Linear<Batches>& t)
    : factor{ Product<Batches>(t.down, t.down), Product<Batches>(t.down, t.up),
        Product<Batches>(t.up, t.up) }
  {
  }
};

/// Adds weight z_c to the next three sums and advances `sum`. Each sum is loaded and stored once
/// for several batches.
template<int Batches>
EIGEN_ALWAYS_INLINE void AddProducts(
  const Factors<Batches>& weight, const Quadratic<Batches>& z, Lanes*& sum)
{
  for (const Factors<Batches>& factor : z.factor)
  {
    Lanes result = *sum;
    for (int k = 0; k < Batches; ++k)
    {
      result += weight[k] * factor[k];
    }
    *sum++ = result;
  }
}

/// Calls add(weight t_a) for the quadratics of t.
template<int Batches, class Add>
EIGEN_ALWAYS_INLINE void ForQuadratics(
  const Factors<Batches>& weight, const Linear<Batches>& t, Add&& add)
{
  const Factors<Batches> down = Product<Batches>(weight, t.down);
  const Factors<Batches> up = Product<Batches>(weight, t.up);
  add(Product<Batches>(down, t.down));
  add(Product<Batches>(down, t.up));
  add(Product<Batches>(up, t.up));
}

/// Adds weight t_a z_c to the next nine sums, with the quadratics t_a of t.
template<int Batches>
EIGEN_ALWAYS_INLINE void AddProducts(const Factors<Batches>& weight, const Linear<Batches>& t,
  const Quadratic<Batches>& z, Lanes*& sum)
{
  ForQuadratics<Batches>(
    weight, t, [&](const Factors<Batches>& product) { AddProducts<Batches>(product, z, sum); });
}

template<int Batches>
void AddMass(const SampleBatch* batch, Lanes* sum)
{
  const Linear<Batches> x(batch, 0);
  const Linear<Batches> y(batch, 1);
  const Quadratic<Batches> z(Linear<Batches>(batch, 2));
  Factors<Batches> mass;
  for (int k = 0; k < Batches; ++k)
  {
    mass[k] = batch[k].mass;
  }
  ForQuadratics<Batches>(
    mass, y, [&](const Factors<Batches>& product) { AddProducts<Batches>(product, x, z, sum); });
}

template<int Batches>
void AddStiffness(const SampleBatch* batch, Lanes* same, Lanes* mixed)
{
  for (int p = 0; p < 3; ++p)
  {
    const Linear<Batches> ofP(batch, p);
    const Linear<Batches> ofQ(batch, (p + 1) % 3);
    const Quadratic<Batches> ofR(Linear<Batches>(batch, (p + 2) % 3));
    Factors<Batches> sameTensor;
    Factors<Batches> mixedTensor;
    for (int k = 0; k < Batches; ++k)
    {
      sameTensor[k] = batch[k].tensor.same[p];
      mixedTensor[k] = batch[k].tensor.mixed[p];
    }
    AddProducts<Batches>(sameTensor, ofQ, ofR, same);
    const Factors<Batches> down = Product<Batches>(mixedTensor, ofQ.down);
    const Factors<Batches> up = Product<Batches>(mixedTensor, ofQ.up);
    AddProducts<Batches>(Product<Batches>(down, ofP.down), ofR, mixed);
    AddProducts<Batches>(Product<Batches>(down, ofP.up), ofR, mixed);
    AddProducts<Batches>(Product<Batches>(up, ofP.down), ofR, mixed);
    AddProducts<Batches>(Product<Batches>(up, ofP.up), ofR, mixed);
  }
}

/// Bit of a corner along an axis.
constexpr int Bit(int corner, int axis)
{
  return (corner >> axis) & 1;
}

/// Derivative of a corner's function along an axis, up to its other two factors.
constexpr double Slope(int corner, int axis)
{
  return Bit(corner, axis) ? 1.0 : -1.0;
}

/// An entry of an element matrix is the sum over k of sign[entry][k] times moment place[entry][k].
template<int Terms>
struct MomentSums
{
  int place[ElementEntries][Terms] = {};
  double sign[ElementEntries][Terms] = {};
};

template<const auto& Sums, std::size_t Entry, std::size_t... Term>
double EntryOf(const double* moment, std::index_sequence<Term...>)
{
  return ((Sums.sign[Entry][Term] * moment[Sums.place[Entry][Term]]) + ...);
}

template<const auto& Sums, int Terms, std::size_t... Entry>
ElementMatrix EntriesOf(const double* moment, std::index_sequence<Entry...>)
{
  return { EntryOf<Sums, Entry>(moment, std::make_index_sequence<Terms>())... };
}

/// Computes an element matrix from moments. The loops are unrolled, so that places and signs are
/// constants in the code.
template<const auto& Sums, int Terms, std::size_t Count>
ElementMatrix Apply(const std::array<Lanes, Count>& lanes)
{
  std::array<double, Count> moment;
  for (std::size_t k = 0; k < Count; ++k)
  {
    moment[k] = SumOverLanes(lanes[k]);
  }
  return EntriesOf<Sums, Terms>(moment.data(), std::make_index_sequence<ElementEntries>());
}

constexpr MomentSums<1> MakeMassTerms()
{
  MomentSums<1> sums;
  for (int i = 0; i < FunctionsPerPatch; ++i)
  {
    for (int j = i; j < FunctionsPerPatch; ++j)
    {
      const int entry = PackedIndex(i, j);
      sums.place[entry][0] =
        9 * (Bit(i, 1) + Bit(j, 1)) + 3 * (Bit(i, 0) + Bit(j, 0)) + Bit(i, 2) + Bit(j, 2);
      sums.sign[entry][0] = 1.0;
    }
  }
  return sums;
}

/// Sums, for each axis p, T_pp ∂_p b_i ∂_p b_j and T_pq (∂_p b_i ∂_q b_j + ∂_q b_i ∂_p b_j).
constexpr MomentSums<9> MakeStiffnessTerms()
{
  MomentSums<9> sums;
  for (int i = 0; i < FunctionsPerPatch; ++i)
  {
    for (int j = i; j < FunctionsPerPatch; ++j)
    {
      int* const place = sums.place[PackedIndex(i, j)];
      double* const sign = sums.sign[PackedIndex(i, j)];
      for (int p = 0; p < 3; ++p)
      {
        const int q = (p + 1) % 3;
        const int r = (p + 2) % 3;
        const int alongR = Bit(i, r) + Bit(j, r);
        place[3 * p] = 9 * p + 3 * (Bit(i, q) + Bit(j, q)) + alongR;
        sign[3 * p] = Slope(i, p) * Slope(j, p);
        // One function is differentiated along p, the other along q.
        place[3 * p + 1] = Mixed + 12 * p + 3 * (Bit(j, p) + 2 * Bit(i, q)) + alongR;
        sign[3 * p + 1] = Slope(i, p) * Slope(j, q);
        place[3 * p + 2] = Mixed + 12 * p + 3 * (Bit(i, p) + 2 * Bit(j, q)) + alongR;
        sign[3 * p + 2] = Slope(i, q) * Slope(j, p);
      }
    }
  }
  return sums;
}

constexpr MomentSums<1> MassTerms = MakeMassTerms();
constexpr MomentSums<9> StiffnessTerms = MakeStiffnessTerms();

} // namespace

void MassMoments::Add(const SampleBatch* batch, int count)
{
  for (; count >= BatchesAtOnce; count -= BatchesAtOnce, batch += BatchesAtOnce)
  {
    AddMass<BatchesAtOnce>(batch, sum_.data());
  }
  for (; count > 0; --count, ++batch)
  {
    AddMass<1>(batch, sum_.data());
  }
}

ElementMatrix MassMoments::Matrix() const
{
  return Apply<MassTerms, 1>(sum_);
}

void StiffnessMoments::Add(const SampleBatch* batch, int count)
{
  Lanes* const same = sum_.data();
  Lanes* const mixed = sum_.data() + Mixed;
  for (; count >= BatchesAtOnce; count -= BatchesAtOnce, batch += BatchesAtOnce)
  {
    AddStiffness<BatchesAtOnce>(batch, same, mixed);
  }
  for (; count > 0; --count, ++batch)
  {
    AddStiffness<1>(batch, same, mixed);
  }
}

ElementMatrix StiffnessMoments::Matrix() const
{
  return Apply<StiffnessTerms, 9>(sum_);
}

} // namespace gridfem
