// Integration of element matrices patch by patch.
#include "Integrals/ElementMatrices.h"

#include "Integrals/PatchIntegrals.h"
#include "Integrals/TrilinearBasis.h"

namespace gridfem
{

void EvaluateTrilinear(const Vec3& local, std::array<double, FunctionsPerPatch>& value)
{
  TrilinearValues(local, value);
}

void EvaluateTrilinearGradient(const Vec3& local, std::array<Vec3, FunctionsPerPatch>& gradient)
{
  std::array<CornerValues, 3> derivative;
  TrilinearGradients(local, derivative);
  for (int c = 0; c < FunctionsPerPatch; ++c)
  {
    gradient[c] = Vec3(derivative[0][c], derivative[1][c], derivative[2][c]);
  }
}

ElementMatrices IntegrateElements(const GridFunctions& space, const QuadratureRule& rule,
  int threads, const Progress& progress, double normalStabilization)
{
  ElementMatrices elements;
  IntegratePatches(space, rule, threads, progress, elements,
    [normalStabilization](const TriangleBatch&, const TrianglePlanes& planes)
    {
      return [tensor = TangentialProjection(planes.normal, normalStabilization)](
               Id, int count, SampleBatch* samples)
      {
        for (int k = 0; k < count; ++k)
        {
          samples[k].tensor = tensor.Times(samples[k].mass);
        }
      };
    });
  return elements;
}

ElementMatrices IntegrateWeightedElements(const GridFunctions& space, const QuadratureRule& rule,
  const std::vector<double>& weight, int threads, const Progress& progress,
  double normalStabilization)
{
  ElementMatrices elements;
  IntegratePatches(space, rule, threads, progress, elements,
    [&](const TriangleBatch& batch, const TrianglePlanes& planes)
    {
      Lanes ofTriangle;
      for (int lane = 0; lane < LaneCount; ++lane)
      {
        ofTriangle[lane] = weight[space.clipped.pieceTriangle[batch.piece[lane]]];
      }
      return [ofTriangle, tensor = TangentialProjection(planes.normal, normalStabilization)](
               Id, int count, SampleBatch* samples)
      {
        for (int k = 0; k < count; ++k)
        {
          samples[k].tensor = tensor.Times(samples[k].mass);
          samples[k].mass *= ofTriangle;
        }
      };
    });
  return elements;
}

} // namespace gridfem
