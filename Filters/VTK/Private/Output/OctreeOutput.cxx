#include "Output/OctreeOutput.h"

#include "Input/PointCoordinates.h"
#include "Output/ClippedFans.h"
#include "Pipeline/Allocation.h"

#include "Base/Errors.h"
#include "Base/Parallel.h"
#include "Integrals/TrilinearBasis.h"

#include "vtkCellArray.h"
#include "vtkCellData.h"
#include "vtkCellType.h"
#include "vtkDoubleArray.h"
#include "vtkIdTypeArray.h"
#include "vtkIntArray.h"
#include "vtkNew.h"
#include "vtkPointData.h"
#include "vtkPoints.h"
#include "vtkPolyData.h"
#include "vtkUnstructuredGrid.h"

#include <Eigen/Geometry>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>
#include <string>

namespace gridfem
{
namespace
{

/// The component of a function without a patch here.
constexpr Id NoComponent = std::numeric_limits<Index>::max();

vtkSmartPointer<vtkPoints> NewPoints(int precision, Id count)
{
  auto points = vtkSmartPointer<vtkPoints>::New();
  points->SetDataType(precision);
  SetTuples(points->GetData(), count);
  return points;
}

/// Makes cells of `size` points each, whose ids follow each other in `connectivity`.
vtkSmartPointer<vtkCellArray> CellsOfSize(vtkIdTypeArray* connectivity, int size)
{
  const Id cells = connectivity->GetNumberOfValues() / size;
  auto offsets = NewArray<vtkIdTypeArray>("", cells + 1);
  for (Id cell = 0; cell <= cells; ++cell)
  {
    offsets->SetValue(cell, cell * size);
  }
  auto result = vtkSmartPointer<vtkCellArray>::New();
  result->SetData(offsets, connectivity);
  return result;
}

/// Makes cells of `size` points each, which share no points.
vtkSmartPointer<vtkCellArray> CellsOfConsecutivePoints(Id cells, int size)
{
  auto connectivity = NewArray<vtkIdTypeArray>("", cells * size);
  std::iota(connectivity->GetPointer(0), connectivity->GetPointer(0) + cells * size, vtkIdType(0));
  return CellsOfSize(connectivity, size);
}

/// Returns the world position of a cell's corner on a level.
Vec3 CornerPosition(const Grid& grid, int depth, MortonKey key, int corner)
{
  const CellIndex cell = MortonDecode(key);
  const double side = std::ldexp(1.0, grid.depth - depth);
  return grid.ToWorld(side * Vec3(cell[0] + (corner & 1), cell[1] + ((corner >> 1) & 1),
                               cell[2] + ((corner >> 2) & 1)));
}

/// Returns the cells of a coarser level: the ancestors, once each.
std::vector<MortonKey> AncestorCells(const std::vector<MortonKey>& cells, int generations)
{
  std::vector<MortonKey> ancestors;
  for (const MortonKey key : cells)
  {
    const MortonKey ancestor = key >> (3 * generations);
    if (ancestors.empty() || ancestors.back() != ancestor)
    {
      ancestors.push_back(ancestor);
    }
  }
  return ancestors;
}

/// Returns the surface area in every patch of a level.
/// @param area  the areas in the patches of the finest level
std::vector<double> AreasOfLevel(
  const std::vector<PatchLevel>& levels, std::vector<double> area, std::size_t level)
{
  for (std::size_t k = 0; k < level; ++k)
  {
    std::vector<double> coarse(levels[k + 1].NumberOfPatches(), 0.0);
    for (std::size_t patch = 0; patch < area.size(); ++patch)
    {
      coarse[levels[k].parent[patch]] += area[patch];
    }
    area = std::move(coarse);
  }
  return area;
}

/// Returns the connected component of every patch of a level, numbered as on the finest level. If
/// the plain space joins several components, the lowest number counts. Patches on other ranks have
/// the greatest number.
std::vector<Index> PatchComponents(
  const std::vector<PatchLevel>& levels, const std::vector<Index>& ofFunction, std::size_t level)
{
  std::vector<Index> component;
  for (const auto& dof : levels.front().dof)
  {
    component.push_back(ofFunction[dof[0]]);
  }
  for (std::size_t k = 0; k < level; ++k)
  {
    std::vector<Index> coarse(levels[k + 1].NumberOfPatches(), std::numeric_limits<Index>::max());
    for (std::size_t patch = 0; patch < component.size(); ++patch)
    {
      Index& parent = coarse[levels[k].parent[patch]];
      parent = std::min(parent, component[patch]);
    }
    component = std::move(coarse);
  }
  return component;
}

void AddFunctionArrays(const ShownLevel& shown, vtkUnstructuredGrid* output)
{
  const auto count = static_cast<Id>(shown.function.size());
  auto basisId = NewArray<vtkIdTypeArray>("BasisId", count);
  auto supportArea = NewArray<vtkDoubleArray>("SupportArea", count);
  auto component = NewArray<vtkIdTypeArray>("Component", count);
  std::copy(shown.function.begin(), shown.function.end(), basisId->GetPointer(0));
  std::copy(shown.area.begin(), shown.area.end(), supportArea->GetPointer(0));
  std::replace_copy(shown.component.begin(), shown.component.end(), component->GetPointer(0),
    NoComponent, Id{ -1 });
  output->GetPointData()->AddArray(basisId);
  output->GetPointData()->AddArray(supportArea);
  output->GetPointData()->AddArray(component);
}

} // namespace

void WriteOctreeCells(const ClippedMesh& clipped, int level, int precision, int threads,
  vtkUnstructuredGrid* output, const MortonKey* before)
{
  const int finest = clipped.grid.depth;
  const int from = level < 0 ? finest : std::min(level, finest);
  const int to = level < 0 ? 0 : from;
  std::vector<std::pair<int, MortonKey>> cells;
  for (int depth = from; depth >= to; --depth)
  {
    for (const MortonKey key : AncestorCells(clipped.cells, finest - depth))
    {
      if (!before || key != *before >> (3 * (finest - depth)))
      {
        cells.emplace_back(depth, key);
      }
    }
  }
  const Id count = static_cast<Id>(cells.size());
  auto points = NewPoints(precision, FunctionsPerPatch * count);
  auto levels = NewArray<vtkIntArray>("Level", count);
  const auto fill = [&](auto* coordinates)
  {
    ParallelRanges(count, threads,
      [&](Id begin, Id end)
      {
        for (Id cell = begin; cell < end; ++cell)
        {
          const auto& [depth, key] = cells[cell];
          for (int corner = 0; corner < FunctionsPerPatch; ++corner)
          {
            StorePoint(CornerPosition(clipped.grid, depth, key, corner),
              coordinates + 3 * (FunctionsPerPatch * cell + corner));
          }
          levels->SetValue(cell, depth);
        }
      });
  };
  VisitCoordinates(points, fill);
  output->SetPoints(points);
  output->SetCells(VTK_VOXEL, CellsOfConsecutivePoints(count, FunctionsPerPatch));
  output->GetCellData()->AddArray(levels);
}

void WriteQuadraturePoints(const InputMesh& mesh, const ClippedMesh& clipped,
  const QuadratureRule& rule, int precision, int threads, vtkPolyData* output)
{
  const Id perTriangle = static_cast<Id>(rule.points.size());
  const Id count = perTriangle * clipped.NumberOfTriangles();
  auto points = NewPoints(precision, count);
  auto weight = NewArray<vtkDoubleArray>("Weight", count);
  auto sourceCell = NewArray<vtkIdTypeArray>("SourceCellId", count);
  const double cellArea = clipped.grid.spacing * clipped.grid.spacing;
  const auto position = [&](Index corner) -> const Vec3&
  { return clipped.position[clipped.corners[corner]]; };
  const auto fill = [&](auto* coordinates)
  {
    ForEachFan(clipped, threads,
      [&](Id piece, Id begin, Id end)
      {
        const Index first = clipped.pieceBegin[piece];
        const Vec3& a = position(first);
        for (Id triangle = begin; triangle < end; ++triangle)
        {
          const Vec3& b = position(first + 1 + static_cast<Index>(triangle - begin));
          const Vec3& c = position(first + 2 + static_cast<Index>(triangle - begin));
          const double area = 0.5 * cellArea * (b - a).cross(c - a).norm();
          for (Id k = 0; k < perTriangle; ++k)
          {
            const Id sample = perTriangle * triangle + k;
            const auto& w = rule.points[k].barycentric;
            StorePoint(
              clipped.grid.ToWorld(w[0] * a + w[1] * b + w[2] * c), coordinates + 3 * sample);
            weight->SetValue(sample, rule.points[k].weight * area);
            sourceCell->SetValue(sample, mesh.sourceCell[clipped.pieceTriangle[piece]]);
          }
        }
      });
  };
  VisitCoordinates(points, fill);
  output->SetPoints(points);
  output->SetVerts(CellsOfConsecutivePoints(count, 1));
  output->GetPointData()->AddArray(weight);
  output->GetPointData()->AddArray(sourceCell);
}

std::size_t LevelOfDepth(const std::vector<PatchLevel>& levels, int depth)
{
  const auto found = std::find_if(
    levels.begin(), levels.end(), [&](const PatchLevel& level) { return level.depth <= depth; });
  return std::min<std::size_t>(found - levels.begin(), levels.size() - 1);
}

std::vector<double> PatchAreas(const GridFunctions& space)
{
  std::vector<double> area(space.Finest().NumberOfPatches(), 0.0);
  const double cellArea = space.GetGrid().spacing * space.GetGrid().spacing;
  for (Id piece = 0; piece < space.clipped.NumberOfPieces(); ++piece)
  {
    area[space.piecePatch[piece]] += cellArea * PieceArea(space.clipped, piece);
  }
  return area;
}

ShownLevel DescribeLevel(const std::vector<PatchLevel>& levels, const std::vector<double>& areas,
  const std::vector<Index>& components, std::size_t level)
{
  const std::vector<double> area = AreasOfLevel(levels, areas, level);
  const std::vector<Index> ofPatch = PatchComponents(levels, components, level);
  ShownLevel shown;
  shown.level = &levels[level];
  shown.function.resize(shown.level->numberOfFunctions);
  std::iota(shown.function.begin(), shown.function.end(), Id{ 0 });
  shown.area.assign(shown.function.size(), 0.0);
  shown.component.assign(shown.function.size(), NoComponent);
  for (Id patch = shown.level->NumberOfPatches() - 1; patch >= 0; --patch)
  {
    for (const Index function : shown.level->dof[patch])
    {
      shown.area[function] += area[patch];
      shown.component[function] = std::min<Id>(shown.component[function], ofPatch[patch]);
    }
  }
  return shown;
}

void WriteBasisFunctions(
  const Grid& grid, const ShownLevel& shown, int precision, vtkUnstructuredGrid* output)
{
  const PatchLevel& level = *shown.level;
  auto points = NewPoints(precision, level.numberOfFunctions);
  for (Index function = 0; function < level.numberOfFunctions; ++function)
  {
    points->SetPoint(function, grid.origin.data()); // functions without a patch
  }
  auto patchId = NewArray<vtkIdTypeArray>("PatchId", level.NumberOfPatches());
  auto levels = NewArray<vtkIntArray>("Level", level.NumberOfPatches());
  auto corners =
    NewArray<vtkIdTypeArray>("", static_cast<Id>(FunctionsPerPatch) * level.NumberOfPatches());
  for (Id patch = 0; patch < level.NumberOfPatches(); ++patch)
  {
    vtkIdType* const ids = corners->GetPointer(FunctionsPerPatch * patch);
    for (int corner = 0; corner < FunctionsPerPatch; ++corner)
    {
      ids[corner] = level.dof[patch][corner];
      const Vec3 position = CornerPosition(grid, level.depth, level.cell[patch], corner);
      points->SetPoint(ids[corner], position.data());
    }
    patchId->SetValue(patch, shown.firstPatch + patch);
    levels->SetValue(patch, level.depth);
  }
  output->SetPoints(points);
  output->SetCells(VTK_VOXEL, CellsOfSize(corners, FunctionsPerPatch));
  output->GetCellData()->AddArray(patchId);
  output->GetCellData()->AddArray(levels);
  AddFunctionArrays(shown, output);
}

void RequireBasisFunction(int depth, Id functions, Id function)
{
  if (function < 0 || function >= functions)
  {
    throw InvalidInput("Basis Id " + std::to_string(function) + " does not exist: level " +
                       std::to_string(depth) + " has the basis functions 0 to " +
                       std::to_string(functions - 1) + ".");
  }
}

MultiVector BasisFunctionCoefficients(const std::vector<PatchLevel>& levels, int depth, Id function)
{
  const PatchLevel& level = levels[LevelOfDepth(levels, depth)];
  const PatchLevel& finest = levels.front();
  RequireBasisFunction(level.depth, level.numberOfFunctions, function);
  MultiVector coefficients = MultiVector::Zero(finest.numberOfFunctions, 1);
  const int generations = finest.depth - level.depth;
  const double side = std::ldexp(1.0, generations);
  for (Id patch = 0; patch < finest.NumberOfPatches(); ++patch)
  {
    Id ancestor = patch;
    for (int k = 0; k < generations; ++k)
    {
      ancestor = levels[k].parent[ancestor];
    }
    const auto& dof = level.dof[ancestor];
    const auto found = std::find(dof.begin(), dof.end(), function);
    if (found == dof.end())
    {
      continue;
    }
    const CellIndex cell = MortonDecode(finest.cell[patch]);
    const CellIndex coarse = MortonDecode(level.cell[ancestor]);
    for (int corner = 0; corner < FunctionsPerPatch; ++corner)
    {
      const Vec3 local(cell[0] + (corner & 1) - side * coarse[0],
        cell[1] + ((corner >> 1) & 1) - side * coarse[1],
        cell[2] + ((corner >> 2) & 1) - side * coarse[2]);
      std::array<double, FunctionsPerPatch> value;
      TrilinearValues(local / side, value);
      coefficients(finest.dof[patch][corner], 0) = value[found - dof.begin()];
    }
  }
  return coefficients;
}

} // namespace gridfem
