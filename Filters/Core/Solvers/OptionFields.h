// Lists the fields of an options struct with their names, defaults and ranges. Stage keys, range
// checks and the properties in Python come from this list.
#ifndef GridFEM_OptionFields_h
#define GridFEM_OptionFields_h

#include "Equations/Poisson.h"
#include "Solvers/Requirements.h"
#include "Solvers/StageKey.h"

#include <limits>
#include <type_traits>

namespace gridfem
{

/// The values that an option may have. Others are refused.
struct Range
{
  double least = -std::numeric_limits<double>::infinity();
  double most = std::numeric_limits<double>::infinity();
};

constexpr Range AtLeast(double least)
{
  return { least, std::numeric_limits<double>::infinity() };
}

constexpr Range Within(double least, double most)
{
  return { least, most };
}

/// Any finite number.
constexpr Range Finite()
{
  return { std::numeric_limits<double>::lowest(), std::numeric_limits<double>::max() };
}

/// The range of a switch or of a list of ids: any value.
constexpr Range AnyValue()
{
  return {};
}

/// An equation whose iteration ends when its estimated algebraic error is a tenth of the space's
/// error.
inline EquationOptions EndedByAccuracy()
{
  EquationOptions equation;
  equation.solve.tolerance = 0.0;
  equation.solve.maximumIterations = 200;
  equation.accuracy = 0.1;
  return equation;
}

/// An equation whose iteration ends at a tolerance.
inline EquationOptions EndedByTolerance(double tolerance)
{
  EquationOptions equation;
  equation.solve.tolerance = tolerance;
  equation.solve.maximumIterations = 200;
  return equation;
}

/// An options struct names all its fields in a static function template:
///
///   template<class Self, class Visit>
///   static void ForEach(Self& self, Visit&& visit)
///   {
///     visit("ScreeningWeight", self.screeningWeight, AtLeast(0.0));
///     visit(self.equation);
///   }
///
/// The properties in VTK and ParaView have the same names. TestOptionFields refuses a struct with a
/// field that ForEach leaves out.
namespace option_fields
{

/// Does the same for an equation. The number of threads changes no bit of the solution, and a
/// measure of the caller's own cannot be compared.
template<class Equation, class Visit>
void ForEachOf(Equation& equation, Visit&& visit)
{
  auto& multigrid = equation.multigrid;
  visit("Cycle", multigrid.cycle, Within(0, 1));
  visit("Smoother", multigrid.smoother, Within(0, 2));
  visit("PreSweeps", multigrid.preSweeps, AtLeast(0));
  visit("PostSweeps", multigrid.postSweeps, AtLeast(0));
  visit("Precision", multigrid.precision, Within(0, 2));
  visit("SweepsPerSynchronization", multigrid.sweepsPerSynchronization, AtLeast(1));
  visit("Device", multigrid.device, Within(0, 2));
  auto& solve = equation.solve;
  visit("Tolerance", solve.tolerance, AtLeast(0.0));
  visit("MaximumIterations", solve.maximumIterations, AtLeast(0));
  visit("Measure", solve.measure, Within(0, 1));
  visit("GiveUp", solve.giveUp, Within(0, 2));
  visit("Accuracy", equation.accuracy, Within(0.0, 1.0));
}

struct AddToKey
{
  StageKey& key;

  template<class Value>
  void operator()(const char* /*name*/, const Value& value, const Range& /*range*/) const
  {
    key.Add(value);
  }

  void operator()(const EquationOptions& equation) const { ForEachOf(equation, *this); }
};

struct Require
{
  template<class Value>
  void operator()(const char* name, const Value& value, const Range& range) const
  {
    if constexpr (!std::is_same_v<Value, bool> &&
                  (std::is_arithmetic_v<Value> || std::is_enum_v<Value>))
    {
      RequireInRange(name, static_cast<double>(value), range.least, range.most);
    }
  }

  void operator()(const EquationOptions& equation) const { ForEachOf(equation, *this); }
};

struct Count
{
  int& fields;

  template<class Value>
  void operator()(const char* /*name*/, const Value& /*value*/, const Range& /*range*/) const
  {
    ++fields;
  }

  void operator()(const EquationOptions& /*equation*/) const { ++fields; }
};

} // namespace option_fields

/// The key of all options of an equation that affect its solution.
inline StageKey KeyOf(const EquationOptions& equation)
{
  StageKey key;
  option_fields::AddToKey{ key }(equation);
  return key;
}

/// The key of all fields.
template<class Options>
StageKey KeyOfOptions(const Options& options)
{
  StageKey key;
  Options::ForEach(options, option_fields::AddToKey{ key });
  return key;
}

/// Throws InvalidInput for a number that is NaN or out of range. The message has the label of the
/// option.
template<class Options>
void RequireOptions(const Options& options)
{
  Options::ForEach(options, option_fields::Require{});
}

/// How many fields ForEach names.
template<class Options>
int NumberOfNamedFields()
{
  int fields = 0;
  const Options options;
  Options::ForEach(options, option_fields::Count{ fields });
  return fields;
}

} // namespace gridfem

#endif
