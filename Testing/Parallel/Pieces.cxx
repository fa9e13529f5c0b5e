#include "Pieces.h"

#include <gtest/gtest.h>

#include <cmath>

namespace gridfem::testing
{

RankSpaceOptions StableOptions()
{
  RankSpaceOptions options = Options(4);
  options.space.normalStabilization = 1e-2; // small tolerances in few iterations
  return options;
}

std::unique_ptr<const FiniteElementSpace> WholeSpace(
  const TriangleMesh& mesh, const RankSpaceOptions& options, bool hasHats)
{
  if (hasHats)
  {
    return std::make_unique<HatSpace>(BuildHatSpace(mesh, options.space));
  }
  return std::make_unique<GridSpace>(BuildGridSpace(mesh, options.space));
}

MultiVector VectorsAt(const std::vector<Vec3>& points)
{
  MultiVector values(static_cast<Id>(points.size()), 3);
  for (std::size_t k = 0; k < points.size(); ++k)
  {
    const Vec3& p = points[k];
    values.row(static_cast<Id>(k)) << std::sin(2.0 * p[0]) + p[1], p[0] * p[2], std::cos(p[1]);
  }
  return values;
}

EquationOptions Exactly()
{
  EquationOptions options;
  options.multigrid.threads = 1;
  options.solve.tolerance = 1e-12;
  options.solve.maximumIterations = 300;
  return options;
}

PoissonSolution SolveScreened(
  const SurfaceSpace& space, const MultiVector& f, const PoissonOptions& options)
{
  const Field field{ FieldAssociation::Points, f };
  const Multigrid multigrid =
    BuildMultigrid(space, options.screeningWeight, 1.0, options.multigrid);
  return SolvePoisson(
    space, multigrid, space.LoadOfValues(field), space.LoadOfGradientsOf(field, nullptr), options);
}

Piece PieceOf(const TriangleMesh& mesh, Dealing dealing, bool withCopies)
{
  const Communicator ranks(MPI_COMM_WORLD);
  const std::vector<int> rankOf = Deal(mesh, dealing, ranks.Size());
  Piece piece;
  piece.mesh = PartOf(mesh, rankOf, ranks.Rank(), &piece.points);
  std::vector<Id> place(mesh.points.size(), -1);
  for (std::size_t k = 0; k < piece.points.size(); ++k)
  {
    place[piece.points[k]] = static_cast<Id>(k);
  }
  const std::vector<Id> own = place;
  for (Id t = 0; t < static_cast<Id>(mesh.triangles.size()); ++t)
  {
    const auto& corners = mesh.triangles[t];
    if (rankOf[t] == ranks.Rank())
    {
      piece.triangles.push_back(t);
      continue;
    }
    if (!withCopies || (own[corners[0]] < 0 && own[corners[1]] < 0 && own[corners[2]] < 0))
    {
      continue;
    }
    piece.originals.push_back(t);
    auto& copy = piece.copies.emplace_back();
    for (int corner = 0; corner < 3; ++corner)
    {
      Id& point = place[corners[corner]];
      if (point < 0)
      {
        point = static_cast<Id>(piece.mesh.points.size());
        piece.mesh.points.push_back(mesh.points[corners[corner]]);
        piece.points.push_back(corners[corner]);
      }
      copy[corner] = point;
    }
  }
  return piece;
}

void ExpectRows(const char* name, const MultiVector& found, const MultiVector& whole,
  const std::vector<Id>& places, const std::vector<char>& isCompared)
{
  SCOPED_TRACE(name);
  ASSERT_EQ(found.rows(), static_cast<Id>(places.size()));
  ASSERT_EQ(found.cols(), whole.cols());
  const double allowed =
    1e-8 * whole.array().isNaN().select(0.0, whole.array().abs()).maxCoeff<Eigen::PropagateNaN>();
  for (Id k = 0; k < found.rows(); ++k)
  {
    if (!isCompared.empty() && !isCompared[places[k]])
    {
      continue;
    }
    for (Id c = 0; c < found.cols(); ++c)
    {
      const double wanted = whole(places[k], c);
      ASSERT_EQ(std::isnan(found(k, c)), std::isnan(wanted)) << "row " << k;
      ASSERT_FALSE(std::abs(found(k, c) - wanted) > allowed)
        << "row " << k << ": " << found(k, c) << " instead of " << wanted;
    }
  }
}

} // namespace gridfem::testing
