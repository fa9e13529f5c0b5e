// Functions that change in time, step by step.
#ifndef GridFEM_Evolution_h
#define GridFEM_Evolution_h

#include "Equations/Poisson.h"

namespace gridfem
{

/// Returns the weight of the stiffness in the mass, in squared units of length: a tenth of the area
/// per function. Functions that hardly reach the surface would be undetermined without it if little
/// spreads in a step. A pattern ten functions long changes 4 % slower.
inline double MassSmoothing(const SpaceLevels& space)
{
  double area = 0.0;
  for (const double integral : space.Integrals())
  {
    area += integral;
  }
  return 0.1 * area / static_cast<double>(space.NumberOfFunctions(0));
}

/// An equation in time with its hierarchy, and its solution at one time. A column of coefficients
/// belongs to each function of the equation. Steps have one length. One process holds the space.
/// Same bits for any number of threads.
class Evolution
{
public:
  virtual ~Evolution() = default;

  /// Begins again from these coefficients. The hierarchy stays.
  virtual void Start(MultiVector coefficients) = 0;

  /// Makes the next step and reports how its solves went. Throws Aborted, and then leaves the
  /// solution as it was.
  virtual SolveReport Advance(const Job& job) = 0;

  virtual const MultiVector& Coefficients() const = 0;

  ///@{ The errors of the terms that the last step has extrapolated, times its length, and the
  /// largest values during the step, of each unknown. Both together tell of steps that are too
  /// long. Empty if nothing is extrapolated.
  virtual Columns ExtrapolationErrors() const { return {}; }
  virtual Columns LargestValues() const { return {}; }
  ///@}

  /// An energy that only damping and the solves change, in squared units of length of the space.
  /// NaN if the equation has none.
  virtual double Energy(const Job& job) const = 0;
};

} // namespace gridfem

#endif
