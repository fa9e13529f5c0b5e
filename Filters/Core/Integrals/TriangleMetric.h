// A metric that is constant on every triangle, given by tensors in space. It also defines how
// integrals over the mesh change in the metric. [T §5.1, (5.5), (5.6)]
#ifndef GridFEM_TriangleMetric_h
#define GridFEM_TriangleMetric_h

#include "Grid/Field.h"

#include <vector>

namespace gridfem
{

/// Two edges of a triangle from its first corner, and the normal.
struct TriangleFrame
{
  Vec3 a;
  Vec3 b;
  Vec3 normal; // its length is twice the area
  bool isFlat; // whether the height is at most 1e-10 of the longest edge

  TriangleFrame(const TriangleMesh& mesh, Id triangle);
};

/// Factors that turn integrals over the mesh into integrals in the metric g: ∫ √|g| u v and
/// ∫ <∇u, √|g| g⁻¹ ∇v>. Gradient fields are given as vectors in space: s represents the linear form
/// <s, ·>. The gradient of a function is therefore given in the same way for every metric.
struct TriangleMetric
{
  std::vector<double> area;            // √|g|: area in the metric over area of the mesh
  std::vector<Eigen::Matrix3d> tensor; // √|g| g⁻¹ in the plane of the triangle, 0 across it

  /// Area of the surface in the metric, in squared units of the points.
  double AreaOf(const TriangleMesh& mesh) const;

  /// Returns √|g| g⁻¹ s, the vectors of the integrals in the metric; 3 C columns.
  Field Transform(const TriangleMesh& mesh, const Field& s) const;
};

/// The restriction of a symmetric tensor to the plane of a triangle. A triangle flatter than 1e-10
/// of its longest edge has no plane; its restriction is the identity.
class PlaneTensor
{
public:
  PlaneTensor(const TriangleMesh& mesh, Id triangle, const Eigen::Matrix3d& tensor);

  /// Eigenvalues, ascending.
  std::array<double, 2> Eigenvalues() const;

  /// Whether both eigenvalues are between 1e-100 and 1e100, and the larger is less than 1e14 times
  /// the smaller. A map with such a metric stretches one direction less than 1e7 times as much as
  /// the other.
  bool IsMetric() const;

  ///@{ Entries of TriangleMetric for this triangle. The tensor must be a metric.
  double Area() const;
  Eigen::Matrix3d InverseTimesArea() const;
  ///@}

private:
  Vec3 first_ = Vec3::Zero(); // an orthonormal basis
  Vec3 second_ = Vec3::Zero();
  double E_ = 1.0;
  double F_ = 0.0;
  double G_ = 1.0;
  bool hasPlane_ = false;
};

/// Makes a symmetric tensor from six components in VTK's order: XX, YY, ZZ, XY, YZ, XZ.
Eigen::Matrix3d SymmetricTensor(const double* six);

/// Returns the metric given by tensors of six components. Tensors at points are averaged over each
/// triangle. Throws InvalidInput if one is not a metric in the plane of its triangle.
TriangleMetric MetricOfTensors(const TriangleMesh& mesh, const Field& tensors);

/// Multiplies every vector of a field with 3 C columns by matrixOf(triangle).
/// @return  on triangles, or on corners if s is on points
template<class MatrixOf>
Field MapVectors(const TriangleMesh& mesh, const Field& s, const MatrixOf& matrixOf)
{
  const auto triangles = static_cast<Id>(mesh.triangles.size());
  const bool isConstant = s.association == FieldAssociation::Triangles;
  const Id rows = isConstant ? 1 : 3;
  Field result;
  result.association = isConstant ? FieldAssociation::Triangles : FieldAssociation::Corners;
  result.values.resize(rows * triangles, s.values.cols());
  for (Id t = 0; t < triangles; ++t)
  {
    const Eigen::Matrix3d matrix = matrixOf(t);
    const std::array<Id, 3> given = s.RowsOf(t, mesh.triangles[t]);
    for (Id k = 0; k < rows; ++k)
    {
      for (Id c = 0; c < s.values.cols(); c += 3)
      {
        const Vec3 vector = s.values.row(given[k]).segment<3>(c).transpose();
        result.values.row(rows * t + k).segment<3>(c) = (matrix * vector).transpose();
      }
    }
  }
  return result;
}

/// Returns the metric of a mesh with the same triangles and moved points. It is the metric of the
/// linear map between the triangles. Area and tensor are 0 on triangles where it is singular.
/// @param singular  receives the number of triangles with area whose metric is singular
TriangleMetric MetricOfMovedTriangles(
  const TriangleMesh& mesh, const TriangleMesh& moved, Id& singular);

/// Throws InvalidInput unless the metric has an entry for every triangle of the mesh.
void RequireMetric(const TriangleMetric& metric, const TriangleMesh& mesh);

/// Returns the gradients in space of functions that are linear on each triangle, constant on
/// triangles. There are three columns for each column of the field. Triangles flatter than 1e-10
/// get 0. Throws InvalidInput for a field that is not on points.
Field GradientsOf(const TriangleMesh& mesh, const Field& f);

} // namespace gridfem

#endif
