// Computes barycentric coordinates on source triangles.
#include "Grid/SourceTriangle.h"

#include <Eigen/Geometry>

#include <algorithm>

namespace gridfem
{

SourceTriangle::SourceTriangle(const ClippedMesh& clipped, const TriangleMesh& mesh, Id triangle)
  : clipped_(clipped), mesh_(mesh), triangle_(triangle), points_(mesh.triangles[triangle])
{
}

Barycentric SourceTriangle::Locate(Id point) const
{
  Barycentric result = { 0.0, 0.0, 0.0 };
  if (point < clipped_.numberOfInputPoints)
  {
    const int corner = this->CornerAt(point);
    if (corner < 0)
    {
      return this->LocateByPosition(point);
    }
    result[corner] = 1.0;
    return result;
  }
  const auto number = static_cast<std::size_t>(point - clipped_.numberOfInputPoints);
  if (number >= clipped_.cutPoints.size())
  {
    return this->LocateByPosition(point);
  }
  const CutPoint& cut = clipped_.cutPoints[number];
  const std::array<double, 3> weight = cut.Weights();
  if (cut.triangle == triangle_)
  {
    return weight;
  }
  for (int k = 0; k < 3; ++k)
  {
    if (weight[k] != 0.0)
    {
      const int corner = this->CornerAt(mesh_.triangles[cut.triangle][k]);
      if (corner < 0)
      {
        return this->LocateByPosition(point);
      }
      result[corner] += weight[k];
    }
  }
  return result;
}

int SourceTriangle::CornerAt(Id inputPoint) const
{
  for (int k = 0; k < 3; ++k)
  {
    if (points_[k] == inputPoint)
    {
      return k;
    }
  }
  for (int k = 0; k < 3; ++k)
  {
    if (mesh_.points[points_[k]] == mesh_.points[inputPoint])
    {
      return k;
    }
  }
  return -1;
}

Vec3 SourceTriangle::AreaVector() const
{
  const Vec3& apex = clipped_.position[points_[0]];
  return (clipped_.position[points_[1]] - apex).cross(clipped_.position[points_[2]] - apex);
}

Barycentric SourceTriangle::LocateByPosition(Id point) const
{
  const Vec3 area = this->AreaVector();
  const Vec3& p = clipped_.position[point];
  Barycentric result;
  double sum = 0.0;
  for (int k = 0; k < 3; ++k)
  {
    const Vec3 next = clipped_.position[points_[(k + 1) % 3]] - p;
    const Vec3 last = clipped_.position[points_[(k + 2) % 3]] - p;
    result[k] = std::max(0.0, area.dot(next.cross(last)));
    sum += result[k];
  }
  for (double& weight : result)
  {
    weight = sum > 0.0 ? weight / sum : 1.0 / 3.0;
  }
  return result;
}

} // namespace gridfem
