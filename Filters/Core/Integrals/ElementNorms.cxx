#include "Integrals/ElementNorms.h"

namespace gridfem
{
namespace
{

using PatchRows = std::array<const double*, FunctionsPerPatch>;

using PatchLanes = Eigen::Array<double, FunctionsPerPatch, 1>;

/// The place where row i of the packed upper triangle would begin if it had all columns.
constexpr int BeginOfRow(int i)
{
  return PackedIndex(i, i) - i;
}
static_assert(
  BeginOfRow(0) == 0 && BeginOfRow(FunctionsPerPatch - 1) + FunctionsPerPatch == ElementEntries);

/// Returns how often each entry of row i counts. Entries before the diagonal belong to earlier rows
/// and count 0 times.
std::array<PatchLanes, FunctionsPerPatch> WeightsOfRows()
{
  std::array<PatchLanes, FunctionsPerPatch> weight;
  for (int i = 0; i < FunctionsPerPatch; ++i)
  {
    for (int j = 0; j < FunctionsPerPatch; ++j)
    {
      weight[i][j] = j > i ? 2.0 : j == i ? 1.0 : 0.0;
    }
  }
  return weight;
}

/// Returns uᵀ mass u of a patch, for column c. Every row of the triangle is a vector over all
/// columns, so that no sum waits for another.
double SquaredNorm(const ElementMatrix& mass, const PatchRows& row, Id c)
{
  static const std::array<PatchLanes, FunctionsPerPatch> weight = WeightsOfRows();
  PatchLanes u;
  for (int i = 0; i < FunctionsPerPatch; ++i)
  {
    u[i] = row[i][c];
  }
  PatchLanes sum = PatchLanes::Zero();
  for (int i = 0; i < FunctionsPerPatch; ++i)
  {
    sum += u[i] * weight[i] * Eigen::Map<const PatchLanes>(&mass[BeginOfRow(i)]);
  }
  return (sum * u).sum();
}

} // namespace

Columns SquaredNorms(
  const PatchLevel& level, const Array<ElementMatrix>& mass, const MultiVector& u, int threads)
{
  return ParallelSum(level.NumberOfPatches(), threads, Columns(Columns::Zero(u.cols())),
    [&](Id begin, Id end)
    {
      Columns sums = Columns::Zero(u.cols());
      for (Id patch = begin; patch < end; ++patch)
      {
        PatchRows row;
        for (int i = 0; i < FunctionsPerPatch; ++i)
        {
          row[i] = u.data() + level.dof[patch][i] * u.cols(); // valid even without columns
        }
        for (Id c = 0; c < u.cols(); ++c)
        {
          sums[c] += SquaredNorm(mass[patch], row, c);
        }
      }
      return sums;
    });
}

} // namespace gridfem
