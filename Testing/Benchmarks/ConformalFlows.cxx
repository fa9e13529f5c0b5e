#include "ConformalFlows.h"

#include "AlgebraicMultigrid.h"
#include "Cholmod.h"
#include "Hierarchy.h"

#include "Base/VectorRows.h"
#include "Shape/MeanCurvatureFlow.h"

#include <algorithm>
#include <stdexcept>

namespace gridfem::benchmarks
{

namespace
{

class HatFlowSystem : public MovingSystem
{
public:
  explicit HatFlowSystem(std::shared_ptr<const TriangleMesh> mesh) : mesh_(std::move(mesh))
  {
    CotangentSystem hats = AssembleCotangents(*mesh_);
    mass_ = std::move(hats.mass);
    stiffness_ = std::move(hats.stiffness);
    row_ = std::move(hats.row);
    for (const auto& triangle : mesh_->triangles)
    {
      for (int j = 0; j < 3; ++j)
      {
        for (int i = 0; i < 3; ++i)
        {
          entry_.push_back(this->EntryOf(row_[triangle[i]], row_[triangle[j]]));
        }
      }
    }
  }

  Eigen::MatrixXd Start() const override
  {
    Eigen::MatrixXd points(mass_.rows(), 3);
    for (std::size_t k = 0; k < row_.size(); ++k)
    {
      if (row_[k] >= 0)
      {
        points.row(row_[k]) = mesh_->points[k].transpose();
      }
    }
    return points;
  }

  void Move(const Eigen::MatrixXd& coefficients) override
  {
    double* const value = mass_.valuePtr();
    std::fill(value, value + mass_.nonZeros(), 0.0);
    const int* entry = entry_.data();
    for (const auto& triangle : mesh_->triangles)
    {
      const auto corner = [&](int k) -> Vec3
      { return coefficients.row(row_[triangle[k]]).transpose(); };
      const Vec3 first = corner(0);
      const double area = 0.5 * (corner(1) - first).cross(corner(2) - first).norm();
      for (int k = 0; k < 9; ++k)
      {
        value[*entry++] += area / (k % 4 == 0 ? 6.0 : 12.0); // k = 3 j + i
      }
    }
  }

  std::vector<Vec3> Points(const Eigen::MatrixXd& coefficients) const override
  {
    std::vector<Vec3> points = mesh_->points;
    for (std::size_t k = 0; k < row_.size(); ++k)
    {
      if (row_[k] >= 0)
      {
        points[k] = coefficients.row(row_[k]).transpose();
      }
    }
    return points;
  }

  double TimeOf(double worldTime) const override { return worldTime; }

private:
  int EntryOf(int row, int column) const
  {
    const int* const begin = mass_.innerIndexPtr() + mass_.outerIndexPtr()[column];
    const int* const end = mass_.innerIndexPtr() + mass_.outerIndexPtr()[column + 1];
    const int* const found = std::lower_bound(begin, end, row);
    if (found == end || *found != row)
    {
      throw std::runtime_error("A triangle without an area has no place in the matrices.");
    }
    return static_cast<int>(found - mass_.innerIndexPtr());
  }

  std::shared_ptr<const TriangleMesh> mesh_;
  std::vector<int> row_;   // per point
  std::vector<int> entry_; // of the mass, nine per triangle
};

class SpaceFlowSystem : public MovingSystem
{
public:
  SpaceFlowSystem(std::shared_ptr<const FiniteElementSpace> space, int threads)
    : space_(std::move(space)), moving_(space_->Copy()), threads_(threads)
  {
    stiffness_ = ToEigen(space_->Matrix(0, 0.0, 1.0, threads_));
    moving_->FillMatrix(0, 1.0, 0.0, rows_, threads_);
    mass_ = ToEigen(rows_);
  }

  Eigen::MatrixXd Start() const override { return space_->EmbeddingOfMesh(threads_); }

  void Move(const Eigen::MatrixXd& coefficients) override
  {
    moving_->SetMetric(coefficients, threads_, ElementParts::Mass);
    moving_->FillMatrix(0, 1.0, 0.0, rows_, threads_);
    // Rows of a symmetric matrix are its columns, and both hold their entries in ascending order.
    std::copy(rows_.value.begin(), rows_.value.end(), mass_.valuePtr());
  }

  std::vector<Vec3> Points(const Eigen::MatrixXd& coefficients) const override
  {
    const MultiVector position = space_->ValuesAtPoints(coefficients, threads_);
    std::vector<Vec3> points(position.rows());
    for (Id k = 0; k < position.rows(); ++k)
    {
      points[k] = space_->Origin() + space_->UnitLength() * RowOf(position, k);
    }
    return points;
  }

  double TimeOf(double worldTime) const override
  {
    return worldTime / (space_->UnitLength() * space_->UnitLength());
  }

private:
  std::shared_ptr<const FiniteElementSpace> space_;
  std::unique_ptr<FiniteElementSpace> moving_;
  SparseMatrix rows_; // the mass
  int threads_;
};

/// The matrix of a step, which direct and algebraic solvers share.
class MatrixFlow : public ConformalFlow
{
public:
  explicit MatrixFlow(std::shared_ptr<MovingSystem> system)
    : system_(std::move(system)), A_(system_->Stiffness())
  {
  }

  void Begin(double timeStep) override
  {
    timeStep_ = system_->TimeOf(timeStep);
    x_ = system_->Start();
    this->Update();
  }

  std::vector<Vec3> Points() const override { return system_->Points(x_); }

protected:
  void Update()
  {
    system_->Move(x_);
    const double* const mass = system_->Mass().valuePtr();
    const double* const stiffness = system_->Stiffness().valuePtr();
    double* const value = A_.valuePtr();
    for (Eigen::Index k = 0; k < A_.nonZeros(); ++k)
    {
      value[k] = mass[k] + timeStep_ * stiffness[k];
    }
  }

  std::shared_ptr<MovingSystem> system_;
  SymmetricMatrix A_;
  Eigen::MatrixXd x_;
  double timeStep_ = 0.0;
};

class CholmodFlow : public MatrixFlow
{
public:
  CholmodFlow(std::shared_ptr<MovingSystem> system, int threads)
    : MatrixFlow(std::move(system)), threads_(threads)
  {
  }

  void Begin(double timeStep) override
  {
    MatrixFlow::Begin(timeStep);
    if (!isAnalyzed_)
    {
      cholmod_.Analyze(A_);
      isAnalyzed_ = true;
    }
  }

  int Step() override
  {
    this->Update();
    SetBlasThreads(threads_);
    cholmod_.Factor(A_);
    x_ = cholmod_.Solve(system_->Mass() * x_);
    SetBlasThreads(1);
    return 0;
  }

private:
  Cholmod cholmod_;
  bool isAnalyzed_ = false;
  int threads_;
};

class AmgFlow : public MatrixFlow
{
public:
  AmgFlow(std::shared_ptr<MovingSystem> system, double tolerance)
    : MatrixFlow(std::move(system)), tolerance_(tolerance)
  {
  }

  int Step() override
  {
    this->Update();
    const auto amg = MakeBoomerAmg(A_);
    amg->Setup();
    const Eigen::MatrixXd centered = x_.rowwise() - x_.colwise().mean();
    const Eigen::MatrixXd residual = -timeStep_ * (system_->Stiffness() * x_);
    int iterations = 0;
    for (int c = 0; c < 3; ++c)
    {
      const double wanted = tolerance_ * (system_->Mass() * centered.col(c)).norm();
      Eigen::VectorXd change;
      const double tolerance = std::min(0.5, wanted / residual.col(c).norm());
      iterations = std::max(iterations, amg->Solve(residual.col(c), change, tolerance, 100));
      x_.col(c) += change;
    }
    return iterations;
  }

private:
  double tolerance_;
};

class MultigridFlow : public ConformalFlow
{
public:
  MultigridFlow(std::shared_ptr<const FiniteElementSpace> space,
    std::shared_ptr<const TriangleMesh> mesh, double tolerance, int threads)
    : space_(std::move(space)), mesh_(std::move(mesh))
  {
    options_.conformalized = true;
    options_.multigrid.threads = threads;
    options_.solve.tolerance = tolerance;
  }

  void Begin(double timeStep) override
  {
    options_.timeStep = timeStep / (space_->UnitLength() * space_->UnitLength());
    flow_.reset();
    flow_ = std::make_unique<MeanCurvatureFlow>(space_, mesh_, options_);
  }

  int Step() override
  {
    const FlowStep step = flow_->Advance(options_.multigrid.threads);
    if (step.end != FlowEnd::None || !step.converged)
    {
      throw std::runtime_error("A step of the flow by multigrid has not been made.");
    }
    return step.iterations;
  }

  std::vector<Vec3> Points() const override { return flow_->Points(options_.multigrid.threads); }

private:
  std::shared_ptr<const FiniteElementSpace> space_;
  std::shared_ptr<const TriangleMesh> mesh_;
  FlowOptions options_;
  std::unique_ptr<MeanCurvatureFlow> flow_;
};

} // namespace

std::unique_ptr<MovingSystem> MakeHatSystem(std::shared_ptr<const TriangleMesh> mesh)
{
  return std::make_unique<HatFlowSystem>(std::move(mesh));
}

std::unique_ptr<MovingSystem> MakeSpaceSystem(
  std::shared_ptr<const FiniteElementSpace> space, int threads)
{
  return std::make_unique<SpaceFlowSystem>(std::move(space), threads);
}

std::unique_ptr<ConformalFlow> MakeCholmodFlow(std::shared_ptr<MovingSystem> system, int threads)
{
  return std::make_unique<CholmodFlow>(std::move(system), threads);
}

std::unique_ptr<ConformalFlow> MakeAmgFlow(std::shared_ptr<MovingSystem> system, double tolerance)
{
  return std::make_unique<AmgFlow>(std::move(system), tolerance);
}

std::unique_ptr<ConformalFlow> MakeMultigridFlow(std::shared_ptr<const FiniteElementSpace> space,
  std::shared_ptr<const TriangleMesh> mesh, double tolerance, int threads)
{
  return std::make_unique<MultigridFlow>(std::move(space), std::move(mesh), tolerance, threads);
}

} // namespace gridfem::benchmarks
