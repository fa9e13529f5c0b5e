// The additive Schwarz matrix of a level on a device: M = Σ R_pᵀ A_p⁻¹ R_p over groups p of
// unknowns, where R_p picks a group's unknowns and A_p = R_p A R_pᵀ.
#ifndef GridFEM_Device_Schwarz_h
#define GridFEM_Device_Schwarz_h

#include "RowProducts.h"

#include <cmath>

namespace gridfem::device
{

/// Unknowns of most groups: the functions of a cell. They have memory of their own in each thread.
constexpr Index UsualGroup = 8;

/// Whether a diagonal can be divided by.
GRIDFEM_ON_DEVICE bool IsUsableDiagonal(double value)
{
  return value > 1e-200 && value < 1e200;
}

enum GroupState : unsigned char
{
  IsComplete = 0,
  IsUnresolved = 1, // directions were left out
  IsOutside = 2     // the pattern of A, which is that of M too, lacks a pair of its unknowns
};

/// Factors the block of a group and stores its inverse, in the units of the unknowns.
struct InvertGroups
{
  Index size;           // unknowns of each group
  const Index* unknown; // group after group; -1: an unused place
  Places places;        // of the matrix
  const double* value;
  const double* unit; // of each unknown
  bool needsPattern;  // M has the pattern of A
  double* work;       // size² numbers for each group; null if groups have the usual size
  float* inverse;     // size² numbers for each group
  unsigned char* state;

  GRIDFEM_ON_DEVICE void operator()(Index group) const
  {
    const Id square = Id(size) * size;
    if (size == UsualGroup)
    {
      double own[UsualGroup * UsualGroup];
      this->Invert(group, own, inverse + group * square);
    }
    else
    {
      this->Invert(group, work + group * square, inverse + group * square);
    }
  }

private:
  static constexpr Index Most = 64;

  GRIDFEM_ON_DEVICE void Invert(Index group, double* S, float* result) const
  {
    const Index* const members = unknown + Id(group) * size;
    double scale[Most];
    Index order[Most];
    this->Gather(members, S, scale, state[group]);
    const Index rank = this->Factor(S, scale, order, state[group]);
    this->InvertTriangle(S, rank);
    for (Index i = 0; i < size * size; ++i)
    {
      result[i] = 0.0f;
    }
    for (Index i = 0; i < rank; ++i)
    {
      for (Index j = 0; j <= i; ++j)
      {
        double sum = 0.0;
        for (Index k = i; k < rank; ++k)
        {
          sum += S[k * size + i] * S[k * size + j];
        }
        const Index a = order[i];
        const Index b = order[j];
        const double entry = sum * scale[a] * scale[b] * unit[members[a]] * unit[members[b]];
        result[a * size + b] = static_cast<float>(entry);
        result[b * size + a] = static_cast<float>(entry);
      }
    }
  }

  /// S = the block of A, scaled to unit diagonal. The scale of unused and unsolvable unknowns is 0.
  GRIDFEM_ON_DEVICE void Gather(
    const Index* members, double* S, double* scale, unsigned char& result) const
  {
    result = IsComplete;
    for (Index i = 0; i < size * size; ++i)
    {
      S[i] = 0.0;
    }
    for (Index i = 0; i < size; ++i)
    {
      scale[i] = 0.0;
      if (members[i] < 0)
      {
        continue;
      }
      Index found = 0;
      Index sought = 0;
      for (Index j = 0; j < size; ++j)
      {
        sought += members[j] >= 0 ? 1 : 0;
      }
      places.ForEachEntry(members[i],
        [&](Id place, Index column)
        {
          for (Index j = 0; j < size; ++j)
          {
            if (members[j] == column)
            {
              S[i * size + j] = value[place];
              ++found;
            }
          }
        });
      if (needsPattern && found < sought)
      {
        result = IsOutside;
      }
      const double diagonal = S[i * size + i];
      scale[i] = IsUsableDiagonal(diagonal) ? 1.0 / sqrt(diagonal) : 0.0;
    }
    for (Index i = 0; i < size; ++i)
    {
      for (Index j = 0; j < size; ++j)
      {
        S[i * size + j] *= scale[i] * scale[j];
      }
    }
  }

  /// Pivoted Cholesky factorization. The rows of S are exchanged as the pivots are chosen.
  /// @param order  receives the unknown of each row
  /// @return       the number of pivots
  GRIDFEM_ON_DEVICE Index Factor(
    double* S, const double* scale, Index* order, unsigned char& result) const
  {
    Index solvable = 0;
    for (Index i = 0; i < size; ++i)
    {
      order[i] = i;
      solvable += scale[i] > 0.0 ? 1 : 0;
    }
    for (Index k = 0; k < solvable; ++k)
    {
      Index best = k;
      for (Index i = k + 1; i < size; ++i)
      {
        if (S[i * size + i] > S[best * size + best])
        {
          best = i;
        }
      }
      if (!(S[best * size + best] >= SmallestDevicePivot))
      {
        result |= S[best * size + best] <= NullPivot ? IsComplete : IsUnresolved;
        return k;
      }
      this->Exchange(S, order, k, best);
      const double root = sqrt(S[k * size + k]);
      S[k * size + k] = root;
      for (Index i = k + 1; i < size; ++i)
      {
        S[i * size + k] /= root;
      }
      for (Index i = k + 1; i < size; ++i)
      {
        for (Index j = k + 1; j <= i; ++j)
        {
          S[i * size + j] -= S[i * size + k] * S[j * size + k];
          S[j * size + i] = S[i * size + j];
        }
      }
    }
    return solvable;
  }

  GRIDFEM_ON_DEVICE void Exchange(double* S, Index* order, Index a, Index b) const
  {
    if (a == b)
    {
      return;
    }
    const Index other = order[a];
    order[a] = order[b];
    order[b] = other;
    for (Index j = 0; j < size; ++j)
    {
      const double entry = S[a * size + j];
      S[a * size + j] = S[b * size + j];
      S[b * size + j] = entry;
    }
    for (Index i = 0; i < size; ++i)
    {
      const double entry = S[i * size + a];
      S[i * size + a] = S[i * size + b];
      S[i * size + b] = entry;
    }
  }

  /// Replaces the lower triangle L of the first rows by L⁻¹.
  GRIDFEM_ON_DEVICE void InvertTriangle(double* S, Index rank) const
  {
    for (Index j = 0; j < rank; ++j)
    {
      S[j * size + j] = 1.0 / S[j * size + j];
      for (Index i = j + 1; i < rank; ++i)
      {
        double sum = 0.0;
        for (Index k = j; k < i; ++k)
        {
          sum += S[i * size + k] * S[k * size + j];
        }
        S[i * size + j] = -sum / S[i * size + i];
      }
    }
  }
};

/// Adds the inverses of a set of groups to M.
struct AddInverses
{
  Places places; // of M
  Index size;
  const Index* unknown;
  const float* inverse;
  const Index* memberBegin; // of each unknown: the places of its groups that hold it
  const Index* member;
  float* sum;

  GRIDFEM_ON_DEVICE void operator()(Index slot) const
  {
    const Index row = places.rowOf[slot];
    if (row < 0)
    {
      return;
    }
    places.ForEachEntry(row,
      [&](Id place, Index column)
      {
        float entry = sum[place];
        for (Index m = memberBegin[row]; m < memberBegin[row + 1]; ++m)
        {
          const Index own = member[m];
          const Index first = own - own % size;
          for (Index j = 0; j < size; ++j)
          {
            if (unknown[first + j] == column)
            {
              entry += inverse[Id(own) * size + j];
            }
          }
        }
        sum[place] = entry;
      });
  }
};

/// Fills M with zeros, or with D⁻¹ for the diagonal D of A.
struct StartSum
{
  Places places; // of M
  const double* diagonal;
  const double* unit;
  bool isSingly;
  float* sum;

  GRIDFEM_ON_DEVICE void operator()(Index slot) const
  {
    const Index row = places.rowOf[slot];
    if (row < 0)
    {
      return;
    }
    const double own = diagonal[row];
    const bool isUsable = IsUsableDiagonal(own);
    places.ForEachEntry(row,
      [&](Id place, Index column)
      {
        sum[place] = isSingly && isUsable && column == row
                       ? static_cast<float>(unit[row] * unit[row] / own)
                       : 0.0f;
      });
  }
};

} // namespace gridfem::device

#endif
