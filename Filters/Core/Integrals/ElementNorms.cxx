#include "Integrals/ElementNorms.h"

namespace gridfem
{
namespace
{

using PatchRows = std::array<const double*, FunctionsPerPatch>;

using PatchLanes = Eigen::Array<double, FunctionsPerPatch, 1>;

/// How often an entry of row i of the packed lower triangle counts; those behind the diagonal,
/// which belong to the next rows, do not.
std::array<PatchLanes, FunctionsPerPatch> WeightsOfRows()
{
  std::array<PatchLanes, FunctionsPerPatch> weight;
  for (int i = 0; i < FunctionsPerPatch; ++i)
  {
    for (int j = 0; j < FunctionsPerPatch; ++j)
    {
      weight[i][j] = j < i ? 2.0 : j == i ? 1.0 : 0.0;
    }
  }
  return weight;
}

/// uᵀ mass u of a patch, for column c. A row of the triangle is a vector, whatever its length.
double SquaredNorm(const ElementMatrix& mass, const PatchRows& row, Id c)
{
  static const std::array<PatchLanes, FunctionsPerPatch> weight = WeightsOfRows();
  static_assert(
    PackedIndex(FunctionsPerPatch - 1, FunctionsPerPatch - 1) + 1 ==
    std::tuple_size_v<ElementMatrix>); // a vector from its first entry on fits everywhere
  PatchLanes u;
  for (int i = 0; i < FunctionsPerPatch; ++i)
  {
    u[i] = row[i][c];
  }
  PatchLanes sum = PatchLanes::Zero();
  for (int i = 0; i < FunctionsPerPatch; ++i)
  {
    sum += u[i] * weight[i] * Eigen::Map<const PatchLanes>(&mass[PackedIndex(i, 0)]);
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
          row[i] = u.data() + level.dof[patch][i] * u.cols(); // of no columns, too
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
