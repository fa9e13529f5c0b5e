#include "Parallel/RankLevels.h"

#include "Integrals/Evaluation.h"
#include "Parallel/RankComponents.h"
#include "Spaces/PatchOrdering.h"

namespace gridfem
{

RankLevels::RankLevels(const RankSpace& space) : space_(space)
{
  space.Ranks().Together(
    [&]
    {
      const std::vector<LevelNumbering>& numberings = space.Numberings();
      rows_.reserve(numberings.size());
      for (std::size_t l = 0; l < numberings.size(); ++l)
      {
        rows_.emplace_back(space.Ranks(), numberings[l].foreign, numberings[l].neighbours);
        parts_.push_back(PatchesByRanks(space.Own().Functions().levels[l], numberings[l]));
      }
      integrals_ = space.Own().Integrals();
      areas_ = AreasOfPieces(
        space.Own().Functions(), static_cast<Id>(space.Own().Mesh().triangles.size()));
    });
  rows_.front().Sum(
    Eigen::Map<MultiVector>(integrals_.data(), static_cast<Id>(integrals_.size()), 1));
}

std::size_t RankLevels::NumberOfLevels() const
{
  return rows_.size() + space_.Shared().NumberOfLevels();
}

const GridSpace& RankLevels::HolderOf(std::size_t level) const
{
  return this->IsDivided(level) ? space_.Own() : space_.Shared();
}

std::size_t RankLevels::LevelThere(std::size_t level) const
{
  return this->IsDivided(level) ? level : level - rows_.size();
}

Index RankLevels::NumberOfFunctions(std::size_t level) const
{
  return this->IsDivided(level) ? static_cast<Index>(space_.Numberings()[level].total)
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
      relaxation = this->IsDivided(level)
                     ? LevelRelaxation{ OrderPatches(parts_[level].front()), {}, {} }
                     : this->HolderOf(level).Relaxation(this->LevelThere(level), options);
    });
  return relaxation;
}

Components RankLevels::ComponentsOf(std::size_t level, const Job& job) const
{
  if (this->IsDivided(level))
  {
    return ComponentsOfRanks(space_.Ranks(), space_.Numberings()[level], rows_[level],
      space_.Own().Functions().levels[level]);
  }
  Components components;
  space_.Ranks().Together(
    [&] { components = this->HolderOf(level).ComponentsOf(this->LevelThere(level), job); });
  return components;
}

double RankLevels::Extent() const
{
  return space_.Own().Extent();
}

Columns RankLevels::SquaredNorms(const MultiVector& u, const Job& job) const
{
  Columns norms;
  space_.Ranks().Together([&] { norms = space_.Own().SquaredNorms(u, job); });
  space_.Ranks().Sum(norms.data(), norms.size());
  return norms;
}

MultiVector RankLevels::ValuesAtPoints(const MultiVector& coefficients, const Job&) const
{
  return space_.ValuesAtPoints(coefficients, space_.Distribution().NumberOfOwnPoints());
}

double RankLevels::UnitLength() const
{
  return space_.Own().UnitLength();
}

/// A field on the triangles that this rank has received.
Field RankLevels::Send(const Field& own) const
{
  return { own.association, own.association == FieldAssociation::Points
                              ? space_.Distribution().SendPoints(own.values)
                              : space_.Distribution().SendTriangles(own.values) };
}

/// @param integrate  returns what this rank's patches add, on a number of threads
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
  return this->Load(job, [&](int threads) { return space_.Own().LoadOfValues(here, threads); });
}

MultiVector RankLevels::LoadOfWeightedValues(
  const Field& f, const std::vector<double>& weight, const Job& job) const
{
  const Field here = this->Send(f);
  const std::vector<double> weightHere = space_.SendToTriangles(weight);
  return this->Load(
    job, [&](int threads) { return space_.Own().LoadOfWeightedValues(here, weightHere, threads); });
}

MultiVector RankLevels::LoadOfGradients(const Field& s, const Field* scale, const Job& job) const
{
  const Field here = this->Send(s);
  const Field factor = scale ? this->Send(*scale) : Field();
  return this->Load(job, [&](int threads)
    { return space_.Own().LoadOfGradients(here, scale ? &factor : nullptr, threads); });
}

MultiVector RankLevels::LoadOfGradientsOf(const Field& f, const Field* scale, const Job& job) const
{
  const Field here = this->Send(f);
  const Field factor = scale ? this->Send(*scale) : Field();
  return this->Load(job, [&](int threads)
    { return space_.Own().LoadOfGradientsOf(here, scale ? &factor : nullptr, threads); });
}

MultiVector RankLevels::LoadOfGradientsOfCoordinates(const Field* scale, const Job& job) const
{
  const Field factor = scale ? this->Send(*scale) : Field();
  return this->Load(job, [&](int threads)
    { return space_.Own().LoadOfGradientsOfCoordinates(scale ? &factor : nullptr, threads); });
}

/// Ranks that have parts of a triangle add up their shares of its mean.
MultiVector RankLevels::GradientsOnTriangles(const MultiVector& coefficients, const Job& job) const
{
  MultiVector shares;
  space_.Ranks().Together(
    [&]
    {
      const MultiVector means = space_.Own().GradientsOnTriangles(coefficients, job.threads);
      const Eigen::Map<const Eigen::VectorXd> areas(
        areas_.data(), static_cast<Eigen::Index>(areas_.size()));
      shares.resize(means.rows(), means.cols() + 1);
      shares << areas.asDiagonal() * means, areas;
    });
  const MultiVector sums = space_.Distribution().SumTriangles(shares);
  MultiVector means;
  space_.Ranks().Together(
    [&]
    {
      means = sums.leftCols(sums.cols() - 1);
      for (Id t = 0; t < means.rows(); ++t)
      {
        const double area = sums(t, means.cols());
        means.row(t) *= area > 0.0 ? 1.0 / area : 0.0;
      }
    });
  return means;
}

std::vector<char> RankLevels::PointsWithFunctions() const
{
  std::vector<char> has;
  const MultiVector none = MultiVector::Zero(static_cast<Id>(integrals_.size()), 1);
  space_.ValuesAtPoints(none, space_.Distribution().NumberOfOwnPoints(), &has);
  return has;
}

std::shared_ptr<const SurfaceSpace> RankLevels::WithWeighedMass(
  const std::vector<double>& weight, const Job& job) const
{
  struct Weighed
  {
    explicit Weighed(RankSpace ofRanks) : space(std::move(ofRanks)), levels(space) {}

    const RankSpace space;
    const RankLevels levels;
  };
  const auto weighed = std::make_shared<const Weighed>(space_.WithWeighedMass(weight, job.threads));
  job.Check(1.0);
  return { weighed, &weighed->levels };
}

const DividedRows* RankLevels::Divided(std::size_t level) const
{
  return this->IsDivided(level) ? &rows_[level] : nullptr;
}

std::shared_ptr<const DividedLevel> RankLevels::Divide(
  std::size_t level, const SparseMatrix& A, const MultigridOptions& options) const
{
  if (!this->IsDivided(level))
  {
    return nullptr;
  }
  return std::make_shared<RankLevel>(space_.Ranks(), space_.Numberings()[level], rows_[level],
    this->IsDivided(level + 1) ? &rows_[level + 1] : nullptr, parts_[level], A, options.threads);
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
