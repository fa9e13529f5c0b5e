// Integration of element matrices patch by patch, and their Galerkin coarsening.
#include "ElementMatrices.h"

#include "DenseElement.h"
#include "Grouping.h"
#include "PatchIntegrals.h"
#include "TrilinearBasis.h"

namespace gridfem
{
namespace
{

std::array<OctantWeights, 8> MakeChildWeights()
{
  // Along one axis the child's nodes lie at 0, 1/2 or 1 of the parent: octant bit + corner bit.
  const double axis[3][2] = { { 1.0, 0.0 }, { 0.5, 0.5 }, { 0.0, 1.0 } };
  std::array<OctantWeights, 8> weights;
  for (int octant = 0; octant < 8; ++octant)
  {
    for (int c = 0; c < FunctionsPerPatch; ++c)
    {
      for (int p = 0; p < FunctionsPerPatch; ++p)
      {
        double product = 1.0;
        for (int bit = 0; bit < 3; ++bit)
        {
          product *= axis[((octant >> bit) & 1) + ((c >> bit) & 1)][(p >> bit) & 1];
        }
        weights[octant][c][p] = product;
      }
    }
  }
  return weights;
}

/// m = Wᵀ m, W the weights of a child's corners in its parent's: axis by axis, where the child's
/// nodes lie at 0 and 1/2 or at 1/2 and 1 of the parent.
void InterpolateRows(DenseElement& m, int octant)
{
  for (int axis = 0; axis < 3; ++axis)
  {
    const int step = 1 << axis;
    for (int corner = 0; corner < FunctionsPerPatch; ++corner)
    {
      if (corner & step)
      {
        continue;
      }
      const bool isUpper = octant & step;
      auto middle = m.row(isUpper ? corner : corner + step);
      middle *= 0.5;
      m.row(isUpper ? corner + step : corner) += middle;
    }
  }
}

/// Galerkin coarsening: the functions of the parent in terms of those of its children.
ElementMatrix SumOfChildren(
  const Level& fine, const Groups& children, Id parent, const Array<ElementMatrix>& matrices)
{
  DenseElement sum = DenseElement::Zero();
  for (Id k = children.begin[parent]; k < children.begin[parent + 1]; ++k)
  {
    const Id child = children.item[k];
    DenseElement part = Unpack(matrices[child]);
    InterpolateRows(part, fine.Octant(child));
    part.transposeInPlace();
    InterpolateRows(part, fine.Octant(child));
    sum += part;
  }
  return Pack(sum);
}

} // namespace

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

ElementMatrices IntegrateElements(
  const FunctionSpace& space, const QuadratureRule& rule, int threads, const Progress& progress)
{
  ElementMatrices elements;
  IntegratePatches(space, rule, threads, progress, elements,
    [](const TriangleBatch&, const TrianglePlanes& planes)
    {
      return [tensor = TangentialProjection(planes.normal)](Id, int count, SampleBatch* samples)
      {
        for (int k = 0; k < count; ++k)
        {
          samples[k].tensor = tensor.Times(samples[k].mass);
        }
      };
    });
  return elements;
}

Array<ElementMatrix> CoarsenElements(
  const Level& fine, const Level& coarse, const Array<ElementMatrix>& matrices, int threads)
{
  const Groups children = GroupItems(fine.parent, coarse.NumberOfPatches(), threads);
  Array<ElementMatrix> result(coarse.NumberOfPatches());
  ParallelRanges(coarse.NumberOfPatches(), threads,
    [&](Id begin, Id end)
    {
      for (Id parent = begin; parent < end; ++parent)
      {
        result[parent] = SumOfChildren(fine, children, parent, matrices);
      }
    });
  return result;
}

void CoarsenElements(const Level& fine, const Level& coarse, const ElementMatrices& elements,
  ElementMatrices& result, int threads)
{
  const Groups children = GroupItems(fine.parent, coarse.NumberOfPatches(), threads);
  result.mass.resize(coarse.NumberOfPatches());
  result.stiffness.resize(coarse.NumberOfPatches());
  ParallelRanges(coarse.NumberOfPatches(), threads,
    [&](Id begin, Id end)
    {
      for (Id parent = begin; parent < end; ++parent)
      {
        result.mass[parent] = SumOfChildren(fine, children, parent, elements.mass);
        result.stiffness[parent] = SumOfChildren(fine, children, parent, elements.stiffness);
      }
    });
}

const OctantWeights& ChildWeights(int octant)
{
  static const std::array<OctantWeights, 8> weights = MakeChildWeights();
  return weights[octant];
}

} // namespace gridfem
