#include "ShiftInvert.h"

#include "Cholmod.h"

#include <Spectra/MatOp/SparseSymMatProd.h>
#include <Spectra/SymGEigsShiftSolver.h>

namespace gridfem::benchmarks
{

namespace
{

/// (L - σM)⁻¹ as Spectra asks for it.
class InverseOperator
{
public:
  using Scalar = double;

  explicit InverseOperator(const CotangentSystem& hats) : hats_(hats) {}

  Eigen::Index rows() const { return hats_.mass.rows(); }
  Eigen::Index cols() const { return hats_.mass.cols(); }
  void set_shift(const double& sigma)
  {
    const SymmetricMatrix matrix = Combine(hats_, -sigma);
    factor_.Analyze(matrix);
    factor_.Factor(matrix);
  }
  void perform_op(const double* x, double* y) const
  {
    ++solves_;
    Eigen::Map<Eigen::VectorXd>(y, this->rows()) =
      factor_.Solve(Eigen::Map<const Eigen::VectorXd>(x, this->rows()));
  }
  double Solves() const { return solves_; }

private:
  const CotangentSystem& hats_;
  Cholmod factor_;
  mutable double solves_ = 0.0;
};

} // namespace

HatSpectrum SpectraSpectrum(const CotangentSystem& hats, int count, double tolerance)
{
  InverseOperator inverse(hats);
  Spectra::SparseSymMatProd<double> mass(hats.mass);
  // Below zero, so that the matrix is definite; of the order of the first eigenvalue.
  const double shift = -1.0 / hats.mass.sum();
  Spectra::SymGEigsShiftSolver<InverseOperator, Spectra::SparseSymMatProd<double>,
    Spectra::GEigsMode::ShiftInvert>
    solver(
      inverse, mass, count, std::min<int>(3 * count / 2, static_cast<int>(mass.rows())), shift);
  solver.init();
  solver.compute(Spectra::SortRule::LargestMagn, 1000, tolerance, Spectra::SortRule::SmallestAlge);
  HatSpectrum result;
  const Eigen::VectorXd values = solver.eigenvalues();
  result.eigenvalues.assign(values.data(), values.data() + values.size());
  result.vectors = solver.eigenvectors();
  result.solves = inverse.Solves();
  return result;
}

} // namespace gridfem::benchmarks
