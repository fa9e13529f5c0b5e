#include "Integrals/SurfaceMetric.h"

#include "Base/Errors.h"
#include "Integrals/PatchIntegrals.h"

#include <atomic>
#include <utility>

namespace gridfem
{

namespace
{

/// A metric is singular if its determinant is outside these bounds: a fraction of the squared
/// trace, and the range in which doubles keep all digits.
constexpr double SmallestQuotient = 1e-14;
constexpr double SmallestDeterminant = 1e-300;
constexpr double LargestDeterminant = 1e300;

/// Returns the lower bound of the determinant, for a number or for lanes.
template<class Number>
Number LeastDeterminant(const Number& trace)
{
  return SmallestQuotient * trace * trace + SmallestDeterminant;
}

/// Metrics at one point of the rule on all triangles of a batch.
struct LaneMetric
{
  Lanes E;
  Lanes F;
  Lanes G;
};

/// Metrics that are checked together.
using MetricGroup = std::array<LaneMetric, BatchesAtOnce>;

/// Loads the metrics of `count` points of the rule, beginning with `point`.
void Load(
  const SampleMetric& metric, const TriangleBatch& batch, Id point, int count, MetricGroup& group)
{
  static_assert(
    sizeof(FundamentalForm) == 3 * sizeof(double) && sizeof(LaneMetric) == 3 * sizeof(Lanes));
  std::array<const double*, LaneCount> form; // E, F, G of each point in turn
  for (int lane = 0; lane < LaneCount; ++lane)
  {
    form[lane] = &metric[batch.firstSample[lane] + point].E;
  }
  Lanes* const lanes = &group[0].E;
  int number = 0;
  for (; number + LaneCount <= 3 * count; number += LaneCount)
  {
    LoadLanes(form, number, lanes + number);
  }
  for (; number < 3 * count; ++number)
  {
    for (int lane = 0; lane < LaneCount; ++lane)
    {
      lanes[number][lane] = form[lane][number];
    }
  }
}

void Store(const LaneMetric& lanes, const TriangleBatch& batch, Id point, SampleMetric& metric)
{
  for (int lane = 0; lane < batch.count; ++lane)
  {
    metric[batch.firstSample[lane] + point] = { lanes.E[lane], lanes.F[lane], lanes.G[lane] };
  }
}

Lanes Determinant(const LaneMetric& metric)
{
  return metric.E * metric.G - metric.F * metric.F;
}

/// Whether all metrics of the group are regular. It checks all lanes at once.
bool AreRegular(const MetricGroup& metric, int count)
{
  Lanes margin = Lanes::Ones();
  Lanes zero = Lanes::Zero();
  for (int k = 0; k < count; ++k)
  {
    const Lanes determinant = Determinant(metric[k]);
    const Lanes trace = metric[k].E + metric[k].G;
    margin = margin.min(metric[k].E)
               .min(determinant - LeastDeterminant(trace))
               .min(LargestDeterminant - determinant);
    zero += 0.0 * (determinant + trace);
  }
  // The minimum may miss NaN; the sum cannot.
  return margin.minCoeff() > 0.0 && zero.sum() == 0.0;
}

/// Sets the weight of samples with a singular metric to 0.
/// @return  number of these samples that had a weight
Id DropSingular(LaneMetric& metric, SampleBatch& samples)
{
  Id singular = 0;
  for (int lane = 0; lane < LaneCount; ++lane)
  {
    const double determinant = metric.E[lane] * metric.G[lane] - metric.F[lane] * metric.F[lane];
    const double trace = metric.E[lane] + metric.G[lane];
    const bool isRegular = metric.E[lane] > 0.0 && determinant < LargestDeterminant &&
                           determinant > LeastDeterminant(trace);
    if (!isRegular)
    {
      singular += samples.mass[lane] > 0.0 ? 1 : 0;
      samples.mass[lane] = 0.0;
      metric.E[lane] = metric.G[lane] = 1.0;
      metric.F[lane] = 0.0;
    }
  }
  return singular;
}

/// Sets mass and tensor of samples in the metric. On entry, the mass is the mass on the mesh.
void SetWeights(const LaneMetric& metric, const TangentBasis& basis, const LaneVector& normal,
  double normalWeight, SampleBatch& samples)
{
  const Lanes determinant = Determinant(metric);
  const Lanes inverseRoot = determinant.rsqrt();
  const Lanes over = samples.mass * inverseRoot;
  // The part along the normal does not scale, just like the stiffness of a scaled surface.
  samples.tensor = TensorInBasis(
    over * metric.G, -over * metric.F, over * metric.E, normalWeight * samples.mass, basis, normal);
  samples.mass = over * determinant;
}

/// Coefficients of an embedding on a patch, one column per coordinate.
using PatchEmbedding = Eigen::Matrix<double, FunctionsPerPatch, 3>;

/// Returns the metric of the embedding at positions in the cell.
LaneMetric MetricAt(
  const Lanes (&position)[3], const TangentBasis& basis, const PatchEmbedding& embedding)
{
  Lanes alongFirst[3] = { Lanes::Zero(), Lanes::Zero(), Lanes::Zero() };
  Lanes alongSecond[3] = { Lanes::Zero(), Lanes::Zero(), Lanes::Zero() };
  for (int axis = 0; axis < 3; ++axis)
  {
    const int first = 1 << ((axis + 1) % 3);
    const int second = 1 << ((axis + 2) % 3);
    const Lanes& s = position[(axis + 1) % 3];
    const Lanes& t = position[(axis + 2) % 3];
    const Lanes st = s * t;
    // The derivative along the axis is bilinear in the other two coordinates.
    const std::pair<int, Lanes> edges[4] = { { 0, 1.0 - s - t + st }, { first, s - st },
      { second, t - st }, { first + second, st } };
    for (int component = 0; component < 3; ++component)
    {
      Lanes slope = Lanes::Zero();
      for (const auto& [corner, factor] : edges)
      {
        slope +=
          (embedding(corner + (1 << axis), component) - embedding(corner, component)) * factor;
      }
      alongFirst[component] += slope * basis.first.axis[axis];
      alongSecond[component] += slope * basis.second.axis[axis];
    }
  }
  LaneMetric metric{ Lanes::Zero(), Lanes::Zero(), Lanes::Zero() };
  for (int component = 0; component < 3; ++component)
  {
    metric.E += alongFirst[component] * alongFirst[component];
    metric.F += alongFirst[component] * alongSecond[component];
    metric.G += alongSecond[component] * alongSecond[component];
  }
  return metric;
}

/// Returns the metric of the maps that move the source triangles of a batch, in the given basis.
LaneMetric MetricOfTriangles(const ClippedMesh& clipped, const TriangleMesh& mesh,
  const TriangleMesh& moved, const TriangleBatch& batch, const TangentBasis& basis)
{
  LaneMetric metric{ Lanes::Zero(), Lanes::Zero(), Lanes::Zero() };
  for (int lane = 0; lane < batch.count; ++lane)
  {
    const std::array<Id, 3>& corner = mesh.triangles[clipped.pieceTriangle[batch.piece[lane]]];
    const Vec3& origin = mesh.points[corner[0]];
    const Vec3 a = mesh.points[corner[1]] - origin;
    const Vec3 b = mesh.points[corner[2]] - origin;
    const Vec3 normal = a.cross(b);
    const double square = normal.squaredNorm();
    if (!(square > 0.0))
    {
      continue;
    }
    const Vec3 movedA = moved.points[corner[1]] - moved.points[corner[0]];
    const Vec3 movedB = moved.points[corner[2]] - moved.points[corner[0]];
    const auto image = [&](const LaneVector& direction) -> Vec3
    {
      const Vec3 d(direction.axis[0][lane], direction.axis[1][lane], direction.axis[2][lane]);
      return normal.dot(d.cross(b)) / square * movedA + normal.dot(a.cross(d)) / square * movedB;
    };
    const Vec3 first = image(basis.first);
    const Vec3 second = image(basis.second);
    metric.E[lane] = first.dot(first);
    metric.F[lane] = first.dot(second);
    metric.G[lane] = second.dot(second);
  }
  return metric;
}

} // namespace

SampleMetric MetricOfEmbedding(const GridFunctions& space, const QuadratureRule& rule,
  const MultiVector& embedding, const Job& job)
{
  const PatchLevel& level = space.Finest();
  if (embedding.rows() != level.numberOfFunctions || embedding.cols() != 3)
  {
    throw InvalidInput("An embedding needs three coefficients for each function of the space.");
  }
  const Id points = static_cast<Id>(rule.points.size());
  SampleMetric metric(NumberOfSamples(space.clipped, rule));
  ForEachPatch(space, rule, job,
    [&](Id patch, auto&& forEachBatch)
    {
      PatchEmbedding coefficients;
      for (int corner = 0; corner < FunctionsPerPatch; ++corner)
      {
        coefficients.row(corner) = embedding.row(level.dof[patch][corner]);
      }
      forEachBatch(
        [&](const TriangleBatch& batch)
        {
          const TangentBasis basis(TrianglePlanes(batch).normal);
          SampleBatch samples;
          for (Id point = 0; point < points; ++point)
          {
            SetPositions(batch, rule.points[point], samples);
            Store(MetricAt(samples.position, basis, coefficients), batch, point, metric);
          }
        });
    });
  return metric;
}

SampleMetric MetricOfMesh(const GridFunctions& space, const QuadratureRule& rule,
  const TriangleMesh& mesh, const TriangleMesh& moved, const Job& job)
{
  if (mesh.points.size() != moved.points.size() || mesh.triangles != moved.triangles)
  {
    throw InvalidInput(
      "A moved mesh needs the points and triangles of the mesh before the motion.");
  }
  const Id points = static_cast<Id>(rule.points.size());
  SampleMetric metric(NumberOfSamples(space.clipped, rule));
  ForEachPatch(space, rule, job,
    [&](Id, auto&& forEachBatch)
    {
      forEachBatch(
        [&](const TriangleBatch& batch)
        {
          const TangentBasis basis(TrianglePlanes(batch).normal);
          const LaneMetric ofBatch = MetricOfTriangles(space.clipped, mesh, moved, batch, basis);
          for (Id point = 0; point < points; ++point)
          {
            Store(ofBatch, batch, point, metric);
          }
        });
    });
  return metric;
}

Id IntegrateElements(const GridFunctions& space, const QuadratureRule& rule,
  const SampleMetric& metric, ElementMatrices& result, const Job& job, double normalStabilization,
  ElementParts parts)
{
  if (static_cast<Id>(metric.size()) != NumberOfSamples(space.clipped, rule))
  {
    throw InvalidInput("Every sample of the quadrature rule needs a metric.");
  }
  std::atomic<Id> singular = 0;
  IntegratePatches(space, rule, job, result, parts,
    [&](const TriangleBatch& batch, const TrianglePlanes& planes)
    {
      return [&, basis = TangentBasis(planes.normal)](Id point, int count, SampleBatch* samples)
      {
        MetricGroup group;
        Load(metric, batch, point, count, group);
        const bool areRegular = AreRegular(group, count);
        for (int k = 0; k < count; ++k)
        {
          if (!areRegular)
          {
            singular += DropSingular(group[k], samples[k]);
          }
          SetWeights(group[k], basis, planes.normal, normalStabilization, samples[k]);
        }
      };
    });
  return singular;
}

} // namespace gridfem
