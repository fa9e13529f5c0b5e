// Integrates element matrices patch by patch.
#include "Integrals/ElementMatrices.h"

#include "Integrals/PatchIntegrals.h"

namespace gridfem
{
namespace
{

/// Returns the tensors of a batch's source triangles, plus normalWeight n nᵀ.
LaneTensor TensorOfTriangles(const ClippedMesh& clipped, const TriangleBatch& batch,
  const std::vector<Eigen::Matrix3d>& tensor, const LaneVector& normal, double normalWeight)
{
  LaneTensor result;
  for (int lane = 0; lane < LaneCount; ++lane)
  {
    const Eigen::Matrix3d& own = tensor[clipped.pieceTriangle[batch.piece[lane]]];
    for (int p = 0; p < 3; ++p)
    {
      result.same[p][lane] = own(p, p);
      result.mixed[p][lane] = own(p, (p + 1) % 3);
    }
  }
  for (int p = 0; p < 3; ++p)
  {
    result.same[p] += normalWeight * normal.axis[p] * normal.axis[p];
    result.mixed[p] += normalWeight * normal.axis[p] * normal.axis[(p + 1) % 3];
  }
  return result;
}

} // namespace

ElementMatrices IntegrateElements(const GridFunctions& space, const QuadratureRule& rule,
  const Job& job, double normalStabilization, const std::vector<double>* weight,
  const std::vector<Eigen::Matrix3d>* tensor)
{
  ElementMatrices elements;
  IntegratePatches(space, rule, job, elements, ElementParts::Both,
    [&](const TriangleBatch& batch, const TrianglePlanes& planes)
    {
      Lanes ofTriangle = Lanes::Ones();
      for (int lane = 0; weight && lane < LaneCount; ++lane)
      {
        ofTriangle[lane] = (*weight)[space.clipped.pieceTriangle[batch.piece[lane]]];
      }
      const LaneTensor ofStiffness =
        tensor
          ? TensorOfTriangles(space.clipped, batch, *tensor, planes.normal, normalStabilization)
          : TangentialProjection(planes.normal, normalStabilization);
      return [ofTriangle, ofStiffness](Id, int count, SampleBatch* samples)
      {
        for (int k = 0; k < count; ++k)
        {
          samples[k].tensor = ofStiffness.Times(samples[k].mass);
          samples[k].mass *= ofTriangle;
        }
      };
    });
  return elements;
}

} // namespace gridfem
