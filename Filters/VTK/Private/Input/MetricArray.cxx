#include "Input/MetricArray.h"

#include "Base/Errors.h"

#include "vtkDataArray.h"

#include <cmath>
#include <limits>
#include <optional>
#include <sstream>

namespace gridfem
{
namespace
{

std::string NameOf(const InputArray& input)
{
  return "Metric Array '" + input.name + "'";
}

/// Returns the place of a row in the array: the point, or the cell of the row's triangle.
std::string PlaceOf(const InputArray& input, const InputMesh& mesh, Id row)
{
  return input.association == FieldAssociation::Points
           ? "point " + std::to_string(row)
           : "cell " + std::to_string(mesh.sourceCell[row]);
}

/// Converts nine components, row by row, to six.
Field Symmetric(const InputArray& input, const InputMesh& mesh, const Field& nine)
{
  constexpr double Rounding = 1e-5; // of floats, relative to the largest component
  constexpr int Upper[6] = { 0, 4, 8, 1, 5, 2 };
  constexpr int Lower[6] = { 0, 4, 8, 3, 7, 6 };
  Field six{ nine.association, MultiVector(nine.values.rows(), 6) };
  for (Id row = 0; row < nine.values.rows(); ++row)
  {
    const double largest = nine.values.row(row).cwiseAbs().maxCoeff();
    for (int k = 0; k < 6; ++k)
    {
      const double a = nine.values(row, Upper[k]);
      const double b = nine.values(row, Lower[k]);
      if (std::abs(a - b) > Rounding * largest)
      {
        throw InvalidInput(NameOf(input) + " is not symmetric at " + PlaceOf(input, mesh, row) +
                           ". The metric of a map with the Jacobian J is J^T J.");
      }
      six.values(row, k) = 0.5 * (a + b);
    }
  }
  return six;
}

struct Fault
{
  Id row;
  std::array<double, 2> eigenvalues;
};

/// Returns the first row that is not a metric on one of its triangles.
std::optional<Fault> FindFault(const TriangleMesh& mesh, const Field& tensors)
{
  std::optional<Fault> fault;
  for (std::size_t t = 0; t < mesh.triangles.size(); ++t)
  {
    for (const Id row : tensors.RowsOf(static_cast<Id>(t), mesh.triangles[t]))
    {
      const PlaneTensor plane(mesh, static_cast<Id>(t), SymmetricTensor(&tensors.values(row, 0)));
      if (!plane.IsMetric() && (!fault || row < fault->row))
      {
        fault = Fault{ row, plane.Eigenvalues() };
      }
    }
  }
  return fault;
}

} // namespace

TriangleMetric ReadMetric(const InputArray& input, const InputMesh& mesh)
{
  const int components = input.array->GetNumberOfComponents();
  if (components != 6 && components != 9)
  {
    throw InvalidInput(NameOf(input) + " has " + std::to_string(components) +
                       " components. A symmetric tensor has six (XX, YY, ZZ, XY, YZ, XZ) or nine.");
  }
  const Field given = ReadField(input, mesh);
  const Field tensors = components == 9 ? Symmetric(input, mesh, given) : given;
  const std::optional<Fault> fault = FindFault(*mesh.triangles, tensors);
  if (fault)
  {
    std::ostringstream message;
    message << NameOf(input) << " is not positive definite in the plane of the surface at "
            << PlaceOf(input, mesh, fault->row) << ": its eigenvalues there are "
            << fault->eigenvalues[0] << " and " << fault->eigenvalues[1]
            << ". Both must be above 0, between 1e-100 and 1e100, and less than a factor of 1e14 "
               "apart.";
    throw InvalidInput(message.str());
  }
  return MetricOfTensors(*mesh.triangles, tensors);
}

} // namespace gridfem
