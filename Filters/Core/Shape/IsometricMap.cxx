#include "Shape/IsometricMap.h"

#include "Shape/DiskSystems.h"

#include <algorithm>
#include <cmath>
#include <deque>
#include <limits>
#include <utility>

namespace gridfem
{
namespace
{

constexpr int MostSteps = 100;
constexpr double LeastGain = 1e-3; // of the energy, by the next step

double Dot(const MultiVector& a, const MultiVector& b)
{
  return (a.array() * b.array()).sum();
}

double Determinant(const Vec2& a, const Vec2& b)
{
  return a[0] * b[1] - a[1] * b[0];
}

/// The two sides of a triangle from its first corner, as columns.
Eigen::Matrix2d SidesFrom(const std::array<Index, 3>& corner, const MultiVector& plane)
{
  Eigen::Matrix2d sides;
  for (int axis = 0; axis < 2; ++axis)
  {
    sides(axis, 0) = plane(corner[1], axis) - plane(corner[0], axis);
    sides(axis, 1) = plane(corner[2], axis) - plane(corner[0], axis);
  }
  return sides;
}

/// The largest part of a step until it turns a triangle to a line.
double PartToFlip(const Disk& disk, const MultiVector& plane, const MultiVector& step)
{
  double least = std::numeric_limits<double>::infinity();
  for (const auto& corner : disk.triangles)
  {
    const Eigen::Matrix2d side = SidesFrom(corner, plane);
    const Eigen::Matrix2d change = SidesFrom(corner, step);
    // The area after a part s of the step is p s² + q s + r.
    const double r = side.determinant();
    const double q =
      Determinant(change.col(0), side.col(1)) + Determinant(side.col(0), change.col(1));
    const double p = change.determinant();
    const double root = q * q - 4.0 * p * r;
    const double denominator = root < 0.0 ? 0.0 : std::sqrt(root) - q;
    if (denominator > 0.0)
    {
      least = std::min(least, 2.0 * r / denominator);
    }
  }
  return least;
}

/// Directions from gradients and what earlier steps have shown [Nocedal and Wright, L-BFGS].
class StepMemory
{
public:
  void Clear() { steps_.clear(); }

  void Add(MultiVector step, MultiVector change)
  {
    constexpr std::size_t Most = 5;
    const double product = Dot(step, change);
    if (product > 0.0)
    {
      steps_.push_back({ std::move(step), std::move(change), 1.0 / product });
    }
    if (steps_.size() > Most)
    {
      steps_.pop_front();
    }
  }

  /// @param solve  solves with an approximate second derivative
  template<class Solve>
  MultiVector Direction(MultiVector gradient, Solve&& solve) const
  {
    std::vector<double> part(steps_.size());
    for (std::size_t k = steps_.size(); k-- > 0;)
    {
      part[k] = steps_[k].scale * Dot(steps_[k].step, gradient);
      gradient -= part[k] * steps_[k].change;
    }
    MultiVector direction = solve(gradient);
    for (std::size_t k = 0; k < steps_.size(); ++k)
    {
      direction += (part[k] - steps_[k].scale * Dot(steps_[k].change, direction)) * steps_[k].step;
    }
    return -direction;
  }

private:
  struct Step
  {
    MultiVector step;
    MultiVector change; // of the gradient
    double scale;
  };
  std::deque<Step> steps_;
};

class IsometricSearch
{
public:
  IsometricSearch(const Disk& disk, const std::vector<SideLengths>& sides)
    : disk_(disk), sides_(sides), weight_(sides.size())
  {
    for (const SideLengths& triangle : sides)
    {
      const auto flat = triangle.InPlane();
      Eigen::Matrix2d shape;
      shape << flat[1] - flat[0], flat[2] - flat[0];
      fromSides_.push_back(shape.inverse());
      areas_.push_back(triangle.Area());
      area_ += areas_.back();
    }
  }

  /// The energy beyond its least. Infinite if a triangle is flipped.
  double EnergyOf(const MultiVector& plane) const
  {
    double energy = 0.0;
    for (std::size_t t = 0; t < areas_.size(); ++t)
    {
      const Eigen::Matrix2d J = SidesFrom(disk_.triangles[t], plane) * fromSides_[t];
      const double size = J.determinant();
      if (!(size > 0.0))
      {
        return std::numeric_limits<double>::infinity();
      }
      energy += areas_[t] * (J.squaredNorm() * (1.0 + 1.0 / (size * size)) - 4.0);
    }
    return energy;
  }

  PlaneMap Run(MultiVector plane, const Job& job)
  {
    PlaneMap map{ std::move(plane), false };
    double energy = this->EnergyOf(map.plane);
    if (!std::isfinite(energy))
    {
      map.gain = std::numeric_limits<double>::quiet_NaN();
      return map;
    }
    this->Differentiate(map.plane);
    for (; map.steps < MostSteps; ++map.steps)
    {
      const Job part = job.Part(
        static_cast<double>(map.steps) / MostSteps, static_cast<double>(map.steps + 1) / MostSteps);
      const MultiVector step = this->NextStep(part);
      const double slope = Dot(gradient_, step);
      constexpr double Rounding = 1e-12; // of a sum over all triangles
      map.gain = energy > 0.0 ? -0.5 * slope / energy : 0.0;
      map.hasConverged = -0.5 * slope <= std::max(LeastGain * energy, Rounding * area_);
      if (map.hasConverged || !this->Advance(step, slope, energy, map.plane))
      {
        break;
      }
    }
    return map;
  }

private:
  /// Finds the gradient, and the weight of each triangle in the approximate second derivative.
  void Differentiate(const MultiVector& plane)
  {
    gradient_.setZero(plane.rows(), 2);
    for (std::size_t t = 0; t < areas_.size(); ++t)
    {
      const auto& corner = disk_.triangles[t];
      const Eigen::Matrix2d J = SidesFrom(corner, plane) * fromSides_[t];
      const double size = J.determinant();
      const double square = J.squaredNorm();
      Eigen::Matrix2d ofSize; // the derivative of the determinant
      ofSize << J(1, 1), -J(1, 0), -J(0, 1), J(0, 0);
      const Eigen::Matrix2d derivative =
        2.0 * (1.0 + 1.0 / (size * size)) * J - 2.0 * square / (size * size * size) * ofSize;
      const Eigen::Matrix2d pull = areas_[t] * derivative * fromSides_[t].transpose();
      for (int axis = 0; axis < 2; ++axis)
      {
        gradient_(corner[1], axis) += pull(axis, 0);
        gradient_(corner[2], axis) += pull(axis, 1);
        gradient_(corner[0], axis) -= pull(axis, 0) + pull(axis, 1);
      }
      // The smaller singular value s counts: a spring from s to 1 has this derivative.
      const double sum = std::sqrt(square + 2.0 * size);
      const double difference = std::sqrt(std::max(square - 2.0 * size, 0.0));
      const double large = 0.5 * (sum + difference);
      const double small = size / large;
      constexpr double Most = 1e12;
      weight_[t] = std::min(2.0 * (1.0 + 1.0 / small) * (1.0 + 1.0 / (small * small)), Most);
    }
  }

  MultiVector NextStep(const Job& job)
  {
    if (!system_.Factor(CotangentStiffness(disk_, sides_, weight_), job.Part(0.0, 0.8)))
    {
      return MultiVector::Constant(
        gradient_.rows(), 2, std::numeric_limits<double>::quiet_NaN()); // ends the search
    }
    return memory_.Direction(gradient_,
      [&](const MultiVector& b) { return system_.Solve(Eigen::MatrixXd(b), job.Part(0.8, 1.0)); });
  }

  /// Moves the map along a step until the energy falls as the slope promises.
  /// @return false if it does not
  bool Advance(const MultiVector& step, double slope, double& energy, MultiVector& plane)
  {
    constexpr double OfFlip = 0.8;
    constexpr double OfPromise = 1e-4;
    constexpr int MostHalvings = 30;
    double part = std::min(1.0, OfFlip * PartToFlip(disk_, plane, step));
    for (int k = 0; k < MostHalvings && slope < 0.0; ++k, part *= 0.5)
    {
      const MultiVector next = plane + part * step;
      const double after = this->EnergyOf(next);
      if (!(after <= energy + OfPromise * part * slope))
      {
        continue;
      }
      const MultiVector before = gradient_;
      MultiVector taken = next - plane;
      plane = next;
      energy = after;
      this->Differentiate(plane);
      constexpr double Whole = 0.25; // shorter steps tell little about whole ones
      if (part < Whole)
      {
        memory_.Clear();
      }
      else
      {
        memory_.Add(std::move(taken), gradient_ - before);
      }
      return true;
    }
    return false;
  }

  const Disk& disk_;
  const std::vector<SideLengths>& sides_;
  std::vector<Eigen::Matrix2d> fromSides_; // the inverse of the sides of each triangle
  std::vector<double> areas_;
  double area_ = 0.0;
  MultiVector gradient_;
  std::vector<double> weight_;
  PinnedSystem system_;
  StepMemory memory_;
};

} // namespace

PlaneMap MapIsometrically(
  const Disk& disk, const std::vector<SideLengths>& sides, MultiVector start, const Job& job)
{
  return IsometricSearch(disk, sides).Run(std::move(start), job);
}

} // namespace gridfem
