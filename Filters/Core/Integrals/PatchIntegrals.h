// Loops of all integrals over the clipped mesh. They go patch by patch, so that each patch has its
// own sums, and process several triangles at once, one per SIMD lane.
#ifndef GridFEM_PatchIntegrals_h
#define GridFEM_PatchIntegrals_h

#include "Base/Grouping.h"
#include "Base/Job.h"
#include "Base/Prefetch.h"
#include "Base/SimdLanes.h"
#include "Grid/GridFunctions.h"
#include "Integrals/ElementMatrices.h"
#include "Integrals/PatchMoments.h"
#include "Integrals/QuadratureSamples.h"
#include "Integrals/TangentPlane.h"

namespace gridfem
{

/// Fan triangles of one patch. Lanes from `count` on repeat the first triangle with zero area.
struct TriangleBatch
{
  Lanes corner[3][3]; // [corner][axis], in the cell's own coordinates
  Index piece[LaneCount];
  Id firstSample[LaneCount]; // see FirstSample
  int count = 0;
};

/// The planes of a batch's triangles.
struct TrianglePlanes
{
  LaneVector normal; // unit vector; 0 or shorter for a triangle with hardly any area
  Lanes area;        // grid units

  explicit TrianglePlanes(const TriangleBatch& batch)
  {
    LaneVector u;
    LaneVector v;
    for (int axis = 0; axis < 3; ++axis)
    {
      u.axis[axis] = batch.corner[1][axis] - batch.corner[0][axis];
      v.axis[axis] = batch.corner[2][axis] - batch.corner[0][axis];
    }
    for (int p = 0; p < 3; ++p)
    {
      const int q = (p + 1) % 3;
      const int r = (p + 2) % 3;
      normal.axis[p] = u.axis[q] * v.axis[r] - u.axis[r] * v.axis[q];
    }
    const Lanes square = normal.Dot(normal);
    const Lanes inverse = square.max(1e-300).rsqrt(); // finite, so that 0 times it is 0
    for (Lanes& component : normal.axis)
    {
      component *= inverse;
    }
    area = 0.5 * square * inverse;
  }
};

/// Computes the positions of one point of the rule on all triangles of a batch.
inline void SetPositions(
  const TriangleBatch& batch, const QuadratureRule::Point& point, SampleBatch& samples)
{
  for (int axis = 0; axis < 3; ++axis)
  {
    samples.position[axis] = point.barycentric[0] * batch.corner[0][axis] +
                             point.barycentric[1] * batch.corner[1][axis] +
                             point.barycentric[2] * batch.corner[2][axis];
  }
}

/// Number of corners prefetched for every piece. It is fixed, so that no branch needs to be
/// predicted.
constexpr Index UsualCorners = 4;

/// Prefetches the corners of a piece, which may lie anywhere in memory. The mesh must have at least
/// UsualCorners corners.
EIGEN_ALWAYS_INLINE void FetchCorners(const ClippedMesh& clipped, Index piece)
{
  const Index last = static_cast<Index>(clipped.corners.size()) - UsualCorners;
  const Index first = std::min(clipped.pieceBegin[piece], last);
  for (Index k = first; k < first + UsualCorners; ++k)
  {
    Fetch(&clipped.position[clipped.corners[k]]);
  }
}

/// Calls body(batch) for the fan triangles of some pieces, several triangles at a time.
/// @param listEnd  end of the whole list; corners of later pieces in it are prefetched
template<class Body>
void ForEachBatch(const ClippedMesh& clipped, const Index* pieceBegin, const Index* pieceEnd,
  const Index* listEnd, const Vec3& origin, const QuadratureRule& rule, Body&& body)
{
  const Id points = static_cast<Id>(rule.points.size());
  TriangleBatch batch;
  const auto setCorner = [&](int corner, const Vec3& position)
  {
    for (int axis = 0; axis < 3; ++axis)
    {
      batch.corner[corner][axis][batch.count] = position[axis];
    }
  };
  for (const Index* piece = pieceBegin; piece < pieceEnd; ++piece)
  {
    constexpr int Ahead = 16; // this many pieces have more than enough corners
    if (listEnd - piece > Ahead)
    {
      FetchCorners(clipped, piece[Ahead]);
    }
    const Index* corner = clipped.corners.data() + clipped.pieceBegin[*piece];
    const Index count = clipped.pieceBegin[*piece + 1] - clipped.pieceBegin[*piece];
    const Vec3 apex = clipped.position[corner[0]] - origin;
    Vec3 second = clipped.position[corner[1]] - origin;
    for (Index k = 1; k + 1 < count; ++k)
    {
      const Vec3 third = clipped.position[corner[k + 1]] - origin;
      setCorner(0, apex);
      setCorner(1, second);
      setCorner(2, third);
      second = third;
      batch.piece[batch.count] = *piece;
      batch.firstSample[batch.count] = FirstSample(clipped, *piece, rule) + (k - 1) * points;
      if (++batch.count == LaneCount)
      {
        body(batch);
        batch.count = 0;
      }
    }
  }
  if (batch.count > 0)
  {
    std::fill(batch.piece + batch.count, batch.piece + LaneCount, batch.piece[0]);
    std::fill(batch.firstSample + batch.count, batch.firstSample + LaneCount, batch.firstSample[0]);
    for (int axis = 0; axis < 3; ++axis)
    {
      for (auto& corner : batch.corner)
      {
        corner[axis].tail(LaneCount - batch.count).setZero();
      }
    }
    body(batch);
  }
}

/// Calls body(patch, forEachBatch) for every finest patch, in parallel. forEachBatch(body) calls
/// ForEachBatch on the pieces of the patch, relative to the lowest corner of its cell.
template<class Body>
void ForEachPatch(
  const GridFunctions& space, const QuadratureRule& rule, const Job& job, Body&& body)
{
  const PatchLevel& level = space.Finest();
  const Groups pieces = GroupItems(space.piecePatch, level.NumberOfPatches(), job.threads);
  ParallelRanges(
    level.NumberOfPatches(), job.threads,
    [&](Id begin, Id end)
    {
      for (Id patch = begin; patch < end; ++patch)
      {
        const Index* const items = pieces.item.data();
        body(patch,
          [&](auto&& onBatch)
          {
            ForEachBatch(space.clipped, items + pieces.begin[patch],
              items + pieces.begin[patch + 1], items + pieces.item.size(),
              CellCorner(level.cell[patch]), rule, onBatch);
          });
      }
    },
    PatchesPerBlock, job.progress);
}

/// Returns the numbers of a batch's source triangles; null: 1.
inline Lanes OnBatch(
  const ClippedMesh& clipped, const TriangleBatch& batch, const std::vector<double>* onTriangles)
{
  Lanes lanes = Lanes::Ones();
  for (int lane = 0; onTriangles && lane < LaneCount; ++lane)
  {
    lanes[lane] = (*onTriangles)[clipped.pieceTriangle[batch.piece[lane]]];
  }
  return lanes;
}

/// Weights of mass and stiffness on the triangles of a batch.
struct BatchWeights
{
  Lanes mass;
  LaneTensor stiffness;

  /// @param weight  of the mass on each source triangle; null: 1
  /// @param tensor  in the plane of each source triangle; null: the projection to the plane
  /// @param normalWeight  weight of n nᵀ, added to the tensor
  BatchWeights(const ClippedMesh& clipped, const TriangleBatch& batch, const LaneVector& normal,
    const std::vector<double>* weight, const std::vector<Eigen::Matrix3d>* tensor,
    double normalWeight)
    : mass(OnBatch(clipped, batch, weight))
  {
    if (!tensor)
    {
      stiffness = TangentialProjection(normal, normalWeight);
      return;
    }
    for (int lane = 0; lane < LaneCount; ++lane)
    {
      const Eigen::Matrix3d& own = (*tensor)[clipped.pieceTriangle[batch.piece[lane]]];
      for (int p = 0; p < 3; ++p)
      {
        stiffness.same[p][lane] = own(p, p);
        stiffness.mixed[p][lane] = own(p, (p + 1) % 3);
      }
    }
    this->AddNormal(normal, Lanes::Constant(normalWeight));
  }

  /// Adds a multiple of n nᵀ to the tensors.
  void AddNormal(const LaneVector& normal, const Lanes& factor)
  {
    for (int p = 0; p < 3; ++p)
    {
      stiffness.same[p] += factor * normal.axis[p] * normal.axis[p];
      stiffness.mixed[p] += factor * normal.axis[p] * normal.axis[(p + 1) % 3];
    }
  }
};

/// Integrates the mass and, if wanted, the stiffness of every finest patch. prepare(batch, planes)
/// returns a function set(point, count, samples). It sets mass and tensor of the samples at `count`
/// points of the rule, beginning with `point`. On entry, the samples have their positions, and
/// their mass is the area they represent.
template<class Prepare>
void IntegratePatches(const GridFunctions& space, const QuadratureRule& rule, const Job& job,
  ElementMatrices& result, ElementParts parts, Prepare&& prepare)
{
  const bool both = parts == ElementParts::Both;
  const Id points = static_cast<Id>(rule.points.size());
  result.mass.resize(space.Finest().NumberOfPatches());
  if (both)
  {
    result.stiffness.resize(space.Finest().NumberOfPatches());
  }
  ForEachPatch(space, rule, job,
    [&](Id patch, auto&& forEachBatch)
    {
      MassMoments mass;
      StiffnessMoments stiffness;
      forEachBatch(
        [&](const TriangleBatch& batch)
        {
          const TrianglePlanes planes(batch);
          const auto set = prepare(batch, planes);
          std::array<SampleBatch, BatchesAtOnce> samples;
          for (Id begin = 0; begin < points; begin += BatchesAtOnce)
          {
            const int count = static_cast<int>(std::min<Id>(BatchesAtOnce, points - begin));
            for (int k = 0; k < count; ++k)
            {
              const QuadratureRule::Point& point = rule.points[begin + k];
              SetPositions(batch, point, samples[k]);
              samples[k].mass = point.weight * planes.area;
            }
            set(begin, count, samples.data());
            mass.Add(samples.data(), count);
            if (both)
            {
              stiffness.Add(samples.data(), count);
            }
          }
        });
      result.mass[patch] = mass.Matrix();
      if (both)
      {
        result.stiffness[patch] = stiffness.Matrix();
      }
    });
}

} // namespace gridfem

#endif
