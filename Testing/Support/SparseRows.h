// Builds sparse matrices entry by entry.
#ifndef GridFEM_Testing_SparseRows_h
#define GridFEM_Testing_SparseRows_h

#include "Algebra/SparseMatrix.h"

namespace gridfem::testing
{

class SparseRows
{
public:
  void Add(Index column, double value)
  {
    column_.push_back(column);
    value_.push_back(value);
  }
  void EndRow() { rowBegin_.push_back(static_cast<Id>(column_.size())); }

  SparseMatrix Matrix(Index columns) const
  {
    SparseMatrix A;
    A.rows = static_cast<Index>(rowBegin_.size()) - 1;
    A.columns = columns;
    A.rowBegin = rowBegin_;
    A.column = column_;
    A.value = value_;
    return A;
  }

private:
  Array<Id> rowBegin_ = Array<Id>(1, 0);
  Array<Index> column_;
  Array<double> value_;
};

} // namespace gridfem::testing

#endif
