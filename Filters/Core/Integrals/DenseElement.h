// An element matrix with all of its 64 entries, for matrix algebra.
#ifndef GridFEM_DenseElement_h
#define GridFEM_DenseElement_h

#include "Integrals/ElementMatrices.h"

namespace gridfem
{

using DenseElement = Eigen::Matrix<double, FunctionsPerPatch, FunctionsPerPatch, Eigen::RowMajor>;

inline DenseElement Unpack(const ElementMatrix& packed)
{
  DenseElement dense;
  int entry = 0;
  for (int i = 0; i < FunctionsPerPatch; ++i)
  {
    for (int j = i; j < FunctionsPerPatch; ++j)
    {
      dense(i, j) = dense(j, i) = packed[entry++];
    }
  }
  return dense;
}

inline ElementMatrix Pack(const DenseElement& dense)
{
  ElementMatrix packed;
  int entry = 0;
  for (int i = 0; i < FunctionsPerPatch; ++i)
  {
    for (int j = i; j < FunctionsPerPatch; ++j)
    {
      packed[entry++] = dense(i, j);
    }
  }
  return packed;
}

} // namespace gridfem

#endif
