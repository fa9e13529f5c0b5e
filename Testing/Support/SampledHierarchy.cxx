#include "SampledHierarchy.h"

#include "SparseRows.h"

#include "Spaces/PatchOrdering.h"

#include <algorithm>
#include <cmath>
#include <map>

namespace gridfem::testing
{
namespace
{

struct SampledLevel
{
  PatchLevel level;
  std::map<MortonKey, Id> patchOfCell;
  std::vector<CellIndex> node; // per function
};

CellIndex CellOf(const Vec3& position, int depth, double size)
{
  CellIndex cell;
  for (int axis = 0; axis < 3; ++axis)
  {
    cell[axis] = std::clamp(static_cast<int>(position[axis] / size), 0, (1 << depth) - 1);
  }
  return cell;
}

CellIndex Corner(const CellIndex& cell, int corner)
{
  return { cell[0] + (corner & 1), cell[1] + (corner >> 1 & 1), cell[2] + (corner >> 2) };
}

SampledLevel BuildLevel(const std::vector<Sample>& samples, int depth, double size)
{
  SampledLevel result;
  result.level.depth = depth;
  for (const Sample& sample : samples)
  {
    result.patchOfCell[MortonEncode(CellOf(sample.position, depth, size))] = 0;
  }
  std::map<CellIndex, Index> functionOfNode;
  for (auto& [key, patch] : result.patchOfCell)
  {
    patch = result.level.NumberOfPatches();
    result.level.cell.push_back(key);
    std::array<Index, FunctionsPerPatch> dof;
    for (int corner = 0; corner < FunctionsPerPatch; ++corner)
    {
      const CellIndex node = Corner(MortonDecode(key), corner);
      const auto [place, isNew] =
        functionOfNode.emplace(node, static_cast<Index>(functionOfNode.size()));
      if (isNew)
      {
        result.node.push_back(node);
      }
      dof[corner] = place->second;
    }
    result.level.dof.push_back(dof);
  }
  result.level.numberOfFunctions = static_cast<Index>(result.node.size());
  return result;
}

SparseMatrix FromRows(const std::vector<std::map<Index, double>>& rows, Index columns)
{
  SparseRows sparse;
  for (const auto& row : rows)
  {
    for (const auto& [column, value] : row)
    {
      sparse.Add(column, value);
    }
    sparse.EndRow();
  }
  return sparse.Matrix(columns);
}

/// Returns the value of a corner's function at local coordinates in [0, 1]³, and computes its
/// gradient.
double Trilinear(const Vec3& local, int corner, Vec3& gradient)
{
  Vec3 factor;
  Vec3 slope;
  for (int axis = 0; axis < 3; ++axis)
  {
    const bool isUpper = corner >> axis & 1;
    factor[axis] = isUpper ? local[axis] : 1.0 - local[axis];
    slope[axis] = isUpper ? 1.0 : -1.0;
  }
  gradient = { slope[0] * factor[1] * factor[2], factor[0] * slope[1] * factor[2],
    factor[0] * factor[1] * slope[2] };
  return factor.prod();
}

using ElementMatrix = Eigen::Matrix<double, FunctionsPerPatch, FunctionsPerPatch>;

/// Adds the integrand at a sample. `local` are the sample's coordinates in the patch's cell.
void AddSample(const Sample& sample, const Vec3& local, double size, double mass, double stiffness,
  ElementMatrix& E)
{
  Eigen::Matrix<double, FunctionsPerPatch, 1> value;
  Eigen::Matrix<double, FunctionsPerPatch, 3> gradient;
  for (int c = 0; c < FunctionsPerPatch; ++c)
  {
    Vec3 g;
    value[c] = Trilinear(local, c, g);
    gradient.row(c) = (g - sample.normal * sample.normal.dot(g)) / size;
  }
  E += sample.weight *
       (mass * value * value.transpose() + stiffness * gradient * gradient.transpose());
}

SparseMatrix SumOverSamples(const std::vector<Sample>& samples, const SampledLevel& level,
  double size, double mass, double stiffness)
{
  std::vector<ElementMatrix> element(level.level.dof.size(), ElementMatrix::Zero());
  for (const Sample& sample : samples)
  {
    const CellIndex cell = CellOf(sample.position, level.level.depth, size);
    const Vec3 local = sample.position / size - Vec3(cell[0], cell[1], cell[2]);
    AddSample(
      sample, local, size, mass, stiffness, element[level.patchOfCell.at(MortonEncode(cell))]);
  }
  std::vector<std::map<Index, double>> rows(level.node.size());
  for (std::size_t patch = 0; patch < element.size(); ++patch)
  {
    const auto& dof = level.level.dof[patch];
    for (int i = 0; i < FunctionsPerPatch; ++i)
    {
      for (int j = 0; j < FunctionsPerPatch; ++j)
      {
        rows[dof[i]][dof[j]] += element[patch](i, j);
      }
    }
  }
  return FromRows(rows, level.level.numberOfFunctions);
}

SparseMatrix Interpolation(const SampledLevel& fine, const SampledLevel& coarse)
{
  std::vector<std::map<Index, double>> rows(fine.node.size());
  for (Id patch = 0; patch < fine.level.NumberOfPatches(); ++patch)
  {
    const MortonKey parent = fine.level.cell[patch] >> 3;
    const CellIndex origin = MortonDecode(parent);
    const auto& coarseDof = coarse.level.dof[coarse.patchOfCell.at(parent)];
    for (const Index function : fine.level.dof[patch])
    {
      const CellIndex& node = fine.node[function];
      const Vec3 local(
        0.5 * node[0] - origin[0], 0.5 * node[1] - origin[1], 0.5 * node[2] - origin[2]);
      for (int corner = 0; corner < FunctionsPerPatch; ++corner)
      {
        Vec3 unused;
        const double weight = Trilinear(local, corner, unused);
        if (weight != 0.0)
        {
          rows[function][coarseDof[corner]] = weight;
        }
      }
    }
  }
  return FromRows(rows, coarse.level.numberOfFunctions);
}

constexpr double GaussOffset = 0.28867513459481287; // 1 / (2 sqrt(3))

} // namespace

std::vector<Sample> SolidCube(int depth)
{
  std::vector<Sample> samples;
  const int side = 2 << depth; // two Gauss points per cell and axis
  const auto coordinate = [](int i) { return i / 2 + 0.5 + (i % 2 ? GaussOffset : -GaussOffset); };
  for (int i = 0; i < side * side * side; ++i)
  {
    const Vec3 position(
      coordinate(i % side), coordinate(i / side % side), coordinate(i / side / side));
    samples.push_back({ position, Vec3::Zero(), 0.125 });
  }
  return samples;
}

std::vector<Sample> FlatSquare(int depth)
{
  std::vector<Sample> samples;
  for (Sample sample : SolidCube(depth))
  {
    if (sample.position[2] < 0.5)
    {
      sample.position[2] = 0.0;
      sample.normal = Vec3::UnitZ();
      sample.weight = 0.25;
      samples.push_back(sample);
    }
  }
  return samples;
}

std::vector<Sample> TiltedPlane(int depth, double height, double slope)
{
  std::vector<Sample> samples;
  const int side = 4 << depth;
  const Vec3 normal = Vec3(-slope, 0.0, 1.0).normalized();
  for (int i = 0; i < side * side; ++i)
  {
    const double x = (i % side + 0.5) / 4;
    const Vec3 position(x, (i / side + 0.5) / 4, height + slope * x);
    if (position[2] >= 0.0 && position[2] <= (1 << depth))
    {
      samples.push_back({ position, normal, 1.0 / 16 / normal[2] });
    }
  }
  return samples;
}

std::vector<MultigridLevel> SampledHierarchy(
  const std::vector<Sample>& samples, int depth, int coarsestDepth, double mass, double stiffness)
{
  std::vector<MultigridLevel> hierarchy;
  SampledLevel fine;
  for (int d = depth; d >= coarsestDepth; --d)
  {
    const double size = 1 << (depth - d);
    SampledLevel level = BuildLevel(samples, d, size);
    if (d < depth)
    {
      hierarchy.back().prolongation = Interpolation(fine, level);
    }
    MultigridLevel next;
    next.A = SumOverSamples(samples, level, size, mass, stiffness);
    next.order = OrderPatches(level.level);
    hierarchy.push_back(std::move(next));
    fine = std::move(level);
  }
  return hierarchy;
}

SparseMatrix Sparse(const Eigen::MatrixXd& A)
{
  std::vector<std::map<Index, double>> rows(A.rows());
  for (Index i = 0; i < A.rows(); ++i)
  {
    for (Index j = 0; j < A.cols(); ++j)
    {
      if (A(i, j) != 0.0)
      {
        rows[i][j] = A(i, j);
      }
    }
  }
  return FromRows(rows, static_cast<Index>(A.cols()));
}

} // namespace gridfem::testing
