#include "HatSystem.h"

#include "Dense.h"

#include <Eigen/SparseCholesky>

#include <stdexcept>

namespace gridfem::testing
{

HatSystem BuildHatSystem(const TriangleMesh& mesh)
{
  HatSystem system;
  const Array<Index> welded = WeldCoincidentPoints(mesh.points);
  system.row.assign(mesh.points.size(), -1);
  int rows = 0;
  for (const auto& triangle : mesh.triangles)
  {
    for (const Id corner : triangle)
    {
      int& row = system.row[welded[corner]];
      row = row < 0 ? rows++ : row;
    }
  }
  for (std::size_t i = 0; i < welded.size(); ++i)
  {
    system.row[i] = system.row[welded[i]];
  }
  std::vector<Eigen::Triplet<double>> mass;
  std::vector<Eigen::Triplet<double>> stiffness;
  for (const auto& triangle : mesh.triangles)
  {
    const Vec3 p[3] = { mesh.points[triangle[0]], mesh.points[triangle[1]],
      mesh.points[triangle[2]] };
    const double twiceArea = (p[1] - p[0]).cross(p[2] - p[0]).norm();
    for (int i = 0; i < 3 && twiceArea > 0.0; ++i)
    {
      for (int j = 0; j < 3; ++j)
      {
        const int row = system.row[triangle[i]];
        const int column = system.row[triangle[j]];
        mass.emplace_back(row, column, twiceArea / (i == j ? 12.0 : 24.0));
        // The gradient of hat i is the opposite edge, turned by 90 degrees, divided by twice the
        // area.
        const Vec3 edgeI = p[(i + 2) % 3] - p[(i + 1) % 3];
        const Vec3 edgeJ = p[(j + 2) % 3] - p[(j + 1) % 3];
        stiffness.emplace_back(row, column, edgeI.dot(edgeJ) / (2.0 * twiceArea));
      }
    }
  }
  system.mass.resize(rows, rows);
  system.mass.setFromTriplets(mass.begin(), mass.end());
  system.stiffness.resize(rows, rows);
  system.stiffness.setFromTriplets(stiffness.begin(), stiffness.end());
  return system;
}

Eigen::MatrixXd SolveHatPoisson(
  const TriangleMesh& mesh, const HatSystem& system, double lambda, const Eigen::MatrixXd& f)
{
  Eigen::MatrixXd values = Eigen::MatrixXd::Zero(system.mass.rows(), f.cols());
  for (std::size_t i = 0; i < mesh.points.size(); ++i)
  {
    if (system.row[i] >= 0)
    {
      values.row(system.row[i]) = f.row(i);
    }
  }
  const Eigen::SimplicialLDLT<Eigen::SparseMatrix<double>> factors(
    lambda * system.mass + system.stiffness);
  if (factors.info() != Eigen::Success)
  {
    throw std::runtime_error("The hat system could not be factored.");
  }
  const Eigen::MatrixXd solution = factors.solve(lambda * (system.mass * values));
  Eigen::MatrixXd result = Eigen::MatrixXd::Zero(f.rows(), f.cols());
  for (std::size_t i = 0; i < mesh.points.size(); ++i)
  {
    if (system.row[i] >= 0)
    {
      result.row(i) = solution.row(system.row[i]);
    }
  }
  return result;
}

std::vector<double> HatEigenvalues(const HatSystem& system, int count)
{
  const Eigen::Index block = count + 10;
  const double area = system.mass.sum();
  const double shift = 1.0 / area;
  const Eigen::SimplicialLDLT<Eigen::SparseMatrix<double>> factors(
    system.stiffness + shift * system.mass);
  if (factors.info() != Eigen::Success)
  {
    throw std::runtime_error("The hat system could not be factored.");
  }
  Eigen::MatrixXd x(system.mass.rows(), block);
  for (Eigen::Index j = 0; j < block; ++j)
  {
    for (Eigen::Index i = 0; i < x.rows(); ++i)
    {
      x(i, j) = std::sin(double((i + 1) * (j + 1)) * 0.7548776662466927);
    }
  }
  Eigen::VectorXd values = Eigen::VectorXd::Zero(block);
  for (int iteration = 0; iteration < 200; ++iteration)
  {
    const Eigen::MatrixXd y = factors.solve(system.mass * x);
    const Eigen::MatrixXd projectedMass = y.transpose() * (system.mass * y);
    const Eigen::MatrixXd projectedStiffness = y.transpose() * (system.stiffness * y);
    const DenseEigenPairs dense = DenseEigen(projectedStiffness, projectedMass);
    x = y * dense.vectors;
    const double change =
      (dense.values - values).head(count).cwiseAbs().maxCoeff<Eigen::PropagateNaN>();
    values = dense.values;
    if (change < 1e-8 * values[count - 1])
    {
      return { values.data(), values.data() + count };
    }
  }
  throw std::runtime_error("The subspace iteration did not converge.");
}

} // namespace gridfem::testing
