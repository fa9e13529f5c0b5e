#include "Integrals/ElementNorms.h"

namespace gridfem
{
namespace
{

using PatchRows = std::array<const double*, FunctionsPerPatch>;

/// uᵀ mass u of a patch, for column c.
double SquaredNorm(const ElementMatrix& mass, const PatchRows& row, Id c)
{
  double diagonal = 0.0;
  double others = 0.0;
  for (int i = 0; i < FunctionsPerPatch; ++i)
  {
    double below = 0.0;
    for (int j = 0; j < i; ++j)
    {
      below += mass[PackedIndex(i, j)] * row[j][c];
    }
    others += below * row[i][c];
    diagonal += mass[PackedIndex(i, i)] * row[i][c] * row[i][c];
  }
  return diagonal + 2.0 * others;
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
