// The fields and point values that a solver is given on a surface. They are read when they are
// needed.
#ifndef GridFEM_GivenField_h
#define GridFEM_GivenField_h

#include "Grid/Field.h"
#include "Solvers/StageKey.h"

#include <functional>
#include <string>
#include <vector>

namespace gridfem
{

enum class NaNs
{
  Refused,
  Kept // unknown values
};

/// A field, or none. Reading may be expensive, so solvers read it only when `version` has changed.
struct GivenField
{
  /// @param field   kept
  /// @param number  another one for each content
  static GivenField Of(std::string name, Field field, std::int64_t number = 0);

  explicit operator bool() const { return components > 0; }
  bool IsOnPoints() const { return association == FieldAssociation::Points; }

  std::string name; // for messages
  FieldAssociation association = FieldAssociation::Points;
  Id components = 0; // 0: none is given
  StageKey version;
  /// Throws InvalidInput, naming the point or cell, for an infinite value and for a NaN that is
  /// refused.
  std::function<Field(NaNs)> read;
};

/// Values at some points of the mesh.
struct PointValues
{
  std::vector<Id> points;
  MultiVector values; // a row for each point
};

/// Points at which a solution has the given values, or none.
struct GivenConstraints
{
  explicit operator bool() const { return find != nullptr; }

  std::string property; // that marks the points, for messages
  StageKey version;
  std::function<PointValues()> find; // in this process; may find none. Throws InvalidInput
};

/// Adds three facts to a key: whether the field is there, where it lives, and its version.
StageKey KeyOf(const GivenField& field);
StageKey KeyOf(const GivenConstraints& constraints);

} // namespace gridfem

#endif
