#include "Spectrum/MassUnit.h"

#include "Equations/LevelProblem.h"
#include "Krylov/DenseSpectrum.h"

#include <cmath>
#include <numeric>

namespace gridfem
{
namespace
{

/// Largest ratio of masses to the usual ones that changes nothing.
constexpr double UsualRatio = 1e3;

double Trace(const SparseMatrix& matrix)
{
  const std::vector<double> diagonal = matrix.Diagonal();
  return std::accumulate(diagonal.begin(), diagonal.end(), 0.0);
}

/// The mass of the coarsest level over the usual mass, which follows from the stiffness. A metric
/// changes it by its smaller eigenvalue, about.
double RatioOfMasses(const SpaceLevels& space, int threads)
{
  constexpr double SquaredSpacing = 6.0; // stiffness over mass, times the squared side of a cell
  const std::size_t coarsest = space.NumberOfLevels() - 1;
  if (space.Distributed(coarsest))
  {
    return 1.0;
  }
  const double stiffness = Trace(space.Matrix(coarsest, 0.0, 1.0, threads));
  const double mass = Trace(space.Matrix(coarsest, 1.0, 0.0, threads));
  return SquaredSpacing * mass / stiffness / std::pow(4.0, static_cast<double>(coarsest));
}

} // namespace

double MassUnit(const SpaceLevels& space, int threads)
{
  const double ratio = RatioOfMasses(space, threads);
  const bool isUsual = ratio > 1.0 / UsualRatio && ratio < UsualRatio;
  return isUsual || !(ratio > 0.0) || std::isinf(ratio)
           ? 1.0
           : std::pow(4.0, std::round(0.5 * std::log2(ratio)));
}

bool IsStretched(const SpaceLevels& space, const SparseMatrix& mass, int threads)
{
  constexpr double Most = 10.0;
  const auto isFarFromOne = [](double ratio) { return !(ratio > 1.0 / Most && ratio < Most); };
  // A surface has about one function per square of a cell.
  const double area = std::accumulate(mass.value.begin(), mass.value.end(), 0.0);
  return !space.Distributed(0) && (isFarFromOne(RatioOfMasses(space, threads)) ||
                                    isFarFromOne(area / space.NumberOfFunctions(0)));
}

void DivideBy(double unit, SparseMatrix& mass)
{
  if (unit != 1.0)
  {
    for (double& value : mass.value)
    {
      value /= unit;
    }
  }
}

void ConvertUnit(double from, double to, Spectrum& spectrum)
{
  const double factor = from / to;
  if (factor != 1.0)
  {
    for (double& value : spectrum.eigenvalues)
    {
      value /= factor;
    }
    spectrum.vectors /= std::sqrt(factor);
  }
}

double LowestOnCoarsest(const SpaceLevels& space, double unit, int threads)
{
  const std::size_t coarsest = space.NumberOfLevels() - 1;
  if (space.Distributed(coarsest) || !IsDense(space.NumberOfFunctions(coarsest), 1))
  {
    return 0.0;
  }
  SparseMatrix mass = space.Matrix(coarsest, 1.0, 0.0, threads);
  DivideBy(unit, mass);
  const Constants constants = ConstantsOnLevel(space, coarsest, mass, threads);
  const EigenPairs<double> lowest =
    SolveDense(ProblemOnLevel<double>(space, coarsest, constants, std::move(mass), threads), 1);
  return lowest.values.size() > 0 ? lowest.values[0] : 0.0;
}

} // namespace gridfem
