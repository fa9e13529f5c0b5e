// What one random case came to.
#ifndef GridFEM_Testing_Outcome_h
#define GridFEM_Testing_Outcome_h

#include "Krylov/ConjugateGradients.h"
#include "Problems/SolutionAccuracy.h"

#include <cmath>
#include <string>
#include <vector>

namespace gridfem::testing
{

struct Outcome
{
  std::string problem;
  std::string description;         // of the mesh and the space
  std::string refusal;             // the message of InvalidInput, which is no failure
  std::vector<std::string> broken; // what must hold and does not
  bool isIterative = false;        // has a report
  bool converged = true;           // of several solves all
  bool isDefault = false;          // solved with default options, on valid numbers
  bool isDataLimited = false;      // no solver could do better: PoissonSolution::isAtRounding
  double smallestEnergy = 0.0;     // where it has not converged: the best that was reached
  SolveEnd end = SolveEnd::Converged;

  void Require(bool holds, const std::string& what)
  {
    if (!holds && (broken.empty() || broken.back() != what))
    {
      broken.push_back(what);
    }
  }

  /// What is called converged has to be a number.
  void RequireFinite(const MultiVector& values, const std::string& what)
  {
    this->Require(!converged || values.allFinite(), what + " is not finite");
  }

  /// What is said of an error may be unknown.
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
