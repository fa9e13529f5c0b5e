// The mesh and the arrays that a problem of the Python package is given.
#ifndef GridFEM_Given_h
#define GridFEM_Given_h

#include "Properties.h"

#include "Solvers/GivenField.h"

#include <map>
#include <memory>
#include <string>
#include <vector>

namespace gridfem
{

/// A row for each point or each cell.
struct GivenArray
{
  MultiVector values;
  bool isOnPoints = true;
};

/// Polygons with the same number of corners each, as triangles, and arrays on them.
struct Given
{
  std::shared_ptr<const TriangleMesh> mesh;
  std::vector<Id> sourceCell; // per triangle
  Id numberOfCells = 0;
  std::map<std::string, GivenArray> arrays;
  std::vector<Id> sources; // points

  /// @param cells  a row of ids of points for each cell, `corners` in each
  void SetCells(std::vector<Vec3> points, const Id* cells, Id numberOfCells, Id corners);

  /// A row for each point: the array's, or 0 if it is on cells, or the coordinates if it is not
  /// given.
  MultiVector RowsAtPoints(const std::string& name) const;

  /// The known rows of the array `values`, which is on points. A row is known when it has no NaN, a
  /// cell uses its point, and the mask is neither 0 nor NaN there. Throws InvalidInput for an
  /// infinite value, and when nothing is known.
  PointValues KnownValues(const GivenArray* mask) const;

  /// Null when it is not given.
  const GivenArray* Find(const std::string& name) const;

  /// The array as Core integrates it. Values that no cell uses are 0. Throws InvalidInput, naming
  /// the first point or cell, for an infinite value and for a NaN unless it keeps NaN.
  gridfem::Field FieldOf(const std::string& name, bool keepsNaN = false) const;

  /// The array for a solver; without components when it is not given.
  /// @param name  of the array, which messages give, too
  GivenField Field(const std::string& name) const;

  /// The points where the array `mask` holds the solution at the value of `values`. None without a
  /// mask.
  GivenConstraints Constraints(const std::string& mask) const;

  /// Gives the rows of points that no function reaches what they were given (RowsAtPoints).
  void KeepUnsolved(
    const std::string& name, const std::vector<char>& isReached, MultiVector& values) const;

  /// Means over the cells of values on triangles, weighted by area.
  MultiVector MeansOnCells(const MultiVector& onTriangles) const;
};

} // namespace gridfem

#endif
