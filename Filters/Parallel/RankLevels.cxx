#include "Parallel/RankLevels.h"

#include "Integrals/Evaluation.h"
#include "Parallel/RankComponents.h"
#include "Spaces/PatchOrdering.h"

#include <optional>

namespace gridfem
{

RankLevels::RankLevels(const RankSpace& space, const RankHats* hats) : space_(space), hats_(hats)
{
  if (hats)
  {
    grid_ = std::make_unique<const RankLevels>(space);
  }
  space.Ranks().Together(
    [&]
    {
      if (hats)
      {
        rows_.emplace_back(
          space.Ranks(), hats->Numbering().ghosts, hats->Numbering().neighbors, true);
      }
      const std::vector<LevelNumbering>& numberings = space.Numberings();
      for (std::size_t l = 0; l < numberings.size(); ++l)
      {
        rows_.emplace_back(space.Ranks(), numberings[l].ghosts, numberings[l].neighbors);
        parts_.push_back(PatchesByRanks(space.Own().Functions().levels[l], numberings[l]));
      }
      integrals_ = this->Own().Integrals();
      areas_ = hats ? hats->IsIntegrated()
                    : AreasOfPieces(space.Own().Functions(),
                        static_cast<Id>(space.Own().Mesh().triangles.size()));
    });
  rows_.front().Sum(
    Eigen::Map<MultiVector>(integrals_.data(), static_cast<Id>(integrals_.size()), 1));
}

const FiniteElementSpace& RankLevels::Own() const
{
  return hats_ ? static_cast<const FiniteElementSpace&>(hats_->Own()) : space_.Own();
}

const LevelNumbering& RankLevels::Numbering(std::size_t level) const
{
  return this->IsOfHats(level) ? hats_->Numbering() : space_.Numberings()[this->GridLevel(level)];
}

std::size_t RankLevels::NumberOfLevels() const
{
  return rows_.size() + space_.Shared().NumberOfLevels();
}

const SpaceLevels& RankLevels::HolderOf(std::size_t level) const
{
  return this->IsDivided(level) ? static_cast<const SpaceLevels&>(this->Own()) : space_.Shared();
}

std::size_t RankLevels::LevelThere(std::size_t level) const
{
  return this->IsDivided(level) ? level : level - rows_.size();
}

Index RankLevels::NumberOfFunctions(std::size_t level) const
{
  return this->IsDivided(level) ? static_cast<Index>(this->Numbering(level).total)
                                : this->HolderOf(level).NumberOfFunctions(this->LevelThere(level));
}

void RankLevels::FillMatrix(
  std::size_t level, double a, double b, SparseMatrix& matrix, const Job& job) const
{
  space_.Ranks().Together(
    [&] { this->HolderOf(level).FillMatrix(this->LevelThere(level), a, b, matrix, job); });
}

SharedMatrix RankLevels::Prolongation(std::size_t level) const
{
  return this->HolderOf(level).Prolongation(this->LevelThere(level));
}

SharedMatrix RankLevels::Restriction(std::size_t level) const
{
  return this->HolderOf(level).Restriction(this->LevelThere(level));
}

LevelRelaxation RankLevels::Relaxation(std::size_t level, const MultigridOptions& options) const
{
  LevelRelaxation relaxation;
  space_.Ranks().Together(
    [&]
    {
      if (this->IsDivided(level) && !this->IsOfHats(level))
      {
        const std::size_t l = this->GridLevel(level);
        relaxation.order = OrderPatches(parts_[l].front(), space_.Own().Functions().levels[l]);
        return;
      }
      relaxation = this->HolderOf(level).Relaxation(this->LevelThere(level), options);
    });
  return relaxation;
}

Components RankLevels::ComponentsOf(std::size_t level, const Job& job) const
{
  Components components;
  space_.Ranks().Together(
    [&] { components = this->HolderOf(level).ComponentsOf(this->LevelThere(level), job); });
  return this->IsDivided(level)
           ? ComponentsOfRanks(space_.Ranks(), this->Numbering(level), rows_[level], components)
           : components;
}

double RankLevels::Extent() const
{
  return space_.Own().Extent();
}

Columns RankLevels::SquaredNorms(const MultiVector& u, const Job& job) const
{
  Columns norms;
  space_.Ranks().Together([&] { norms = this->Own().SquaredNorms(u, job); });
  space_.Ranks().Sum(norms.data(), norms.size());
  return norms;
}

/// Shared rows have the same bits on all ranks, so any of them may return a value.
MultiVector RankLevels::ValuesAtPoints(const MultiVector& coefficients, const Job& job) const
{
  return this->ValuesOf(coefficients, nullptr, job);
}

MultiVector RankLevels::ValuesOf(
  const MultiVector& coefficients, std::vector<char>* hasValue, const Job& job) const
{
  MultiVector values;
  MultiVector own;
  std::vector<char> isHere;
  space_.Ranks().Together(
    [&]
    {
      values = this->Own().ValuesAtPoints(coefficients, job.threads);
      isHere = this->Own().PointsWithFunctions();
      own = MultiVector::Zero(space_.Distribution().NumberOfOwnPoints(), coefficients.cols());
    });
  std::vector<char> isReturned = space_.Distribution().ReturnPoints(values, isHere, own);
  if (hasValue)
  {
    *hasValue = std::move(isReturned);
  }
  return own;
}

double RankLevels::UnitLength() const
{
  return space_.Own().UnitLength();
}

/// Sends a field to the triangles that this rank has received.
Field RankLevels::Send(const Field& own) const
{
  return { own.association, own.association == FieldAssociation::Points
                              ? space_.Distribution().SendPoints(own.values)
                              : space_.Distribution().SendTriangles(own.values) };
}

/// Adds up a load over the ranks.
/// @param integrate  returns this rank's part, using a number of threads
template<class Integrate>
MultiVector RankLevels::Load(const Job& job, Integrate&& integrate) const
{
  MultiVector load;
  space_.Ranks().Together([&] { load = integrate(job.threads); });
  rows_.front().Sum(load);
  job.Check(1.0);
  return load;
}

MultiVector RankLevels::LoadOfValues(const Field& f, const Job& job) const
{
  const Field here = this->Send(f);
  return this->Load(job, [&](int threads) { return this->Own().LoadOfValues(here, threads); });
}

MultiVector RankLevels::LoadOfWeightedValues(
  const Field& f, const std::vector<double>& weight, const Job& job) const
{
  const Field here = this->Send(f);
  const std::vector<double> weightHere = space_.SendToTriangles(weight);
  return this->Load(
    job, [&](int threads) { return this->Own().LoadOfWeightedValues(here, weightHere, threads); });
}

MultiVector RankLevels::LoadOfGradients(const Field& s, const Field* scale, const Job& job) const
{
  const Field here = this->Send(s);
  const Field factor = scale ? this->Send(*scale) : Field();
  return this->Load(job, [&](int threads)
    { return this->Own().LoadOfGradients(here, scale ? &factor : nullptr, threads); });
}

MultiVector RankLevels::LoadOfGradientsOf(const Field& f, const Field* scale, const Job& job) const
{
  const Field here = this->Send(f);
  const Field factor = scale ? this->Send(*scale) : Field();
  return this->Load(job, [&](int threads)
    { return this->Own().LoadOfGradientsOf(here, scale ? &factor : nullptr, threads); });
}

MultiVector RankLevels::LoadOfGradientsOfCoordinates(const Field* scale, const Job& job) const
{
  const Field factor = scale ? this->Send(*scale) : Field();
  return this->Load(job, [&](int threads)
    { return this->Own().LoadOfGradientsOfCoordinates(scale ? &factor : nullptr, threads); });
}

/// Collective. Combines the means of a triangle from the ranks that have parts of it, weighted by
/// area.
/// @param means  rows = received triangles
/// @return       rows = own triangles
MultiVector RankLevels::MeansOfRanks(
  const MultiVector& means, const std::vector<double>& areas) const
{
  MultiVector shares;
  space_.Ranks().Together(
    [&]
    {
      const Eigen::Map<const Eigen::VectorXd> weights(
        areas.data(), static_cast<Eigen::Index>(areas.size()));
      shares.resize(means.rows(), means.cols() + 1);
      shares << weights.asDiagonal() * means, weights;
    });
  const MultiVector sums = space_.Distribution().SumTriangles(shares);
  MultiVector result;
  space_.Ranks().Together(
    [&]
    {
      result = sums.leftCols(sums.cols() - 1);
      for (Id t = 0; t < result.rows(); ++t)
      {
        const double area = sums(t, result.cols());
        result.row(t) *= area > 0.0 ? 1.0 / area : 0.0;
      }
    });
  return result;
}

MultiVector RankLevels::GradientsOnTriangles(const MultiVector& coefficients, const Job& job) const
{
  MultiVector means;
  space_.Ranks().Together(
    [&] { means = this->Own().GradientsOnTriangles(coefficients, job.threads); });
  return this->MeansOfRanks(means, areas_);
}

MultiVector RankLevels::LoadOfDirections(
  const MultiVector& coefficients, const Field& scale, const Job& job) const
{
  if (!hats_)
  {
    const Field factor = this->Send(scale);
    return this->Load(job,
      [&](int threads) { return space_.Own().LoadOfDirections(coefficients, &factor, threads); });
  }
  MultiVector directions;
  space_.Ranks().Together(
    [&]
    {
      directions = MeanDirections(space_.Own().Functions(),
        static_cast<Id>(space_.Own().Mesh().triangles.size()), coefficients, job.threads);
    });
  const Field means{ FieldAssociation::Triangles, this->MeansOfRanks(directions, grid_->areas_) };
  return this->LoadOfGradients(means, &scale, job);
}

std::vector<char> RankLevels::PointsWithFunctions() const
{
  std::vector<char> has;
  this->ValuesOf(MultiVector::Zero(static_cast<Id>(integrals_.size()), 1), &has, {});
  return has;
}

std::shared_ptr<const SurfaceSpace> RankLevels::WithWeightedMass(
  const std::vector<double>& weight, const Job& job) const
{
  struct Weighted
  {
    RankSpace space;
    std::optional<RankHats> hats;
    std::unique_ptr<const RankLevels> levels;
  };
  const std::vector<double> received = space_.SendToTriangles(weight);
  const auto weighted = std::make_shared<Weighted>(Weighted{ space_, {}, nullptr });
  std::optional<GridSpace> grid;
  space_.Ranks().Together(
    [&]
    {
      if (hats_)
      {
        HatSpace own = hats_->Own();
        own.WeighMass(received, job.threads); // including its grid
        grid.emplace(own.Grid());
        weighted->hats = hats_->WithOwn(std::move(own));
        return;
      }
      grid.emplace(space_.Own());
      grid->WeighMass(received, job.threads);
    });
  weighted->space = space_.WithOwn(std::move(*grid), job.threads);
  weighted->levels = std::make_unique<const RankLevels>(
    weighted->space, weighted->hats ? &*weighted->hats : nullptr);
  job.Check(1.0);
  return { weighted, weighted->levels.get() };
}

const DistributedRows* RankLevels::Distributed(std::size_t level) const
{
  return this->IsDivided(level) ? &rows_[level] : nullptr;
}

std::shared_ptr<const DistributedLevel> RankLevels::Divide(
  std::size_t level, const SparseMatrix& A, const MultigridOptions& options) const
{
  if (!this->IsDivided(level))
  {
    return nullptr;
  }
  LevelBorder border =
    this->IsOfHats(level)
      ? BorderOfGroups(space_.Ranks(), this->Numbering(level), A, options.threads)
      : BorderOfPatches(space_.Ranks(), this->Numbering(level), parts_[this->GridLevel(level)]);
  return std::make_shared<RankLevel>(space_.Ranks(), this->Numbering(level), rows_[level],
    this->IsDivided(level + 1) ? &rows_[level + 1] : nullptr, std::move(border), A,
    options.threads);
}

Progress OfAllRanks(const Communicator& ranks, const Progress& progress)
{
  return Progress(
    [ranks, progress](double fraction)
    {
      double wish = progress.Report(fraction) ? 0.0 : 1.0;
      ranks.Maximum(&wish, 1);
      return wish == 0.0;
    });
}

} // namespace gridfem
