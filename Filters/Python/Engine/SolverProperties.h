// The options of a solver as properties with the names, defaults and ranges that its struct has.
#ifndef GridFEM_SolverProperties_h
#define GridFEM_SolverProperties_h

#include "Properties.h"

#include "Solvers/OptionFields.h"
#include "Solvers/SurfaceOptions.h"

#include <type_traits>

namespace gridfem
{

struct TakeProperty
{
  Properties& properties;

  template<class Value>
  void operator()(const char* name, Value& value, const Range& range) const
  {
    if constexpr (std::is_same_v<Value, bool>)
    {
      value = properties.Switch(name, value);
    }
    else if constexpr (std::is_enum_v<Value> || std::is_integral_v<Value>)
    {
      value = static_cast<Value>(properties.Integer(name, static_cast<int>(value),
        static_cast<int>(range.least), static_cast<int>(range.most)));
    }
    else if constexpr (std::is_same_v<Value, double>)
    {
      value = properties.Number(name, value, range.least, range.most);
    }
  }

  /// A default tolerance of 0 means that the wanted accuracy decides.
  void operator()(EquationOptions& equation) const;
};

/// Replaces the defaults of a solver's options by the properties that are given. Throws
/// InvalidInput for a value that is refused.
template<class Options>
void TakeOptions(Properties& properties, Options& options)
{
  Options::ForEach(options, TakeProperty{ properties });
}

/// The properties of the surface that all solvers share.
void TakeSurfaceOptions(Properties& properties, SurfaceOptions& options, double leastStabilization);

} // namespace gridfem

#endif
