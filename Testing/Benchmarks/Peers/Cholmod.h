// Supernodal sparse Cholesky by CHOLMOD, with its own choice of ordering (AMD, then METIS).
#ifndef GridFEM_Benchmarks_Cholmod_h
#define GridFEM_Benchmarks_Cholmod_h

#include "CotangentSystem.h"

#include <memory>

namespace gridfem::benchmarks
{

/// Threads of the BLAS that CHOLMOD and the eigensolvers call. Only OpenBLAS accepts the number.
/// Other libraries follow their environment variables.
void SetBlasThreads(int threads);

class Cholmod
{
public:
  Cholmod();
  ~Cholmod();
  Cholmod(const Cholmod&) = delete;
  Cholmod& operator=(const Cholmod&) = delete;

  /// The symbolic part.
  void Analyze(const SymmetricMatrix& A);

  /// Takes the symbolic part of a matrix of the same pattern, which was analyzed but not factored.
  void AnalyzeAs(const Cholmod& other);

  /// The numeric part; may be repeated for new values of the same pattern. Throws
  /// std::runtime_error when A is not positive definite.
  void Factor(const SymmetricMatrix& A);

  /// All columns at once.
  Eigen::MatrixXd Solve(const Eigen::MatrixXd& b) const;

private:
  struct State;
  std::unique_ptr<State> state_;
};

} // namespace gridfem::benchmarks

#endif
