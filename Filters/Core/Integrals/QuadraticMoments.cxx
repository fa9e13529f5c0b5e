#include "Integrals/QuadraticMoments.h"

#include "Integrals/QuadraticBasis.h"

namespace gridfem
{
namespace
{

constexpr int Functions = SmoothFunctionsPerPatch;
constexpr int AxisPairs = 9; // pairs of the three functions along an axis
constexpr int AxisTerms = 5; // Bernstein polynomials of degree four
constexpr double Choose2[3] = { 1.0, 2.0, 1.0 };
constexpr double Choose4[AxisTerms] = { 1.0, 4.0, 6.0, 4.0, 1.0 };

/// The functions along an axis and their slopes, as Bernstein polynomials of degree two.
constexpr double AxisFunctions[2][3][3] = {
  { { 0.5, 0.0, 0.0 }, { 0.5, 1.0, 0.5 }, { 0.0, 0.0, 0.5 } },
  { { -1.0, -0.5, 0.0 }, { 1.0, 0.0, -1.0 }, { 0.0, 0.5, 1.0 } },
};

/// The factors along an axis: the first factor is a slope if bit 0 is set, the second if bit 1 is
/// set.
enum PairKind : int
{
  Values = 0,
  SlopeFirst = 1,
  SlopeSecond = 2,
  Slopes = 3
};

using PairTable = Eigen::Matrix<double, AxisPairs, AxisTerms>;

/// Row 3 i + j has the product of the functions i and j.
PairTable MakePairTable(int kind)
{
  PairTable table = PairTable::Zero();
  for (int pair = 0; pair < AxisPairs; ++pair)
  {
    const double* const first = AxisFunctions[kind & 1][pair / 3];
    const double* const second = AxisFunctions[kind >> 1][pair % 3];
    for (int i = 0; i < 3; ++i)
    {
      for (int j = 0; j < 3; ++j)
      {
        table(pair, i + j) += Choose2[i] * Choose2[j] / Choose4[i + j] * first[i] * second[j];
      }
    }
  }
  return table;
}

const PairTable& PairsOf(int kind)
{
  static const std::array<PairTable, 4> tables = { MakePairTable(Values), MakePairTable(SlopeFirst),
    MakePairTable(SlopeSecond), MakePairTable(Slopes) };
  return tables[kind];
}

/// The Bernstein polynomials of degree four.
void SetBernstein(const Lanes& t, Lanes* value)
{
  const Lanes rest = 1.0 - t;
  const Lanes t2 = t * t;
  const Lanes rest2 = rest * rest;
  value[0] = rest2 * rest2;
  value[1] = 4.0 * (t * rest) * rest2;
  value[2] = 6.0 * t2 * rest2;
  value[3] = 4.0 * (t * rest) * t2;
  value[4] = t2 * t2;
}

} // namespace

void QuadraticMoments::Add(const TriangleBatch& batch, const TrianglePlanes& planes,
  const QuadratureRule& rule, const BatchWeights& weights, const Lanes& bendWeight)
{
  Sums moments = Sums::Zero(); // a row for each triangle of area 1
  for (const QuadratureRule::Point& point : rule.points)
  {
    SampleBatch sample;
    SetPositions(batch, point, sample);
    Lanes x[Terms];
    Lanes y[Terms];
    Lanes z[Terms];
    SetBernstein(sample.position[0], x);
    SetBernstein(sample.position[1], y);
    SetBernstein(sample.position[2], z);
    for (int c = 0; c < Terms; ++c)
    {
      for (int b = 0; b < Terms; ++b)
      {
        const Lanes yz = point.weight * y[b] * z[c];
        double* const column = moments.col(Terms * (Terms * c + b)).data();
        for (int a = 0; a < Terms; ++a)
        {
          Eigen::Map<Lanes, Eigen::AlignedMax>(column + LaneCount * a) += yz * x[a];
        }
      }
    }
  }
  Eigen::Matrix<double, LaneCount, LaneCount> factors; // a column for each triangle
  factors.row(0) = (planes.area * weights.mass).matrix().transpose();
  for (int p = 0; p < 3; ++p)
  {
    factors.row(1 + p) = (planes.area * weights.stiffness.same[p]).matrix().transpose();
    factors.row(4 + p) = (planes.area * weights.stiffness.mixed[p]).matrix().transpose();
  }
  factors.row(7).setZero();
  for (int moment = 0; moment < Moments; ++moment)
  {
    Eigen::Map<Lanes, Eigen::AlignedMax> sum(sums_.col(moment).data());
    for (int lane = 0; lane < LaneCount; ++lane)
    {
      sum += factors.col(lane).array() * moments(lane, moment);
    }
  }
  this->AddBend(batch, planes, bendWeight);
}

/// The points of the rule of degree two are enough, because the weight alone has to be right.
void QuadraticMoments::AddBend(
  const TriangleBatch& batch, const TrianglePlanes& planes, const Lanes& weight)
{
  for (const QuadratureRule::Point& point : TriangleRule(2).points)
  {
    SampleBatch sample;
    SetPositions(batch, point, sample);
    Eigen::Matrix<double, LaneCount, Functions> bend;
    ForEachSecondDerivative(sample.position, planes.normal,
      [&bend](int function, const Lanes& value) { bend.col(function) = value; });
    const Lanes factor = weight * point.weight * planes.area;
    bend_.noalias() += bend.transpose() * factor.matrix().asDiagonal() * bend;
  }
}

/// Multiplies the moments along each axis by the products of functions: an entry for every two
/// functions of the cell.
QuadraticMoments::Matrix QuadraticMoments::Expand(
  const Sums& sums, int row, const std::array<int, 3>& kinds)
{
  using AlongX = Eigen::Matrix<double, AxisPairs, Terms * Terms>;
  using Plane = Eigen::Matrix<double, Terms, Terms>;
  const Eigen::Matrix<double, 1, Moments> moments = sums.row(row);
  const Eigen::Map<const Eigen::Matrix<double, Terms, Terms * Terms>> given(moments.data());
  const AlongX alongX = PairsOf(kinds[0]) * given;
  Matrix result;
  for (int x = 0; x < AxisPairs; ++x)
  {
    const Eigen::Matrix<double, 1, Terms* Terms> ofPair = alongX.row(x);
    const Eigen::Map<const Plane> plane(ofPair.data()); // rows: y
    const Eigen::Matrix<double, AxisPairs, Terms> alongY = PairsOf(kinds[1]) * plane;
    const Eigen::Matrix<double, AxisPairs, AxisPairs> alongZ =
      alongY * PairsOf(kinds[2]).transpose();
    for (int y = 0; y < AxisPairs; ++y)
    {
      for (int z = 0; z < AxisPairs; ++z)
      {
        result(x / 3 + 3 * (y / 3) + 9 * (z / 3), x % 3 + 3 * (y % 3) + 9 * (z % 3)) = alongZ(y, z);
      }
    }
  }
  return result;
}

SmoothElementMatrix QuadraticMoments::Pack(const Matrix& matrix)
{
  SmoothElementMatrix packed;
  for (int i = 0; i < Functions; ++i)
  {
    for (int j = i; j < Functions; ++j)
    {
      packed[PackedIndex<Functions>(i, j)] = matrix(i, j);
    }
  }
  return packed;
}

SmoothElementMatrix QuadraticMoments::Mass() const
{
  return Pack(Expand(sums_, 0, { Values, Values, Values }));
}

SmoothElementMatrix QuadraticMoments::Stiffness() const
{
  Matrix sum = bend_;
  for (int p = 0; p < 3; ++p)
  {
    std::array<int, 3> kinds{ Values, Values, Values };
    kinds[p] = Slopes;
    sum += Expand(sums_, 1 + p, kinds);
    kinds[p] = SlopeFirst;
    kinds[(p + 1) % 3] = SlopeSecond;
    const Matrix mixed = Expand(sums_, 4 + p, kinds);
    sum += mixed + mixed.transpose();
  }
  return Pack(sum);
}

} // namespace gridfem
