#include "Shape/DiskSystems.h"

#include "Base/Errors.h"

#include <utility>

namespace gridfem
{
namespace
{

using Triplets = std::vector<Eigen::Triplet<double>>;

} // namespace

DiskMatrix CotangentStiffness(
  const Disk& disk, const std::vector<SideLengths>& sides, const std::vector<double>& weight)
{
  Triplets entries;
  entries.reserve(12 * disk.triangles.size());
  for (std::size_t t = 0; t < disk.triangles.size(); ++t)
  {
    for (int k = 0; k < 3; ++k)
    {
      const Index a = disk.triangles[t][k];
      const Index b = disk.triangles[t][(k + 1) % 3];
      const double value = 0.5 * weight[t] * sides[t].CotangentAt((k + 2) % 3);
      entries.emplace_back(a, a, value);
      entries.emplace_back(b, b, value);
      entries.emplace_back(a, b, -value);
      entries.emplace_back(b, a, -value);
    }
  }
  DiskMatrix stiffness(disk.NumberOfVertices(), disk.NumberOfVertices());
  stiffness.setFromTriplets(entries.begin(), entries.end());
  return stiffness;
}

void RefuseSystem()
{
  throw InvalidInput("The system of the flat map has no solution. Triangles of very different "
                     "size can cause this. Clean the mesh first.");
}

bool PinnedSystem::Factor(const DiskMatrix& matrix, const Job& job)
{
  const Id others = matrix.rows() - 1;
  const DiskMatrix part = matrix.bottomRightCorner(others, others);
  if (!factors_)
  {
    factors_ = std::make_unique<Eigen::SimplicialLDLT<DiskMatrix>>();
    factors_->analyzePattern(part);
    job.Check(0.3);
  }
  factors_->factorize(part);
  job.Check(1.0);
  return factors_->info() == Eigen::Success;
}

MultiVector PinnedSystem::Solve(const Eigen::MatrixXd& b, const Job& job) const
{
  const Id others = b.rows() - 1;
  MultiVector x = MultiVector::Zero(b.rows(), b.cols());
  x.bottomRows(others) = factors_->solve(Eigen::MatrixXd(b.bottomRows(others)));
  job.Check(1.0);
  return x;
}

InnerSystem::InnerSystem(const Disk& disk, const DiskMatrix& matrix, const Job& job)
  : disk_(disk), row_(disk.points.size(), 0)
{
  for (std::size_t k = 0; k < disk.loop.size(); ++k)
  {
    row_[disk.loop[k]] = ~static_cast<Index>(k);
  }
  for (Index& row : row_)
  {
    row = row < 0 ? row : inner_++;
  }
  Triplets among;
  Triplets across;
  for (Index column = 0; column < matrix.cols(); ++column)
  {
    for (DiskMatrix::InnerIterator entry(matrix, column); entry; ++entry)
    {
      const Index row = row_[entry.row()];
      if (row >= 0 && row_[column] >= 0)
      {
        among.emplace_back(row, row_[column], entry.value());
      }
      else if (row >= 0)
      {
        across.emplace_back(row, ~row_[column], entry.value());
      }
    }
  }
  DiskMatrix inner(inner_, inner_);
  inner.setFromTriplets(among.begin(), among.end());
  toLoop_.resize(inner_, static_cast<Index>(disk.loop.size()));
  toLoop_.setFromTriplets(across.begin(), across.end());
  job.Check(0.1);
  if (inner_ > 0)
  {
    factors_.analyzePattern(inner);
    job.Check(0.3);
    factors_.factorize(inner);
    if (factors_.info() != Eigen::Success)
    {
      RefuseSystem();
    }
  }
  job.Check(1.0);
}

Eigen::MatrixXd InnerSystem::SolveInner(const Eigen::MatrixXd& b) const
{
  return inner_ > 0 ? Eigen::MatrixXd(factors_.solve(b)) : b;
}

MultiVector InnerSystem::Solve(const Eigen::MatrixXd& b, const Job& job) const
{
  Eigen::MatrixXd inside(inner_, b.cols());
  for (Index vertex = 0; vertex < b.rows(); ++vertex)
  {
    if (row_[vertex] >= 0)
    {
      inside.row(row_[vertex]) = b.row(vertex);
    }
  }
  inside = this->SolveInner(inside);
  MultiVector values = MultiVector::Zero(b.rows(), b.cols());
  for (Index vertex = 0; vertex < b.rows(); ++vertex)
  {
    if (row_[vertex] >= 0)
    {
      values.row(vertex) = inside.row(row_[vertex]);
    }
  }
  job.Check(1.0);
  return values;
}

MultiVector InnerSystem::Extend(const Eigen::MatrixXd& onLoop, const Job& job) const
{
  const Eigen::MatrixXd inside = this->SolveInner(-(toLoop_ * onLoop));
  MultiVector values(disk_.NumberOfVertices(), onLoop.cols());
  for (Index vertex = 0; vertex < values.rows(); ++vertex)
  {
    const Index row = row_[vertex];
    values.row(vertex) =
      row < 0 ? Eigen::RowVectorXd(onLoop.row(~row)) : Eigen::RowVectorXd(inside.row(row));
  }
  job.Check(1.0);
  return values;
}

} // namespace gridfem
