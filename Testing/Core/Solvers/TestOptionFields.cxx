// Every field of a solver's options is named once, and counts in the keys of stages.
#include "EachOption.h"
#include "Solvers/CurvatureSolver.h"
#include "Solvers/DetailSolver.h"
#include "Solvers/DiffusionSolver.h"
#include "Solvers/DistanceSolver.h"
#include "Solvers/FarthestPointsSolver.h"
#include "Solvers/FlowSolver.h"
#include "Solvers/GaussianFieldSolver.h"
#include "Solvers/GradientSolver.h"
#include "Solvers/InterpolationSolver.h"
#include "Solvers/PathSolver.h"
#include "Solvers/PoissonSolver.h"
#include "Solvers/SignatureSolver.h"
#include "Solvers/SpectrumSolver.h"
#include "Solvers/StitchSolver.h"

#include <gtest/gtest.h>

#include <cmath>

using namespace gridfem;
using namespace gridfem::testing;

namespace
{

struct Forgetful
{
  double named = 1.0;
  bool forgotten = false;

  template<class Self, class Visit>
  static void ForEach(Self& self, Visit&& visit)
  {
    visit("Named", self.named, AtLeast(0.0));
  }
};

template<class Options>
class OptionFields : public ::testing::Test
{
};

using AllOptions = ::testing::Types<CurvatureSolver::Options, DetailSolver::Options,
  DiffusionSolver::Options, DistanceSolver::Options, FarthestPointsSolver::Options,
  FlowSolver::Options, GaussianFieldSolver::Options, GradientSolver::Options,
  InterpolationSolver::Options, PathSolver::Options, PoissonSolver::Options,
  SignatureSolver::Options, SpectrumSolver::Options, StitchSolver::Options>;
TYPED_TEST_SUITE(OptionFields, AllOptions);

} // namespace

TEST(OptionFields, AForgottenFieldIsSeen)
{
  EXPECT_EQ(NumberOfFields<Forgetful>(), 2);
  EXPECT_EQ(NumberOfNamedFields<Forgetful>(), 1);
}

TYPED_TEST(OptionFields, NameAllFields)
{
  EXPECT_EQ(NumberOfNamedFields<TypeParam>(), NumberOfFields<TypeParam>());
}

TYPED_TEST(OptionFields, ChangeTheKeyEach)
{
  const TypeParam options;
  const StageKey key = KeyOfOptions(options);
  EXPECT_TRUE(key == KeyOfOptions(options));
  for (const auto& [name, changed] : EachChanged(options))
  {
    EXPECT_TRUE(key != KeyOfOptions(changed)) << name;
  }
}

TYPED_TEST(OptionFields, DefaultsAreAllowed)
{
  EXPECT_NO_THROW(RequireOptions(TypeParam()));
}

TEST(OptionFields, RefuseNumbersOutOfRange)
{
  PoissonSolver::Options options;
  options.screeningWeight = -1.0;
  EXPECT_THROW(RequireOptions(options), InvalidInput);
  options.screeningWeight = std::nan("");
  EXPECT_THROW(RequireOptions(options), InvalidInput);
  options = {};
  options.gradientScale = std::numeric_limits<double>::infinity();
  EXPECT_THROW(RequireOptions(options), InvalidInput);
  options = {};
  options.equation.solve.tolerance = std::nan("");
  EXPECT_THROW(RequireOptions(options), InvalidInput);
}
