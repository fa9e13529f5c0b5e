#include "PatchMoments.h"

#include <utility>

namespace gridfem
{

namespace
{

constexpr int Mixed = 27;

/// Functions of one coordinate of several batches of samples.
template<int Batches>
struct Factors
{
  Lanes linear[2][Batches];    // 1 - t, t
  Lanes quadratic[3][Batches]; // (1 - t)², t (1 - t), t²

  Factors(const SampleBatch* batch, int axis)
  {
    for (int b = 0; b < Batches; ++b)
    {
      const Lanes& t = batch[b].position[axis];
      linear[0][b] = 1.0 - t;
      linear[1][b] = t;
      quadratic[0][b] = linear[0][b] * linear[0][b];
      quadratic[1][b] = linear[0][b] * t;
      quadratic[2][b] = t * t;
    }
  }
};

template<int Batches>
using Weights = std::array<Lanes, Batches>;

template<int Batches>
Weights<Batches> Product(const Weights<Batches>& a, const Lanes (&b)[Batches])
{
  Weights<Batches> product;
  for (int k = 0; k < Batches; ++k)
  {
    product[k] = a[k] * b[k];
  }
  return product;
}

/// sum += Σ a b: a sum that is loaded and stored once for several batches.
template<int Batches>
void AddProduct(const Weights<Batches>& a, const Lanes (&b)[Batches], Lanes& sum)
{
  Lanes result = sum;
  for (int k = 0; k < Batches; ++k)
  {
    result += a[k] * b[k];
  }
  sum = result;
}

template<int Batches>
void AddMass(const SampleBatch* batch, Lanes* sum)
{
  const Factors<Batches> x(batch, 0);
  const Factors<Batches> y(batch, 1);
  const Factors<Batches> z(batch, 2);
  Weights<Batches> mass;
  for (int k = 0; k < Batches; ++k)
  {
    mass[k] = batch[k].mass;
  }
  for (const auto& b : y.quadratic)
  {
    const Weights<Batches> weightedY = Product<Batches>(mass, b);
    for (const auto& a : x.quadratic)
    {
      const Weights<Batches> weighted = Product<Batches>(weightedY, a);
      for (const auto& c : z.quadratic)
      {
        AddProduct<Batches>(weighted, c, *sum++);
      }
    }
  }
}

template<int Batches>
void AddStiffness(const SampleBatch* batch, Lanes* same, Lanes* mixed)
{
  const Factors<Batches> factors[3] = { { batch, 0 }, { batch, 1 }, { batch, 2 } };
  for (int p = 0; p < 3; ++p)
  {
    const Factors<Batches>& ofQ = factors[(p + 1) % 3];
    const Factors<Batches>& ofR = factors[(p + 2) % 3];
    Weights<Batches> sameTensor;
    Weights<Batches> mixedTensor;
    for (int k = 0; k < Batches; ++k)
    {
      sameTensor[k] = batch[k].tensor.same[p];
      mixedTensor[k] = batch[k].tensor.mixed[p];
    }
    for (const auto& alongQ : ofQ.quadratic)
    {
      const Weights<Batches> weighted = Product<Batches>(sameTensor, alongQ);
      for (const auto& alongR : ofR.quadratic)
      {
        AddProduct<Batches>(weighted, alongR, *same++);
      }
    }
    for (const auto& alongQ : ofQ.linear)
    {
      const Weights<Batches> weightedQ = Product<Batches>(mixedTensor, alongQ);
      for (const auto& alongP : factors[p].linear)
      {
        const Weights<Batches> weighted = Product<Batches>(weightedQ, alongP);
        for (const auto& alongR : ofR.quadratic)
        {
          AddProduct<Batches>(weighted, alongR, *mixed++);
        }
      }
    }
  }
}

/// Bit of a corner along an axis.
constexpr int Bit(int corner, int axis)
{
  return (corner >> axis) & 1;
}

/// Derivative of the function of a corner along an axis, up to the other two factors.
constexpr double Slope(int corner, int axis)
{
  return Bit(corner, axis) ? 1.0 : -1.0;
}

/// An entry of an element matrix is the sum of sign[entry][k] times moment place[entry][k].
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

/// Unrolled, so that places and signs are part of the code.
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

/// Per axis T_pp ∂_p b_i ∂_p b_j and T_pq (∂_p b_i ∂_q b_j + ∂_q b_i ∂_p b_j).
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
        // One function has its slope along p, the other along q.
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
