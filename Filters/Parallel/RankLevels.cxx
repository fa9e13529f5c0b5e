#include "Parallel/RankLevels.h"

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

MultiVector RankLevels::ValuesAtPoints(const MultiVector& coefficients, const Job& job) const
{
  return space_.Own().ValuesAtPoints(coefficients, job);
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
