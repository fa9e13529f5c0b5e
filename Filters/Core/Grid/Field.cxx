#include "Grid/Field.h"

#include "Base/Errors.h"
#include "Base/VectorRows.h"
#include "Grid/TriangleArea.h"

#include <algorithm>
#include <cmath>
#include <functional>
#include <string>

namespace gridfem
{

Field CoordinatesOf(const TriangleMesh& mesh)
{
  return { FieldAssociation::Points, RowsOf(mesh.points) };
}

void RequireField(const Field& field, const TriangleMesh& mesh)
{
  const bool onPoints = field.association == FieldAssociation::Points;
  const std::size_t items = onPoints ? mesh.points.size() : mesh.triangles.size();
  const std::size_t rows = field.association == FieldAssociation::Corners ? 3 * items : items;
  if (static_cast<std::size_t>(field.values.rows()) != rows)
  {
    throw InvalidInput("The field has " + std::to_string(field.values.rows()) +
                       " rows; the mesh has " + std::to_string(items) +
                       (onPoints ? " points." : " triangles."));
  }
}

void RequireVectors(const Field& field, const TriangleMesh& mesh)
{
  RequireField(field, mesh);
  if (field.values.cols() % 3 != 0)
  {
    throw InvalidInput("The vector field has " + std::to_string(field.values.cols()) +
                       " columns; vectors need a multiple of 3.");
  }
}

void RequireScale(const Field* scale, const TriangleMesh& mesh)
{
  if (!scale)
  {
    return;
  }
  RequireField(*scale, mesh);
  if (scale->values.cols() != 1)
  {
    throw InvalidInput(
      "The gradient scale has " + std::to_string(scale->values.cols()) + " columns instead of 1.");
  }
}

void RequireWeights(const std::vector<double>& weight, const TriangleMesh& mesh)
{
  const bool areUsable = std::all_of(
    weight.begin(), weight.end(), [](double w) { return w >= 0.0 && std::isfinite(w); });
  if (weight.size() != mesh.triangles.size() || !areUsable)
  {
    throw InvalidInput("Every triangle needs a finite weight that is not negative.");
  }
}

std::vector<double> ProductOf(const std::vector<double>& a, const std::vector<double>& b)
{
  std::vector<double> product(a.size());
  std::transform(a.begin(), a.end(), b.begin(), product.begin(), std::multiplies<>());
  return product;
}

void RequireOnPoints(const Field& field, const TriangleMesh& mesh)
{
  RequireField(field, mesh);
  if (field.association != FieldAssociation::Points)
  {
    throw InvalidInput("A field that is constant on triangles has no gradient; give it on points.");
  }
}

MultiVector MeansOnCells(const TriangleMesh& mesh, const std::vector<Id>& sourceCell,
  const MultiVector& onTriangles, Id cells)
{
  MultiVector mean = MultiVector::Zero(cells, onTriangles.cols());
  std::vector<double> area(static_cast<std::size_t>(cells), 0.0);
  for (Id t = 0; t < onTriangles.rows(); ++t)
  {
    const double ofTriangle = AreaOf(mesh, t);
    if (ofTriangle > 0.0)
    {
      mean.row(sourceCell[t]) += ofTriangle * onTriangles.row(t);
      area[sourceCell[t]] += ofTriangle;
    }
  }
  for (Id cell = 0; cell < cells; ++cell)
  {
    mean.row(cell) /= area[cell]; // 0 / 0 is NaN
  }
  return mean;
}

} // namespace gridfem
