#include "Integrals/DirectionalElements.h"

#include "Base/Errors.h"
#include "Integrals/PatchIntegrals.h"

#include <algorithm>
#include <cmath>

namespace gridfem
{

namespace
{

/// A direction has no part in the plane if this part is shorter than this fraction of its length.
constexpr double SmallestPart = 1e-10;

LaneVector Load(
  const std::vector<Vec3>& direction, const ClippedMesh& clipped, const TriangleBatch& batch)
{
  LaneVector result;
  for (int lane = 0; lane < LaneCount; ++lane)
  {
    Vec3 unit = Vec3::Zero();
    if (lane < batch.count)
    {
      unit = direction[clipped.pieceTriangle[batch.piece[lane]]].stableNormalized();
    }
    for (int axis = 0; axis < 3; ++axis)
    {
      result.axis[axis][lane] = unit[axis];
    }
  }
  return result;
}

/// Returns the tensors of the two directions. Each contains half of the normal's weight.
std::array<LaneTensor, 2> Split(
  const LaneVector& direction, const LaneVector& normal, double normalWeight)
{
  const TangentBasis basis(normal);
  const Lanes x = direction.Dot(basis.first);
  const Lanes y = direction.Dot(basis.second);
  const Lanes square = x * x + y * y;
  Lanes along;
  Lanes mixed;
  for (int lane = 0; lane < LaneCount; ++lane)
  {
    const bool isThere = square[lane] > SmallestPart * SmallestPart;
    along[lane] = isThere ? x[lane] * x[lane] / square[lane] : 0.5;
    mixed[lane] = isThere ? x[lane] * y[lane] / square[lane] : 0.0;
  }
  const Lanes across = 1.0 - along;
  const Lanes ofNormal = Lanes::Constant(0.5 * normalWeight);
  return { TensorInBasis(along, mixed, across, ofNormal, basis, normal),
    TensorInBasis(across, -mixed, along, ofNormal, basis, normal) };
}

bool IsUsable(double weight)
{
  return weight >= 0.0 && std::isfinite(weight);
}

} // namespace

DirectionalElements IntegrateElements(const GridFunctions& space, const QuadratureRule& rule,
  const std::vector<Vec3>& direction, const Job& job, double normalStabilization)
{
  const auto& triangles = space.clipped.pieceTriangle;
  if (!triangles.empty() &&
      *std::max_element(triangles.begin(), triangles.end()) >= static_cast<Id>(direction.size()))
  {
    throw InvalidInput("Every source triangle needs a direction.");
  }
  DirectionalElements elements;
  const Id patches = space.Finest().NumberOfPatches();
  elements.mass.resize(patches);
  elements.stiffness[0].resize(patches);
  elements.stiffness[1].resize(patches);
  ForEachPatch(space, rule, job,
    [&](Id patch, auto&& forEachBatch)
    {
      MassMoments mass;
      std::array<StiffnessMoments, 2> stiffness;
      forEachBatch(
        [&](const TriangleBatch& batch)
        {
          const TrianglePlanes planes(batch);
          const auto tensors =
            Split(Load(direction, space.clipped, batch), planes.normal, normalStabilization);
          SampleBatch samples;
          for (const QuadratureRule::Point& point : rule.points)
          {
            SetPositions(batch, point, samples);
            samples.mass = point.weight * planes.area;
            mass.Add(&samples, 1);
            for (int part = 0; part < 2; ++part)
            {
              samples.tensor = tensors[part].Times(samples.mass);
              stiffness[part].Add(&samples, 1);
            }
          }
        });
      elements.mass[patch] = mass.Matrix();
      elements.stiffness[0][patch] = stiffness[0].Matrix();
      elements.stiffness[1][patch] = stiffness[1].Matrix();
    });
  return elements;
}

void Weigh(const DirectionalElements& elements, const std::vector<ElementWeights>& weights,
  ElementMatrices& result, int threads)
{
  const bool areUsable = std::all_of(weights.begin(), weights.end(),
    [](const ElementWeights& w)
    { return IsUsable(w.mass) && IsUsable(w.stiffness[0]) && IsUsable(w.stiffness[1]); });
  if (weights.size() != elements.mass.size() || !areUsable)
  {
    throw InvalidInput("Every patch needs finite weights that are not negative.");
  }
  result.mass.resize(weights.size());
  result.stiffness.resize(weights.size());
  ParallelRanges(static_cast<Id>(weights.size()), threads,
    [&](Id begin, Id end)
    {
      for (Id patch = begin; patch < end; ++patch)
      {
        const auto& [mass, stiffness] = weights[patch];
        for (int k = 0; k < ElementEntries; ++k)
        {
          result.mass[patch][k] = mass * elements.mass[patch][k];
          result.stiffness[patch][k] = stiffness[0] * elements.stiffness[0][patch][k] +
                                       stiffness[1] * elements.stiffness[1][patch][k];
        }
      }
    });
}

} // namespace gridfem
