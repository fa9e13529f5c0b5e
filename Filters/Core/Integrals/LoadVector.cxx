// Right-hand sides. Per piece the integrals against the three linear functions of its source
// triangle are formed first; multiplying them by corner values then serves any number of columns.
#include "Integrals/LoadVector.h"

#include "Base/Grouping.h"
#include "Grid/SourceTriangle.h"
#include "Integrals/Assembly.h"
#include "Integrals/Direction.h"
#include "Integrals/QuadratureSamples.h"
#include "Integrals/TrilinearBasis.h"

#include <string>

namespace gridfem
{
namespace
{

/// Columns that are integrated in one pass: bounds the memory per patch.
constexpr Id ColumnsPerPass = 4;

/// weight[k][i]: what corner k of the source triangle contributes to function i of a patch.
using CornerWeights = std::array<CornerValues, 3>;

/// The same for vectors: weight[k][axis][i].
using CornerVectors = std::array<std::array<CornerValues, 3>, 3>;

/// sum += factor x values
void AddScaled(double factor, const CornerValues& values, CornerValues& sum)
{
  for (int i = 0; i < FunctionsPerPatch; ++i)
  {
    sum[i] += factor * values[i];
  }
}

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

/// A pass over the pieces for some of the columns: function and column of a patch's share.
struct Share
{
  Id firstColumn;
  Id columns;
  double* value; // 8 x columns

  double& At(int function, Id column) const { return value[function * columns + column]; }
};

/// Adds the shares of all patches of each function.
void GatherShares(const std::vector<double>& shares, const FunctionPlaces& places, Id firstColumn,
  Id columns, int threads, MultiVector& result)
{
  ParallelRanges(result.rows(), threads,
    [&](Id begin, Id end)
    {
      for (Id f = begin; f < end; ++f)
      {
        for (Index k = places.begin[f]; k < places.begin[f + 1]; ++k)
        {
          const double* share = shares.data() + places.item[k] * columns;
          for (Id c = 0; c < columns; ++c)
          {
            result(f, firstColumn + c) += share[c];
          }
        }
      }
    });
}

/// Sums addPiece(piece, cell corner, Share) over all pieces.
template<class AddPiece>
MultiVector IntegratePieces(const GridFunctions& space, Id columns, int threads,
  const Progress& progress, AddPiece&& addPiece)
{
  const PatchLevel& level = space.Finest();
  const Groups pieces = GroupItems(space.piecePatch, level.NumberOfPatches(), threads);
  const FunctionPlaces places = PlacesOfFunctions(level, threads);
  MultiVector result = MultiVector::Zero(level.numberOfFunctions, columns);
  std::vector<double> shares;
  for (Id first = 0; first < columns; first += ColumnsPerPass)
  {
    const Id count = std::min(ColumnsPerPass, columns - first);
    shares.assign(level.NumberOfPatches() * FunctionsPerPatch * count, 0.0);
    ParallelRanges(
      level.NumberOfPatches(), threads,
      [&](Id begin, Id end)
      {
        for (Id patch = begin; patch < end; ++patch)
        {
          const Vec3 origin = CellCorner(level.cell[patch]);
          const Share share{ first, count, shares.data() + patch * FunctionsPerPatch * count };
          for (Id k = pieces.begin[patch]; k < pieces.begin[patch + 1]; ++k)
          {
            addPiece(pieces.item[k], origin, share);
          }
        }
      },
      PatchesPerBlock,
      progress.Part(double(first) / double(columns), double(first + count) / double(columns)));
    GatherShares(shares, places, first, count, threads, result);
  }
  return result;
}

double ScaleAt(const Field* scale, const std::array<Id, 3>& rows, const Barycentric& lambda)
{
  return scale ? lambda[0] * scale->values(rows[0], 0) + lambda[1] * scale->values(rows[1], 0) +
                   lambda[2] * scale->values(rows[2], 0)
               : 1.0;
}

/// Calls body(local position, weight, λ) for the samples of a piece; the weights carry area and
/// scale, λ are the barycentric coordinates in the source triangle.
template<class Body>
void ForEachSample(const GridFunctions& space, Id piece, const Vec3& origin,
  const SourceTriangle& source, const Field* scale, const QuadratureRule& rule, Body&& body)
{
  const ClippedMesh& clipped = space.clipped;
  const Index* corner = clipped.corners.data() + clipped.pieceBegin[piece];
  const std::array<Id, 3> scaleRows =
    scale ? scale->RowsOf(clipped.pieceTriangle[piece], source.Points()) : std::array<Id, 3>{};
  const Barycentric apex = source.Locate(corner[0]);
  ForEachFanTriangle(clipped, piece, origin,
    [&](const FanTriangle& triangle)
    {
      const Barycentric second = source.Locate(corner[triangle.k]);
      const Barycentric third = source.Locate(corner[triangle.k + 1]);
      for (const QuadratureRule::Point& point : rule.points)
      {
        const auto& t = point.barycentric;
        Barycentric lambda;
        for (int k = 0; k < 3; ++k)
        {
          lambda[k] = t[0] * apex[k] + t[1] * second[k] + t[2] * third[k];
        }
        const double weight = point.weight * triangle.area * ScaleAt(scale, scaleRows, lambda);
        body(triangle.At(t), weight, lambda);
      }
    });
}

/// ∫ ∂b_i / ∂axis over a piece, per axis.
std::array<CornerValues, 3> SumDerivatives(const GridFunctions& space, Id piece, const Vec3& origin,
  const SourceTriangle& source, const Field* scale, const QuadratureRule& rule)
{
  std::array<CornerValues, 3> sum{};
  ForEachSample(space, piece, origin, source, scale, rule,
    [&](const Vec3& local, double weight, const Barycentric&)
    {
      std::array<CornerValues, 3> derivative;
      TrilinearGradients(local, derivative);
      for (int axis = 0; axis < 3; ++axis)
      {
        AddScaled(weight, derivative[axis], sum[axis]);
      }
    });
  return sum;
}

/// share += weights x corner values
void AddScalars(
  const CornerWeights& weights, const Field& f, const std::array<Id, 3>& rows, const Share& share)
{
  for (int k = 0; k < 3; ++k)
  {
    const double* value = f.values.data() + rows[k] * f.values.cols() + share.firstColumn;
    for (int i = 0; i < FunctionsPerPatch; ++i)
    {
      for (Id c = 0; c < share.columns; ++c)
      {
        share.At(i, c) += weights[k][i] * value[c];
      }
    }
  }
}

/// share += factor weights · (map of the corner vectors)
template<class Map>
void AddVectors(const CornerVectors& weights, const Field& s, const std::array<Id, 3>& rows,
  double factor, const Share& share, Map&& map)
{
  for (int k = 0; k < 3; ++k)
  {
    const double* value = s.values.data() + rows[k] * s.values.cols() + 3 * share.firstColumn;
    for (Id c = 0; c < share.columns; ++c)
    {
      const Vec3 vector(value[3 * c], value[3 * c + 1], value[3 * c + 2]);
      const Vec3 tangential = factor * map(vector);
      for (int i = 0; i < FunctionsPerPatch; ++i)
      {
        share.At(i, c) += weights[k][0][i] * tangential[0] + weights[k][1][i] * tangential[1] +
                          weights[k][2][i] * tangential[2];
      }
    }
  }
}

/// ∫ <s, ∇b_i> for s = map(normal, vector of the field).
template<class Map>
MultiVector IntegrateVectors(const GridFunctions& space, const TriangleMesh& mesh, const Field& s,
  const Field* scale, const QuadratureRule& rule, int threads, const Progress& progress, Map&& map)
{
  CheckMesh(space, mesh);
  RequireVectors(s, mesh);
  RequireScale(scale, mesh);
  return IntegratePieces(space, s.values.cols() / 3, threads, progress,
    [&](Id piece, const Vec3& origin, const Share& share)
    {
      const Id triangle = space.clipped.pieceTriangle[piece];
      const SourceTriangle source(space.clipped, mesh, triangle);
      CornerVectors weights{};
      ForEachSample(space, piece, origin, source, scale, rule,
        [&](const Vec3& local, double weight, const Barycentric& lambda)
        {
          std::array<CornerValues, 3> derivative;
          TrilinearGradients(local, derivative);
          for (int k = 0; k < 3; ++k)
          {
            for (int axis = 0; axis < 3; ++axis)
            {
              AddScaled(weight * lambda[k], derivative[axis], weights[k][axis]);
            }
          }
        });
      const Vec3 normal = source.Normal();
      AddVectors(weights, s, s.RowsOf(triangle, source.Points()), space.GetGrid().spacing, share,
        [&](const Vec3& vector) { return Vec3(map(normal, vector)); });
    });
}

/// share += factor <direction, ∇b_i> with the direction of the surface gradient of Σ u_i b_i.
template<class ValueOf>
void AddDirection(const std::array<CornerValues, 3>& derivative, const Vec3& normal, double factor,
  const Share& share, Id column, ValueOf&& u)
{
  // Differences alone count: without it rounding of large values would give constants a direction.
  const double reference = u(0);
  Vec3 gradient = Vec3::Zero();
  for (int i = 1; i < FunctionsPerPatch; ++i)
  {
    gradient += (u(i) - reference) * Vec3(derivative[0][i], derivative[1][i], derivative[2][i]);
  }
  gradient -= normal.dot(gradient) * normal;
  const Vec3 direction = DirectionOf(gradient);
  for (int i = 0; i < FunctionsPerPatch; ++i)
  {
    share.At(i, column) +=
      factor * (derivative[0][i] * direction[0] + derivative[1][i] * direction[1] +
                 derivative[2][i] * direction[2]);
  }
}

} // namespace

MultiVector IntegrateValues(const GridFunctions& space, const TriangleMesh& mesh, const Field& f,
  const QuadratureRule& rule, int threads, const Progress& progress)
{
  CheckMesh(space, mesh);
  RequireField(f, mesh);
  return IntegratePieces(space, f.values.cols(), threads, progress,
    [&](Id piece, const Vec3& origin, const Share& share)
    {
      const Id triangle = space.clipped.pieceTriangle[piece];
      const SourceTriangle source(space.clipped, mesh, triangle);
      CornerWeights weights{};
      ForEachSample(space, piece, origin, source, nullptr, rule,
        [&](const Vec3& local, double weight, const Barycentric& lambda)
        {
          CornerValues b;
          TrilinearValues(local, b);
          for (int k = 0; k < 3; ++k)
          {
            AddScaled(weight * lambda[k], b, weights[k]);
          }
        });
      AddScalars(weights, f, f.RowsOf(triangle, source.Points()), share);
    });
}

MultiVector IntegrateGradients(const GridFunctions& space, const TriangleMesh& mesh, const Field& s,
  const Field* scale, const QuadratureRule& rule, int threads, const Progress& progress)
{
  return IntegrateVectors(space, mesh, s, scale, rule, threads, progress,
    [](const Vec3& normal, const Vec3& vector) { return vector - normal.dot(vector) * normal; });
}

MultiVector IntegrateTurnedGradients(const GridFunctions& space, const TriangleMesh& mesh,
  const Field& s, const QuadratureRule& rule, int threads, const Progress& progress)
{
  return IntegrateVectors(space, mesh, s, nullptr, rule, threads, progress,
    [](const Vec3& normal, const Vec3& vector) { return normal.cross(vector); });
}

MultiVector IntegrateDirections(const GridFunctions& space, const TriangleMesh& mesh,
  const MultiVector& coefficients, const Field* scale, const QuadratureRule& rule, int threads,
  const Progress& progress)
{
  CheckMesh(space, mesh);
  RequireScale(scale, mesh);
  const PatchLevel& level = space.Finest();
  if (coefficients.rows() != level.numberOfFunctions)
  {
    throw InvalidInput("There are " + std::to_string(coefficients.rows()) + " coefficients for " +
                       std::to_string(level.numberOfFunctions) + " functions.");
  }
  const double spacing = space.GetGrid().spacing;
  return IntegratePieces(space, coefficients.cols(), threads, progress,
    [&](Id piece, const Vec3& origin, const Share& share)
    {
      const SourceTriangle source(space.clipped, mesh, space.clipped.pieceTriangle[piece]);
      const Vec3 normal = source.Normal();
      const auto& dof = level.dof[space.piecePatch[piece]];
      ForEachSample(space, piece, origin, source, scale, rule,
        [&](const Vec3& local, double weight, const Barycentric&)
        {
          std::array<CornerValues, 3> derivative;
          TrilinearGradients(local, derivative);
          for (Id c = 0; c < share.columns; ++c)
          {
            AddDirection(derivative, normal, weight * spacing, share, c,
              [&](int i) { return coefficients(dof[i], share.firstColumn + c); });
          }
        });
    });
}

MultiVector IntegrateGradientsOf(const GridFunctions& space, const TriangleMesh& mesh,
  const Field& f, const Field* scale, const QuadratureRule& rule, int threads,
  const Progress& progress)
{
  CheckMesh(space, mesh);
  RequireOnPoints(f, mesh);
  RequireScale(scale, mesh);
  return IntegratePieces(space, f.values.cols(), threads, progress,
    [&](Id piece, const Vec3& origin, const Share& share)
    {
      const SourceTriangle source(space.clipped, mesh, space.clipped.pieceTriangle[piece]);
      const std::array<CornerValues, 3> sum =
        SumDerivatives(space, piece, origin, source, scale, rule);
      const std::array<Vec3, 3> gradient = source.Gradients();
      CornerWeights weights{};
      for (int k = 0; k < 3; ++k)
      {
        for (int axis = 0; axis < 3; ++axis)
        {
          AddScaled(gradient[k][axis], sum[axis], weights[k]);
        }
      }
      AddScalars(weights, f, source.Points(), share);
    });
}

MultiVector IntegrateGradientsOfCoordinates(const GridFunctions& space, const TriangleMesh& mesh,
  const Field* scale, const QuadratureRule& rule, double normalStabilization, int threads,
  const Progress& progress)
{
  CheckMesh(space, mesh);
  RequireScale(scale, mesh);
  const double spacing = space.GetGrid().spacing;
  return IntegratePieces(space, 3, threads, progress,
    [&](Id piece, const Vec3& origin, const Share& share)
    {
      const SourceTriangle source(space.clipped, mesh, space.clipped.pieceTriangle[piece]);
      const std::array<CornerValues, 3> sum =
        SumDerivatives(space, piece, origin, source, scale, rule);
      const Vec3 normal = source.Normal();
      for (int i = 0; i < FunctionsPerPatch; ++i)
      {
        const Vec3 derivative(sum[0][i], sum[1][i], sum[2][i]);
        const double less = (1.0 - normalStabilization) * normal.dot(derivative);
        for (int c = 0; c < 3; ++c)
        {
          share.At(i, c) += spacing * (derivative[c] - less * normal[c]);
        }
      }
    });
}

} // namespace gridfem
