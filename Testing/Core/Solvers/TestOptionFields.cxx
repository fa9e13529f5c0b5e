// Every field of a solver's options is named once, and counts in the keys of stages.
#include "EachOption.h"
#include "Solvers/CurvatureSolver.h"
#include "Solvers/DetailSolver.h"
#include "Solvers/DiffusionSolver.h"
#include "Solvers/DistanceSolver.h"
#include "Solvers/DynamicsSolver.h"
#include "Solvers/FarthestPointsSolver.h"
#include "Solvers/FlowSolver.h"
#include "Solvers/FunctionalMapSolver.h"
#include "Solvers/GaussianFieldSolver.h"
#include "Solvers/GradientSolver.h"
#include "Solvers/InterpolationSolver.h"
#include "Solvers/ParameterizationSolver.h"
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
  DiffusionSolver::Options, DistanceSolver::Options, DynamicsSolver::Options,
  FarthestPointsSolver::Options, FlowSolver::Options, FunctionalMapSolver::Options,
  GaussianFieldSolver::Options, GradientSolver::Options, InterpolationSolver::Options,
  ParameterizationSolver::Options, PathSolver::Options, PoissonSolver::Options,
  SignatureSolver::Options, SpectrumSolver::Options, StitchSolver::Options>;
TYPED_TEST_SUITE(OptionFields, AllOptions);

} // namespace

TEST(OptionFields, AForgottenFieldIsSeen)
{
  EXPECT_EQ(NumberOfFields<Forgetful>(), 2);
  EXPECT_EQ(NumberOfNamedFields<Forgetful>(), 1);
}

/// An equation names all fields of its three structs, except for the structs themselves, the number
/// of threads, and a measure of the caller's own.
TEST(OptionFields, AnEquationNamesItsFieldsAndEachChangesItsKey)
{
  int named = 0;
  EquationOptions equation;
  option_fields::ForEachOf(equation, option_fields::Count{ named });
  EXPECT_EQ(named, NumberOfFields<EquationOptions>() - 2 + NumberOfFields<MultigridOptions>() - 1 +
                     NumberOfFields<SolveOptions>() - 1);
  const StageKey key = KeyOf(equation);
  for (int field = 0; field < named; ++field)
  {
    std::string name;
    EquationOptions changed;
    option_fields::ForEachOf(changed, ChangeField(field, name));
    EXPECT_TRUE(key != KeyOf(changed)) << name;
  }
  equation.multigrid.threads = 3;
  EXPECT_TRUE(key == KeyOf(equation));
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

/// Gives each number a value outside of its range.
struct Exceed
{
  int field;
  std::string& name;

  template<class Value>
  void operator()(const char* ofField, Value& value, const Range& range)
  {
    constexpr bool isNumber =
      !std::is_same_v<Value, bool> && (std::is_arithmetic_v<Value> || std::is_enum_v<Value>);
    if constexpr (isNumber)
    {
      if (field-- == 0)
      {
        name = ofField;
        const bool hasMost = range.most < 1e9;
        value = static_cast<Value>(hasMost ? range.most + 1.0 : range.least - 1.0);
        if constexpr (std::is_same_v<Value, double>)
        {
          value = hasMost || range.least > -1e9 ? value : std::numeric_limits<double>::infinity();
        }
      }
    }
  }

  void operator()(EquationOptions& equation) { option_fields::ForEachOf(equation, *this); }
};

TYPED_TEST(OptionFields, EachNumberOutOfRangeIsRefusedByItsLabel)
{
  for (int field = 0;; ++field)
  {
    std::string name;
    TypeParam options;
    TypeParam::ForEach(options, Exceed{ field, name });
    if (name.empty())
    {
      break;
    }
    if (name == "InsideLabel" || name == "ReferenceLabel")
    {
      continue; // any integer
    }
    try
    {
      RequireOptions(options);
      ADD_FAILURE() << name;
    }
    catch (const InvalidInput& error)
    {
      EXPECT_EQ(std::string(error.what()).find(LabelOf(name) + " is "), 0u) << error.what();
    }
  }
}

TEST(LabelOf, PutsSpacesBetweenWords)
{
  EXPECT_EQ(LabelOf("ScreeningWeight"), "Screening Weight");
  EXPECT_EQ(LabelOf("NumberOfModes"), "Number Of Modes");
  EXPECT_EQ(LabelOf("Depth"), "Depth");
  EXPECT_EQ(LabelOf("Time Step"), "Time Step");
}

TEST(RequireInRange, TellsValueAndRange)
{
  const auto message = [](double value, double least, double most)
  {
    try
    {
      RequireInRange("NumberOfSteps", value, least, most);
    }
    catch (const InvalidInput& error)
    {
      return std::string(error.what());
    }
    return std::string();
  };
  constexpr double Infinity = std::numeric_limits<double>::infinity();
  EXPECT_EQ(message(1.0, 1.0, 4.0), "");
  EXPECT_EQ(message(4.0, 1.0, 4.0), "");
  EXPECT_EQ(message(0.5, 1.0, 4.0), "Number Of Steps is 0.5; it must be from 1 to 4.");
  EXPECT_EQ(message(-2.0, 0.0, Infinity), "Number Of Steps is -2; it must be 0 or more.");
  EXPECT_EQ(message(Infinity, -Infinity, Infinity), "Number Of Steps is inf; it must be finite.");
  EXPECT_EQ(message(std::nan(""), 0.0, 1.0), "Number Of Steps is not a number.");
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
