#include "PatchMoments.h"

namespace gridfem
{

namespace
{

constexpr int Mixed = 27;

/// Functions of one coordinate.
struct Factors
{
  Lanes linear[2];    // 1 - t, t
  Lanes quadratic[3]; // (1 - t)², t (1 - t), t²

  explicit Factors(const Lanes& t)
  {
    linear[0] = 1.0 - t;
    linear[1] = t;
    quadratic[0] = linear[0] * linear[0];
    quadratic[1] = linear[0] * linear[1];
    quadratic[2] = linear[1] * linear[1];
  }
};

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

  template<std::size_t Count>
  ElementMatrix Apply(const std::array<Lanes, Count>& lanes) const
  {
    std::array<double, Count> moment;
    for (std::size_t k = 0; k < Count; ++k)
    {
      moment[k] = lanes[k].sum();
    }
    ElementMatrix matrix;
    for (int entry = 0; entry < ElementEntries; ++entry)
    {
      matrix[entry] = 0.0;
      for (int k = 0; k < Terms; ++k)
      {
        matrix[entry] += sign[entry][k] * moment[place[entry][k]];
      }
    }
    return matrix;
  }
};

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

void MassMoments::Add(const SampleBatch& batch)
{
  const Factors x(batch.position[0]);
  const Factors y(batch.position[1]);
  const Factors z(batch.position[2]);
  Lanes* sum = sum_.data();
  for (const Lanes& b : y.quadratic)
  {
    const Lanes weightedY = batch.mass * b;
    for (const Lanes& a : x.quadratic)
    {
      const Lanes weightedXY = weightedY * a;
      for (const Lanes& c : z.quadratic)
      {
        *sum++ += weightedXY * c;
      }
    }
  }
}

ElementMatrix MassMoments::Matrix() const
{
  return MassTerms.Apply(sum_);
}

void StiffnessMoments::Add(const SampleBatch& batch)
{
  const Factors factors[3] = { Factors(batch.position[0]), Factors(batch.position[1]),
    Factors(batch.position[2]) };
  Lanes* same = sum_.data();
  Lanes* mixed = sum_.data() + Mixed;
  for (int p = 0; p < 3; ++p)
  {
    const Factors& ofQ = factors[(p + 1) % 3];
    const Factors& ofR = factors[(p + 2) % 3];
    for (const Lanes& alongQ : ofQ.quadratic)
    {
      const Lanes weighted = batch.tensor.same[p] * alongQ;
      for (const Lanes& alongR : ofR.quadratic)
      {
        *same++ += weighted * alongR;
      }
    }
    for (const Lanes& alongQ : ofQ.linear)
    {
      const Lanes weightedQ = batch.tensor.mixed[p] * alongQ;
      for (const Lanes& alongP : factors[p].linear)
      {
        const Lanes weighted = weightedQ * alongP;
        for (const Lanes& alongR : ofR.quadratic)
        {
          *mixed++ += weighted * alongR;
        }
      }
    }
  }
}

ElementMatrix StiffnessMoments::Matrix() const
{
  return StiffnessTerms.Apply(sum_);
}

} // namespace gridfem
