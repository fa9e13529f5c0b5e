// Evaluates functions. Every point lies in a patch, and a patch has a fixed number of coefficients.
#include "Integrals/Evaluation.h"

#include "Algebra/RowBuilder.h"
#include "Base/Grouping.h"
#include "Base/Parallel.h"
#include "Base/Prefetch.h"
#include "Integrals/CellBasis.h"
#include "Integrals/PatchShares.h"
#include "Integrals/QuadratureSamples.h"

#include <algorithm>
#include <string>

namespace gridfem
{
namespace
{

void CheckCoefficients(Index functions, const MultiVector& coefficients)
{
  if (coefficients.rows() != functions)
  {
    throw InvalidInput("There are " + std::to_string(coefficients.rows()) + " coefficients for " +
                       std::to_string(functions) + " functions.");
  }
}

/// Evaluates some columns at points [begin, end). Points without a patch get 0.
template<int Width, int Functions>
void EvaluateColumns(const GridFunctions& space, const BasicPatchLevel<Functions>& level,
  const Array<Index>& patchOfPoint, const MultiVector& coefficients, Id first, Id begin, Id end,
  MultiVector& result)
{
  constexpr Id Ahead = 8; // prefetch distance, because the coefficients of a patch may lie anywhere
                          // in memory
  std::array<double, Functions> b;
  for (Id point = begin; point < end; ++point)
  {
    const Id later = point + Ahead < end ? patchOfPoint[point + Ahead] : -1;
    for (int i = 0; later >= 0 && i < Functions; ++i)
    {
      Fetch(&coefficients(level.dof[later][i], first));
    }
    std::array<double, Width> sum{};
    const Id patch = patchOfPoint[point];
    if (patch >= 0)
    {
      BasisValues(space.clipped.position[point] - CellCorner(level.cell[patch]), b);
      for (int i = 0; i < Functions; ++i)
      {
        const double* const value = &coefficients(level.dof[patch][i], first);
        for (int c = 0; c < Width; ++c)
        {
          sum[c] += b[i] * value[c];
        }
      }
    }
    std::copy(sum.begin(), sum.end(), &result(point, first));
  }
}

/// Evaluates all columns of a group of points before the next group, so that rows stay in the
/// cache.
template<int Functions>
MultiVector EvaluateAt(const GridFunctions& space, const BasicPatchLevel<Functions>& level,
  const Array<Index>& patchOfPoint, const MultiVector& coefficients, const Job& job)
{
  CheckCoefficients(level.numberOfFunctions, coefficients);
  MultiVector result(static_cast<Id>(patchOfPoint.size()), coefficients.cols());
  const Id pointsAtOnce = std::max<Id>(64, DefaultBlockSize / std::max<Id>(1, result.cols()));
  ParallelRanges(
    result.rows(), job.threads,
    [&](Id begin, Id end)
    {
      ForEachPass(coefficients.cols(),
        [&](auto columns, Id first)
        {
          EvaluateColumns<decltype(columns)::value>(
            space, level, patchOfPoint, coefficients, first, begin, end, result);
        });
    },
    pointsAtOnce, job.progress);
  return result;
}

/// Returns ∫ ∇u over a piece in grid units. On a piece, gradients of trilinear functions have
/// degree two, and gradients of quadratic functions have degree five.
template<int Functions>
void IntegrateGradient(const GridFunctions& space, const BasicPatchLevel<Functions>& level,
  Id piece, const MultiVector& coefficients, Eigen::Ref<Eigen::RowVectorXd> sum)
{
  constexpr int Degree = Functions == FunctionsPerPatch ? 2 : 6;
  const Id patch = space.piecePatch[piece];
  const Vec3 normal = UnitNormal(space.clipped, piece);
  sum.setZero();
  ForEachSample(space.clipped, piece, CellCorner(level.cell[patch]), TriangleRule(Degree),
    [&](const Vec3& local, double weight)
    {
      std::array<std::array<double, Functions>, 3> derivative;
      BasisGradients(local, derivative);
      for (int i = 0; i < Functions; ++i)
      {
        const Vec3 gradient(derivative[0][i], derivative[1][i], derivative[2][i]);
        const Vec3 tangential = weight * (gradient - normal.dot(gradient) * normal);
        for (Id c = 0; c < coefficients.cols(); ++c)
        {
          // Differences are used so that the gradient of a constant is exactly 0.
          const double slope =
            coefficients(level.dof[patch][i], c) - coefficients(level.dof[patch][0], c);
          sum.segment<3>(3 * c) += slope * tangential.transpose();
        }
      }
    });
}

/// Returns v / |v|, even if |v|² overflows or underflows, and 0 for v = 0.
Vec3 DirectionOf(const Vec3& v)
{
  const double largest = v.cwiseAbs().maxCoeff();
  return largest > 0.0 ? Vec3((v / largest).normalized()) : Vec3(Vec3::Zero());
}

/// Returns the sum of share(∫ ∇u, area) over the pieces of each triangle, divided by the triangle's
/// area. The integral and the area of a piece are in grid units.
template<int Functions, class Share>
MultiVector MeansOfPieces(const GridFunctions& space, const BasicPatchLevel<Functions>& level,
  Id triangles, const MultiVector& coefficients, const Job& job, Share&& share)
{
  CheckCoefficients(level.numberOfFunctions, coefficients);
  const ClippedMesh& clipped = space.clipped;
  const Groups pieces =
    GroupItems(clipped.pieceTriangle.data(), clipped.NumberOfPieces(), triangles, job.threads);
  MultiVector mean = MultiVector::Zero(triangles, 3 * coefficients.cols());
  ParallelRanges(
    triangles, job.threads,
    [&](Id begin, Id end)
    {
      Eigen::RowVectorXd integral(mean.cols());
      for (Id t = begin; t < end; ++t)
      {
        double area = 0.0;
        for (Index k = pieces.begin[t]; k < pieces.begin[t + 1]; ++k)
        {
          IntegrateGradient(space, level, pieces.item[k], coefficients, integral);
          const double ofPiece = PieceArea(clipped, pieces.item[k]);
          for (Id c = 0; c < mean.cols(); c += 3)
          {
            const Vec3 sum = integral.segment<3>(c).transpose();
            const Vec3 added = share(sum, ofPiece);
            mean.row(t).segment<3>(c) += added.transpose();
          }
          area += ofPiece;
        }
        mean.row(t) *= area > 0.0 ? 1.0 / area : 0.0;
      }
    },
    DefaultBlockSize, job.progress);
  return mean;
}

} // namespace

template<int Functions>
MultiVector EvaluateAtPoints(const GridFunctions& space, const BasicPatchLevel<Functions>& level,
  const MultiVector& coefficients, const Job& job)
{
  return EvaluateAt(space, level, space.pointPatch, coefficients, job);
}

MultiVector EvaluateAtClippedPoints(
  const GridFunctions& space, const MultiVector& coefficients, int threads)
{
  const Array<Index> patchOfPoint = FindPointPatches(space.clipped, space.piecePatch,
    space.Finest().NumberOfPatches(), static_cast<Id>(space.clipped.position.size()), threads);
  return EvaluateAt(space, space.Finest(), patchOfPoint, coefficients, threads);
}

template<int Functions>
MultiVector MeanGradients(const GridFunctions& space, const BasicPatchLevel<Functions>& level,
  Id triangles, const MultiVector& coefficients, const Job& job)
{
  MultiVector mean = MeansOfPieces(space, level, triangles, coefficients, job,
    [](const Vec3& integral, double) { return integral; });
  mean /= space.GetGrid().spacing;
  return mean;
}

std::vector<double> AreasOfPieces(const GridFunctions& space, Id triangles)
{
  std::vector<double> area(triangles, 0.0);
  for (Id piece = 0; piece < space.clipped.NumberOfPieces(); ++piece)
  {
    area[space.clipped.pieceTriangle[piece]] += PieceArea(space.clipped, piece);
  }
  return area;
}

MultiVector MeanDirections(
  const GridFunctions& space, Id triangles, const MultiVector& coefficients, const Job& job)
{
  return MeansOfPieces(space, space.Finest(), triangles, coefficients, job,
    [](const Vec3& integral, double area) { return Vec3(area * DirectionOf(integral)); });
}

template<int Functions>
SparseMatrix EvaluationRows(const GridFunctions& space, const BasicPatchLevel<Functions>& level,
  const std::vector<Id>& points)
{
  RowBuilder rows;
  RowBuilder::Entries entries;
  for (const Id point : points)
  {
    if (point < 0 || point >= static_cast<Id>(space.pointPatch.size()))
    {
      throw InvalidInput("There is no point " + std::to_string(point) + ".");
    }
    entries.clear();
    const Index patch = space.pointPatch[point];
    if (patch >= 0)
    {
      std::array<double, Functions> b;
      BasisValues(space.clipped.position[point] - CellCorner(level.cell[patch]), b);
      for (int i = 0; i < Functions; ++i)
      {
        entries.emplace_back(level.dof[patch][i], b[i]);
      }
    }
    rows.Append(entries);
  }
  return rows.Finish(level.numberOfFunctions);
}

MultiVector MeansOnPatches(const GridFunctions& space, const MultiVector& onTriangles, int threads)
{
  const Id patches = space.Finest().NumberOfPatches();
  const Groups pieces =
    GroupItems(space.piecePatch.data(), space.clipped.NumberOfPieces(), patches, threads);
  MultiVector mean = MultiVector::Zero(patches, onTriangles.cols());
  ParallelRanges(patches, threads,
    [&](Id begin, Id end)
    {
      for (Id patch = begin; patch < end; ++patch)
      {
        double area = 0.0;
        for (Index k = pieces.begin[patch]; k < pieces.begin[patch + 1]; ++k)
        {
          const double ofPiece = PieceArea(space.clipped, pieces.item[k]);
          mean.row(patch) += ofPiece * onTriangles.row(space.clipped.pieceTriangle[pieces.item[k]]);
          area += ofPiece;
        }
        mean.row(patch) *= area > 0.0 ? 1.0 / area : 0.0;
      }
    });
  return mean;
}

template MultiVector EvaluateAtPoints(
  const GridFunctions&, const PatchLevel&, const MultiVector&, const Job&);
template MultiVector MeanGradients(
  const GridFunctions&, const PatchLevel&, Id, const MultiVector&, const Job&);
template SparseMatrix EvaluationRows(
  const GridFunctions&, const PatchLevel&, const std::vector<Id>&);
template MultiVector EvaluateAtPoints(
  const GridFunctions&, const SmoothLevel&, const MultiVector&, const Job&);
template MultiVector MeanGradients(
  const GridFunctions&, const SmoothLevel&, Id, const MultiVector&, const Job&);
template SparseMatrix EvaluationRows(
  const GridFunctions&, const SmoothLevel&, const std::vector<Id>&);

} // namespace gridfem
