#include "Spaces/RandomLoads.h"

#include "Base/NormalNumbers.h"
#include "Base/Parallel.h"
#include "Integrals/PatchShares.h"
#include "Spaces/HatSpace.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <stdexcept>
#include <vector>

namespace gridfem
{
namespace
{

/// A matrix or the numbers of an element with Size functions.
template<int Size>
using OfElement = Eigen::Matrix<double, Size, Size>;

/// Returns the lower triangle F with F Fᵀ = A for a positive semi-definite A. Pivots that are
/// rounding errors count as 0. The order is fixed: with pivoting, a last digit could exchange equal
/// pivots, and give another sample.
template<int Size>
OfElement<Size> FactorOfElement(const OfElement<Size>& A)
{
  constexpr double Rounding = 1e-12;
  OfElement<Size> F = OfElement<Size>::Zero();
  for (int k = 0; k < Size; ++k)
  {
    const double pivot = A(k, k) - F.row(k).head(k).squaredNorm();
    if (pivot > Rounding * A(k, k))
    {
      F(k, k) = std::sqrt(pivot);
      for (int i = k + 1; i < Size; ++i)
      {
        F(i, k) = (A(i, k) - F.row(i).head(k).dot(F.row(k).head(k))) / F(k, k);
      }
    }
  }
  return F;
}

/// Writes F z for Width samples into the share of an element, function by function.
template<int Width, int Size>
void WriteShare(const OfElement<Size>& F, std::uint64_t element, std::uint64_t seed, Id firstSample,
  double* share)
{
  constexpr int Pairs = (Size + 1) / 2;
  Eigen::Matrix<double, 2 * Pairs, Width> z;
  for (int c = 0; c < Width; ++c)
  {
    const NormalNumbers numbers(seed, static_cast<std::uint64_t>(firstSample + c));
    for (int k = 0; k < Pairs; ++k)
    {
      const auto pair = numbers.Pair(element * Pairs + static_cast<std::uint64_t>(k));
      z(2 * k, c) = pair[0];
      z(2 * k + 1, c) = pair[1];
    }
  }
  for (int i = 0; i < Size; ++i)
  {
    for (int c = 0; c < Width; ++c)
    {
      share[i * Width + c] = F.row(i).dot(z.col(c).template head<Size>());
    }
  }
}

MultiVector LoadsOnGrid(
  const GridSpace& grid, double a, double b, std::uint64_t seed, Id first, Id count, const Job& job)
{
  const PatchLevel& level = grid.Functions().Finest();
  const ElementMatrices& elements = grid.Operators().elements.front();
  MultiVector result(level.numberOfFunctions, count);
  std::vector<double> shares;
  ForEachPass(count,
    [&](auto pass, Id column)
    {
      constexpr int Width = decltype(pass)::value;
      shares.resize(level.NumberOfPatches() * FunctionsPerPatch * Width);
      ParallelRanges(
        level.NumberOfPatches(), job.threads,
        [&](Id begin, Id end)
        {
          OfElement<FunctionsPerPatch> A;
          for (Id patch = begin; patch < end; ++patch)
          {
            for (int i = 0; i < FunctionsPerPatch; ++i)
            {
              for (int j = 0; j < FunctionsPerPatch; ++j)
              {
                const int entry = PackedIndex(i, j);
                A(i, j) = a * elements.mass[patch][entry] + b * elements.stiffness[patch][entry];
              }
            }
            WriteShare<Width>(FactorOfElement(A), static_cast<std::uint64_t>(patch), seed,
              first + column, shares.data() + patch * FunctionsPerPatch * Width);
          }
        },
        PatchesPerBlock,
        job.progress.Part(double(column) / double(count), double(column + Width) / double(count)));
      SumShares<Width>(shares, grid.Operators().places.front(), column, job.threads, result);
    });
  return result;
}

/// The corners of a triangle in the order of their functions, which does not depend on the order of
/// the mesh.
struct SortedCorners
{
  std::array<int, 3> corner{ 0, 1, 2 };
  std::uint64_t number = 0; // of the triangle, from its functions

  SortedCorners(const TriangleMesh& mesh, const HatFunctions& hats, Id triangle)
  {
    const auto function = [&](int k) { return hats.ofPoint[mesh.triangles[triangle][k]]; };
    std::sort(
      corner.begin(), corner.end(), [&](int i, int j) { return function(i) < function(j); });
    for (const int k : corner)
    {
      number = NormalNumbers::Mixed(number + static_cast<std::uint64_t>(function(k)));
    }
  }
};

/// Returns the element matrix of a triangle, with its corners in this order.
OfElement<3> MatrixOfTriangle(
  const HatTriangle& triangle, const std::array<int, 3>& corner, double a, double b)
{
  OfElement<3> A = a * triangle.area / 12.0 * (OfElement<3>::Ones() + OfElement<3>::Identity());
  for (int i = 0; i < 3; ++i)
  {
    for (int j = 0; j < 3; ++j)
    {
      A(i, j) += b * triangle.area * triangle.Gradient(corner[i]).dot(triangle.Gradient(corner[j]));
    }
  }
  return A;
}

MultiVector LoadsOnHats(
  const HatSpace& space, double a, double b, std::uint64_t seed, Id first, Id count, const Job& job)
{
  const HatFunctions& hats = space.Hats().functions;
  const TriangleMesh& mesh = space.Grid().Mesh();
  if (&space.Matrices() != &space.Hats().matrices)
  {
    throw InvalidInput("Random loads of hat functions need the metric of their mesh.");
  }
  MultiVector result = MultiVector::Zero(hats.Count(), count);
  std::vector<double> shares;
  ForEachPass(count,
    [&](auto pass, Id column)
    {
      constexpr int Width = decltype(pass)::value;
      shares.resize(mesh.triangles.size() * 3 * Width);
      ParallelRanges(
        static_cast<Id>(mesh.triangles.size()), job.threads,
        [&](Id begin, Id end)
        {
          for (Id t = begin; t < end; ++t)
          {
            const HatTriangle triangle(mesh, t, hats.unitLength);
            if (triangle.IsFlat())
            {
              continue; // no function lists it
            }
            const SortedCorners sorted(mesh, hats, t);
            double share[3 * Width];
            WriteShare<Width>(FactorOfElement(MatrixOfTriangle(triangle, sorted.corner, a, b)),
              sorted.number, seed, first + column, share);
            for (int k = 0; k < 3; ++k)
            {
              std::copy_n(
                share + k * Width, Width, shares.data() + (t * 3 + sorted.corner[k]) * Width);
            }
          }
        },
        DefaultBlockSize,
        job.progress.Part(double(column) / double(count), double(column + Width) / double(count)));
      ParallelRanges(hats.Count(), job.threads,
        [&](Id begin, Id end)
        {
          for (Id i = begin; i < end; ++i)
          {
            for (Index k = hats.begin[i]; k < hats.begin[i + 1]; ++k)
            {
              for (int c = 0; c < Width; ++c)
              {
                result(i, column + c) += shares[Id(hats.corners[k].packed) * Width + c];
              }
            }
          }
        });
    });
  return result;
}

} // namespace

MultiVector RandomLoads(const FiniteElementSpace& space, double a, double b, std::uint64_t seed,
  Id first, Id count, const Job& job)
{
  if (const auto* grid = dynamic_cast<const GridSpace*>(&space))
  {
    return LoadsOnGrid(*grid, a, b, seed, first, count, job);
  }
  if (const auto* hats = dynamic_cast<const HatSpace*>(&space))
  {
    return LoadsOnHats(*hats, a, b, seed, first, count, job);
  }
  throw std::logic_error("This space has no element matrices for random loads.");
}

} // namespace gridfem
