#include "Shape/Stitching.h"

#include "Base/Errors.h"
#include "Distance/MarchedDistance.h"
#include "Equations/Poisson.h"
#include "Grid/TriangleArea.h"
#include "Spaces/PointComponents.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <string>
#include <tuple>

namespace gridfem
{
namespace
{

/// Weight of the change by stitching, per squared unit of length: 1 / (2 cells)². The change is
/// harmonic inside a scan; details of the colors that functions cannot represent are finer.
constexpr double DetailWeight = 0.25;

void RequireLabels(const ScanLabels& labels, const TriangleMesh& mesh)
{
  const bool areOnPoints = labels.association == FieldAssociation::Points;
  const std::size_t rows = areOnPoints ? mesh.points.size() : mesh.triangles.size();
  if (labels.values.size() != rows)
  {
    throw InvalidInput("There are " + std::to_string(labels.values.size()) + " labels for " +
                       std::to_string(rows) + (areOnPoints ? " points." : " triangles."));
  }
  if (std::any_of(labels.values.begin(), labels.values.end(), [](Index l) { return l < 0; }))
  {
    throw InvalidInput("Labels of scans must not be negative.");
  }
}

/// The scan of a triangle with labels on points. For a color on the triangle itself, it is the
/// label of most corners.
Index ScanOfCorners(const std::array<Index, 3>& label, bool isMajority)
{
  if (label[0] == label[1] && label[0] == label[2])
  {
    return label[0];
  }
  if (!isMajority)
  {
    return ScanCut::Seam;
  }
  return label[1] == label[2] ? label[1] : label[0];
}

std::vector<Index> ScansOfTriangles(
  const TriangleMesh& mesh, const ScanLabels& labels, FieldAssociation colors)
{
  const std::vector<Index>& label = labels.values;
  std::vector<Index> scan(mesh.triangles.size());
  if (labels.association == FieldAssociation::Points)
  {
    for (std::size_t t = 0; t < scan.size(); ++t)
    {
      const auto& corner = mesh.triangles[t];
      scan[t] = ScanOfCorners({ label[corner[0]], label[corner[1]], label[corner[2]] },
        colors == FieldAssociation::Triangles);
    }
    return scan;
  }
  if (colors == FieldAssociation::Triangles)
  {
    return label;
  }
  std::vector<Index> low(mesh.points.size(), std::numeric_limits<Index>::max());
  std::vector<Index> high(mesh.points.size(), -1);
  for (std::size_t t = 0; t < scan.size(); ++t)
  {
    for (const Id point : mesh.triangles[t])
    {
      low[point] = std::min(low[point], label[t]);
      high[point] = std::max(high[point], label[t]);
    }
  }
  for (std::size_t t = 0; t < scan.size(); ++t)
  {
    const auto& corner = mesh.triangles[t];
    const bool isInside = std::all_of(
      corner.begin(), corner.end(), [&](Id point) { return low[point] == high[point]; });
    scan[t] = isInside ? label[t] : ScanCut::Seam;
  }
  return scan;
}

/// A corner of a triangle that is not a seam, by place and scan.
struct ScanCorner
{
  Index place; // welded id of its point
  Index scan;
  Id corner; // 3 triangle of the pieces + corner
};

/// Numbers the points of the pieces. Each place has one point per scan.
void NumberPoints(const TriangleMesh& mesh, ScanCut& cut)
{
  const Array<Index> place = WeldCoincidentPoints(mesh.points, UsedPoints(mesh));
  std::vector<ScanCorner> corners;
  corners.reserve(3 * cut.triangleOfPiece.size());
  for (std::size_t piece = 0; piece < cut.triangleOfPiece.size(); ++piece)
  {
    const Id triangle = cut.triangleOfPiece[piece];
    for (int k = 0; k < 3; ++k)
    {
      corners.push_back({ place[mesh.triangles[triangle][k]], cut.scanOfTriangle[triangle],
        static_cast<Id>(3 * piece) + k });
    }
  }
  std::sort(corners.begin(), corners.end(),
    [](const ScanCorner& a, const ScanCorner& b)
    { return std::tie(a.place, a.scan, a.corner) < std::tie(b.place, b.scan, b.corner); });
  cut.pieces.triangles.resize(cut.triangleOfPiece.size());
  cut.pointOfPoint.assign(mesh.points.size(), -1);
  for (std::size_t k = 0; k < corners.size(); ++k)
  {
    const ScanCorner& c = corners[k];
    if (k == 0 || corners[k - 1].place != c.place || corners[k - 1].scan != c.scan)
    {
      cut.pieces.points.push_back(mesh.points[c.place]);
    }
    const auto number = static_cast<Index>(cut.pieces.points.size()) - 1;
    cut.pieces.triangles[c.corner / 3][c.corner % 3] = number;
    cut.pointOfPoint[mesh.triangles[cut.triangleOfPiece[c.corner / 3]][c.corner % 3]] = number;
  }
}

/// Means of the values on the triangles around each point of the pieces, weighted by area.
MultiVector MeansAtPoints(const ScanCut& cut, const MultiVector& onTriangles)
{
  const auto points = static_cast<Id>(cut.pieces.points.size());
  MultiVector mean = MultiVector::Zero(points, onTriangles.cols());
  std::vector<double> area(points, 0.0);
  for (std::size_t piece = 0; piece < cut.triangleOfPiece.size(); ++piece)
  {
    const double own = AreaOf(cut.pieces, static_cast<Id>(piece));
    for (const Id point : cut.pieces.triangles[piece])
    {
      mean.row(point) += own * onTriangles.row(cut.triangleOfPiece[piece]);
      area[point] += own;
    }
  }
  for (Id point = 0; point < points; ++point)
  {
    mean.row(point) *= area[point] > 0.0 ? 1.0 / area[point] : 0.0;
  }
  return mean;
}

/// The means of values at the corners of each triangle.
MultiVector MeansOnTriangles(
  const std::vector<std::array<Id, 3>>& triangles, const MultiVector& atPoints)
{
  MultiVector mean(static_cast<Id>(triangles.size()), atPoints.cols());
  for (Id t = 0; t < mean.rows(); ++t)
  {
    const auto& corner = triangles[t];
    mean.row(t) =
      (atPoints.row(corner[0]) + atPoints.row(corner[1]) + atPoints.row(corner[2])) / 3.0;
  }
  return mean;
}

/// The gradients of values at the points of the pieces, on the triangles of the mesh: three columns
/// for each; 0 on seams and on triangles without an area.
MultiVector GradientsOnTriangles(const ScanCut& cut, const MultiVector& atPoints)
{
  const auto triangles = static_cast<Id>(cut.scanOfTriangle.size());
  MultiVector gradient = MultiVector::Zero(triangles, 3 * atPoints.cols());
  for (std::size_t piece = 0; piece < cut.triangleOfPiece.size(); ++piece)
  {
    const auto& corner = cut.pieces.triangles[piece];
    const std::array<Vec3, 3> p = { cut.pieces.points[corner[0]], cut.pieces.points[corner[1]],
      cut.pieces.points[corner[2]] };
    const Vec3 normal = (p[1] - p[0]).cross(p[2] - p[0]);
    for (int k = 0; k < 3 && normal.squaredNorm() > 0.0; ++k)
    {
      const Vec3 ofCorner =
        normal.cross(Vec3(p[(k + 2) % 3] - p[(k + 1) % 3])) / normal.squaredNorm();
      for (Id c = 0; c < atPoints.cols(); ++c)
      {
        for (int axis = 0; axis < 3; ++axis)
        {
          gradient(cut.triangleOfPiece[piece], 3 * c + axis) +=
            ofCorner[axis] * atPoints(corner[k], c);
        }
      }
    }
  }
  return gradient;
}

/// ∫ <s, ∇b_i> with the gradients that are kept.
MultiVector LoadOfKeptGradients(const FiniteElementSpace& space, const ScanCut& cut,
  const std::vector<double>& share, const Field& colors, const Job& job)
{
  const Field kept{ FieldAssociation::Triangles,
    Eigen::Map<const Eigen::VectorXd>(share.data(), static_cast<Eigen::Index>(share.size())) };
  if (colors.association == FieldAssociation::Triangles)
  {
    const Field gradients{ FieldAssociation::Triangles,
      GradientsOnTriangles(cut, MeansAtPoints(cut, colors.values)) };
    return space.LoadOfGradients(gradients, &kept, job);
  }
  return space.LoadOfGradientsOf(colors, &kept, job);
}

/// Whether each point of the mesh is a corner of a seam, or of triangles of two scans.
/// @param hats  coincident points have the same function
std::vector<char> PointsOnSeams(
  const TriangleMesh& mesh, const HatFunctions& hats, const ScanCut& cut)
{
  constexpr Index None = -2; // no triangle yet
  std::vector<Index> scan(hats.Count(), None);
  std::vector<char> isOnSeam(mesh.points.size(), 0);
  for (std::size_t t = 0; t < mesh.triangles.size(); ++t)
  {
    for (const Id point : mesh.triangles[t])
    {
      if (hats.ofPoint[point] < 0)
      {
        continue; // has only flat triangles
      }
      Index& known = scan[hats.ofPoint[point]];
      known =
        known == None || known == cut.scanOfTriangle[t] ? cut.scanOfTriangle[t] : ScanCut::Seam;
    }
  }
  for (std::size_t point = 0; point < isOnSeam.size(); ++point)
  {
    const Index function = hats.ofPoint[point];
    isOnSeam[point] = function >= 0 && scan[function] == ScanCut::Seam;
  }
  return isOnSeam;
}

/// Rows at the colors' points or triangles, as rows of the pieces.
Field OnPieces(const ScanCut& cut, FieldAssociation association, const MultiVector& rows)
{
  Field field{ association, {} };
  if (association == FieldAssociation::Triangles)
  {
    field.values.resize(static_cast<Id>(cut.triangleOfPiece.size()), rows.cols());
    for (Id piece = 0; piece < field.values.rows(); ++piece)
    {
      field.values.row(piece) = rows.row(cut.triangleOfPiece[piece]);
    }
    return field;
  }
  field.values.resize(static_cast<Id>(cut.pieces.points.size()), rows.cols());
  for (Id point = 0; point < rows.rows(); ++point)
  {
    if (cut.pointOfPoint[point] >= 0)
    {
      field.values.row(cut.pointOfPoint[point]) = rows.row(point);
    }
  }
  return field;
}

/// The share of details that is kept in each row of the colors. It is the share of the gradients
/// around the row.
std::vector<double> SharesOfRows(
  const ScanCut& cut, FieldAssociation association, const std::vector<double>& share)
{
  if (association == FieldAssociation::Triangles)
  {
    return share;
  }
  const MultiVector mean = MeansAtPoints(
    cut, Eigen::Map<const Eigen::VectorXd>(share.data(), static_cast<Eigen::Index>(share.size())));
  std::vector<double> ofRow(cut.pointOfPoint.size(), 1.0);
  for (std::size_t row = 0; row < ofRow.size(); ++row)
  {
    ofRow[row] = cut.pointOfPoint[row] >= 0 ? mean(cut.pointOfPoint[row], 0) : 1.0;
  }
  return ofRow;
}

/// Restores details. The new values are the colors plus the smoothed change within scans, to the
/// extent that details are kept. Values without a piece stay.
SolveReport KeepDetails(const FiniteElementSpace& details, const ScanCut& cut,
  const std::vector<double>& shareOfRow, const Field& colors, const PoissonOptions& solver,
  const Job& job, MultiVector& values)
{
  PoissonOptions poisson = solver;
  poisson.screeningWeight = DetailWeight;
  const Field change = OnPieces(cut, colors.association, values - colors.values);
  const Multigrid multigrid =
    BuildMultigrid(details, DetailWeight, 1.0, solver.multigrid, job.progress.Part(0.0, 0.3));
  PoissonSolution solution = SolvePoisson(details, multigrid,
    details.LoadOfValues(change, job.Part(0.3, 0.5)), {}, poisson, job.progress.Part(0.5, 1.0));
  MultiVector smoothed = details.ValuesAtPoints(solution.coefficients, job.threads);
  const bool areOnPoints = colors.association == FieldAssociation::Points;
  const std::vector<char> isSmoothed = details.PointsWithFunctions();
  if (!areOnPoints)
  {
    smoothed = MeansOnTriangles(cut.pieces.triangles, smoothed);
  }
  const std::vector<Index>& pieceOf = areOnPoints ? cut.pointOfPoint : cut.pieceOfTriangle;
  for (Id row = 0; row < values.rows(); ++row)
  {
    const Index piece = pieceOf[row];
    if (piece >= 0 && (!areOnPoints || isSmoothed[piece]))
    {
      values.row(row) +=
        shareOfRow[row] * (colors.values.row(row) + smoothed.row(piece) - values.row(row));
    }
  }
  return std::move(solution.report);
}

/// The function at the colors' own points or triangles. Points without a function keep their color.
MultiVector AtColors(const FiniteElementSpace& space, const TriangleMesh& mesh, const Field& colors,
  const MultiVector& coefficients, const Job& job)
{
  MultiVector values = space.ValuesAtPoints(coefficients, job);
  if (colors.association == FieldAssociation::Triangles)
  {
    return MeansOnTriangles(mesh.triangles, values);
  }
  const std::vector<char> has = space.PointsWithFunctions();
  for (Id point = 0; point < values.rows(); ++point)
  {
    if (!has[point])
    {
      values.row(point) = colors.values.row(point);
    }
  }
  return values;
}

/// Adds constants, so that on every component the reference keeps the mean of its own colors.
void KeepMeanOf(Index reference, const FiniteElementSpace& space, const TriangleMesh& mesh,
  const ScanCut& cut, const Field& colors, const Job& job, MultiVector& values)
{
  const Components components = space.ComponentsOf(0, job);
  const std::vector<Index> component = ComponentsOfPoints(space, components, job);
  const Index count = components.count;
  MultiVector change = MultiVector::Zero(count, values.cols());
  std::vector<double> area(count, 0.0);
  for (const std::size_t t : cut.triangleOfPiece)
  {
    const auto& corner = mesh.triangles[t];
    const Index own = component[corner[0]];
    if (cut.scanOfTriangle[t] == reference && own >= 0)
    {
      const double third = AreaOf(mesh, static_cast<Id>(t)) / 3.0;
      for (const Id row : colors.RowsOf(static_cast<Id>(t), corner))
      {
        change.row(own) += third * (colors.values.row(row) - values.row(row));
        area[own] += third;
      }
    }
  }
  for (Id row = 0; row < values.rows(); ++row)
  {
    const bool isOnPoints = colors.association == FieldAssociation::Points;
    const Index own = component[isOnPoints ? row : mesh.triangles[row][0]];
    if (own >= 0 && area[own] > 0.0)
    {
      values.row(row) += change.row(own) / area[own];
    }
  }
}

} // namespace

ScanCut CutAtSeams(const TriangleMesh& mesh, const ScanLabels& labels, FieldAssociation colors)
{
  RequireLabels(labels, mesh);
  ScanCut cut;
  cut.scanOfTriangle = ScansOfTriangles(mesh, labels, colors);
  cut.pieceOfTriangle.assign(cut.scanOfTriangle.size(), -1);
  for (std::size_t t = 0; t < cut.scanOfTriangle.size(); ++t)
  {
    if (cut.scanOfTriangle[t] != ScanCut::Seam)
    {
      cut.pieceOfTriangle[t] = static_cast<Index>(cut.triangleOfPiece.size());
      cut.triangleOfPiece.push_back(static_cast<Id>(t));
    }
  }
  NumberPoints(mesh, cut);
  return cut;
}

std::vector<double> KeptShares(const TriangleMesh& mesh, const ScanCut& cut, double width)
{
  if (!(width >= 0.0) || std::isinf(width))
  {
    throw InvalidInput(
      "The blend width is " + std::to_string(width) + "; it must be a number of 0 or more.");
  }
  std::vector<double> share(mesh.triangles.size(), 1.0);
  if (width > 0.0)
  {
    const HatFunctions hats = NumberHatFunctions(mesh);
    const std::vector<double> distance =
      MarchDistance(mesh, hats, PointsOnSeams(mesh, hats, cut), width);
    for (std::size_t t = 0; t < share.size(); ++t)
    {
      double mean = 0.0;
      for (const Id point : mesh.triangles[t])
      {
        mean += std::min(distance[point], width) / (3.0 * width);
      }
      share[t] = mean * mean * (3.0 - 2.0 * mean);
    }
  }
  for (std::size_t t = 0; t < share.size(); ++t)
  {
    share[t] = cut.scanOfTriangle[t] == ScanCut::Seam ? 0.0 : share[t];
  }
  return share;
}

StitchedColors StitchColors(const FiniteElementSpace& space, const TriangleMesh& mesh,
  const ScanCut& cut, const Field& colors, const StitchOptions& options,
  const FiniteElementSpace* details, const Job& job)
{
  RequireField(colors, mesh);
  PoissonOptions poisson{ options, 0.0 };
  poisson.estimateErrors = true;
  const MultiVector values = space.LoadOfValues(colors, job.Part(0.0, 0.1));
  const std::vector<double> share = KeptShares(mesh, cut, options.blendWidth);
  const MultiVector gradients = LoadOfKeptGradients(space, cut, share, colors, job.Part(0.1, 0.2));
  const Multigrid multigrid =
    BuildMultigrid(space, 0.0, 1.0, options.multigrid, job.progress.Part(0.2, 0.4));
  PoissonSolution solution =
    SolvePoisson(space, multigrid, values, gradients, poisson, job.progress.Part(0.4, 0.7));

  StitchedColors stitched;
  stitched.values = AtColors(space, mesh, colors, solution.coefficients, job.threads);
  stitched.report = std::move(solution.report);
  stitched.accuracy = solution.accuracy;
  if (details && !cut.triangleOfPiece.empty())
  {
    SolveReport report = KeepDetails(*details, cut, SharesOfRows(cut, colors.association, share),
      colors, poisson, job.Part(0.7, 1.0), stitched.values);
    if (stitched.report.converged && !report.converged)
    {
      stitched.report = std::move(report);
    }
  }
  if (options.reference)
  {
    KeepMeanOf(*options.reference, space, mesh, cut, colors, job.threads, stitched.values);
  }
  job.Check(1.0);
  return stitched;
}

} // namespace gridfem
