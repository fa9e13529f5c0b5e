// Integrates right-hand sides over several triangles at once, one per SIMD lane. Fields are linear
// on each source triangle, so four numbers per lane and column give their values at all samples.
#include "Integrals/LoadVector.h"

#include "Integrals/LoadSums.h"
#include "Integrals/PatchIntegrals.h"
#include "Integrals/PatchShares.h"

#include <algorithm>
#include <string>

namespace gridfem
{
namespace
{

void CheckMesh(const GridFunctions& space, const TriangleMesh& mesh)
{
  const ClippedMesh& clipped = space.clipped;
  if (clipped.numberOfInputPoints != static_cast<Id>(mesh.points.size()))
  {
    throw InvalidInput("The function space was made from another mesh: it has " +
                       std::to_string(clipped.numberOfInputPoints) + " points instead of " +
                       std::to_string(mesh.points.size()) + ".");
  }
  const auto last = std::max_element(clipped.pieceTriangle.begin(), clipped.pieceTriangle.end());
  if (last != clipped.pieceTriangle.end() && *last >= static_cast<Id>(mesh.triangles.size()))
  {
    throw InvalidInput("The function space was made from another mesh: it uses triangle " +
                       std::to_string(*last) + " of " + std::to_string(mesh.triangles.size()) +
                       ".");
  }
}

/// The rows of a field at the corners of the source triangle of each lane.
using RowNumbers = std::array<std::array<Id, 3>, LaneCount>;

/// A function that is linear on the triangle of each lane.
struct LinearLanes
{
  Lanes constant;
  LaneVector slope;

  EIGEN_ALWAYS_INLINE Lanes At(const Lanes* position) const
  {
    return constant + slope.axis[0] * position[0] + slope.axis[1] * position[1] +
           slope.axis[2] * position[2];
  }
};

/// The source triangles of a batch, in the cell's own coordinates. Triangles flatter than 1e-10 of
/// a cell have no plane, so fields on them are taken as constant.
class SourceLanes
{
public:
  SourceLanes(const GridFunctions& space, const TriangleMesh& mesh, const TriangleBatch& batch,
    const Vec3& origin)
  {
    LaneVector corner[3];
    for (int lane = 0; lane < LaneCount; ++lane)
    {
      triangle_[lane] = space.clipped.pieceTriangle[batch.piece[lane]];
      for (int k = 0; k < 3; ++k)
      {
        const Vec3& position = space.clipped.position[mesh.triangles[triangle_[lane]][k]];
        for (int axis = 0; axis < 3; ++axis)
        {
          corner[k].axis[axis][lane] = position[axis] - origin[axis];
        }
      }
    }
    this->SetGeometry(corner);
    mesh_ = &mesh;
  }

  const LaneVector& Normal() const { return normal_; }

  /// Returns one number per lane: ofTriangle(source triangle).
  template<class OfTriangle>
  Lanes PerTriangle(const OfTriangle& ofTriangle) const
  {
    Lanes value;
    for (int lane = 0; lane < LaneCount; ++lane)
    {
      value[lane] = ofTriangle(triangle_[lane]);
    }
    return value;
  }

  RowNumbers RowsOf(const Field& f) const
  {
    RowNumbers rows;
    for (int lane = 0; lane < LaneCount; ++lane)
    {
      rows[lane] = f.RowsOf(triangle_[lane], mesh_->triangles[triangle_[lane]]);
    }
    return rows;
  }

  /// Returns a column of a field as a linear function.
  LinearLanes Column(const Field& f, const RowNumbers& rows, Id column) const
  {
    Lanes value[3];
    const double* const values = f.values.data() + column;
    for (int lane = 0; lane < LaneCount; ++lane)
    {
      for (int k = 0; k < 3; ++k)
      {
        value[k][lane] = values[rows[lane][k] * f.values.cols()];
      }
    }
    LinearLanes result;
    const Lanes first = value[1] - value[0];
    const Lanes second = value[2] - value[0];
    for (int axis = 0; axis < 3; ++axis)
    {
      result.slope.axis[axis] = first * gradient_[0].axis[axis] + second * gradient_[1].axis[axis];
    }
    result.constant = value[0] - result.slope.Dot(apex_);
    return result;
  }

private:
  static constexpr double SmallestHeight = 1e-10; // grid units; smaller heights are rounding errors
                                                  // of clipping

  void SetGeometry(const LaneVector* corner)
  {
    LaneVector u;
    LaneVector v;
    apex_ = corner[0];
    for (int axis = 0; axis < 3; ++axis)
    {
      u.axis[axis] = corner[1].axis[axis] - corner[0].axis[axis];
      v.axis[axis] = corner[2].axis[axis] - corner[0].axis[axis];
    }
    LaneVector area;
    for (int p = 0; p < 3; ++p)
    {
      const int q = (p + 1) % 3;
      const int r = (p + 2) % 3;
      area.axis[p] = u.axis[q] * v.axis[r] - u.axis[r] * v.axis[q];
    }
    const Lanes square = area.Dot(area);
    const Lanes longest = u.Dot(u).max(v.Dot(v)).max(u.Dot(u) + v.Dot(v) - 2.0 * u.Dot(v));
    const Lanes inverse = (square > SmallestHeight * SmallestHeight * longest)
                            .select(1.0 / square.max(1e-300), Lanes::Zero());
    const Lanes length = square.max(1e-300).rsqrt();
    // Gradients of the barycentric coordinates of the second and third corners. Each is
    // perpendicular to the edge from the first corner to the other one.
    for (int p = 0; p < 3; ++p)
    {
      const int q = (p + 1) % 3;
      const int r = (p + 2) % 3;
      gradient_[0].axis[p] = (v.axis[q] * area.axis[r] - v.axis[r] * area.axis[q]) * inverse;
      gradient_[1].axis[p] = (area.axis[q] * u.axis[r] - area.axis[r] * u.axis[q]) * inverse;
      normal_.axis[p] = area.axis[p] * length;
    }
  }

  Id triangle_[LaneCount];
  const TriangleMesh* mesh_;
  LaneVector apex_;
  LaneVector gradient_[2];
  LaneVector normal_;
};

/// Calls body(sample) for the points of the rule.
template<class Body>
EIGEN_ALWAYS_INLINE void ForEachSample(
  const TriangleBatch& batch, const QuadratureRule& rule, const LinearLanes* scale, Body&& body)
{
  const Lanes area = TrianglePlanes(batch).area;
  for (const QuadratureRule::Point& point : rule.points)
  {
    Sample sample;
    for (int axis = 0; axis < 3; ++axis)
    {
      sample.position[axis] = point.barycentric[0] * batch.corner[0][axis] +
                              point.barycentric[1] * batch.corner[1][axis] +
                              point.barycentric[2] * batch.corner[2][axis];
    }
    sample.weight = point.weight * area;
    if (scale)
    {
      sample.weight *= scale->At(sample.position);
    }
    body(sample);
  }
}

/// Integrates over all patches. addBatch(batch, source triangles, first column, sums) adds a batch
/// to `sums`, a Sums<functions, columns of the pass>.
template<template<int, int> class Sums, int Functions, class AddBatch>
MultiVector Integrate(const GridFunctions& space, const BasicPatchLevel<Functions>& level,
  const TriangleMesh& mesh, Id columns, const QuadratureRule& rule, const Job& job,
  AddBatch&& addBatch)
{
  CheckMesh(space, mesh);
  const FunctionPlaces places = PlacesOfFunctions(level, job.threads);
  MultiVector result(level.numberOfFunctions, columns);
  std::vector<double> shares;
  ForEachPass(columns,
    [&](auto pass, Id first)
    {
      constexpr int Width = decltype(pass)::value;
      shares.resize(level.NumberOfPatches() * Functions * Width);
      ForEachPatch(space, rule,
        job.Part(double(first) / double(columns), double(first + Width) / double(columns)),
        [&](Id patch, auto&& forEachBatch)
        {
          Sums<Functions, Width> sums;
          const Vec3 origin = CellCorner(level.cell[patch]);
          forEachBatch([&](const TriangleBatch& batch)
            { addBatch(batch, SourceLanes(space, mesh, batch, origin), first, sums); });
          sums.Write(shares.data() + patch * Functions * Width);
        });
      SumShares<Width>(shares, places, first, job.threads, result);
    });
  return result;
}

/// Calls body(scale on the triangles of a batch), or body(null) without a scale.
template<class Body>
EIGEN_ALWAYS_INLINE void WithScale(const Field* scale, const SourceLanes& source, Body&& body)
{
  if (scale)
  {
    const LinearLanes lanes = source.Column(*scale, source.RowsOf(*scale), 0);
    body(&lanes);
  }
  else
  {
    body(static_cast<const LinearLanes*>(nullptr));
  }
}

/// Adds vectors that are constant on each triangle of a batch, times the scale.
template<class Sums>
EIGEN_ALWAYS_INLINE void AddConstant(const TriangleBatch& batch, const SourceLanes& source,
  const QuadratureRule& rule, const Field* scale, const LaneVector* vector, Sums& sums)
{
  WithScale(scale, source,
    [&](const LinearLanes* factor) {
      ForEachSample(batch, rule, factor, [&](const Sample& sample) { sums.Add(sample, vector); });
    });
}

/// Returns factor (v - <n, v> n).
EIGEN_ALWAYS_INLINE LaneVector Tangential(
  const LaneVector& vector, const LaneVector& normal, double factor)
{
  const Lanes along = vector.Dot(normal);
  LaneVector result;
  for (int axis = 0; axis < 3; ++axis)
  {
    result.axis[axis] = factor * (vector.axis[axis] - along * normal.axis[axis]);
  }
  return result;
}

/// Returns ∫ <s, ∇b_i> for s = map(vector of the field, normal).
template<int Functions, class Map>
MultiVector IntegrateVectors(const GridFunctions& space, const BasicPatchLevel<Functions>& level,
  const TriangleMesh& mesh, const Field& s, const Field* scale, const QuadratureRule& rule,
  const Job& job, Map&& map)
{
  RequireVectors(s, mesh);
  RequireScale(scale, mesh);
  return Integrate<GradientSums>(space, level, mesh, s.values.cols() / 3, rule, job,
    [&](const TriangleBatch& batch, const SourceLanes& source, Id first, auto& sums)
    {
      constexpr int Width = std::decay_t<decltype(sums)>::Count;
      const RowNumbers rows = source.RowsOf(s);
      std::array<LinearLanes, 3 * Width> column;
      for (int c = 0; c < 3 * Width; ++c)
      {
        column[c] = source.Column(s, rows, 3 * first + c);
      }
      WithScale(scale, source,
        [&](const LinearLanes* factor)
        {
          ForEachSample(batch, rule, factor,
            [&](const Sample& sample)
            {
              LaneVector vector[Width];
              for (int c = 0; c < Width; ++c)
              {
                LaneVector given;
                for (int axis = 0; axis < 3; ++axis)
                {
                  given.axis[axis] = column[3 * c + axis].At(sample.position);
                }
                vector[c] = map(given, source.Normal());
              }
              sums.Add(sample, vector);
            });
        });
    });
}

/// Returns factor v / |v|, or 0 for v = 0. v may be so small that its square is 0.
EIGEN_ALWAYS_INLINE LaneVector Direction(const LaneVector& vector, double factor)
{
  const Lanes largest = vector.axis[0].abs().max(vector.axis[1].abs()).max(vector.axis[2].abs());
  const Lanes inverse = (largest > 1e-300).select(1.0 / largest, Lanes::Zero());
  LaneVector result;
  for (int axis = 0; axis < 3; ++axis)
  {
    result.axis[axis] = vector.axis[axis] * inverse;
  }
  const Lanes square = result.Dot(result);
  const Lanes scale = (square > 0.0).select(factor / square.sqrt(), Lanes::Zero());
  for (int axis = 0; axis < 3; ++axis)
  {
    result.axis[axis] *= scale;
  }
  return result;
}

} // namespace

template<int Functions>
MultiVector IntegrateValues(const GridFunctions& space, const BasicPatchLevel<Functions>& level,
  const TriangleMesh& mesh, const Field& f, const QuadratureRule& rule, const Job& job,
  const std::vector<double>* weight)
{
  RequireField(f, mesh);
  if (weight)
  {
    RequireWeights(*weight, mesh);
  }
  return Integrate<ValueSums>(space, level, mesh, f.values.cols(), rule, job,
    [&](const TriangleBatch& batch, const SourceLanes& source, Id first, auto& sums)
    {
      const Lanes factor =
        source.PerTriangle([weight](Id triangle) { return weight ? (*weight)[triangle] : 1.0; });
      constexpr int Width = std::decay_t<decltype(sums)>::Count;
      const RowNumbers rows = source.RowsOf(f);
      std::array<LinearLanes, Width> column;
      for (int c = 0; c < Width; ++c)
      {
        column[c] = source.Column(f, rows, first + c);
      }
      ForEachSample(batch, rule, nullptr,
        [&](const Sample& sample)
        {
          Lanes value[Width];
          for (int c = 0; c < Width; ++c)
          {
            value[c] = factor * column[c].At(sample.position);
          }
          sums.Add(sample, value);
        });
    });
}

template<int Functions>
MultiVector IntegrateGradients(const GridFunctions& space, const BasicPatchLevel<Functions>& level,
  const TriangleMesh& mesh, const Field& s, const Field* scale, const QuadratureRule& rule,
  const Job& job)
{
  const double spacing = space.GetGrid().spacing;
  return IntegrateVectors(space, level, mesh, s, scale, rule, job,
    [spacing](const LaneVector& vector, const LaneVector& normal)
    { return Tangential(vector, normal, spacing); });
}

template<int Functions>
MultiVector IntegrateTurnedGradients(const GridFunctions& space,
  const BasicPatchLevel<Functions>& level, const TriangleMesh& mesh, const Field& s,
  const QuadratureRule& rule, const Job& job)
{
  const double spacing = space.GetGrid().spacing;
  return IntegrateVectors(space, level, mesh, s, nullptr, rule, job,
    [spacing](const LaneVector& vector, const LaneVector& normal)
    {
      LaneVector turned;
      for (int p = 0; p < 3; ++p)
      {
        const int q = (p + 1) % 3;
        const int r = (p + 2) % 3;
        turned.axis[p] =
          spacing * (normal.axis[q] * vector.axis[r] - normal.axis[r] * vector.axis[q]);
      }
      return turned;
    });
}

template<int Functions>
MultiVector IntegrateDirections(const GridFunctions& space, const BasicPatchLevel<Functions>& level,
  const TriangleMesh& mesh, const MultiVector& coefficients, const Field* scale,
  const QuadratureRule& rule, const Job& job)
{
  RequireScale(scale, mesh);
  if (coefficients.rows() != level.numberOfFunctions)
  {
    throw InvalidInput("There are " + std::to_string(coefficients.rows()) + " coefficients for " +
                       std::to_string(level.numberOfFunctions) + " functions.");
  }
  const double spacing = space.GetGrid().spacing;
  return Integrate<GradientSums>(space, level, mesh, coefficients.cols(), rule, job,
    [&](const TriangleBatch& batch, const SourceLanes& source, Id first, auto& sums)
    {
      constexpr int Width = std::decay_t<decltype(sums)>::Count;
      const auto& dof = level.dof[space.piecePatch[batch.piece[0]]];
      std::vector<PatchSlopes<Functions>> slopes;
      slopes.reserve(Width);
      for (int c = 0; c < Width; ++c)
      {
        slopes.emplace_back(dof, coefficients, first + c);
      }
      WithScale(scale, source,
        [&](const LinearLanes* factor)
        {
          ForEachSample(batch, rule, factor,
            [&](const Sample& sample)
            {
              LaneVector vector[Width];
              for (int c = 0; c < Width; ++c)
              {
                vector[c] = Direction(
                  Tangential(slopes[c].At(sample.position), source.Normal(), 1.0), spacing);
              }
              sums.Add(sample, vector);
            });
        });
    });
}

template<int Functions>
MultiVector IntegrateGradientsOf(const GridFunctions& space,
  const BasicPatchLevel<Functions>& level, const TriangleMesh& mesh, const Field& f,
  const Field* scale, const QuadratureRule& rule, const Job& job)
{
  RequireOnPoints(f, mesh);
  RequireScale(scale, mesh);
  return Integrate<GradientSums>(space, level, mesh, f.values.cols(), rule, job,
    [&](const TriangleBatch& batch, const SourceLanes& source, Id first, auto& sums)
    {
      constexpr int Width = std::decay_t<decltype(sums)>::Count;
      const RowNumbers rows = source.RowsOf(f);
      LaneVector slope[Width];
      for (int c = 0; c < Width; ++c)
      {
        slope[c] = source.Column(f, rows, first + c).slope;
      }
      AddConstant(batch, source, rule, scale, slope, sums);
    });
}

template<int Functions>
MultiVector IntegrateGradientsOfCoordinates(const GridFunctions& space,
  const BasicPatchLevel<Functions>& level, const TriangleMesh& mesh, const Field* scale,
  const QuadratureRule& rule, double normalStabilization, const Job& job)
{
  RequireScale(scale, mesh);
  const double spacing = space.GetGrid().spacing;
  return Integrate<GradientSums>(space, level, mesh, 3, rule, job,
    [&](const TriangleBatch& batch, const SourceLanes& source, Id, auto& sums)
    {
      constexpr int Width = std::decay_t<decltype(sums)>::Count;
      LaneVector slope[Width];
      for (int c = 0; c < Width; ++c)
      {
        const int column = c % 3; // a pass of four columns is compiled, but never runs
        for (int axis = 0; axis < 3; ++axis)
        {
          slope[c].axis[axis] =
            spacing * ((axis == column ? 1.0 : 0.0) - (1.0 - normalStabilization) *
                                                        source.Normal().axis[column] *
                                                        source.Normal().axis[axis]);
        }
      }
      AddConstant(batch, source, rule, scale, slope, sums);
    });
}

template MultiVector IntegrateValues(const GridFunctions&, const PatchLevel&, const TriangleMesh&,
  const Field&, const QuadratureRule&, const Job&, const std::vector<double>*);
template MultiVector IntegrateGradients(const GridFunctions&, const PatchLevel&,
  const TriangleMesh&, const Field&, const Field*, const QuadratureRule&, const Job&);
template MultiVector IntegrateTurnedGradients(const GridFunctions&, const PatchLevel&,
  const TriangleMesh&, const Field&, const QuadratureRule&, const Job&);
template MultiVector IntegrateDirections(const GridFunctions&, const PatchLevel&,
  const TriangleMesh&, const MultiVector&, const Field*, const QuadratureRule&, const Job&);
template MultiVector IntegrateGradientsOf(const GridFunctions&, const PatchLevel&,
  const TriangleMesh&, const Field&, const Field*, const QuadratureRule&, const Job&);
template MultiVector IntegrateGradientsOfCoordinates(const GridFunctions&, const PatchLevel&,
  const TriangleMesh&, const Field*, const QuadratureRule&, double, const Job&);
template MultiVector IntegrateValues(const GridFunctions&, const SmoothLevel&, const TriangleMesh&,
  const Field&, const QuadratureRule&, const Job&, const std::vector<double>*);
template MultiVector IntegrateGradients(const GridFunctions&, const SmoothLevel&,
  const TriangleMesh&, const Field&, const Field*, const QuadratureRule&, const Job&);
template MultiVector IntegrateTurnedGradients(const GridFunctions&, const SmoothLevel&,
  const TriangleMesh&, const Field&, const QuadratureRule&, const Job&);
template MultiVector IntegrateDirections(const GridFunctions&, const SmoothLevel&,
  const TriangleMesh&, const MultiVector&, const Field*, const QuadratureRule&, const Job&);
template MultiVector IntegrateGradientsOf(const GridFunctions&, const SmoothLevel&,
  const TriangleMesh&, const Field&, const Field*, const QuadratureRule&, const Job&);
template MultiVector IntegrateGradientsOfCoordinates(const GridFunctions&, const SmoothLevel&,
  const TriangleMesh&, const Field*, const QuadratureRule&, double, const Job&);

} // namespace gridfem
