#include "Integrals/SampledFunctions.h"

#include "Algebra/RowBuilder.h"
#include "Base/Parallel.h"
#include "Integrals/CellBasis.h"
#include "Integrals/PatchIntegrals.h"

#include <array>

namespace gridfem
{
namespace
{

/// The part of the surface in an octant of a cell.
struct SurfacePart
{
  double area = 0.0;
  Vec3 moment = Vec3::Zero(); // area times center, in the cell's own coordinates
};

template<int Functions>
struct SampledPatch
{
  std::array<SurfacePart, 8> part;
  std::array<double, Functions> integral{}; // ∫ b_i over the patch

  void Add(const TriangleBatch& batch, const QuadratureRule& rule, const Lanes& weight)
  {
    const Lanes area = TrianglePlanes(batch).area * weight;
    SampleBatch samples;
    std::array<double, Functions> value;
    for (const QuadratureRule::Point& point : rule.points)
    {
      SetPositions(batch, point, samples);
      for (int lane = 0; lane < batch.count; ++lane)
      {
        const Vec3 place(
          samples.position[0][lane], samples.position[1][lane], samples.position[2][lane]);
        const double own = point.weight * area[lane];
        SurfacePart& octant =
          part[(place[0] < 0.5 ? 0 : 1) + (place[1] < 0.5 ? 0 : 2) + (place[2] < 0.5 ? 0 : 4)];
        octant.area += own;
        octant.moment += own * place;
        BasisValues(place, value);
        for (int i = 0; i < Functions; ++i)
        {
          integral[i] += own * value[i];
        }
      }
    }
  }
};

/// Multiplies each row by its weight.
void ScaleRows(const std::vector<double>& weight, SparseMatrix& matrix, int threads)
{
  ParallelRanges(matrix.rows, threads,
    [&](Id begin, Id end)
    {
      for (Id row = begin; row < end; ++row)
      {
        for (Id k = matrix.rowBegin[row]; k < matrix.rowBegin[row + 1]; ++k)
        {
          matrix.value[k] *= weight[row];
        }
      }
    });
}

/// Scales the rows so that their sums are these integrals.
void SetRowSums(const std::vector<double>& integral, SparseMatrix& matrix, int threads)
{
  const MultiVector sum = RowSums(matrix, threads);
  std::vector<double> scale(integral.size(), 1.0);
  for (std::size_t row = 0; row < scale.size(); ++row)
  {
    const double own = sum(static_cast<Id>(row), 0);
    scale[row] = own > 0.0 ? integral[row] / own : 1.0;
  }
  ScaleRows(scale, matrix, threads);
}

} // namespace

template<int Functions>
SampledFunctions SampleFunctions(const GridFunctions& space,
  const BasicPatchLevel<Functions>& level, const QuadratureRule& rule, const Job& job,
  const std::vector<double>* weight)
{
  std::vector<SampledPatch<Functions>> patches(static_cast<std::size_t>(level.NumberOfPatches()));
  ForEachPatch(space, rule, job.Part(0.0, 0.5),
    [&](Id patch, auto&& forEachBatch)
    {
      forEachBatch([&](const TriangleBatch& batch)
        { patches[patch].Add(batch, rule, OnBatch(space.clipped, batch, weight)); });
    });
  RowBuilder rows;
  RowBuilder::Entries entries;
  std::vector<double> areas;
  std::vector<double> integral(static_cast<std::size_t>(level.numberOfFunctions), 0.0);
  std::array<double, Functions> value;
  for (std::size_t patch = 0; patch < patches.size(); ++patch)
  {
    for (int i = 0; i < Functions; ++i)
    {
      integral[level.dof[patch][i]] += patches[patch].integral[i];
    }
    for (const SurfacePart& part : patches[patch].part)
    {
      if (!(part.area > 0.0))
      {
        continue;
      }
      BasisValues(part.moment / part.area, value);
      entries.clear();
      for (int i = 0; i < Functions; ++i)
      {
        entries.emplace_back(level.dof[patch][i], value[i]);
      }
      rows.Append(entries);
      areas.push_back(part.area);
    }
  }
  job.Check(0.8);
  SampledFunctions sampled;
  sampled.values = rows.Finish(level.numberOfFunctions);
  SparseMatrix weighted = sampled.values;
  ScaleRows(areas, weighted, job.threads);
  sampled.integrals = Transpose(weighted, job.threads);
  SetRowSums(integral, sampled.integrals, job.threads);
  job.Check(1.0);
  return sampled;
}

template SampledFunctions SampleFunctions(const GridFunctions&, const PatchLevel&,
  const QuadratureRule&, const Job&, const std::vector<double>*);
template SampledFunctions SampleFunctions(const GridFunctions&, const SmoothLevel&,
  const QuadratureRule&, const Job&, const std::vector<double>*);

} // namespace gridfem
