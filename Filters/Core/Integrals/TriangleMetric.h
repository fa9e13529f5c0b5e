// A metric that is constant on every triangle, given by tensors in space, and what it makes of
// integrals over the mesh. [T §5.1, (5.5), (5.6)]
#ifndef GridFEM_TriangleMetric_h
#define GridFEM_TriangleMetric_h

#include "Grid/Field.h"

#include <vector>

namespace gridfem
{

/// The edges of a triangle from its first corner, and what is across them.
struct TriangleFrame
{
  Vec3 a;
  Vec3 b;
  Vec3 normal; // twice the area long
  bool isFlat; // its height is at most 1e-10 of its longest edge

  TriangleFrame(const TriangleMesh& mesh, Id triangle);
};

/// Integrals in the metric g are integrals over the mesh with these: ∫ √|g| u v and
/// ∫ <∇u, √|g| g⁻¹ ∇v>. A gradient is what its field has in space: a given s stands for the linear
/// form <s, ·>, so that the gradient of a function is given in the same way whatever the metric.
struct TriangleMetric
{
  std::vector<double> area;            // √|g|: area in the metric over area of the mesh
  std::vector<Eigen::Matrix3d> tensor; // √|g| g⁻¹ in the plane of the triangle, 0 across it

  /// Of the surface, squared units of the points.
  double AreaOf(const TriangleMesh& mesh) const;

  /// √|g| g⁻¹ s: what the metric makes of vectors, 3 C columns.
  Field Transform(const TriangleMesh& mesh, const Field& s) const;
};

/// The restriction of a symmetric tensor to the plane of a triangle. That of a triangle flatter
/// than 1e-10 of its longest edge, which has no plane, is the identity.
class PlaneTensor
{
public:
  PlaneTensor(const TriangleMesh& mesh, Id triangle, const Eigen::Matrix3d& tensor);

  /// Ascending.
  std::array<double, 2> Eigenvalues() const;

  /// Both eigenvalues are between 1e-100 and 1e100, and the larger is less than 1e14 times the
  /// smaller: such a map stretches one direction up to 1e7 times as much as the other.
  bool IsMetric() const;

  ///@{ As TriangleMetric has them; of a metric.
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

/// A symmetric tensor of six components in VTK's order: XX, YY, ZZ, XY, YZ, XZ.
Eigen::Matrix3d SymmetricTensor(const double* six);

/// The metric of tensors of six components; of tensors at points the means over the triangles
/// count. Throws InvalidInput where one is not a metric in the plane of its triangle.
TriangleMetric MetricOfTensors(const TriangleMesh& mesh, const Field& tensors);

/// matrixOf(triangle) times every vector of a field with 3 C columns.
/// @return  on triangles, or on corners where s is on points
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

/// Throws InvalidInput unless the metric has all triangles of the mesh.
void RequireMetric(const TriangleMetric& metric, const TriangleMesh& mesh);

/// Gradients in space of functions that are linear on each triangle: three columns for each of the
/// field's, constant on triangles; 0 on triangles flatter than 1e-10. Throws InvalidInput for a
/// field that is not on points.
Field GradientsOf(const TriangleMesh& mesh, const Field& f);

} // namespace gridfem

#endif
