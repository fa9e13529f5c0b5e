// Properties that every options struct of a solver and every solver have.
#ifndef GridFEM_Testing_EachOption_h
#define GridFEM_Testing_EachOption_h

#include "Solvers/OptionFields.h"

#include <algorithm>
#include <string>
#include <type_traits>
#include <utility>
#include <vector>

namespace gridfem::testing
{

/// Converts to the type of any field of an aggregate.
struct AnyField
{
  template<class Value>
  operator Value() const;
};

template<class Struct, class Indices, class = void>
struct TakesFields : std::false_type
{
};

template<class Struct, std::size_t... Index>
struct TakesFields<Struct, std::index_sequence<Index...>,
  std::void_t<decltype(Struct{ (static_cast<void>(Index), AnyField{})... })>> : std::true_type
{
};

/// How many fields an aggregate has, up to 40.
template<class Struct, std::size_t Count = 40>
constexpr int NumberOfFields()
{
  if constexpr (TakesFields<Struct, std::make_index_sequence<Count>>::value)
  {
    return static_cast<int>(Count);
  }
  else
  {
    static_assert(Count > 0);
    return NumberOfFields<Struct, Count - 1>();
  }
}

/// Gives one field of an options struct another value in its range, and notes its name.
class ChangeField
{
public:
  ChangeField(int field, std::string& name) : field_(field), name_(name) {}

  template<class Value>
  void operator()(const char* name, Value& value, const Range& range)
  {
    if (field_-- != 0)
    {
      return;
    }
    name_ = name;
    if constexpr (std::is_same_v<Value, bool>)
    {
      value = !value;
    }
    else if constexpr (std::is_same_v<Value, double>)
    {
      value = value == 0.0 ? std::min(0.5, range.most) : 0.5 * value;
    }
    else if constexpr (std::is_enum_v<Value> || std::is_integral_v<Value>)
    {
      const int next = static_cast<int>(value) + 1;
      value = static_cast<Value>(next <= range.most ? next : next - 2);
    }
  }

  void operator()(EquationOptions& equation)
  {
    if (field_-- == 0)
    {
      name_ = "the equation";
      equation.solve.tolerance = 0.5;
      equation.accuracy = 0.0;
    }
  }

private:
  int field_;
  std::string& name_;
};

/// The options with each of their fields changed, one after the other, by the field's name.
template<class Options>
std::vector<std::pair<std::string, Options>> EachChanged(const Options& options)
{
  std::vector<std::pair<std::string, Options>> all;
  for (int field = 0; field < NumberOfNamedFields<Options>(); ++field)
  {
    std::string name;
    Options changed = options;
    Options::ForEach(changed, ChangeField(field, name));
    all.emplace_back(name, changed);
  }
  return all;
}

} // namespace gridfem::testing

#endif
