#include "AlgebraicMultigrid.h"
#include "ShiftInvert.h"

#include <slepceps.h>

#include <algorithm>
#include <stdexcept>

namespace gridfem::benchmarks
{

namespace
{

Mat View(const SymmetricMatrix& A)
{
  Mat view = nullptr;
  const auto rows = static_cast<PetscInt>(A.rows());
  MatCreateSeqAIJWithArrays(PETSC_COMM_SELF, rows, rows, const_cast<int*>(A.outerIndexPtr()),
    const_cast<int*>(A.innerIndexPtr()), const_cast<double*>(A.valuePtr()), &view);
  MatSetOption(view, MAT_SYMMETRIC, PETSC_TRUE);
  MatSetOption(view, MAT_SYMMETRY_ETERNAL, PETSC_TRUE);
  return view;
}

} // namespace

HatSpectrum SlepcSpectrum(const CotangentSystem& hats, int count, double tolerance)
{
  SlepcInitializeNoArguments();
  Mat stiffness = View(hats.stiffness);
  Mat mass = View(hats.mass);
  EPS solver = nullptr;
  EPSCreate(PETSC_COMM_SELF, &solver);
  EPSSetOperators(solver, stiffness, mass);
  EPSSetProblemType(solver, EPS_GHEP);
  EPSSetDimensions(solver, count, PETSC_DEFAULT, PETSC_DEFAULT);
  EPSSetTolerances(solver, tolerance, 1000);
  EPSSetTarget(solver, -1.0 / hats.mass.sum()); // below zero: the shifted matrix is definite
  EPSSetWhichEigenpairs(solver, EPS_TARGET_MAGNITUDE);
  ST transform = nullptr;
  EPSGetST(solver, &transform);
  STSetType(transform, STSINVERT);
  STSetMatStructure(transform, SAME_NONZERO_PATTERN);
  KSP inverse = nullptr;
  STGetKSP(transform, &inverse);
  KSPSetType(inverse, KSPPREONLY);
  PC factor = nullptr;
  KSPGetPC(inverse, &factor);
  PCSetType(factor, PCCHOLESKY);
  PCFactorSetMatSolverType(factor, MATSOLVERCHOLMOD);
  EPSSetFromOptions(solver);
  if (EPSSolve(solver) != 0)
  {
    throw std::runtime_error("SLEPc could not compute the spectrum.");
  }
  HatSpectrum result;
  PetscInt converged = 0;
  EPSGetConverged(solver, &converged);
  for (PetscInt k = 0; k < std::min<PetscInt>(converged, count); ++k)
  {
    PetscScalar value = 0.0;
    EPSGetEigenvalue(solver, k, &value, nullptr);
    result.eigenvalues.push_back(value);
  }
  std::sort(result.eigenvalues.begin(), result.eigenvalues.end());
  PetscInt solves = 0;
  KSPGetTotalIterations(inverse, &solves);
  result.solves = solves;
  EPSDestroy(&solver);
  MatDestroy(&mass);
  MatDestroy(&stiffness);
  SlepcFinalize();
  return result;
}

} // namespace gridfem::benchmarks
