// Marks the rows of results that a problem has no value for.
#ifndef GridFEM_UnsolvedRows_h
#define GridFEM_UnsolvedRows_h

#include "Base/Types.h"

#include <limits>
#include <vector>

namespace gridfem
{

/// Sets all rows without a flag to a value.
/// @param isSolved  a flag for each row
inline void FillRows(const std::vector<char>& isSolved, double value, MultiVector& rows)
{
  for (Id row = 0; row < rows.rows(); ++row)
  {
    if (!isSolved[static_cast<std::size_t>(row)])
    {
      rows.row(row).setConstant(value);
    }
  }
}

///@{ Makes all rows without a flag NaN.
inline void ClearRows(const std::vector<char>& isSolved, MultiVector& rows)
{
  FillRows(isSolved, std::numeric_limits<double>::quiet_NaN(), rows);
}

inline void ClearRows(const std::vector<char>& isSolved, std::vector<double>& rows)
{
  for (std::size_t row = 0; row < rows.size(); ++row)
  {
    rows[row] = isSolved[row] ? rows[row] : std::numeric_limits<double>::quiet_NaN();
  }
}
///@}

} // namespace gridfem

#endif
