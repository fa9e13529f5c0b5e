// The result of one random case.
#ifndef GridFEM_Testing_Outcome_h
#define GridFEM_Testing_Outcome_h

#include "Equations/SolutionAccuracy.h"
#include "Krylov/ConjugateGradients.h"

#include <cmath>
#include <string>
#include <vector>

namespace gridfem::testing
{

struct Outcome
{
  std::string problem;
  std::string description;         // mesh and space
  std::string refusal;             // message of InvalidInput; a refusal is no failure
  std::vector<std::string> broken; // violated requirements
  bool isIterative = false;        // whether it has a report
  bool converged = true;           // whether all solves converged
  bool isDefault = false;          // solved with default options and valid numbers
  bool isDataLimited = false;      // no solver could do better; see PoissonSolution::isAtRounding
  double smallestEnergy = 0.0;     // if not converged: the best energy reached
  SolveEnd end = SolveEnd::Converged;

  void Require(bool holds, const std::string& what)
  {
    if (!holds && (broken.empty() || broken.back() != what))
    {
      broken.push_back(what);
    }
  }

  /// Requires that converged values are finite.
  void RequireFinite(const MultiVector& values, const std::string& what)
  {
    this->Require(!converged || values.allFinite(), what + " is not finite");
  }

  /// Requires estimates of errors that are not negative or infinite. An estimate may be unknown
  /// (NaN).
  void RequireEstimate(const SolutionAccuracy& accuracy)
  {
    for (const double said : { accuracy.discretization, accuracy.largest, accuracy.algebraic })
    {
      this->Require(!converged || !(said < 0.0 || std::isinf(said)), "no estimate of an error");
    }
  }

  void Add(const SolveReport& report)
  {
    isIterative = true;
    if (!report.converged)
    {
      converged = false;
      end = report.end;
      smallestEnergy = SmallestEnergy(report);
    }
  }

private:
  static double SmallestEnergy(const SolveReport& report)
  {
    double smallest = 1.0;
    for (const IterationRecord& record : report.history)
    {
      smallest = record.energy < smallest ? record.energy : smallest;
    }
    return smallest;
  }
};

} // namespace gridfem::testing

#endif
