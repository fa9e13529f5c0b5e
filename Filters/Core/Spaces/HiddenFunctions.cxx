#include "Spaces/HiddenFunctions.h"

#include "Base/Parallel.h"
#include "Integrals/DenseElement.h"
#include "Spaces/PatchOrdering.h"

#include <Eigen/Eigenvalues>

#include <cmath>

namespace gridfem
{
namespace
{

/// Cosine of the largest angle between planes that are taken for one smooth surface.
constexpr double NearlyParallel = 0.7;

/// The plane of a patch, in coordinates of its cell. Without area: normal 0.
struct Plane
{
  Vec3 normal = Vec3::Zero();
  Vec3 centre = Vec3::Zero();
};

Vec3 Corner(int corner)
{
  return Vec3(corner & 1, (corner >> 1) & 1, corner >> 2);
}

/// Row c: the corner c.
Eigen::Matrix<double, FunctionsPerPatch, 3> MakeCorners()
{
  Eigen::Matrix<double, FunctionsPerPatch, 3> corners;
  for (int c = 0; c < FunctionsPerPatch; ++c)
  {
    corners.row(c) = Corner(c);
  }
  return corners;
}

const Eigen::Matrix<double, FunctionsPerPatch, 3>& Corners()
{
  static const Eigen::Matrix<double, FunctionsPerPatch, 3> corners = MakeCorners();
  return corners;
}

/// The centre is a sum of entries, too.
Plane FitPlane(const ElementMatrix& mass, const ElementMatrix& stiffness)
{
  const Eigen::Matrix<double, 1, FunctionsPerPatch> integral = Unpack(mass).colwise().sum();
  const Eigen::Matrix3d tangential = StiffnessOfCoordinates(stiffness);
  // Not the mass: that of a metric may be any multiple.
  const double area = 0.5 * tangential.trace();
  const Eigen::Matrix3d normals = area * Eigen::Matrix3d::Identity() - tangential;
  Plane plane;
  int largest = 0;
  // Of one normal any column has the direction; of several the largest comes near their mean.
  if (integral.sum() > 0.0 && normals.diagonal().maxCoeff(&largest) > 0.0)
  {
    plane.normal = normals.col(largest).normalized();
    plane.centre = (integral * Corners()).transpose() / integral.sum();
  }
  return plane;
}

/// Turns normals so that neighbours on one smooth piece of surface agree, from the first patch of
/// each piece outwards. The patches of a function are compared with the first that is reached.
void Orient(const PatchLevel& level, const FunctionPlaces& places, std::vector<Plane>& planes)
{
  std::vector<char> isOriented(planes.size(), 0);
  std::vector<char> isVisited(level.numberOfFunctions, 0);
  std::vector<Index> front;
  const auto visitPatches = [&](Index function, const Vec3& normal)
  {
    for (Index k = places.begin[function]; k < places.begin[function + 1]; ++k)
    {
      const Index other = places.item[k] / FunctionsPerPatch;
      const double cosine = isOriented[other] ? 0.0 : normal.dot(planes[other].normal);
      if (std::abs(cosine) > NearlyParallel)
      {
        planes[other].normal *= cosine < 0.0 ? -1.0 : 1.0;
        isOriented[other] = 1;
        front.push_back(other);
      }
    }
  };
  for (Index seed = 0; seed < static_cast<Index>(planes.size()); ++seed)
  {
    if (isOriented[seed])
    {
      continue;
    }
    isOriented[seed] = 1;
    front.assign(1, seed);
    for (std::size_t next = 0; next < front.size(); ++next)
    {
      for (const Index function : level.dof[front[next]])
      {
        if (!isVisited[function])
        {
          isVisited[function] = 1;
          visitPatches(function, planes[front[next]].normal);
        }
      }
    }
  }
}

/// D (M + L) D for every patch.
Array<ElementMatrix> Scaled(const PatchLevel& level, const ElementMatrices& elements,
  const std::vector<double>& height, int threads)
{
  Array<ElementMatrix> scaled(level.NumberOfPatches());
  ParallelRanges(
    level.NumberOfPatches(), threads,
    [&](Id begin, Id end)
    {
      for (Id patch = begin; patch < end; ++patch)
      {
        std::array<double, FunctionsPerPatch> factor;
        for (int c = 0; c < FunctionsPerPatch; ++c)
        {
          factor[c] = height[level.dof[patch][c]];
        }
        scaled[patch] = ScaledEnergy(elements, patch, factor);
      }
    },
    PatchesPerBlock);
  return scaled;
}

} // namespace

Eigen::Matrix3d StiffnessOfCoordinates(const ElementMatrix& stiffness)
{
  const Eigen::Matrix<double, FunctionsPerPatch, 3> product = Unpack(stiffness) * Corners();
  return Corners().transpose() * product;
}

ElementMatrix ScaledEnergy(
  const ElementMatrices& elements, Id patch, const std::array<double, FunctionsPerPatch>& factor)
{
  ElementMatrix scaled;
  int entry = 0;
  for (int i = 0; i < FunctionsPerPatch; ++i)
  {
    for (int j = i; j < FunctionsPerPatch; ++j, ++entry)
    {
      const double energy = elements.mass[patch][entry] + elements.stiffness[patch][entry];
      scaled[entry] = factor[i] * energy * factor[j];
    }
  }
  return scaled;
}

double FlatShare(const LevelOperators& system, int threads)
{
  // Of the stiffness of the coordinates, ∫ I - n nᵀ: on a flat patch only rounding and the weight
  // of the normal are left along n.
  constexpr double FlatRatio = 1e-6;
  const std::size_t level = std::min<std::size_t>(2, system.elements.size() - 1);
  const Array<ElementMatrix>& stiffness = system.elements[level].stiffness;
  const Eigen::Vector2d flatAndAll = ParallelSum(
    static_cast<Id>(stiffness.size()), threads, Eigen::Vector2d(0.0, 0.0),
    [&](Id begin, Id end)
    {
      Eigen::Vector2d sum(0.0, 0.0);
      for (Id patch = begin; patch < end; ++patch)
      {
        const Eigen::Matrix3d coordinates = StiffnessOfCoordinates(stiffness[patch]);
        const double area = 0.5 * coordinates.trace();
        // Is the least eigenvalue above that share of the area?
        const Eigen::LLT<Eigen::Matrix3d> above(
          coordinates - FlatRatio * area * Eigen::Matrix3d::Identity());
        const bool isFlat = above.info() != Eigen::Success;
        sum += Eigen::Vector2d(isFlat ? area : 0.0, area);
      }
      return sum;
    },
    PatchesPerBlock);
  return flatAndAll[1] > 0.0 ? flatAndAll[0] / flatAndAll[1] : 0.0;
}

std::vector<double> CornerHeights(const PatchLevel& level, const FunctionPlaces& places,
  const ElementMatrices& elements, int threads)
{
  std::vector<Plane> planes(level.NumberOfPatches());
  ParallelRanges(
    level.NumberOfPatches(), threads,
    [&](Id begin, Id end)
    {
      for (Id patch = begin; patch < end; ++patch)
      {
        planes[patch] = FitPlane(elements.mass[patch], elements.stiffness[patch]);
      }
    },
    PatchesPerBlock);
  Orient(level, places, planes);
  std::vector<double> height(level.numberOfFunctions, 0.0);
  ParallelRanges(level.numberOfFunctions, threads,
    [&](Id begin, Id end)
    {
      for (Id f = begin; f < end; ++f)
      {
        double sum = 0.0;
        double integral = 0.0;
        for (Index k = places.begin[f]; k < places.begin[f + 1]; ++k)
        {
          const Index patch = places.item[k] / FunctionsPerPatch;
          const int corner = places.item[k] % FunctionsPerPatch;
          double weight = 0.0;
          for (int j = 0; j < FunctionsPerPatch; ++j)
          {
            weight += elements.mass[patch][PackedIndex(corner, j)];
          }
          const Plane& plane = planes[patch];
          sum += weight * plane.normal.dot(Corner(corner) - plane.centre);
          integral += weight;
        }
        height[f] = integral > 0.0 ? sum / integral : 0.0;
      }
    });
  return height;
}

HiddenLevels BuildHiddenLevels(
  const GridFunctions& space, const LevelOperators& system, int threads)
{
  HiddenLevels hidden;
  hidden.revision = system.revision;
  if (system.prolongation.empty())
  {
    return hidden;
  }
  hidden.height =
    CornerHeights(space.Finest(), system.places.front(), system.elements.front(), threads);
  Array<ElementMatrix> elements =
    Scaled(space.Finest(), system.elements.front(), hidden.height, threads);
  hidden.levels.resize(system.prolongation.size());
  for (std::size_t l = 1; l <= hidden.levels.size(); ++l)
  {
    elements = CoarsenElements(space.levels[l - 1], space.levels[l], elements, threads);
    MultigridLevel& level = hidden.levels[l - 1];
    level.A = system.pattern[l];
    AssembleValues(space.levels[l], system.places[l], {}, 0.0, elements, 1.0, level.A, threads);
    level.order = OrderPatches(space.levels[l]);
    if (l < system.prolongation.size())
    {
      level.prolongation = system.prolongation[l];
      level.restriction = system.restriction[l];
    }
  }
  return hidden;
}

} // namespace gridfem
