// Finds the nearest of many points in a space of many dimensions.
#ifndef GridFEM_NearestRows_h
#define GridFEM_NearestRows_h

#include "Base/Grouping.h"
#include "Base/Job.h"

#include <vector>

namespace gridfem
{

/// Rows of numbers, grouped around about as many centers as each group has rows. The triangle
/// inequality leaves out most groups, if rows lie on a surface in their space, as modes at the
/// points of a surface do. Finding a row then costs about the root of their number.
class NearestRows
{
public:
  /// @param rows  at least one row, finite
  explicit NearestRows(const MultiVector& rows, int threads = 0);

  /// Returns for each query the nearest row, exactly but for rounding. Among rows at the same
  /// distance, it takes the row with the least index.
  /// @param queries  has as many columns as the rows; finite
  std::vector<Id> Find(const MultiVector& queries, const Job& job = {}) const;

private:
  struct Nearest
  {
    Id row = -1;
    double distance = 0.0;
  };

  void Group(const MultiVector& rows, int threads);
  MultiVector ToCenters(const MultiVector& rows) const;
  void SearchGroup(
    Index group, double toCenter, const MultiVector& queries, Id query, Nearest& nearest) const;
  Nearest Search(const MultiVector& queries, Id query, const double* toCenters,
    std::vector<std::pair<double, Index>>& order) const;

  MultiVector centers_;
  Groups groups_;             // of rows by their nearest center
  MultiVector rows_;          // in the order of the groups
  std::vector<double> away_;  // distance of each of them from its center
  std::vector<double> radii_; // of the groups
};

} // namespace gridfem

#endif
