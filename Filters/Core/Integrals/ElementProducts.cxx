#include "Integrals/ElementProducts.h"

#include "Base/Errors.h"
#include "Base/SimdLanes.h"
#include "Integrals/PatchShares.h"

#include <string>

namespace gridfem
{
namespace
{

/// Computes share = factor x matrix x coefficients of a patch. The lanes are the patch's functions.
template<int Width>
void Multiply(double factor, const ElementMatrix& matrix,
  const std::array<Index, FunctionsPerPatch>& dof, const MultiVector& u, const PatchShare& share)
{
  std::array<Lanes, Width> sum;
  sum.fill(Lanes::Zero());
  for (int j = 0; j < FunctionsPerPatch; ++j)
  {
    Lanes column;
    for (int i = 0; i < FunctionsPerPatch; ++i)
    {
      column[i] = factor * matrix[PackedIndex(i, j)];
    }
    const double* const value = &u(dof[j], share.firstColumn);
    for (int c = 0; c < Width; ++c)
    {
      sum[c] += value[c] * column;
    }
  }
  for (int i = 0; i < FunctionsPerPatch; ++i)
  {
    for (int c = 0; c < Width; ++c)
    {
      share.value[i * Width + c] = sum[c][i];
    }
  }
}

void Check(const PatchLevel& level, const std::vector<double>& scale, const MultiVector& u)
{
  if (u.rows() != level.numberOfFunctions)
  {
    throw InvalidInput("There are " + std::to_string(u.rows()) + " coefficients for " +
                       std::to_string(level.numberOfFunctions) + " functions.");
  }
  if (!scale.empty() && static_cast<Id>(scale.size()) != level.NumberOfPatches())
  {
    throw InvalidInput("There are " + std::to_string(scale.size()) + " scales for " +
                       std::to_string(level.NumberOfPatches()) + " patches.");
  }
}

} // namespace

MultiVector MultiplyElements(const PatchLevel& level, const FunctionPlaces& places,
  const Array<ElementMatrix>& matrices, const std::vector<double>& scale, const MultiVector& u,
  int threads)
{
  Check(level, scale, u);
  MultiVector result(u.rows(), u.cols());
  std::vector<double> shares;
  ForEachPass(u.cols(),
    [&](auto columns, Id first)
    {
      constexpr int Width = decltype(columns)::value;
      shares.resize(level.NumberOfPatches() * FunctionsPerPatch * Width);
      ParallelRanges(level.NumberOfPatches(), threads,
        [&](Id begin, Id end)
        {
          for (Id patch = begin; patch < end; ++patch)
          {
            Multiply<Width>(scale.empty() ? 1.0 : scale[patch], matrices[patch], level.dof[patch],
              u, { first, shares.data() + patch * FunctionsPerPatch * Width });
          }
        });
      SumShares<Width>(shares, places, first, threads, result);
    });
  return result;
}

} // namespace gridfem
