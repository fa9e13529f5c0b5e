#include "Spectrum/SpectralDescriptors.h"

#include "Base/Errors.h"
#include "Base/Parallel.h"

#include <Eigen/Cholesky>

#include <cmath>
#include <limits>
#include <string>

namespace gridfem
{
namespace
{

/// An eigenvalue below this fraction of the largest is zero.
constexpr double ZeroFraction = 1e-9;

/// Zero modes are equal if they differ by less than this fraction of their largest value. It is the
/// rounding of single precision, with room.
constexpr double EqualZeroModes = 1e-5;

/// The Gram matrix of modes has unit diagonal up to the error between points. A pivot below this
/// means that a mode is a sum of others at the points.
constexpr double SmallestPivot = 1e-6;

/// Triangles whose products are summed at a time, and the largest number of sums in memory.
constexpr Id TriangleBlock = 256;
constexpr Id LargestParts = 16;

void RequireCount(int count)
{
  if (count < 1)
  {
    throw InvalidInput("The number of scales must be at least 1.");
  }
}

/// area Σ_k weight(k, j) φ_k(x)²: rows = points, a column per column of `weights`.
MultiVector WeightedSquares(const PointModes& modes, const Eigen::MatrixXd& weights, const Job& job)
{
  MultiVector result(modes.values.rows(), weights.cols());
  ParallelRanges(
    modes.values.rows(), job.threads,
    [&](Id begin, Id end)
    {
      const Id count = end - begin;
      const MultiVector squares = modes.values.middleRows(begin, count).cwiseAbs2();
      result.middleRows(begin, count).noalias() = modes.area * (squares * weights);
    },
    DefaultBlockSize, job.progress);
  return result;
}

void CheckSources(const PointModes& modes, const std::vector<Id>& sources)
{
  if (sources.empty())
  {
    throw InvalidInput("A distance needs at least one source.");
  }
  for (const Id source : sources)
  {
    if (source < 0 || source >= modes.values.rows())
    {
      throw InvalidInput("Source " + std::to_string(source) +
                         " is not a point of the mesh, which "
                         "has " +
                         std::to_string(modes.values.rows()) + " points.");
    }
  }
}

/// The smallest value over the sources of Σ weight (φ(x) - φ(y))²; infinite if no source is
/// reachable.
template<class Reachable>
std::vector<double> SquaredDistance(const PointModes& modes, const Eigen::RowVectorXd& weights,
  const std::vector<Id>& sources, int threads, Reachable&& reachable)
{
  std::vector<double> result(modes.values.rows(), std::numeric_limits<double>::infinity());
  ParallelRanges(modes.values.rows(), threads,
    [&](Id begin, Id end)
    {
      for (Id point = begin; point < end; ++point)
      {
        for (const Id source : sources)
        {
          if (reachable(point, source))
          {
            const double squared =
              (modes.values.row(point) - modes.values.row(source)).cwiseAbs2().dot(weights);
            result[point] = std::min(result[point], squared);
          }
        }
      }
    });
  return result;
}

/// Corner values of the triangles begin .. end and their sums. They are scaled so that the product
/// of the rows of two functions is the integral of their product. On a triangle of area A with
/// corner values p, q, r the integral is A/12 (pᵀp + qᵀq + rᵀr + (p+q+r)ᵀ(p+q+r)).
MultiVector CornerRows(const TriangleMesh& mesh, const MultiVector& values, Id begin, Id end)
{
  MultiVector rows(4 * (end - begin), values.cols());
  for (Id t = begin; t < end; ++t)
  {
    const auto& [i, j, k] = mesh.triangles[t];
    const double area =
      0.5 * (mesh.points[j] - mesh.points[i]).cross(mesh.points[k] - mesh.points[i]).norm();
    const double scale = std::sqrt(area / 12.0);
    auto four = rows.middleRows(4 * (t - begin), 4);
    four.row(0) = scale * values.row(i);
    four.row(1) = scale * values.row(j);
    four.row(2) = scale * values.row(k);
    four.row(3) = four.row(0) + four.row(1) + four.row(2);
  }
  return rows;
}

/// ∫ aᵀb for functions that are linear on every triangle, one column of `values` per function. The
/// first `count` functions are a, all are b. A last row has ∫ b².
Eigen::MatrixXd Products(const TriangleMesh& mesh, const MultiVector& values, Id count, int threads)
{
  const Id triangles = static_cast<Id>(mesh.triangles.size());
  const Id part = std::max(TriangleBlock, (triangles + LargestParts - 1) / LargestParts);
  return ParallelSum(
    triangles, threads, Eigen::MatrixXd(Eigen::MatrixXd::Zero(count + 1, values.cols())),
    [&](Id begin, Id end)
    {
      Eigen::MatrixXd sum = Eigen::MatrixXd::Zero(count + 1, values.cols());
      for (Id t = begin; t < end; t += TriangleBlock)
      {
        const MultiVector rows = CornerRows(mesh, values, t, std::min(end, t + TriangleBlock));
        sum.topRows(count).noalias() += rows.leftCols(count).transpose() * rows;
        sum.row(count) += rows.colwise().squaredNorm();
      }
      return sum;
    },
    part);
}

} // namespace

Index CountZeroModes(const PointModes& modes)
{
  const std::vector<double>& values = modes.eigenvalues;
  if (static_cast<Id>(values.size()) != modes.values.cols())
  {
    throw InvalidInput("There are " + std::to_string(values.size()) + " eigenvalues for " +
                       std::to_string(modes.values.cols()) + " modes.");
  }
  for (std::size_t k = 0; k < values.size(); ++k)
  {
    if (!std::isfinite(values[k]) || (k > 0 && values[k] < values[k - 1]))
    {
      throw InvalidInput("Eigenvalue " + std::to_string(k) +
                         " is not a number, or it is smaller than "
                         "the eigenvalue before.");
    }
  }
  const double last = values.empty() ? 0.0 : values.back();
  if (!(last > 0.0) || !(modes.area > 0.0))
  {
    throw InvalidInput(
      "All " + std::to_string(values.size()) +
      " modes are constants. Every component of the surface has one constant mode, so "
      "more modes than components are needed.");
  }
  Index zeros = 0;
  while (values[zeros] <= ZeroFraction * last)
  {
    ++zeros;
  }
  return zeros;
}

std::vector<double> HeatTimes(const PointModes& modes, int count)
{
  RequireCount(count);
  const double first = modes.eigenvalues[CountZeroModes(modes)];
  const double last = modes.eigenvalues.back();
  std::vector<double> times(count);
  for (int j = 0; j < count; ++j)
  {
    const double fraction = count > 1 ? double(j) / (count - 1) : 0.5;
    times[j] = 4.0 * std::log(10.0) / (last * std::pow(first / last, fraction));
  }
  return times;
}

MultiVector HeatKernelSignature(
  const PointModes& modes, const std::vector<double>& times, const Job& job)
{
  CountZeroModes(modes);
  Eigen::MatrixXd weights(modes.values.cols(), times.size());
  for (Id k = 0; k < weights.rows(); ++k)
  {
    for (Id j = 0; j < weights.cols(); ++j)
    {
      weights(k, j) = std::exp(-modes.eigenvalues[k] * times[j]);
    }
  }
  return WeightedSquares(modes, weights, job);
}

WaveBands WaveEnergies(const PointModes& modes, int count)
{
  RequireCount(count);
  const double first = std::log(modes.eigenvalues[CountZeroModes(modes)]);
  const double range = std::log(modes.eigenvalues.back()) - first;
  WaveBands bands;
  // A single multiplet has no range. Its band is as wide as a factor e.
  bands.width = range > 1e-3 ? 7.0 / 128.0 * range : 1.0;
  const double inside = range > 1e-3 ? range - 4.0 * bands.width : 0.0;
  for (int j = 0; j < count; ++j)
  {
    const double fraction = count > 1 ? double(j) / (count - 1) : 0.5;
    bands.energies.push_back(first + 0.5 * (range - inside) + fraction * inside);
  }
  return bands;
}

MultiVector WaveKernelSignature(const PointModes& modes, const WaveBands& bands, const Job& job)
{
  const Index zeros = CountZeroModes(modes);
  if (!(bands.width > 0.0))
  {
    throw InvalidInput("The width of the bands of the wave kernel must be positive.");
  }
  Eigen::MatrixXd weights = Eigen::MatrixXd::Zero(modes.values.cols(), bands.energies.size());
  for (Id j = 0; j < weights.cols(); ++j)
  {
    Eigen::VectorXd exponent(weights.rows() - zeros);
    for (Id k = zeros; k < weights.rows(); ++k)
    {
      const double distance = (bands.energies[j] - std::log(modes.eigenvalues[k])) / bands.width;
      exponent[k - zeros] = -0.5 * distance * distance;
    }
    // Weights are relative to the nearest mode, so that no band is empty.
    const Eigen::VectorXd weight = (exponent.array() - exponent.maxCoeff()).exp();
    weights.col(j).tail(weight.size()) = weight / weight.sum();
  }
  return WeightedSquares(modes, weights, job);
}

std::vector<double> BiharmonicDistance(
  const PointModes& modes, const std::vector<Id>& sources, int threads)
{
  const Index zeros = CountZeroModes(modes);
  CheckSources(modes, sources);
  Eigen::RowVectorXd weights = Eigen::RowVectorXd::Zero(modes.values.cols());
  for (Id k = zeros; k < weights.size(); ++k)
  {
    weights[k] = 1.0 / (modes.eigenvalues[k] * modes.eigenvalues[k]);
  }
  const MultiVector constants = modes.values.leftCols(zeros);
  const Eigen::RowVectorXd same = EqualZeroModes * constants.cwiseAbs().colwise().maxCoeff();
  const auto reachable = [&](Id point, Id source)
  {
    return ((constants.row(point) - constants.row(source)).cwiseAbs().array() <= same.array())
      .all();
  };
  std::vector<double> distance = SquaredDistance(modes, weights, sources, threads, reachable);
  for (double& value : distance)
  {
    value = std::isfinite(value) ? std::sqrt(value) : std::numeric_limits<double>::quiet_NaN();
  }
  return distance;
}

std::vector<double> DiffusionDistance(
  const PointModes& modes, const std::vector<Id>& sources, double time, int threads)
{
  CountZeroModes(modes);
  CheckSources(modes, sources);
  if (!(time >= 0.0))
  {
    throw InvalidInput("The diffusion time must not be negative.");
  }
  Eigen::RowVectorXd weights(modes.values.cols());
  for (Id k = 0; k < weights.size(); ++k)
  {
    weights[k] = modes.area * std::exp(-2.0 * modes.eigenvalues[k] * time);
  }
  std::vector<double> distance =
    SquaredDistance(modes, weights, sources, threads, [](Id, Id) { return true; });
  for (double& value : distance)
  {
    value = std::sqrt(value);
  }
  return distance;
}

ModeExpansion ExpandInModes(const TriangleMesh& mesh, const PointModes& modes, const MultiVector& f,
  int threads, const DistributedRows* distributed)
{
  const Id points = static_cast<Id>(mesh.points.size());
  const Id count = modes.values.cols();
  if (modes.values.rows() != points || f.rows() != points)
  {
    throw InvalidInput("Modes and functions must have a row for every point of the mesh.");
  }
  MultiVector values(points, count + f.cols());
  values << modes.values, f;
  Eigen::MatrixXd products = Products(mesh, values, count, threads);
  SumOverProcesses(distributed, products);
  const Eigen::MatrixXd gram = products.topLeftCorner(count, count);
  const Eigen::LLT<Eigen::MatrixXd> factor(gram);
  if (factor.info() != Eigen::Success ||
      factor.matrixLLT().diagonal().cwiseAbs2().minCoeff() < SmallestPivot)
  {
    throw InvalidInput("The mesh has too few points to tell " + std::to_string(count) +
                       " modes apart. Use fewer modes or a finer mesh.");
  }
  // The factor makes the modes orthonormal, each to the modes before.
  const Eigen::MatrixXd shares = factor.matrixL().solve(products.topRightCorner(count, f.cols()));
  const Eigen::RowVectorXd squares = products.row(count).tail(f.cols());
  Eigen::RowVectorXd left = (squares - shares.colwise().squaredNorm()).cwiseMax(0.0);
  ModeExpansion expansion{ factor.matrixU().solve(shares), MultiVector(count, f.cols()), {} };
  for (Id mode = count - 1; mode >= 0; --mode)
  {
    expansion.remaining.row(mode) = left.cwiseSqrt();
    left += shares.row(mode).cwiseAbs2();
  }
  expansion.norms = left.cwiseSqrt();
  return expansion;
}

MultiVector SumOfModes(
  const PointModes& modes, const MultiVector& shares, Index first, Index last, int threads)
{
  MultiVector result = MultiVector::Zero(modes.values.rows(), shares.cols());
  const Id begin = std::max<Id>(first, 0);
  const Id count = std::min<Id>(last + Id{ 1 }, shares.rows()) - begin;
  if (count > 0)
  {
    ParallelRanges(result.rows(), threads,
      [&](Id from, Id to)
      {
        result.middleRows(from, to - from).noalias() =
          modes.values.block(from, begin, to - from, count) * shares.middleRows(begin, count);
      });
  }
  return result;
}

} // namespace gridfem
