// Sums and differences of element matrices, for tests.
#ifndef GridFEM_Testing_ElementSums_h
#define GridFEM_Testing_ElementSums_h

#include "Integrals/ElementMatrices.h"
#include "Largest.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

namespace gridfem::testing
{

inline ElementMatrices Coarsened(const PatchLevel& fine, const PatchLevel& coarse,
  const ElementMatrices& elements, int threads = 0)
{
  ElementMatrices result;
  CoarsenElements(fine, coarse, elements, result, threads);
  return result;
}

inline double LargestEntry(const Array<ElementMatrix>& matrices)
{
  double largest = 0.0;
  for (const ElementMatrix& matrix : matrices)
  {
    for (const double entry : matrix)
    {
      largest = Larger(largest, std::abs(entry));
    }
  }
  return largest;
}

/// Returns the largest difference of entries of two lists, which must have the same length.
inline double LargestDifference(const Array<ElementMatrix>& a, const Array<ElementMatrix>& b)
{
  EXPECT_EQ(a.size(), b.size());
  double difference = 0.0;
  for (std::size_t patch = 0; patch < std::min(a.size(), b.size()); ++patch)
  {
    for (int k = 0; k < ElementEntries; ++k)
    {
      difference = Larger(difference, std::abs(a[patch][k] - b[patch][k]));
    }
  }
  return difference;
}

/// Returns xᵀ A x, summed over the columns of x. A is the finest matrix with these element
/// matrices.
inline double Energy(
  const GridFunctions& space, const Array<ElementMatrix>& elements, const MultiVector& x)
{
  double energy = 0.0;
  for (std::size_t patch = 0; patch < elements.size(); ++patch)
  {
    const auto& dof = space.Finest().dof[patch];
    for (int i = 0; i < FunctionsPerPatch; ++i)
    {
      for (int j = 0; j < FunctionsPerPatch; ++j)
      {
        energy += elements[patch][PackedIndex(i, j)] * x.row(dof[i]).dot(x.row(dof[j]));
      }
    }
  }
  return energy;
}

} // namespace gridfem::testing

#endif
