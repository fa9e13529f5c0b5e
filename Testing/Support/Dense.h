// Dense copies of sparse matrices, for references that are computed densely.
#ifndef GridFEM_Testing_Dense_h
#define GridFEM_Testing_Dense_h

#include "Algebra/SparseMatrix.h"

namespace gridfem::testing
{

inline Eigen::MatrixXd Dense(const SparseMatrix& A)
{
  Eigen::MatrixXd dense = Eigen::MatrixXd::Zero(A.rows, A.columns);
  for (Index row = 0; row < A.rows; ++row)
  {
    for (Id k = A.rowBegin[row]; k < A.rowBegin[row + 1]; ++k)
    {
      dense(row, A.column[k]) += A.value[k];
    }
  }
  return dense;
}

} // namespace gridfem::testing

#endif
