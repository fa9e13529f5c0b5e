// Holds the mesh and the arrays that a problem of the Python package is given.
#ifndef GridFEM_Given_h
#define GridFEM_Given_h

#include "Properties.h"

#include "Solvers/DynamicsSolver.h"
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
  std::shared_ptr<const TriangleMesh> reference; // of a map, or null
  std::vector<Id> sources;                       // points
  std::vector<Id> partners;                      // points of the reference, for each source
  std::vector<double> observed;                  // values at the sources, or none
  GivenReactions reactions;                      // or none

  /// @param cells  a row of ids of points for each cell, `corners` in each
  /// @param weldCoincidentPoints  joins seams (JoinSeams); cells with hanging nodes get more
  /// triangles
  void SetCells(std::vector<Vec3> points, const Id* cells, Id numberOfCells, Id corners,
    bool weldCoincidentPoints);

  /// Returns a row for each point: the row of the array, 0 if the array is on cells, or the
  /// coordinates without an array.
  MultiVector RowsAtPoints(const std::string& name) const;

  /// Returns the known rows of the array `values`, or of the coordinates without it. A row is known
  /// if it has no NaN, a cell uses its point, and the mask is neither 0 nor NaN there. Throws
  /// InvalidInput for an infinite value, for values on cells, and if no row is known.
  PointValues KnownValues(const GivenArray* mask) const;

  /// Returns the array, or null if it is not given.
  const GivenArray* Find(const std::string& name) const;

  /// Returns the array in the form that Core integrates. Values that no cell uses are 0. Throws
  /// InvalidInput, naming the first point or cell, for an infinite value and for a NaN unless it
  /// keeps NaN.
  gridfem::Field FieldOf(const std::string& name, bool keepsNaN = false) const;

  /// Returns the array for a solver. It has no components if it is not given.
  /// @param name  the name of the array, also in messages
  GivenField Field(const std::string& name) const;

  /// Returns the points where the array `mask` holds the solution at the value of `values`. None
  /// without a mask. Throws InvalidInput for a mask on cells or with several columns.
  GivenConstraints Constraints(const std::string& mask) const;

  /// Restores the given values at points that no function reaches (RowsAtPoints).
  void KeepUnsolved(
    const std::string& name, const std::vector<char>& isReached, MultiVector& values) const;

  /// If the array is not given, so that the coordinates are solved for: restores the places of
  /// points without a solution, NaN.
  void KeepPlaces(const std::string& name, MultiVector& places) const;

  /// Returns means over the cells of values on triangles, weighted by area.
  MultiVector MeansOnCells(const MultiVector& onTriangles) const;
};

} // namespace gridfem

#endif
