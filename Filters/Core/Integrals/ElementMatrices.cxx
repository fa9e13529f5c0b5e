// Integrates element matrices patch by patch.
#include "Integrals/ElementMatrices.h"

#include "Integrals/PatchIntegrals.h"

namespace gridfem
{
ElementMatrices IntegrateElements(const GridFunctions& space, const QuadratureRule& rule,
  const Job& job, double normalStabilization, const std::vector<double>* weight,
  const std::vector<Eigen::Matrix3d>* tensor)
{
  ElementMatrices elements;
  IntegratePatches(space, rule, job, elements, ElementParts::Both,
    [&](const TriangleBatch& batch, const TrianglePlanes& planes)
    {
      const BatchWeights weights(
        space.clipped, batch, planes.normal, weight, tensor, normalStabilization);
      return [weights](Id, int count, SampleBatch* samples)
      {
        for (int k = 0; k < count; ++k)
        {
          samples[k].tensor = weights.stiffness.Times(samples[k].mass);
          samples[k].mass *= weights.mass;
        }
      };
    });
  return elements;
}

} // namespace gridfem
