#include "Problems/DistantHeat.h"

#include "Base/Parallel.h"

#include <algorithm>
#include <cmath>

namespace gridfem
{
namespace
{

/// Of every solve.
constexpr double Tolerance = 1e-12;

/// What is above this share of the largest value of a solve is known well enough to follow its
/// slope.
constexpr double KnownShare = 1e4 * Tolerance;

/// Less is lost among numbers that are no longer held to all digits.
constexpr double SmallestHeat = 1e-290;

/// How far the heat has come.
class Front
{
public:
  Front(const FiniteElementSpace& space, const SparseMatrix& A, double t, const MultiVector& load,
    int threads)
    : A_(A), load_(load / t), threads_(threads), state_(load.rows(), State::Cold),
      u_(MultiVector::Zero(load.rows(), 1))
  {
    const std::vector<double> diagonal = A.Diagonal(threads);
    size_ = Eigen::Map<const Eigen::VectorXd>(diagonal.data(), load.rows()).cwiseSqrt();
    const Components components = space.ComponentsOf(0, threads);
    std::vector<char> hasSource(components.count, 0);
    for (Id i = 0; i < load.rows(); ++i)
    {
      hasSource[components.ofFunction[i]] |= load(i, 0) != 0.0;
    }
    for (Id i = 0; i < load.rows(); ++i)
    {
      state_[i] = hasSource[components.ofFunction[i]] ? State::Unknown : State::Cold;
    }
  }

  /// Takes over what a solve says of the unknown part, as far as it says something: where it or a
  /// neighbour has a value that is not small. So no function stays behind because it happens to be
  /// near 0. False when the solve brought no heat at all.
  bool Advance(const MultiVector& solution)
  {
    const double largest = solution.col(0).cwiseProduct(size_).cwiseAbs().maxCoeff();
    if (!(largest > SmallestHeat))
    {
      return false;
    }
    for (Id i = 0; i < u_.rows(); ++i)
    {
      u_(i, 0) = state_[i] == State::Unknown ? solution(i, 0) : u_(i, 0);
    }
    const double least = KnownShare * largest;
    ParallelRanges(static_cast<Id>(u_.rows()), threads_,
      [&](Id begin, Id end)
      {
        for (Id i = begin; i < end; ++i)
        {
          if (state_[i] == State::Unknown &&
              this->AnyNeighbour(i, [&](Index j) { return std::abs(u_(j, 0)) * size_[j] > least; }))
          {
            state_[i] = State::Known;
          }
        }
      });
    return true;
  }

  /// Unknown functions that touch none that is known.
  Id CountBeyond() const
  {
    return ParallelSum(static_cast<Id>(u_.rows()), threads_, Id{ 0 },
      [this](Id begin, Id end)
      {
        Id beyond = 0;
        for (Id i = begin; i < end; ++i)
        {
          beyond += state_[i] == State::Unknown && !this->Touches(i, State::Known) ? 1 : 0;
        }
        return beyond;
      });
  }

  /// The load that the known part alone leaves: at its rim. Inside its values are good, and what
  /// their errors would leave there is more than what is still to come.
  MultiVector Remainder()
  {
    for (Id i = 0; i < u_.rows(); ++i)
    {
      if (state_[i] == State::Unknown)
      {
        u_(i, 0) = 0.0;
      }
    }
    MultiVector rest;
    Residual(A_, u_, load_, rest, threads_);
    ParallelRanges(static_cast<Id>(u_.rows()), threads_,
      [&](Id begin, Id end)
      {
        for (Id i = begin; i < end; ++i)
        {
          if (state_[i] == State::Known && !this->Touches(i, State::Unknown))
          {
            rest(i, 0) = 0.0;
          }
        }
      });
    return rest;
  }

  MultiVector TakeHeat() { return std::move(u_); }

private:
  enum class State : char
  {
    Cold, // on a component without a source
    Unknown,
    Known
  };

  /// Of a function and those it is coupled to.
  template<class Is>
  bool AnyNeighbour(Id i, Is&& is) const
  {
    return std::any_of(
      A_.column.data() + A_.rowBegin[i], A_.column.data() + A_.rowBegin[i + 1], is);
  }

  bool Touches(Id i, State state) const
  {
    return this->AnyNeighbour(i, [&](Index j) { return state_[j] == state; });
  }

  const SparseMatrix& A_;
  MultiVector load_;
  int threads_;
  std::vector<State> state_;
  MultiVector u_;
  /// What a coefficient counts, sqrt(A_ii): one whose function has hardly any surface may be large
  /// and says nothing.
  Eigen::VectorXd size_;
};

} // namespace

DistantHeat SpreadHeat(const FiniteElementSpace& space, const Multigrid& multigrid, double t,
  const MultiVector& load, int maximumIterations, const Job& job)
{
  Front front(space, multigrid.Matrix(), t, load, job.threads);
  const MultiVector cold = MultiVector::Zero(load.rows(), 1);
  PoissonOptions options;
  options.screeningWeight = 1.0 / t;
  options.multigrid = multigrid.Options();
  options.solve.tolerance = Tolerance;
  options.solve.maximumIterations = maximumIterations;
  options.start = &cold; // coarse levels know nothing of a front
  DistantHeat heat;
  heat.report.converged = true;
  heat.unreached = front.CountBeyond();
  MultiVector rest = load;
  double done = 0.0;
  while (heat.unreached > 0)
  {
    const double next = done + 0.2 * (1.0 - done); // how many solves follow is not known
    PoissonSolution solution =
      SolvePoisson(space, multigrid, rest, {}, options, job.progress.Part(done, next));
    done = next;
    ++heat.solves;
    KeepWorse(std::move(solution.report), heat.report);
    if (!heat.report.converged || !front.Advance(solution.coefficients))
    {
      break;
    }
    heat.unreached = front.CountBeyond();
    if (heat.unreached > 0)
    {
      rest = t * front.Remainder(); // SolvePoisson multiplies by the weight
    }
  }
  heat.coefficients = front.TakeHeat();
  return heat;
}

} // namespace gridfem
