#include "Krylov/RitzValues.h"

#include <Eigen/Eigenvalues>

#include <cmath>
#include <limits>

namespace gridfem
{

void RitzValues::AddStep(const Columns& step)
{
  for (Id c = 0; c < step.size(); ++c)
  {
    Tridiagonal& T = matrices_[c];
    if (step[c] > 0.0)
    {
      T.diagonal.push_back(1.0 / step[c] + (T.lastStep > 0.0 ? T.lastFactor / T.lastStep : 0.0));
      T.lastStep = step[c];
    }
  }
}

void RitzValues::AddFactor(const Columns& factor)
{
  for (Id c = 0; c < factor.size(); ++c)
  {
    Tridiagonal& T = matrices_[c];
    if (T.offDiagonal.size() < T.diagonal.size())
    {
      T.offDiagonal.push_back(std::sqrt(std::max(factor[c], 0.0)) / T.lastStep);
      T.lastFactor = factor[c];
    }
  }
}

Columns RitzValues::Smallest() const
{
  Columns smallest(static_cast<Id>(matrices_.size()));
  for (Id c = 0; c < smallest.size(); ++c)
  {
    const Tridiagonal& T = matrices_[c];
    smallest[c] = std::numeric_limits<double>::quiet_NaN();
    if (!T.diagonal.empty())
    {
      const auto size = static_cast<Eigen::Index>(T.diagonal.size());
      Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd> solver;
      solver.computeFromTridiagonal(Eigen::Map<const Eigen::VectorXd>(T.diagonal.data(), size),
        Eigen::Map<const Eigen::VectorXd>(T.offDiagonal.data(), size - 1), Eigen::EigenvaluesOnly);
      smallest[c] = solver.eigenvalues()[0];
    }
  }
  return smallest;
}

} // namespace gridfem
