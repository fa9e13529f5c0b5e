#include "Parallel/RankEigenproblem.h"

#include <algorithm>
#include <numeric>

namespace gridfem
{

namespace
{

/// Columns whose images are held at the same time.
constexpr Id ColumnsAtOnce = 16;

/// PETSc has to run before members of its own are made.
const LevelNumbering& NumberingForPetsc(const RankSpace& space, std::size_t level)
{
  StartPetsc(space.Ranks());
  return space.Numberings()[level];
}

PetscMatrix LevelMatrix(const RankSpace& space, std::size_t level, double a, double b, int threads)
{
  SparseMatrix own;
  space.Ranks().Together([&] { space.Own().FillMatrix(level, a, b, own, threads); });
  return SumOverRanks(space.Ranks(), space.Numberings()[level], own);
}

/// What this rank's patches add to ∫ b_i: functions sum to 1 on every patch.
std::vector<double> IntegralParts(const RankSpace& space, std::size_t level, int threads)
{
  SparseMatrix mass;
  space.Own().FillMatrix(level, 1.0, 0.0, mass, threads);
  std::vector<double> integral(mass.rows, 0.0);
  for (Index i = 0; i < mass.rows; ++i)
  {
    integral[i] = std::accumulate(
      mass.value.begin() + mass.rowBegin[i], mass.value.begin() + mass.rowBegin[i + 1], 0.0);
  }
  return integral;
}

template<class Column>
void Fill(Vec vector, const Column& column)
{
  VectorEntries entries(vector);
  for (Id k = 0; k < column.size(); ++k)
  {
    entries[k] = column[k];
  }
}

template<class Column>
void Take(Vec vector, Column&& column)
{
  VectorEntries entries(vector);
  for (Id k = 0; k < column.size(); ++k)
  {
    column[k] = entries[k];
  }
}

} // namespace

RankEigenproblem::RankEigenproblem(
  const RankSpace& space, std::size_t level, const MultigridOptions& options)
  : space_(space), level_(level), numbering_(NumberingForPetsc(space, level)), options_(options),
    vectors_(space.Ranks(), numbering_)
{
  threads = options.threads;
  L_ = LevelMatrix(space, level, 0.0, 1.0, threads);
  M_ = LevelMatrix(space, level, 1.0, 0.0, threads);
  from_ = vectors_.Make();
  to_ = vectors_.Make();
  std::vector<double> integral;
  space.Ranks().Together([&] { integral = IntegralParts(space, level, threads); });
  components_ = std::make_unique<RankComponents>(
    space.Ranks(), numbering_, vectors_, space.Own().Functions().levels[level], integral);
  ofComponents_ = std::make_unique<Constants>(components_->Integrals(), components_->OfFunctions(),
    static_cast<Index>(components_->Count()), threads,
    [ranks = space.Ranks()](double* values, Id count) { ranks.Sum(values, count); });
  constants = ofComponents_.get();
  const std::vector<double>& own = components_->Integrals();
  area_ = std::accumulate(own.begin(), own.end(), 0.0);
  space.Ranks().Sum(&area_, 1);
}

void RankEigenproblem::SetShift(double value)
{
  shift = value;
  cycle_ = std::make_unique<RankCycle>(space_, value, 1.0, options_, level_);
}

MultiVector RankEigenproblem::Times(Mat matrix, const ConstBlock<double>& X) const
{
  MultiVector image(X.rows(), X.cols());
  for (Id c = 0; c < X.cols(); ++c)
  {
    Fill(from_, X.col(c));
    Check(MatMult(matrix, from_, to_));
    Take(to_, image.col(c));
  }
  return image;
}

MultiVector RankEigenproblem::MassTimes(const MultiVector& X) const
{
  return this->Times(M_, X);
}

/// [X₁ X₂ ...]ᵀ [A Y, B Y, ...]
Eigen::MatrixXd RankEigenproblem::ProjectOnto(const BasisParts<double>& parts,
  const ConstBlock<double>& Y, const std::vector<Mat>& matrices) const
{
  const Id rows = std::accumulate(parts.begin(), parts.end(), Id{ 0 },
    [](Id sum, const ConstBlock<double>& part) { return sum + part.cols(); });
  const Id columns = Y.cols();
  Eigen::MatrixXd result(rows, static_cast<Id>(matrices.size()) * columns);
  for (std::size_t m = 0; m < matrices.size(); ++m)
  {
    for (Id first = 0; first < columns; first += ColumnsAtOnce)
    {
      const Id count = std::min(ColumnsAtOnce, columns - first);
      const MultiVector image = this->Times(matrices[m], Y.middleCols(first, count));
      Id row = 0;
      for (const ConstBlock<double>& part : parts)
      {
        result.block(row, static_cast<Id>(m) * columns + first, part.cols(), count).noalias() =
          part.transpose() * image;
        row += part.cols();
      }
    }
  }
  space_.Ranks().Sum(result.data(), result.size());
  return result;
}

Eigen::MatrixXd RankEigenproblem::ProjectBoth(
  const BasisParts<double>& parts, const ConstBlock<double>& Y) const
{
  return this->ProjectOnto(parts, Y, { L_, M_ });
}

Eigen::MatrixXd RankEigenproblem::ProjectMass(
  const BasisParts<double>& parts, const ConstBlock<double>& Y) const
{
  return this->ProjectOnto(parts, Y, { M_ });
}

/// L x - θ M x
MultiVector RankEigenproblem::Residuals(
  const EigenPairs<double>& pairs, const std::vector<Index>& columns) const
{
  const auto X = pairs.vectors.View();
  MultiVector residuals(X.rows(), static_cast<Id>(columns.size()));
  for (Id j = 0; j < residuals.cols(); ++j)
  {
    const Index column = columns[j];
    residuals.col(j) =
      this->Times(L_, X.col(column)) - pairs.values[column] * this->Times(M_, X.col(column));
  }
  return residuals;
}

/// R becomes B R.
void RankEigenproblem::Precondition(Block<double> R) const
{
  for (Id c = 0; c < R.cols(); ++c)
  {
    Fill(from_, R.col(c));
    cycle_->Apply(from_, to_);
    Take(to_, R.col(c));
  }
}

ResidualMeasures RankEigenproblem::Correct(const BlockPreconditioner<double>&,
  const EigenPairs<double>& pairs, const SoftLocking& locking, Block<double> W,
  const MultiVector& load, Block<double> P) const
{
  const MultiVector residuals = this->Residuals(pairs, locking.AtWork());
  W = residuals;
  this->Precondition(W);
  if (load.cols() > 0) // it has no rows else
  {
    P = load;
    this->Precondition(P);
  }
  MultiVector measures(2, residuals.cols());
  measures.row(0) = residuals.cwiseProduct(W).colwise().sum();
  measures.row(1) = residuals.colwise().squaredNorm();
  space_.Ranks().Sum(measures.data(), measures.size());
  return { measures.row(0), measures.row(1) };
}

Eigen::VectorXd RankEigenproblem::SquaredResiduals(
  const EigenPairs<double>& pairs, const std::vector<Index>& columns) const
{
  Eigen::VectorXd norm = this->Residuals(pairs, columns).colwise().squaredNorm();
  space_.Ranks().Sum(norm.data(), norm.size());
  return norm;
}

ColumnFacts RankEigenproblem::FactsOf(const MultiVector& X) const
{
  ColumnFacts facts(X.cols());
  for (Id c = 0; c < X.cols(); ++c)
  {
    const MultiVector image = this->Times(M_, X.col(c));
    facts.mass[c] = X.col(c).dot(image.col(0));
    facts.energy[c] = X.col(c).dot(this->Times(L_, X.col(c)).col(0));
    ColumnFacts one(1);
    for (Id row = 0; row < image.rows(); ++row)
    {
      one.TakeLargest(image.row(row));
    }
    facts.largest[c] = one.largest[0];
  }
  space_.Ranks().Sum(facts.mass.data(), facts.mass.size());
  space_.Ranks().Sum(facts.energy.data(), facts.energy.size());
  const std::vector<double> ofRanks = space_.Ranks().Gather(
    std::vector<double>(facts.largest.data(), facts.largest.data() + facts.largest.size()));
  facts.largest.setZero();
  for (std::size_t first = 0; first < ofRanks.size(); first += X.cols())
  {
    facts.TakeLargest(Eigen::Map<const Eigen::RowVectorXd>(ofRanks.data() + first, X.cols()));
  }
  return facts;
}

MultiVector RankEigenproblem::Spread(const ConstBlock<double>& X) const
{
  MultiVector all(numbering_.Functions(), X.cols());
  std::vector<double> entries;
  for (Id c = 0; c < X.cols(); ++c)
  {
    Fill(from_, X.col(c));
    vectors_.Spread(from_, entries);
    all.col(c) = Eigen::Map<const Eigen::VectorXd>(entries.data(), all.rows());
  }
  return all;
}

} // namespace gridfem
