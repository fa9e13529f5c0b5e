#include "Cholmod.h"

#include <dlfcn.h>
#include <suitesparse/cholmod.h>

#include <stdexcept>

namespace gridfem::benchmarks
{

namespace
{

/// The lower triangle of a symmetric matrix that stores both, as CHOLMOD's own type; no copy.
cholmod_sparse View(const SymmetricMatrix& A)
{
  cholmod_sparse view{};
  view.nrow = static_cast<std::size_t>(A.rows());
  view.ncol = static_cast<std::size_t>(A.cols());
  view.nzmax = static_cast<std::size_t>(A.nonZeros());
  view.p = const_cast<int*>(A.outerIndexPtr());
  view.i = const_cast<int*>(A.innerIndexPtr());
  view.x = const_cast<double*>(A.valuePtr());
  view.stype = -1;
  view.itype = CHOLMOD_INT;
  view.xtype = CHOLMOD_REAL;
  view.dtype = CHOLMOD_DOUBLE;
  view.sorted = 1;
  view.packed = 1;
  return view;
}

} // namespace

void SetBlasThreads(int threads)
{
  if (void* const symbol = dlsym(RTLD_DEFAULT, "openblas_set_num_threads"))
  {
    reinterpret_cast<void (*)(int)>(symbol)(threads);
  }
}

struct Cholmod::State
{
  mutable cholmod_common common;
  cholmod_factor* factor = nullptr;

  State()
  {
    cholmod_start(&common);
    common.supernodal = CHOLMOD_SUPERNODAL;
  }
  ~State()
  {
    cholmod_free_factor(&factor, &common);
    cholmod_finish(&common);
  }
};

Cholmod::Cholmod() : state_(std::make_unique<State>())
{
}

Cholmod::~Cholmod() = default;

void Cholmod::Analyze(const SymmetricMatrix& A)
{
  cholmod_sparse view = View(A);
  cholmod_free_factor(&state_->factor, &state_->common);
  state_->factor = cholmod_analyze(&view, &state_->common);
}

void Cholmod::AnalyzeAs(const Cholmod& other)
{
  cholmod_free_factor(&state_->factor, &state_->common);
  state_->factor = cholmod_copy_factor(other.state_->factor, &state_->common);
}

void Cholmod::Factor(const SymmetricMatrix& A)
{
  cholmod_sparse view = View(A);
  cholmod_factorize(&view, state_->factor, &state_->common);
  if (state_->common.status != CHOLMOD_OK)
  {
    throw std::runtime_error("CHOLMOD could not factor the hat system.");
  }
}

Eigen::MatrixXd Cholmod::Solve(const Eigen::MatrixXd& b) const
{
  cholmod_dense view{};
  view.nrow = static_cast<std::size_t>(b.rows());
  view.ncol = static_cast<std::size_t>(b.cols());
  view.nzmax = view.nrow * view.ncol;
  view.d = view.nrow;
  view.x = const_cast<double*>(b.data());
  view.xtype = CHOLMOD_REAL;
  view.dtype = CHOLMOD_DOUBLE;
  cholmod_dense* x = cholmod_solve(CHOLMOD_A, state_->factor, &view, &state_->common);
  if (x == nullptr)
  {
    throw std::runtime_error("CHOLMOD could not solve the hat system.");
  }
  Eigen::MatrixXd result =
    Eigen::Map<const Eigen::MatrixXd>(static_cast<const double*>(x->x), b.rows(), b.cols());
  cholmod_free_dense(&x, &state_->common);
  return result;
}

} // namespace gridfem::benchmarks
