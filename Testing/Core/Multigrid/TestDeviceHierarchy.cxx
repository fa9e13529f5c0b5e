// Cycles on a device, on its twin for the threads of the host, which has the same source. The
// environment variable GRIDFEM_DEVICE_LIBRARY names another device, such as a GPU.
#include "ApplyRows.h"
#include "Dense.h"
#include "Discretization.h"
#include "Hybrid.h"
#include "Krylov/PrecisionFallback.h"
#include "Meshes.h"
#include "SampledHierarchy.h"
#include "Spectrum/Spectrum.h"

#include <gtest/gtest.h>

#include <cmath>
#include <cstdlib>
#include <limits>
#include <numeric>

namespace gridfem
{
namespace
{

using namespace gridfem::testing;

constexpr double Shift = 0.01;

class DeviceTest : public ::testing::Test
{
protected:
  void SetUp() override
  {
    const char* const given = std::getenv("GRIDFEM_DEVICE_LIBRARY");
    std::string whyNot;
    UseDevice(OpenDevice(given ? given : GRIDFEM_HOST_DEVICE, whyNot));
    ASSERT_NE(FindDevice(whyNot), nullptr) << whyNot;
  }
};

MultigridOptions On(DeviceChoice device)
{
  MultigridOptions options;
  options.device = device;
  return options;
}

Multigrid Build(const Discretization& on, const MultigridOptions& options)
{
  return BuildMultigrid(ViewOf(on.space, on.system), Shift, 1.0, options);
}

Multigrid OnDevice(const Discretization& on)
{
  Multigrid multigrid = Build(on, On(DeviceChoice::Gpu));
  EXPECT_NE(multigrid.OnDevice(), nullptr) << multigrid.WhyNotOnDevice();
  return multigrid;
}

Multigrid OnDevice(std::vector<MultigridLevel> levels)
{
  Multigrid multigrid(std::move(levels), On(DeviceChoice::Gpu));
  EXPECT_NE(multigrid.OnDevice(), nullptr) << multigrid.WhyNotOnDevice();
  return multigrid;
}

MultiVector Corrected(const Multigrid& multigrid, const MultiVector& b)
{
  MultiVector x;
  multigrid.Precondition(b, x);
  return x;
}

std::vector<TriangleMesh> Surfaces()
{
  return { Torus(64, 32, 1.0, 0.4), Transform(Box(4), { 1, 1, 1 }, 0.3),
    Mapped(TwoSheets(24, 0.05), Bend), Unweld(GeodesicSphere(12)) };
}

/// Two levels whose groups share no unknown and whose coarser level corrects nothing. Each group's
/// block is a random positive definite matrix.
std::vector<MultigridLevel> SeparateGroups(int size, int count)
{
  const int rows = size * count;
  Eigen::MatrixXd A = Eigen::MatrixXd::Zero(rows, rows);
  std::vector<MultigridLevel> levels(2);
  PatchOrder& order = levels[0].order;
  for (int k = 0; k < count; ++k)
  {
    const Eigen::MatrixXd R = RandomValues(size, size, k + 1);
    A.block(size * k, size * k, size, size) =
      R * R.transpose() + Eigen::MatrixXd::Identity(size, size);
  }
  order.dof.size = size;
  order.dof.unknown.resize(rows);
  std::iota(order.dof.unknown.begin(), order.dof.unknown.end(), 0);
  order.blockBegin = { 0, count };
  order.colorBegin = { 0, 1 };
  levels[0].A = Sparse(A);
  levels[0].prolongation = Sparse(Eigen::MatrixXd::Zero(rows, 1));
  levels[1].A = Sparse(Eigen::MatrixXd::Identity(1, 1));
  return levels;
}

/// What three steps of the smoother leave of an error whose eigenvalue is `part` of the bound: the
/// Chebyshev polynomial of the fourth kind of degree 3, divided by its value at 0.
double LeftBySmoother(double part)
{
  const double angle = std::acos(1.0 - 2.0 * part);
  return std::sin(3.5 * angle) / std::sin(0.5 * angle) / 7.0;
}

/// M A is the identity, and its largest eigenvalue is bounded by 1.1. Both smoothers together leave
/// the square of what one leaves.
TEST_F(DeviceTest, TheSmootherIsAChebyshevPolynomial)
{
  for (const int size : { 8, 1, 5, 27 })
  {
    std::vector<MultigridLevel> levels = SeparateGroups(size, 40);
    const SparseMatrix A = levels[0].A;
    const Multigrid multigrid = OnDevice(std::move(levels));
    const MultiVector x = RandomValues(A.rows, 2);
    MultiVector b;
    Multiply(A, x, b);
    const double left = LeftBySmoother(1.0 / 1.1);
    EXPECT_LT((Corrected(multigrid, b) - (1.0 - left * left) * x).norm(), 2e-6 * x.norm()) << size;
  }
}

/// Levels of one hierarchy in single precision and on the device solve the same systems.
TEST_F(DeviceTest, SolvesAsTheCpuDoes)
{
  const std::vector<TriangleMesh> surfaces = Surfaces();
  for (const TriangleMesh& mesh : surfaces)
  {
    const Discretization on = Discretize(mesh, 5);
    const Multigrid onCpu = Build(on, On(DeviceChoice::Cpu));
    const Multigrid onDevice = OnDevice(on);
    MultiVector b;
    Multiply(onCpu.Matrix(), RandomValues(onCpu.Matrix().rows, 3), b);
    SolveOptions options;
    options.tolerance = 1e-10;
    MultiVector expected = MultiVector::Zero(b.rows(), b.cols());
    MultiVector x = expected;
    const SolveReport reference =
      SolveConjugateGradients(OperatorOf(onCpu), CycleOf(onCpu), b, expected, options);
    const SolveReport report =
      SolveConjugateGradients(OperatorOf(onDevice), CycleOf(onDevice), b, x, options);
    EXPECT_TRUE(report.converged);
    EXPECT_LE(report.iterations, 2 * reference.iterations + 2);
    MultiVector energy;
    const MultiVector difference = x - expected;
    Multiply(onCpu.Matrix(), difference, energy);
    const double error = std::sqrt(difference.cwiseProduct(energy).sum());
    EXPECT_LT(error, 1e-7 * std::sqrt(expected.cwiseProduct(b).sum())) << &mesh - surfaces.data();
  }
}

/// Conjugate gradients need a symmetric positive preconditioner.
TEST_F(DeviceTest, TheCycleIsSymmetricAndPositive)
{
  const Discretization on = Discretize(Torus(64, 32, 1.0, 0.4), 5);
  const Multigrid multigrid = OnDevice(on);
  const MultiVector a = RandomValues(multigrid.Matrix().rows, 4, 1);
  const MultiVector b = RandomValues(multigrid.Matrix().rows, 4, 2);
  const MultiVector Ba = Corrected(multigrid, a);
  const MultiVector Bb = Corrected(multigrid, b);
  const double size = std::sqrt(a.cwiseProduct(Ba).sum() * b.cwiseProduct(Bb).sum());
  EXPECT_NEAR(b.cwiseProduct(Ba).sum(), a.cwiseProduct(Bb).sum(), 1e-6 * size);
  EXPECT_GT(a.cwiseProduct(Ba).colwise().sum().minCoeff(), 0.0);
}

TEST_F(DeviceTest, ColumnsKnowNothingOfEachOther)
{
  const Discretization on = Discretize(GeodesicSphere(16), 5);
  const Multigrid multigrid = OnDevice(on);
  MultiVector b = RandomValues(multigrid.Matrix().rows, 5);
  b.col(1) *= 1e30;
  b.col(2) *= 1e-30;
  b.col(3).setZero();
  b(7, 4) = std::numeric_limits<double>::quiet_NaN();
  const MultiVector x = Corrected(multigrid, b);
  for (Id c = 0; c < 4; ++c)
  {
    EXPECT_EQ(MultiVector(x.col(c)), Corrected(multigrid, b.col(c))) << c;
  }
  EXPECT_TRUE(x.leftCols(4).allFinite());
  EXPECT_EQ(x.col(3).norm(), 0.0);
  EXPECT_TRUE(x.col(4).hasNaN());
  EXPECT_EQ(Corrected(multigrid, b).leftCols(4), x.leftCols(4)); // same bits
}

/// Functions on slivers of cells have diagonals far below the range of single precision.
TEST_F(DeviceTest, UnknownsMayHaveAnyUnit)
{
  std::vector<MultigridLevel> levels = SampledHierarchy(TiltedPlane(4, 2.3, 0.7), 4, 1, 0.1, 1.0);
  std::vector<MultigridLevel> scaled(levels.size());
  Eigen::VectorXd unit(levels[0].A.rows);
  for (Id i = 0; i < unit.size(); ++i)
  {
    unit[i] = std::exp2(double(4 * (i % 30) - 60));
  }
  for (std::size_t l = 0; l < levels.size(); ++l)
  {
    scaled[l].A = levels[l].A;
    scaled[l].prolongation = levels[l].prolongation;
    scaled[l].order = levels[l].order;
  }
  scaled[0].A = Sparse(unit.asDiagonal() * Dense(levels[0].A) * unit.asDiagonal());
  scaled[0].prolongation = Sparse(unit.cwiseInverse().asDiagonal() * Dense(levels[0].prolongation));
  const MultiVector b = RandomValues(unit.size(), 2);
  const MultiVector x = Corrected(OnDevice(std::move(levels)), b);
  const MultiVector y = Corrected(OnDevice(std::move(scaled)), unit.asDiagonal() * b);
  EXPECT_EQ(MultiVector(unit.asDiagonal() * y), x);
}

/// The levels of hats have Gauss-Seidel on the CPU, and groups that the matrix does not couple.
TEST_F(DeviceTest, HatsAreSolvedToo)
{
  const TriangleMesh mesh = Join(Torus(48, 24, 1.0, 0.4), Mapped(CubeArray(2, 3, 0.01), Bend));
  const HatSpace space = Hybrid::Build(mesh, 4, HatTransfer::Evaluation, 0);
  const Multigrid onDevice = BuildMultigrid(space, 1.0, 1.0, On(DeviceChoice::Gpu));
  ASSERT_NE(onDevice.OnDevice(), nullptr) << onDevice.WhyNotOnDevice();
  MultiVector b;
  const MultiVector expected = RandomValues(onDevice.Matrix().rows, 1);
  Multiply(onDevice.Matrix(), expected, b);
  MultiVector x = MultiVector::Zero(b.rows(), 1);
  SolveOptions options;
  options.tolerance = 1e-9;
  EXPECT_TRUE(
    SolveConjugateGradients(OperatorOf(onDevice), CycleOf(onDevice), b, x, options).converged);
  EXPECT_LT((x - expected).norm(), 1e-6 * expected.norm());
}

TEST_F(DeviceTest, NoColumnsAreCorrectedAtOnce)
{
  const Multigrid multigrid = OnDevice(Discretize(GeodesicSphere(12), 5));
  const MultiVector x = Corrected(multigrid, MultiVector(multigrid.Matrix().rows, 0));
  EXPECT_EQ(x.rows(), multigrid.Matrix().rows);
  EXPECT_EQ(x.cols(), 0);
  EXPECT_EQ(multigrid.OnDevice()->Failure(), "");
}

/// Constants have little energy, which the coarsest level alone sees.
TEST_F(DeviceTest, LeavesNearlySingularSystemsToTheCpu)
{
  const Discretization on = Discretize(Torus(64, 32, 1.0, 0.4), 5);
  const auto build = [&](double weight)
  { return BuildMultigrid(ViewOf(on.space, on.system), weight, 1.0, On(DeviceChoice::Gpu)); };
  EXPECT_EQ(build(1e-10).Where(), "CPU: a small weight needs double precision");
  EXPECT_NE(build(0.0).OnDevice(), nullptr); // constants are no unknown of a singular system
}

/// A step x += B (b - A x) may not make an error grow, so it leaves out what only a measure needs.
TEST_F(DeviceTest, CyclesDoNotGrow)
{
  for (const TriangleMesh& mesh : Surfaces())
  {
    const Multigrid multigrid = OnDevice(Discretize(mesh, 5));
    const MultiVector zero = MultiVector::Zero(multigrid.Matrix().rows, 1);
    MultiVector x = RandomValues(multigrid.Matrix().rows, 1);
    const auto energy = [&]
    {
      MultiVector Ax;
      Multiply(multigrid.Matrix(), x, Ax);
      return x.cwiseProduct(Ax).sum();
    };
    for (int cycle = 0; cycle < 5; ++cycle)
    {
      const double before = energy();
      multigrid.Cycle(zero, x);
      EXPECT_LT(energy(), 0.9 * before);
    }
  }
}

TEST_F(DeviceTest, NewValuesMakeTheHierarchyOfThem)
{
  const Discretization on = Discretize(Torus(64, 32, 1.0, 0.4), 5);
  Multigrid updated = OnDevice(on);
  const MultiVector b = RandomValues(updated.Matrix().rows, 2);
  const MultiVector before = Corrected(updated, b);
  UpdateMultigrid(ViewOf(on.space, on.system), 3.0, 1.0, updated);
  ASSERT_NE(updated.OnDevice(), nullptr);
  const Multigrid made =
    BuildMultigrid(ViewOf(on.space, on.system), 3.0, 1.0, On(DeviceChoice::Gpu));
  EXPECT_EQ(Corrected(updated, b), Corrected(made, b));
  EXPECT_NE(Corrected(updated, b), before);
}

TEST_F(DeviceTest, BlocksInSinglePrecisionAreCorrectedToo)
{
  const Discretization on = Discretize(Torus(64, 32, 1.0, 0.4), 5);
  const MultigridOptions options = On(DeviceChoice::Gpu);
  const BasicMultigrid<float> single(
    BuildMultigridLevels(ViewOf(on.space, on.system), Shift, 1.0, options), options);
  ASSERT_NE(single.OnDevice(), nullptr);
  EXPECT_TRUE(single.IsReliable());
  const MultiVector r = RandomValues(single.Matrix().rows, 7);
  const MultiVector expected = Corrected(OnDevice(on), r);
  MultiVector z;
  const ResidualMeasures measures = Apply(CyclePreconditioner<double>(single, 0), r, z);
  EXPECT_LT((z - expected).norm(), 1e-5 * expected.norm());
  const Eigen::VectorXd energy = r.cwiseProduct(expected).colwise().sum();
  EXPECT_LT((measures.energy - energy).norm(), 1e-5 * energy.norm());
}

TEST_F(DeviceTest, TheOptionsChooseWhereCyclesRun)
{
  const Discretization on = Discretize(Torus(64, 32, 1.0, 0.4), 4);
  EXPECT_EQ(Build(on, On(DeviceChoice::Cpu)).WhyNotOnDevice(), "Device is CPU");
  EXPECT_EQ(Build(on, On(DeviceChoice::Automatic)).WhyNotOnDevice(), "there are few functions");
  MultigridOptions sweeps = On(DeviceChoice::Gpu);
  sweeps.preSweeps = sweeps.postSweeps = 2;
  EXPECT_EQ(Build(on, sweeps).OnDevice(), nullptr);
  EXPECT_EQ(OnDevice(on).WhyNotOnDevice(), "");
  UseDevice(nullptr);
  const Multigrid without = Build(on, On(DeviceChoice::Gpu));
  EXPECT_EQ(without.WhyNotOnDevice(), "no device is in use");
  const MultiVector b = RandomValues(without.Matrix().rows, 1);
  EXPECT_EQ(Corrected(without, b), Corrected(Build(on, On(DeviceChoice::Cpu)), b));
}

/// The functions of flat faces are nearly dependent.
TEST_F(DeviceTest, LeavesToTheCpuWhatNeedsDoublePrecision)
{
  const Multigrid multigrid = Build(Discretize(TwoSheets(8, 0.05), 5), On(DeviceChoice::Gpu));
  EXPECT_EQ(multigrid.OnDevice(), nullptr);
  EXPECT_EQ(multigrid.Where(), "CPU: flat faces need double precision");
}

/// A group with a direction of little energy, among many others. The energy rᵀBr contains it.
TEST_F(DeviceTest, FewUnresolvedGroupsAreSolvedInDoublePrecision)
{
  std::vector<MultigridLevel> levels = SeparateGroups(8, 300);
  Eigen::MatrixXd A = Dense(levels[0].A);
  const Eigen::MatrixXd R = RandomValues(8, 8, 7);
  const int first = 8 * 17;
  A.block(first, first, 8, 8) =
    R.leftCols(7) * R.leftCols(7).transpose() + 1e-9 * R.rightCols(1) * R.rightCols(1).transpose();
  levels[0].A = Sparse(A);
  const Multigrid multigrid = OnDevice(std::move(levels));
  MultiVector error = MultiVector::Zero(A.rows(), 1);
  error.middleRows(first, 8) = DenseEigen(A.block(first, first, 8, 8)).vectors.col(0);
  const MultiVector residual = Product(A, error);
  const double energy = error.cwiseProduct(residual).sum();
  EXPECT_LT(energy, 1e-8);
  const double seen = residual.cwiseProduct(Corrected(multigrid, residual)).sum();
  EXPECT_GT(seen, 0.9 * energy);
  EXPECT_LT(seen, 1.1 * energy);
}

/// Rounding of a residual in single precision must not become a large correction.
TEST_F(DeviceTest, SinglePrecisionLeavesUnresolvedDirectionsOut)
{
  std::vector<MultigridLevel> levels = SeparateGroups(8, 300);
  Eigen::MatrixXd A = Dense(levels[0].A);
  A.row(8 * 17 + 1) = A.row(8 * 17);
  A.col(8 * 17 + 1) = A.col(8 * 17);
  A(8 * 17 + 1, 8 * 17 + 1) += 1e-10;
  levels[0].A = Sparse(A);
  const BasicMultigrid<float> single(std::move(levels), On(DeviceChoice::Gpu));
  ASSERT_NE(single.OnDevice(), nullptr);
  const MultiVector residual = RandomValues(A.rows(), 1);
  MultiVector z;
  Apply(CyclePreconditioner<double>(single, 0), residual, z);
  EXPECT_LT(z.cwiseAbs().maxCoeff<Eigen::PropagateNaN>(), 1e3);
}

/// A scan has groups with unresolved directions.
TEST_F(DeviceTest, ModesOfAScanNeedNoDoublePrecision)
{
  const std::string path = RealMesh("dragon_871k.ply");
  if (path.empty())
  {
    GTEST_SKIP() << "no real meshes";
  }
  const Discretization on = Discretize(ReadMesh(path), 5);
  const auto modesOn = [&](DeviceChoice device)
  {
    SpectrumOptions options;
    options.numberOfModes = 20;
    options.tolerance = 1e-6;
    options.multigrid.device = device;
    return ComputeSpectrum(ViewOf(on.space, on.system), options);
  };
  const Spectrum onCpu = modesOn(DeviceChoice::Cpu);
  const Spectrum onGpu = modesOn(DeviceChoice::Gpu);
  EXPECT_EQ(onGpu.where.substr(0, 4), "GPU:");
  EXPECT_TRUE(onCpu.singlePrecision);
  EXPECT_TRUE(onGpu.singlePrecision);
  EXPECT_LE(onGpu.iterations, onCpu.iterations + 2);
  ASSERT_EQ(onGpu.eigenvalues.size(), onCpu.eigenvalues.size());
  for (std::size_t k = 1; k < onCpu.eigenvalues.size(); ++k)
  {
    EXPECT_NEAR(onGpu.eigenvalues[k] / onCpu.eigenvalues[k], 1.0, 2e-6) << k;
  }
}

/// A device that fails after some cycles.
class FailingCycles : public DeviceCycles
{
public:
  FailingCycles(std::unique_ptr<DeviceCycles> cycles, int left)
    : cycles_(std::move(cycles)), left_(left)
  {
  }

  void Update(const std::vector<DeviceLevel>& levels) override { cycles_->Update(levels); }
  const std::vector<DeviceGroup>& Unresolved(int level) const override
  {
    return cycles_->Unresolved(level);
  }
  void* Room(int level, int columns, DeviceNumbers numbers) override
  {
    return cycles_->Room(level, columns, numbers);
  }
  void Precondition(int level, int columns, DeviceNumbers numbers) override
  {
    if (left_-- <= 0)
    {
      throw std::runtime_error("the card fell off the bus");
    }
    cycles_->Precondition(level, columns, numbers);
  }
  double Seconds() const override { return 0.0; }
  std::size_t Memory() const override { return 0; }

private:
  std::unique_ptr<DeviceCycles> cycles_;
  int left_;
};

std::shared_ptr<const Device> Failing(int left)
{
  std::string whyNot;
  const auto device = FindDevice(whyNot);
  const auto failing = std::make_shared<Device>(*device);
  failing->name = "Card";
  failing->make = [device, left](const std::vector<DeviceLevel>& levels)
  { return std::make_unique<FailingCycles>(device->make(levels), left); };
  return failing;
}

TEST_F(DeviceTest, TheCpuGoesOnIfTheDeviceFails)
{
  const Discretization on = Discretize(Torus(64, 32, 1.0, 0.4), 5);
  UseDevice(Failing(2));
  const Multigrid multigrid = OnDevice(on);
  const Multigrid onCpu = Build(on, On(DeviceChoice::Cpu));
  const MultiVector expected = RandomValues(onCpu.Matrix().rows, 1);
  MultiVector b;
  Multiply(onCpu.Matrix(), expected, b);
  EXPECT_NE(Corrected(multigrid, b), Corrected(onCpu, b));
  MultiVector x = MultiVector::Zero(b.rows(), 1);
  SolveOptions options;
  options.tolerance = 1e-10;
  EXPECT_TRUE(SolveWithFallback(IterationType::ConjugateGradients, OperatorOf(multigrid),
    CycleWithFallback(multigrid), b, x, options)
                .converged);
  EXPECT_EQ(multigrid.OnDevice()->Failure(), "Card: the card fell off the bus");
  EXPECT_EQ(Corrected(multigrid, b), Corrected(onCpu, b));
}

/// A hierarchy in single precision keeps what it needs to go on.
TEST_F(DeviceTest, TheCpuGoesOnInSinglePrecision)
{
  const Discretization on = Discretize(Torus(64, 32, 1.0, 0.4), 5);
  const auto levels = [&]
  { return BuildMultigridLevels(ViewOf(on.space, on.system), Shift, 1.0, MultigridOptions()); };
  const auto applied = [](const BasicMultigrid<float>& multigrid)
  {
    const Vectors<float> r = RandomValues(multigrid.Matrix().rows, 3).cast<float>();
    Vectors<float> z;
    Apply(CyclePreconditioner<float>(multigrid, 0), r, z);
    return z;
  };
  const auto without = applied({ levels(), On(DeviceChoice::Cpu) });
  UseDevice(Failing(0));
  const BasicMultigrid<float> failing(levels(), On(DeviceChoice::Gpu));
  ASSERT_NE(failing.OnDevice(), nullptr);
  const auto with = applied(failing);
  EXPECT_LT((with - without).norm(), 1e-6 * without.norm());
}

/// Cycles that are no approximate inverse at all.
class WrongCycles : public FailingCycles
{
public:
  using FailingCycles::FailingCycles;

  void* Room(int level, int columns, DeviceNumbers numbers) override
  {
    room_ = FailingCycles::Room(level, columns, numbers);
    return room_;
  }
  void Precondition(int level, int columns, DeviceNumbers numbers) override
  {
    FailingCycles::Precondition(level, columns, numbers);
    *static_cast<double*>(room_) = -1.0;
  }

private:
  void* room_ = nullptr;
};

TEST_F(DeviceTest, SolvesGoOnInDoublePrecisionOnTheCpu)
{
  const Discretization on = Discretize(Torus(64, 32, 1.0, 0.4), 5);
  std::string whyNot;
  const auto device = FindDevice(whyNot);
  const auto wrong = std::make_shared<Device>(*device);
  wrong->make = [device](const std::vector<DeviceLevel>& levels)
  { return std::make_unique<WrongCycles>(device->make(levels), 1000); };
  UseDevice(wrong);
  const Multigrid multigrid = OnDevice(on);
  const MultiVector expected = RandomValues(multigrid.Matrix().rows, 1);
  MultiVector b;
  Multiply(multigrid.Matrix(), expected, b);
  MultiVector x = MultiVector::Zero(b.rows(), 1);
  SolveOptions options;
  options.tolerance = 1e-10;
  const SolveReport report = SolveWithFallback(IterationType::ConjugateGradients,
    OperatorOf(multigrid), CycleWithFallback(multigrid), b, x, options);
  EXPECT_TRUE(report.converged);
  EXPECT_GE(report.doubleSince, 0);
  EXPECT_EQ(report.where, "CPU: the solution needs double precision");
}

TEST_F(DeviceTest, ADeviceWithoutRoomIsNotUsed)
{
  const auto full = std::make_shared<Device>();
  full->name = "Card";
  full->make = [](const std::vector<DeviceLevel>&) -> std::unique_ptr<DeviceCycles>
  { throw std::runtime_error("out of memory"); };
  UseDevice(full);
  const Multigrid multigrid = Build(Discretize(Torus(64, 32, 1.0, 0.4), 5), On(DeviceChoice::Gpu));
  EXPECT_EQ(multigrid.OnDevice(), nullptr);
  EXPECT_EQ(multigrid.WhyNotOnDevice(), "Card: out of memory");
}

TEST(Device, ALibraryThatIsNoDeviceSaysSo)
{
  std::string whyNot;
  EXPECT_EQ(OpenDevice("/no/such/library.so", whyNot), nullptr);
  EXPECT_EQ(whyNot, "this installation has no GPU library");
}

} // namespace
} // namespace gridfem
