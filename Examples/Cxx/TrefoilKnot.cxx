#include "TrefoilKnot.h"

#include <vtkCellArray.h>
#include <vtkDoubleArray.h>
#include <vtkMath.h>
#include <vtkPointData.h>
#include <vtkPoints.h>
#include <vtkVector.h>

#include <cmath>

namespace
{

constexpr int Along = 400;
constexpr int Around = 48;
constexpr double Height = 0.7; // half the distance of two strands where they cross
constexpr double TubeRadius = 0.68;
constexpr int NumberOfStripes = 18; // where strands cross, two stripes of different colors meet

vtkVector3d Center(double t)
{
  const double reach = 2 + std::cos(3 * t);
  return { reach * std::cos(2 * t), reach * std::sin(2 * t), Height * std::sin(3 * t) };
}

vtkVector3d Tangent(double t)
{
  const double reach = 2 + std::cos(3 * t);
  const double change = -3 * std::sin(3 * t);
  return { change * std::cos(2 * t) - 2 * reach * std::sin(2 * t),
    change * std::sin(2 * t) + 2 * reach * std::cos(2 * t), 3 * Height * std::cos(3 * t) };
}

void InsertRing(double t, double stripe, vtkPoints* points, vtkDoubleArray* stripes)
{
  // The tangent is nowhere parallel to z, so these directions close up after one turn.
  const vtkVector3d tangent = Tangent(t);
  const vtkVector3d outward = tangent.Cross(vtkVector3d(0, 0, 1)).Normalized();
  const vtkVector3d upward = outward.Cross(tangent).Normalized();
  const vtkVector3d center = Center(t);
  for (int j = 0; j < Around; ++j)
  {
    const double angle = 2 * vtkMath::Pi() * j / Around;
    vtkVector3d point;
    for (int c = 0; c < 3; ++c)
    {
      point[c] =
        center[c] + TubeRadius * (std::cos(angle) * outward[c] + std::sin(angle) * upward[c]);
    }
    points->InsertNextPoint(point.GetData());
    stripes->InsertNextValue(stripe);
  }
}

void InsertQuadAsTriangles(int i, int j, vtkCellArray* triangles)
{
  const vtkIdType here = i * Around;
  const vtkIdType ahead = (i + 1) % Along * Around;
  const int side = (j + 1) % Around;
  triangles->InsertNextCell({ here + j, ahead + j, ahead + side });
  triangles->InsertNextCell({ here + j, ahead + side, here + side });
}

} // namespace

vtkSmartPointer<vtkPolyData> TrefoilKnot()
{
  vtkNew<vtkPoints> points;
  points->SetDataTypeToDouble();
  vtkNew<vtkCellArray> triangles;
  vtkNew<vtkDoubleArray> stripes;
  stripes->SetName("Stripes");
  for (int i = 0; i < Along; ++i)
  {
    const double stripe = i * NumberOfStripes / Along % 2;
    InsertRing(2 * vtkMath::Pi() * i / Along, stripe, points, stripes);
    for (int j = 0; j < Around; ++j)
    {
      InsertQuadAsTriangles(i, j, triangles);
    }
  }
  auto knot = vtkSmartPointer<vtkPolyData>::New();
  knot->SetPoints(points);
  knot->SetPolys(triangles);
  knot->GetPointData()->SetScalars(stripes);
  return knot;
}
