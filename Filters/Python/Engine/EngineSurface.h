// What problems are given, and the surface that they are solved on.
#ifndef GridFEM_EngineSurface_h
#define GridFEM_EngineSurface_h

#include "Properties.h"

#include "Problems/Poisson.h"
#include "Problems/Requirements.h"
#include "Solvers/GivenField.h"
#include "Spaces/SpaceChoice.h"

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

struct KnownRows
{
  std::vector<Id> points;
  MultiVector values; // a row for each
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

  /// Rows for all points, what they are given, of an array; the coordinates where it is not given,
  /// and 0 where it is on cells.
  MultiVector RowsAtPoints(const std::string& name) const;

  /// Of the array `values`, which is on points: rows without a NaN, at points that a cell uses and
  /// where the mask is neither 0 nor NaN. Throws InvalidInput for an infinite value, and when
  /// nothing is known.
  KnownRows KnownValues(const GivenArray* mask) const;

  /// Null when it is not given.
  const GivenArray* Find(const std::string& name) const;

  /// The array as Core integrates it. Throws InvalidInput naming the first point or cell with an
  /// infinite value, or a NaN unless it keeps these; values that no cell uses are 0.
  gridfem::Field FieldOf(const std::string& name, bool keepsNaN = false) const;

  /// The array for a solver; without components when it is not given.
  /// @param name  of the array, which messages give, too
  GivenField Field(const std::string& name) const;

  /// The points where the array `mask` holds the solution at the value of `values`, or where no
  /// mask is given none.
  GivenConstraints Constraints(const std::string& mask) const;

  /// Gives the rows of points that no function reaches what they were given (RowsAtPoints).
  void KeepUnsolved(
    const std::string& name, const std::vector<char>& isReached, MultiVector& values) const;

  /// Means over the cells of values on triangles, weighted by area.
  MultiVector MeansOnCells(const MultiVector& onTriangles) const;
};

/// What differs from filter to filter.
struct SharedDefaults
{
  double tolerance = 1e-8; // 0: there is an Accuracy, which decides where it is 0
  int maximumIterations = 100;
  double normalStabilization = 1e-12;
  CycleType cycle = CycleType::W;
};

/// The properties that all problems have.
struct EngineOptions : EquationOptions
{
  EngineOptions(Properties& properties, const SharedDefaults& defaults);

  /// At this depth and no coarser one.
  EngineOptions AtDepth(int depth) const;

  SpaceOptions functions;
  double functionsPerPoint = EnoughToPrecondition; // of the grid below hat functions, at most
  SpaceChoice choice;
  int parameterUnits; // 0: world, 1: those of area 1, 2: those of a longest side of 1
};

/// A mesh with its function space.
class EngineSurface
{
public:
  /// Throws InvalidInput for a surface that cannot be computed on, and Aborted.
  EngineSurface(const Given& given, const EngineOptions& options, const Progress& progress);

  const TriangleMesh& Mesh() const { return *mesh; }
  const FiniteElementSpace& Space() const { return *space; }
  Job MakeJob(const Progress& progress) const { return { options.functions.threads, progress }; }

  /// A weight per squared length of the parameter units, per squared unit of length of the space.
  double WeightInSpaceUnits(double weight) const;

  /// A length in the parameter units, in the world's.
  double LengthInWorldUnits(double length) const;

  /// Gives the rows of points that no function reaches what they were given.
  void KeepUnsolved(const MultiVector& given, MultiVector& values) const;

  /// The function at the points. Points that no function reaches keep what they were given.
  MultiVector AtPoints(const MultiVector& coefficients, const MultiVector& given) const;

  const EngineOptions options; // with the depth in use
  std::shared_ptr<const TriangleMesh> mesh;
  std::shared_ptr<const FiniteElementSpace> space;
};

} // namespace gridfem

#endif
