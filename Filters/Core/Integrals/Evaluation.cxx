// Evaluation of functions: every point lies in a patch, and a patch has eight coefficients.
#include "Integrals/Evaluation.h"

#include "Base/Parallel.h"
#include "Integrals/QuadratureSamples.h"
#include "Integrals/TrilinearBasis.h"

#include <string>

namespace gridfem
{
namespace
{

void CheckCoefficients(const GridFunctions& space, const MultiVector& coefficients)
{
  if (coefficients.rows() != space.Finest().numberOfFunctions)
  {
    throw InvalidInput("There are " + std::to_string(coefficients.rows()) + " coefficients for " +
                       std::to_string(space.Finest().numberOfFunctions) + " functions.");
  }
}

MultiVector EvaluateAt(const GridFunctions& space, const Array<Index>& patchOfPoint,
  const MultiVector& coefficients, int threads)
{
  CheckCoefficients(space, coefficients);
  const PatchLevel& level = space.Finest();
  const auto points = static_cast<Id>(patchOfPoint.size());
  MultiVector result = MultiVector::Zero(points, coefficients.cols());
  ParallelRanges(points, threads,
    [&](Id begin, Id end)
    {
      CornerValues b;
      for (Id point = begin; point < end; ++point)
      {
        const Id patch = patchOfPoint[point];
        if (patch < 0)
        {
          continue;
        }
        TrilinearValues(space.clipped.position[point] - CellCorner(level.cell[patch]), b);
        for (int c = 0; c < FunctionsPerPatch; ++c)
        {
          result.row(point) += b[c] * coefficients.row(level.dof[patch][c]);
        }
      }
    });
  return result;
}

} // namespace

MultiVector EvaluateAtPoints(
  const GridFunctions& space, const MultiVector& coefficients, int threads)
{
  return EvaluateAt(space, space.pointPatch, coefficients, threads);
}

MultiVector EvaluateAtClippedPoints(
  const GridFunctions& space, const MultiVector& coefficients, int threads)
{
  const Array<Index> patchOfPoint = FindPointPatches(space.clipped, space.piecePatch,
    space.Finest().NumberOfPatches(), static_cast<Id>(space.clipped.position.size()), threads);
  return EvaluateAt(space, patchOfPoint, coefficients, threads);
}

Eigen::RowVectorXd EvaluateInPatch(
  const GridFunctions& space, Id patch, const Vec3& position, const MultiVector& coefficients)
{
  CheckCoefficients(space, coefficients);
  const PatchLevel& level = space.Finest();
  CornerValues b;
  TrilinearValues(position - CellCorner(level.cell[patch]), b);
  Eigen::RowVectorXd result = Eigen::RowVectorXd::Zero(coefficients.cols());
  for (int c = 0; c < FunctionsPerPatch; ++c)
  {
    result += b[c] * coefficients.row(level.dof[patch][c]);
  }
  return result;
}

Eigen::Matrix3Xd EvaluateGradientInPiece(
  const GridFunctions& space, Id piece, const Vec3& position, const MultiVector& coefficients)
{
  CheckCoefficients(space, coefficients);
  const PatchLevel& level = space.Finest();
  const Id patch = space.piecePatch[piece];
  const Vec3 normal = UnitNormal(space.clipped, piece);
  Eigen::Matrix3Xd result = Eigen::Matrix3Xd::Zero(3, coefficients.cols());
  if (normal.isZero(0.0))
  {
    return result;
  }
  std::array<CornerValues, 3> derivative;
  TrilinearGradients(position - CellCorner(level.cell[patch]), derivative);
  for (int c = 0; c < FunctionsPerPatch; ++c)
  {
    const Vec3 gradient(derivative[0][c], derivative[1][c], derivative[2][c]);
    const Vec3 tangential = gradient - normal.dot(gradient) * normal;
    result += tangential / space.GetGrid().spacing * coefficients.row(level.dof[patch][c]);
  }
  return result;
}

} // namespace gridfem
