#include "Given.h"

#include "Base/Errors.h"
#include "Base/VectorRows.h"
#include "Grid/CopiedTriangles.h"
#include "Grid/Field.h"
#include "Grid/JoinSeams.h"
#include "Grid/PolygonTriangles.h"

#include <algorithm>
#include <cmath>

namespace gridfem
{

void Given::SetCells(
  std::vector<Vec3> points, const Id* cells, Id count, Id corners, bool weldCoincidentPoints)
{
  auto triangles = std::make_shared<TriangleMesh>();
  triangles->points = std::move(points);
  triangles->triangles.reserve(count * (corners - 2));
  sourceCell.reserve(count * (corners - 2));
  numberOfCells = count;
  const auto add = [&](Id cell, const Triangle& triangle)
  {
    triangles->triangles.push_back(triangle);
    sourceCell.push_back(cell);
  };
  for (Id cell = 0; cell < count; ++cell)
  {
    const Id* ids = cells + cell * corners;
    if (corners == 3)
    {
      add(cell, { ids[0], ids[1], ids[2] });
    }
    else
    {
      for (const Triangle& triangle :
        TrianglesOfPolygon(triangles->points, cell, { ids, ids + corners }))
      {
        add(cell, triangle);
      }
    }
  }
  DropCopies(*triangles, sourceCell);
  if (weldCoincidentPoints)
  {
    const std::vector<Id> cellOf = sourceCell;
    const std::vector<Id> source = JoinSeams(*triangles).sourceTriangle;
    if (!source.empty())
    {
      sourceCell.resize(source.size());
      std::transform(source.begin(), source.end(), sourceCell.begin(),
        [&](Id triangle) { return cellOf[triangle]; });
    }
  }
  mesh = std::move(triangles);
}

const GivenArray* Given::Find(const std::string& name) const
{
  const auto found = arrays.find(name);
  return found == arrays.end() ? nullptr : &found->second;
}

MultiVector Given::RowsAtPoints(const std::string& name) const
{
  const GivenArray* array = this->Find(name);
  if (!array)
  {
    return RowsOf(mesh->points);
  }
  return array->isOnPoints
           ? array->values
           : MultiVector::Zero(static_cast<Id>(mesh->points.size()), array->values.cols());
}

PointValues Given::KnownValues(const GivenArray* mask) const
{
  const GivenArray* values = this->Find("values");
  if (values && !values->isOnPoints)
  {
    throw InvalidInput("values needs a row for each point.");
  }
  const MultiVector given = this->RowsAtPoints("values");
  const std::vector<char> used = UsedPoints(*mesh);
  PointValues known;
  for (Id point = 0; point < given.rows(); ++point)
  {
    const double chosen = mask ? mask->values(point, 0) : 1.0;
    if (used[point] && chosen != 0.0 && !std::isnan(chosen) && !given.row(point).hasNaN())
    {
      known.points.push_back(point);
    }
  }
  if (known.points.empty())
  {
    throw InvalidInput("No value of 'values' is known at a point of a polygon: all are NaN, "
                       "masked, or not selected.");
  }
  known.values.resize(static_cast<Id>(known.points.size()), given.cols());
  for (Id row = 0; row < known.values.rows(); ++row)
  {
    known.values.row(row) = given.row(known.points[row]);
    if (!known.values.row(row).allFinite())
    {
      throw InvalidInput("Array 'values' has a value that is not finite at point " +
                         std::to_string(known.points[row]) + ".");
    }
  }
  return known;
}

gridfem::Field Given::FieldOf(const std::string& name, bool keepsNaN) const
{
  const GivenArray& array = arrays.at(name);
  gridfem::Field field;
  field.association = array.isOnPoints ? FieldAssociation::Points : FieldAssociation::Triangles;
  const Id rows =
    array.isOnPoints ? static_cast<Id>(mesh->points.size()) : static_cast<Id>(sourceCell.size());
  field.values = MultiVector::Zero(rows, array.values.cols());
  const std::vector<char> used = array.isOnPoints ? UsedPoints(*mesh) : std::vector<char>{};
  for (Id row = 0; row < rows; ++row)
  {
    const Id source = array.isOnPoints ? row : sourceCell[row];
    for (Id c = 0; (!array.isOnPoints || used[row]) && c < array.values.cols(); ++c)
    {
      const double value = array.values(source, c);
      if (!std::isfinite(value) && !(keepsNaN && std::isnan(value)))
      {
        throw InvalidInput("Array '" + name + "' has a NaN or infinite value at " +
                           (array.isOnPoints ? "point " : "cell ") + std::to_string(source) +
                           ". Replace such values first.");
      }
      field.values(row, c) = value;
    }
  }
  return field;
}

GivenField Given::Field(const std::string& name) const
{
  GivenField field;
  if (const GivenArray* array = this->Find(name))
  {
    field.name = name;
    field.association = array->isOnPoints ? FieldAssociation::Points : FieldAssociation::Triangles;
    field.components = array->values.cols();
    field.read = [this, name](NaNs nans) { return this->FieldOf(name, nans == NaNs::Kept); };
  }
  return field;
}

GivenConstraints Given::Constraints(const std::string& mask) const
{
  GivenConstraints constraints;
  if (const GivenArray* array = this->Find(mask))
  {
    if (!array->isOnPoints || array->values.cols() != 1)
    {
      throw InvalidInput(mask + " needs a number for each point.");
    }
    constraints.property = "Constraint Array";
    constraints.find = [this, array] { return this->KnownValues(array); };
  }
  return constraints;
}

void Given::KeepUnsolved(
  const std::string& name, const std::vector<char>& isReached, MultiVector& values) const
{
  const MultiVector given = this->RowsAtPoints(name);
  for (Id point = 0; point < values.rows(); ++point)
  {
    if (!isReached[point])
    {
      values.row(point) = given.row(point);
    }
  }
}

void Given::KeepPlaces(const std::string& name, MultiVector& places) const
{
  if (!this->Find(name))
  {
    places = places.array().isNaN().select(RowsOf(mesh->points), places);
  }
}

MultiVector Given::MeansOnCells(const MultiVector& onTriangles) const
{
  return gridfem::MeansOnCells(*mesh, sourceCell, onTriangles, numberOfCells);
}

} // namespace gridfem
