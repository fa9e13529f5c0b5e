#include "Spaces/HatLoad.h"

#include "Algebra/RowBuilder.h"
#include "Base/Errors.h"
#include "Base/Parallel.h"
#include "Grid/TriangleSides.h"

#include <string>

namespace gridfem
{
namespace
{

void CheckMesh(const HatFunctions& hats, const TriangleMesh& mesh)
{
  if (hats.ofPoint.size() != mesh.points.size())
  {
    throw InvalidInput("The hat functions were made from another mesh: it has " +
                       std::to_string(hats.ofPoint.size()) + " points instead of " +
                       std::to_string(mesh.points.size()) + ".");
  }
}

/// Returns the values at the corners of a triangle of a field with one column, or 1 without a
/// field.
std::array<double, 3> ScaleAtCorners(const Field* scale, const TriangleMesh& mesh, Id triangle)
{
  std::array<double, 3> value = { 1.0, 1.0, 1.0 };
  for (int k = 0; k < 3 && scale; ++k)
  {
    value[k] = scale->values(scale->RowsOf(triangle, mesh.triangles[triangle])[k], 0);
  }
  return value;
}

/// Returns the means over a triangle of φ_k times a linear function with these corner values. Entry
/// k is the weight of corner k of a second linear function in the mean of the product.
std::array<double, 3> MeansOfProducts(const std::array<double, 3>& corner)
{
  const double sum = corner[0] + corner[1] + corner[2];
  return { (sum + corner[0]) / 12.0, (sum + corner[1]) / 12.0, (sum + corner[2]) / 12.0 };
}

/// Sums addTriangle(triangle, its number, corner of the function, row of the result).
template<class AddTriangle>
MultiVector IntegrateTriangles(const HatFunctions& hats, const TriangleMesh& mesh, Id columns,
  int threads, AddTriangle&& addTriangle)
{
  MultiVector result = MultiVector::Zero(hats.Count(), columns);
  ParallelRanges(hats.Count(), threads,
    [&](Id begin, Id end)
    {
      for (Id i = begin; i < end; ++i)
      {
        for (Id k = hats.begin[i]; k < hats.begin[i + 1]; ++k)
        {
          const TriangleCorner corner = hats.corners[k];
          const HatTriangle triangle(mesh, corner.Triangle(), hats.unitLength);
          addTriangle(triangle, corner.Triangle(), corner.Corner(), result.row(i));
        }
      }
    });
  return result;
}

/// Returns ∫ <s, test(triangle, corner)> in world units.
template<class Test>
MultiVector IntegrateVectors(const HatFunctions& hats, const TriangleMesh& mesh, const Field& s,
  const Field* scale, int threads, Test&& test)
{
  CheckMesh(hats, mesh);
  RequireVectors(s, mesh);
  RequireScale(scale, mesh);
  const Id columns = s.values.cols() / 3;
  return IntegrateTriangles(hats, mesh, columns, threads,
    [&](const HatTriangle& triangle, Id number, int corner, auto sum)
    {
      const std::array<Id, 3> row = s.RowsOf(number, mesh.triangles[number]);
      const std::array<double, 3> mean = MeansOfProducts(ScaleAtCorners(scale, mesh, number));
      const Vec3 weight = test(triangle, corner) * triangle.area * hats.unitLength;
      for (Id c = 0; c < columns; ++c)
      {
        for (int k = 0; k < 3; ++k)
        {
          const double* vector = &s.values(row[k], 3 * c);
          sum[c] +=
            mean[k] * (weight[0] * vector[0] + weight[1] * vector[1] + weight[2] * vector[2]);
        }
      }
    });
}

} // namespace

MultiVector IntegrateValues(const HatFunctions& hats, const TriangleMesh& mesh, const Field& f,
  int threads, const std::vector<double>* weight)
{
  CheckMesh(hats, mesh);
  RequireField(f, mesh);
  if (weight)
  {
    RequireWeights(*weight, mesh);
  }
  return IntegrateTriangles(hats, mesh, f.values.cols(), threads,
    [&](const HatTriangle& triangle, Id number, int corner, auto sum)
    {
      const std::array<Id, 3> row = f.RowsOf(number, mesh.triangles[number]);
      const double area = (weight ? (*weight)[number] : 1.0) * triangle.area;
      for (int k = 0; k < 3; ++k)
      {
        sum += area / (k == corner ? 6.0 : 12.0) * f.values.row(row[k]);
      }
    });
}

MultiVector IntegrateGradients(const HatFunctions& hats, const TriangleMesh& mesh, const Field& s,
  const Field* scale, int threads)
{
  return IntegrateVectors(hats, mesh, s, scale, threads,
    [](const HatTriangle& triangle, int corner) { return triangle.Gradient(corner); });
}

/// Uses <n x s, ∇φ> = <s, ∇φ x n>.
MultiVector IntegrateTurnedGradients(
  const HatFunctions& hats, const TriangleMesh& mesh, const Field& s, int threads)
{
  return IntegrateVectors(hats, mesh, s, nullptr, threads,
    [](const HatTriangle& triangle, int corner)
    { return triangle.Gradient(corner).cross(triangle.areaVector.normalized()); });
}

MultiVector IntegrateGradientsOf(const HatFunctions& hats, const TriangleMesh& mesh, const Field& f,
  const Field* scale, int threads)
{
  CheckMesh(hats, mesh);
  RequireOnPoints(f, mesh);
  RequireScale(scale, mesh);
  return IntegrateTriangles(hats, mesh, f.values.cols(), threads,
    [&](const HatTriangle& triangle, Id number, int corner, auto sum)
    {
      const std::array<double, 3> value = ScaleAtCorners(scale, mesh, number);
      const double scaledArea = triangle.area * (value[0] + value[1] + value[2]) / 3.0;
      const Vec3 own = triangle.Gradient(corner);
      for (int k = 0; k < 3; ++k)
      {
        sum += scaledArea * own.dot(triangle.Gradient(k)) * f.values.row(mesh.triangles[number][k]);
      }
    });
}

EdgeSamples SampleSegments(
  const HatFunctions& hats, const TriangleMesh& mesh, const std::vector<TriangleSegment>& segments)
{
  RequireSegments(segments, mesh);
  EdgeSamples samples;
  RowBuilder rows;
  RowBuilder::Entries entries;
  for (std::size_t s = 0; s < segments.size(); ++s)
  {
    const auto& corner = mesh.triangles[segments[s].triangle];
    const Vec3& a = mesh.points[corner[0]];
    const Vec3& b = mesh.points[corner[1]];
    const Vec3& c = mesh.points[corner[2]];
    const double length =
      (PointOfSegment(segments[s], 1.0, a, b, c) - PointOfSegment(segments[s], 0.0, a, b, c))
        .norm();
    for (const GaussPoint& gauss : GaussPoints)
    {
      const Vec3 weight =
        (1.0 - gauss.position) * segments[s].from + gauss.position * segments[s].to;
      entries.clear();
      for (int k = 0; k < 3; ++k)
      {
        if (hats.ofPoint[corner[k]] >= 0 && weight[k] != 0.0)
        {
          entries.emplace_back(hats.ofPoint[corner[k]], weight[k]);
        }
      }
      rows.Append(entries);
      samples.edge.push_back(static_cast<Index>(s));
      samples.position.push_back(gauss.position);
      samples.isMiddle.push_back(0);
      samples.length.push_back(gauss.weight * length);
    }
  }
  samples.rows = rows.Finish(hats.Count());
  return samples;
}

} // namespace gridfem
